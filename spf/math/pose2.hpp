// Planar pose.
#pragma once

#include <Eigen/Core>

namespace spf {

struct Pose2 {
  Eigen::Vector2d position_world = Eigen::Vector2d::Zero();  ///< [m]
  double heading = 0.0;                                      ///< [rad] of body x in world, (-pi, pi]
};

}  // namespace spf
