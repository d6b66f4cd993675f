#include "host/peer_watch.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <limits>
#include <utility>

namespace spf::host {
namespace {

constexpr double kComplaintTime = 5.0;  // [s] for which a complaint stands
constexpr std::size_t kMostComplaints = 32;
constexpr double kMostAround = 1.0;  // [m] that a clock may add to a peer
constexpr double kSameTime = 1e-6;   // [s] messages keep nanoseconds
constexpr std::size_t kMostSent = 64;
constexpr double kOwnPast =
    10.0;  // [s] what was told before the start may come so late, and older is refused

/// Always goes first, and is larger by what it may be away from where it says.
HeardMessage as_of_stranger(const TrajectoryMessage& message, double clock_error) {
  TrajectoryMessage stranger = message;
  stranger.priority = std::numeric_limits<int>::min();
  stranger.claim.reset();  // dated by another clock, and no turn could be agreed with it
  stranger.radius += std::min(std::abs(clock_error) * message.trajectory.max_speed(), kMostAround);
  return stranger;
}

std::string clock_text(double error) {
  char text[96];
  if (error > 0.0)
    std::snprintf(text, sizeof text, "its clock is %.1f s ahead", error);
  else
    std::snprintf(text, sizeof text, "its clock is %.1f s behind, or its messages come so late", -error);
  return text;
}

}  // namespace

void PeerWatch::told(const TrajectoryMessage& message) {
  if (sent_.empty()) return;
  sent_[next_sent_] = {message.sequence, message.sent_time};
  next_sent_ = (next_sent_ + 1) % sent_.size();
}

bool PeerWatch::is_own(const TrajectoryMessage& message, double now) const {
  if (!begun_ || (message.sent_time <= *begun_ && now - *begun_ < kOwnPast)) return true;
  return std::any_of(sent_.begin(), sent_.end(), [&](const Sent& sent) {
    return sent.sequence == message.sequence && std::abs(sent.time - message.sent_time) <= kSameTime;
  });
}

std::optional<HeardMessage> PeerWatch::admitted(const HeardMessage& message, double now) {
  if (!begun_) begun_ = now;
  sent_.resize(kMostSent);
  if (message->robot_id == own_id_) {
    if (is_own(message, now)) return std::nullopt;
    if (complaints_.count({own_id_, PeerFault::same_number}) == 0)
      complain(own_id_, PeerFault::same_number, "another robot has this number", now);
    else
      complaints_[{own_id_, PeerFault::same_number}].time = now;
    TrajectoryMessage namesake = message;
    namesake.robot_id = kNamesake;
    return as_of_stranger(namesake, 0.0);
  }
  clocks_.hear(message->robot_id, message->sent_time, now);
  const double error = clocks_.error(message->robot_id, now);
  if (error == 0.0) return message;
  return as_of_stranger(message, error);
}

void PeerWatch::complain(int robot_id, PeerFault fault, const std::string& text, double now) {
  for (auto complaint = complaints_.begin(); complaint != complaints_.end();) {
    const bool past =
        now - complaint->second.time > kComplaintTime || complaint->second.time > now + kComplaintTime;
    complaint = past ? complaints_.erase(complaint) : std::next(complaint);
  }
  const std::pair<int, PeerFault> key{robot_id, fault};
  if (complaints_.size() >= kMostComplaints && complaints_.count(key) == 0) return;
  complaints_[key] = {text, now};
}

std::vector<int> PeerWatch::distrusted(const std::vector<Peer>& peers, double time) const {
  std::vector<int> doubted;
  for (const Peer& peer : peers) {
    const bool trusted = peer.robot_id != kNamesake && witness_.trusts(peer.robot_id, time) &&
                         clocks_.error(peer.robot_id, time) == 0.0;
    if (!trusted) doubted.push_back(peer.robot_id);
  }
  return doubted;
}

std::vector<PeerComplaint> PeerWatch::complaints(double now) const {
  std::vector<PeerComplaint> all;
  for (const auto& [robot_id, error] : clocks_.errors(now))
    all.push_back({robot_id, PeerFault::clock, clock_text(error)});
  for (const auto& [key, told] : complaints_)
    if (std::abs(now - told.time) <= kComplaintTime) all.push_back({key.first, key.second, told.text});
  std::stable_sort(all.begin(), all.end(), [](const PeerComplaint& one, const PeerComplaint& other) {
    return one.robot_id < other.robot_id;
  });
  return all;
}

void PeerWatch::add_to(Health& health, double now) const {
  for (const PeerComplaint& complaint : complaints(now))
    worsen(health, complaint.fault == PeerFault::malformed ? Level::warn : Level::error,
           "robot " + std::to_string(complaint.robot_id) + ": " + complaint.text);
}

void PeerWatch::forget() {
  witness_.forget();
  clocks_.forget();
  complaints_.clear();
  begun_.reset();
}

}  // namespace spf::host
