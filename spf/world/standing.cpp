#include "spf/world/standing.hpp"

#include <algorithm>

namespace spf {
namespace {

constexpr double kTrackStands = 3.0;    // [s] at one position
constexpr double kPeerStands = 5.0;     // [s] likewise: a robot that gives way goes on soon
constexpr double kArrivedWait = 30.0;   // [s] at least, for who says that it stays
constexpr double kLongestWait = 600.0;  // [s]
constexpr double kMuchLonger = 2.0;     // [1]
constexpr double kStays = 0.7;          // [1] likewise, of one that is known
constexpr double kLeast = 0.05;         // [m] and that much more
constexpr double kElsewhere = 0.3;      // [1] of the radius

bool less(const StandingDisc& a, const StandingDisc& b) {
  return a.position_world.x() != b.position_world.x() ? a.position_world.x() < b.position_world.x()
                                                      : a.position_world.y() < b.position_world.y();
}

bool same(const StandingDisc& a, const StandingDisc& b) {
  const double gap = (a.position_world - b.position_world).norm();
  return gap < kElsewhere * b.radius ||
         (a.id == b.id && a.is_peer == b.is_peer && gap < kStays * b.radius + kLeast);
}

}  // namespace

void keep_nearest(const Eigen::Vector2d& here_world, std::vector<StandingDisc>& discs) {
  if (discs.size() <= kMostStanding) return;
  const auto nearer = [&](const StandingDisc& a, const StandingDisc& b) {
    const double gap_a = (a.position_world - here_world).squaredNorm();
    const double gap_b = (b.position_world - here_world).squaredNorm();
    return gap_a != gap_b ? gap_a < gap_b : less(a, b);
  };
  std::nth_element(discs.begin(), discs.begin() + kMostStanding, discs.end(), nearer);
  discs.resize(kMostStanding);
  std::sort(discs.begin(), discs.end(), less);
}

void find_standing(const WorldSnapshot& world, std::vector<StandingDisc>& discs) {
  discs.clear();
  if (world.tracks != nullptr) {
    for (const ObstacleTrack& track : *world.tracks) {
      if (track.stood < kTrackStands) continue;
      discs.push_back({track.state.position_world, track.state.radius, std::min(track.stood, kLongestWait),
                       track.id, false});
    }
  }
  if (world.peers != nullptr) {
    for (const Peer& peer : *world.peers) {
      const bool arrived = peer.state == PeerState::arrived;
      if (peer.expired || (!arrived && peer.stood < kPeerStands)) continue;
      discs.push_back({peer.position(world.time), peer.radius,
                       std::min(std::max(peer.stood, arrived ? kArrivedWait : 0.0), kLongestWait),
                       peer.robot_id, true});
    }
  }
  std::sort(discs.begin(), discs.end(), less);
}

bool known(const std::vector<StandingDisc>& discs, const StandingDisc& disc) {
  return std::any_of(discs.begin(), discs.end(),
                     [&](const StandingDisc& other) { return same(other, disc); });
}

bool differ(const std::vector<StandingDisc>& before, const std::vector<StandingDisc>& now) {
  if (before.size() != now.size()) return true;
  return std::any_of(now.begin(), now.end(), [&](const StandingDisc& disc) {
    return std::none_of(before.begin(), before.end(), [&](const StandingDisc& old) {
      return same(old, disc) && disc.wait < kMuchLonger * old.wait && old.wait < kMuchLonger * disc.wait;
    });
  });
}

}  // namespace spf
