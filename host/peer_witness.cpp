#include "host/peer_witness.hpp"

#include <algorithm>
#include <cmath>

#include "spf/math/angles.hpp"
#include "spf/world/peer_table.hpp"

namespace spf::host {
namespace {

constexpr double kSilence = 2.0;    // [s] after which a peer is a new one
constexpr double kProbation = 1.0;  // [s] for which a new peer masks nothing
constexpr double kMemory = 1.0;     // [s] time constant of its jumps
constexpr double kMostJumps = 1.0;  // [radii] honest plans join; braking that is heard late differs by less
constexpr double kDoubt = 2.0;      // [s] for which a peer that was not there is not believed
constexpr double kMiddle = 0.3;     // [1] of its radius: errors of poses and clocks stay below

}  // namespace

void PeerWitness::add_message(const TrajectoryMessage& message, double now) {
  if (message.trajectory.empty()) return;
  if (known_.count(message.robot_id) == 0 && !make_room(now)) return;  // and is not trusted
  const auto [entry, is_new] = known_.try_emplace(message.robot_id);
  Record& record = entry->second;
  if (is_new || now - record.last_heard > kSilence) {
    record.first_heard = now;
    record.jumps = 0.0;
  } else {
    const double jump =
        (message.trajectory.position(now) - record.said.position(now)).norm() / message.radius;
    record.jumps = jump + record.jumps * std::exp(-(now - record.last_heard) / kMemory);
  }
  record.last_heard = now;
  record.said = message.trajectory;
}

/// Whether one more peer fits, if need be for the one that has been silent longest.
bool PeerWitness::make_room(double now) {
  if (known_.size() < kMostPeers) return true;
  const auto silent = std::min_element(known_.begin(), known_.end(), [](const auto& a, const auto& b) {
    return a.second.last_heard < b.second.last_heard;
  });
  if (now - silent->second.last_heard <= kSilence) return false;
  known_.erase(silent);
  return true;
}

void PeerWitness::add_scan(const RangeScan& scan, const Pose2& pose_world, double time,
                           const std::vector<Peer>& peers) {
  if (scan.ranges.empty() || scan.angle_increment == 0.0) return;
  for (const Peer& peer : peers) {
    const auto entry = known_.find(peer.robot_id);
    if (entry == known_.end()) continue;
    const Eigen::Vector2d offset = peer.position(time) - pose_world.position_world;
    const double distance = offset.norm();
    if (distance <= peer.radius || distance + peer.radius > scan.max_range) continue;
    double angle = wrap_angle(std::atan2(offset.y(), offset.x()) - pose_world.heading - scan.angle_min);
    if (angle / scan.angle_increment < -0.5) angle += scan.angle_increment > 0.0 ? 2.0 * kPi : -2.0 * kPi;
    const double beam = std::round(angle / scan.angle_increment);
    if (!(beam >= 0.0 && beam < static_cast<double>(scan.ranges.size()))) continue;  // not in view
    const double miss = std::abs(beam * scan.angle_increment - angle) * distance;
    const bool passes = scan.ranges[static_cast<std::size_t>(beam)] > distance + peer.radius;
    if (miss < kMiddle * peer.radius && passes) entry->second.contradicted = time;
  }
}

bool PeerWitness::trusts(int robot_id, double now) const {
  const auto entry = known_.find(robot_id);
  if (entry == known_.end()) return false;
  const Record& record = entry->second;
  return now - record.first_heard >= kProbation && record.jumps <= kMostJumps &&
         now - record.contradicted >= kDoubt;
}

}  // namespace spf::host
