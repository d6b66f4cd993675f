// Dynamic limits: velocity, acceleration and jerk of every node. Frame: world.
#pragma once

#include "spf/planning/costs/node_set.hpp"

namespace spf {

/// Values come from the parameters; there are no defaults here.
struct LimitsCost {
  double weight;            ///< [1/s]
  double max_speed;         ///< [m/s]
  double max_acceleration;  ///< [m/s^2]
  double max_jerk;          ///< [m/s^3]

  /// P = weight * sum over x in {velocity, acceleration, jerk} of max(0, |x|^2 / limit^2 - 1)^3.
  void add(NodeSet& nodes) const;
};

}  // namespace spf
