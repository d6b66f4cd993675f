#include "spf/world/peer_table.hpp"

#include <algorithm>
#include <cmath>

#include "spf/math/believable.hpp"

namespace spf {
namespace {

constexpr double kOldestMessage = 10.0;  // [s] messages sent longer ago are malformed
constexpr double kLargestRadius = 10.0;  // [m] so are those of larger robots
constexpr double kStill = 0.3;           // [1] of a peer's radius: if it moves less, it stands

}  // namespace

PeerTable::PeerTable(int own_id, const PeerTableParameters& parameters)
    : own_id_{own_id}, parameters_{validated(parameters)} {}

MessageVerdict PeerTable::receive(const HeardMessage& heard, double now) {
  const TrajectoryMessage& message = heard;
  MessageVerdict verdict = judge(heard, now);
  const bool believed = verdict == MessageVerdict::accepted;
  if (believed && entries_.count(message.robot_id) == 0 && !make_room(now)) verdict = MessageVerdict::crowded;
  ++counts_[static_cast<std::size_t>(verdict)];
  if (verdict != MessageVerdict::accepted) return verdict;

  const auto [slot, is_new] = entries_.try_emplace(message.robot_id);
  Entry& entry = slot->second;
  entry.sequence = message.sequence;
  entry.expiry_time = std::min(message.expiry_time, now + parameters_.silence);
  Peer& peer = entry.peer;
  peer.robot_id = message.robot_id;
  peer.priority = message.priority;
  peer.state = message.state;
  peer.radius = message.radius;
  peer.position_sigma = message.position_sigma;
  peer.received_time = now;
  peer.expired = false;
  peer.growth = 0.0;
  peer.trajectory = heard.trajectory();
  peer.claim = heard->claim ? &*heard->claim : nullptr;
  watch_standing(entry, is_new, now);
  return verdict;
}

void PeerTable::watch_standing(Entry& entry, bool is_new, double now) {
  Peer& peer = entry.peer;
  const Eigen::Vector2d here = peer.position(now);
  const bool stands = peer.state == PeerState::stopped || peer.state == PeerState::arrived;
  if (is_new || !stands || now < entry.still_since || (here - entry.stood_at).norm() > kStill * peer.radius) {
    entry.stood_at = here;
    entry.still_since = now;
  }
  peer.stood = now - entry.still_since;
}

MessageVerdict PeerTable::judge(const HeardMessage& heard, double now) const {
  const TrajectoryMessage& message = heard;
  if (message.robot_id == own_id_) return MessageVerdict::own;
  if (!heard.usable() || !well_formed(message, now)) return MessageVerdict::malformed;
  const auto entry = entries_.find(message.robot_id);
  if (entry == entries_.end() || now > entry->second.expiry_time) return MessageVerdict::accepted;
  const Entry& known = entry->second;
  if (message.sequence == known.sequence) return MessageVerdict::duplicate;
  // Modulo 2^32, so that a sequence may wrap around.
  const bool newer = static_cast<std::int32_t>(message.sequence - known.sequence) > 0;
  return newer ? MessageVerdict::accepted : MessageVerdict::old;
}

bool PeerTable::well_formed(const TrajectoryMessage& message, double now) const {
  const bool numbers = std::isfinite(now) && std::isfinite(message.sent_time) &&
                       std::isfinite(message.expiry_time) && message.radius > 0.0 &&
                       message.radius <= kLargestRadius && message.position_sigma >= 0.0 &&
                       believable(message.position_sigma);
  if (!numbers || (message.claim && !believable(*message.claim))) return false;
  const double latest = now + parameters_.clock_tolerance;
  return message.sent_time <= latest && message.trajectory.start_time() <= latest &&
         message.sent_time >= now - kOldestMessage && message.expiry_time >= message.sent_time;
}

/// Whether one more sender fits, if need be by dropping the one that expired first.
bool PeerTable::make_room(double now) {
  if (entries_.size() < kMostPeers) return true;
  const auto first = std::min_element(entries_.begin(), entries_.end(), [](const auto& a, const auto& b) {
    return a.second.expiry_time < b.second.expiry_time;
  });
  if (now <= first->second.expiry_time) return false;
  entries_.erase(first);
  return true;
}

const std::vector<Peer>& PeerTable::peers(double now) {
  peers_.clear();
  for (auto slot = entries_.begin(); slot != entries_.end();) {
    Entry& entry = slot->second;
    if (now > entry.expiry_time + parameters_.forget_time) {
      slot = entries_.erase(slot);
      continue;
    }
    ++slot;
    Peer& peer = entry.peer;
    if (!peer.expired && now > entry.expiry_time) {
      // The last known position is where the peer's plan puts it at the expiry time.
      peer.expired = true;
      peer.claim = nullptr;
      constexpr double kLong = 1.0;  // [s] any duration will do: a trajectory rests at its ends
      peer.trajectory =
          Trajectory::standing(peer.trajectory->position(entry.expiry_time), entry.expiry_time, kLong);
    }
    if (peer.expired) {
      peer.growth = std::min(parameters_.growth_rate * (now - entry.expiry_time), parameters_.largest_growth);
    }
    peers_.push_back(peer);
  }
  return peers_;
}

}  // namespace spf
