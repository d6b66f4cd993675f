// Dynamic limits: velocity, acceleration and jerk of every node. Frame: world.
#pragma once

#include "spf/planning/costs/node_set.hpp"

namespace spf {

struct LimitsCost {
  double weight = 1.0;            ///< [1/s]
  double max_speed = 1.0;         ///< [m/s]
  double max_acceleration = 1.0;  ///< [m/s^2]
  double max_jerk = 20.0;         ///< [m/s^3]

  /// P = weight * sum over x in {velocity, acceleration, jerk} of max(0, |x|^2 / limit^2 - 1)^3.
  void add(NodeSet& nodes) const;
};

}  // namespace spf
