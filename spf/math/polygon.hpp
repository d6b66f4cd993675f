// Simple polygons: closed outlines that do not cross themselves. Corners in either sense of rotation, the
// last one joined to the first.
#pragma once

#include <Eigen/Core>

#include <vector>

namespace spf {

/// Distance from a point to the outline, negative inside; infinite for a polygon without corners. Unit: that
/// of the coordinates.
[[nodiscard]] double signed_distance_to_polygon(const Eigen::Vector2d& point,
                                                const std::vector<Eigen::Vector2d>& corners);

/// Positive when the corners go counterclockwise. Unit: that of the coordinates, squared.
[[nodiscard]] double signed_area(const std::vector<Eigen::Vector2d>& corners);

}  // namespace spf
