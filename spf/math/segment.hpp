// Line segments of the plane: nearest points, distances, crossings. Units and frame: those of the
// coordinates, for all arguments the same.
#pragma once

#include <Eigen/Core>

#include <algorithm>

namespace spf {

struct LineSegment {
  Eigen::Vector2d from = Eigen::Vector2d::Zero();
  Eigen::Vector2d to = Eigen::Vector2d::Zero();
};

/// Where on a segment the point nearest to `point` lies: 0 at `from` to 1 at `to`; 0 on a segment of no
/// length.
[[nodiscard]] inline double share_along(const Eigen::Vector2d& point, const LineSegment& segment) {
  const Eigen::Vector2d along = segment.to - segment.from;
  const double squared_length = along.squaredNorm();
  if (squared_length == 0.0) return 0.0;
  return std::clamp((point - segment.from).dot(along) / squared_length, 0.0, 1.0);
}

[[nodiscard]] inline Eigen::Vector2d nearest_on_segment(const Eigen::Vector2d& point,
                                                        const LineSegment& segment) {
  return segment.from + share_along(point, segment) * (segment.to - segment.from);
}

[[nodiscard]] inline double distance_to_segment(const Eigen::Vector2d& point, const LineSegment& segment) {
  return (point - nearest_on_segment(point, segment)).norm();
}

/// True when two segments share a point.
[[nodiscard]] bool segments_cross(const LineSegment& a, const LineSegment& b);
[[nodiscard]] double distance_between_segments(const LineSegment& a, const LineSegment& b);

}  // namespace spf
