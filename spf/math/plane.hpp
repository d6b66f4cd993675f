// Vectors of the plane.
#pragma once

#include <Eigen/Core>

namespace spf {

/// The vector rotated by 90 deg counterclockwise.
[[nodiscard]] inline Eigen::Vector2d left_of(const Eigen::Vector2d& v) {
  return {-v.y(), v.x()};
}

/// Positive when b points to the left of a.
[[nodiscard]] inline double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

}  // namespace spf
