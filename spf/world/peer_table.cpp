#include "spf/world/peer_table.hpp"

#include <algorithm>
#include <cmath>

namespace spf {
namespace {

bool finite(const Trajectory& trajectory) {
  const HeadingState heading = trajectory.heading().state(trajectory.start_time());
  if (!std::isfinite(trajectory.start_time()) || !std::isfinite(heading.heading) ||
      !std::isfinite(heading.yaw_rate)) {
    return false;
  }
  for (int k = 0; k < trajectory.piece_count(); ++k) {
    const QuinticPiece& piece = trajectory.piece(k);
    const bool usable =
        piece.coefficients.allFinite() && std::isfinite(piece.duration) && piece.duration > 0.0;
    if (!usable) return false;
  }
  return true;
}

}  // namespace

PeerTable::PeerTable(int own_id, const PeerTableParameters& parameters)
    : own_id_{own_id}, parameters_{validated(parameters)} {}

MessageVerdict PeerTable::receive(const TrajectoryMessage& message, double now) {
  const MessageVerdict verdict = judge(message, now);
  ++counts_[static_cast<std::size_t>(verdict)];
  if (verdict != MessageVerdict::accepted) return verdict;

  auto place = std::lower_bound(entries_.begin(), entries_.end(), message.robot_id,
                                [](const Entry& entry, int id) { return entry.peer.robot_id < id; });
  if (place == entries_.end() || place->peer.robot_id != message.robot_id) place = entries_.emplace(place);
  place->sequence = message.sequence;
  place->expiry_time = std::min(message.expiry_time, now + parameters_.silence);
  Peer& peer = place->peer;
  peer.robot_id = message.robot_id;
  peer.priority = message.priority;
  peer.state = message.state;
  peer.radius = message.radius;
  peer.position_sigma = message.position_sigma;
  peer.received_time = now;
  peer.expired = false;
  peer.growth = 0.0;
  peer.trajectory = message.trajectory;
  return verdict;
}

MessageVerdict PeerTable::judge(const TrajectoryMessage& message, double now) const {
  if (message.robot_id == own_id_) return MessageVerdict::own;
  if (!well_formed(message, now)) return MessageVerdict::malformed;
  const Entry* known = find(message.robot_id);
  if (!known || now > known->expiry_time) return MessageVerdict::accepted;
  if (message.sequence == known->sequence) return MessageVerdict::duplicate;
  // Counted on a circle, so that a sequence may run over its end.
  const bool newer = static_cast<std::int32_t>(message.sequence - known->sequence) > 0;
  return newer ? MessageVerdict::accepted : MessageVerdict::old;
}

bool PeerTable::well_formed(const TrajectoryMessage& message, double now) const {
  const bool numbers = std::isfinite(now) && std::isfinite(message.sent_time) &&
                       std::isfinite(message.expiry_time) && message.radius > 0.0 &&
                       message.radius <= parameters_.largest_radius && message.position_sigma >= 0.0 &&
                       std::isfinite(message.position_sigma);
  if (!numbers || message.trajectory.empty() || !finite(message.trajectory)) return false;
  const double latest = now + parameters_.clock_tolerance;
  return message.sent_time <= latest && message.trajectory.start_time() <= latest &&
         message.sent_time >= now - parameters_.oldest_message && message.expiry_time >= message.sent_time;
}

const PeerTable::Entry* PeerTable::find(int robot_id) const {
  const auto place = std::lower_bound(entries_.begin(), entries_.end(), robot_id,
                                      [](const Entry& entry, int id) { return entry.peer.robot_id < id; });
  return place != entries_.end() && place->peer.robot_id == robot_id ? &*place : nullptr;
}

const std::vector<Peer>& PeerTable::peers(double now) {
  const auto forgotten = [&](const Entry& entry) {
    return now > entry.expiry_time + parameters_.forget_time;
  };
  entries_.erase(std::remove_if(entries_.begin(), entries_.end(), forgotten), entries_.end());
  peers_.clear();
  for (Entry& entry : entries_) {
    Peer& peer = entry.peer;
    if (!peer.expired && now > entry.expiry_time) {
      // The last known place is where the peer said it would be when its word ran out.
      peer.expired = true;
      constexpr double kLong = 1.0;  // [s] any duration will do: a trajectory stands at its ends
      peer.trajectory =
          Trajectory::standing(peer.trajectory.position(entry.expiry_time), entry.expiry_time, kLong);
    }
    if (peer.expired) {
      peer.growth = std::min(parameters_.growth_rate * (now - entry.expiry_time), parameters_.largest_growth);
    }
    peers_.push_back(peer);
  }
  return peers_;
}

}  // namespace spf
