// Fewer points for the same line: Douglas-Peucker, on timed lines with the distance at equal times, so that
// the thinned line also tells where the robot means to be when.
#pragma once

#include <vector>

#include "report/replay_data.hpp"

namespace spf {

/// Every dropped point lies within `tolerance` [m] of the straight line between its kept neighbours.
[[nodiscard]] std::vector<ReplayPoint> thinned(const std::vector<ReplayPoint>& points, double tolerance);

/// Every dropped point lies within `tolerance` [m] of where linear interpolation in time puts it.
[[nodiscard]] std::vector<ReplayTimedPoint> thinned(const std::vector<ReplayTimedPoint>& points,
                                                    double tolerance);

}  // namespace spf
