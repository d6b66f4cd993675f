// Where a robot is to go. Frame: world (the fleet's).
#pragma once

#include <Eigen/Core>

#include <optional>

namespace spf::host {

struct Goal {
  Eigen::Vector2d position_world = Eigen::Vector2d::Zero();  ///< [m]
  std::optional<double> heading;                             ///< [rad] any without
};

}  // namespace spf::host
