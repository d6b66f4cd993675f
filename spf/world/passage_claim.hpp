// What a robot tells of a narrow passage ahead on its path, so that robots from both sides take turns. Frame:
// world.
#pragma once

#include <Eigen/Core>

#include "spf/math/believable.hpp"

namespace spf {

/// A straight stretch of a robot's path on which two robots cannot pass each other, and which it is about to
/// use.
struct PassageClaim {
  Eigen::Vector2d entry_world = Eigen::Vector2d::Zero();  ///< [m] where it begins
  Eigen::Vector2d exit_world = Eigen::Vector2d::Zero();   ///< [m] where it ends
  double since = 0.0;                                     ///< [s] when the robot began to want it
  bool inside = false;                                    ///< the robot is in it
  bool waits = false;                                     ///< it lets others pass first
};

[[nodiscard]] inline bool believable(const PassageClaim& claim) {
  return believable(claim.entry_world) && believable(claim.exit_world) && believable(claim.since);
}

}  // namespace spf
