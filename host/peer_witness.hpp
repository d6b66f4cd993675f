// Whose word may mask returns. A peer's disc keeps its returns out of the static map, since they are the
// peer itself; a peer that is not where it says it is must not mask anything. So it has to be heard for a
// while, to do what it said before, and to be seen when it is in plain view. Frame: world; times are the
// host's [s]. It remembers at most kMostPeers of them.
#pragma once

#include <map>
#include <vector>

#include "spf/math/pose2.hpp"
#include "spf/world/observation.hpp"
#include "spf/world/peer.hpp"
#include "spf/world/trajectory_message.hpp"

namespace spf::host {

class PeerWitness {
 public:
  /// A message that was believed.
  void add_message(const TrajectoryMessage& message, double now);
  /// A scan of the robot's centre: beams that pass through the middle of a peer's disc show that it is not
  /// there.
  void add_scan(const RangeScan& scan, const Pose2& pose_world, double time, const std::vector<Peer>& peers);
  [[nodiscard]] bool trusts(int robot_id, double now) const;
  void forget() { known_.clear(); }

 private:
  bool make_room(double now);

  struct Record {
    double first_heard = 0.0;     // [s]
    double last_heard = 0.0;      // [s]
    double jumps = 0.0;           // [radii] from what it said before, fading
    double contradicted = -1e18;  // [s] when it was last not where it said
    Trajectory said;
  };
  std::map<int, Record> known_;
};

}  // namespace spf::host
