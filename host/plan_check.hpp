// Is a trajectory that came over a wire one that a robot could drive? Whatever it holds, looking is safe.
#pragma once

#include "spf/trajectory/trajectory.hpp"

namespace spf::host {

struct PlanLimits {
  double fastest = 10.0;    ///< [m/s] anywhere on it
  double longest = 3600.0;  ///< [s] of the whole
};

/// Finite, not empty, near the origin by no more than kFarthest, pieces of positive duration that join (to
/// 0.1 m), and within the limits.
[[nodiscard]] bool drivable(const Trajectory& trajectory, const PlanLimits& limits);

}  // namespace spf::host
