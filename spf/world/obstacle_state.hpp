// A moving obstacle at one instant: a disc with a velocity. Frame: world.
#pragma once

#include <Eigen/Core>

namespace spf {

struct ObstacleState {
  Eigen::Vector2d position_world = Eigen::Vector2d::Zero();  ///< [m] centre
  Eigen::Vector2d velocity_world = Eigen::Vector2d::Zero();  ///< [m/s]
  double radius = 0.3;                                       ///< [m]
};

}  // namespace spf
