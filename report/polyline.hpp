// Fewer points for the same line: Douglas-Peucker, on timed lines with the distance at equal times, so that
// the thinned line also tells where the robot means to be when.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "report/replay_data.hpp"

namespace spf {

/// Every dropped point lies within `tolerance` [m] of the straight line between its kept neighbours.
[[nodiscard]] std::vector<ReplayPoint> thinned(const std::vector<ReplayPoint>& points, double tolerance);

/// Every dropped point lies within `tolerance` [m] of where linear interpolation in time puts it.
[[nodiscard]] std::vector<ReplayTimedPoint> thinned(const std::vector<ReplayTimedPoint>& points,
                                                    double tolerance);

/// For drawing: of the points that share a column of this width, the first, the lowest, the highest and the
/// last. Any number of points ascending in x then fits a picture, and no peak is lost.
[[nodiscard]] std::vector<ReplayPoint> column_extremes(const std::vector<ReplayPoint>& points, double width);

/// SVG path data in whole units, each step relative to the last: lines through the points of every piece, or
/// `mark` at every point, which ends where it begins. Points must be finite.
[[nodiscard]] std::string path_data(const std::vector<std::vector<ReplayPoint>>& pieces,
                                    std::string_view mark);

}  // namespace spf
