#include "spf/math/convex_polygon.hpp"

#include <algorithm>
#include <limits>

#include "spf/math/plane.hpp"

namespace spf {

bool ConvexPolygon::contains(const Eigen::Vector2d& point) const {
  for (std::size_t i = 0; i < size_; ++i) {
    const LineSegment along = edge(i);
    if (cross(Eigen::Vector2d{along.to - along.from}, Eigen::Vector2d{point - along.from}) < 0.0)
      return false;
  }
  return true;
}

double ConvexPolygon::distance_to(const Eigen::Vector2d& point) const {
  if (contains(point)) return 0.0;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < size_; ++i) nearest = std::min(nearest, distance_to_segment(point, edge(i)));
  return nearest;
}

double ConvexPolygon::distance_to(const LineSegment& segment) const {
  if (contains(segment.from)) return 0.0;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < size_; ++i)
    nearest = std::min(nearest, distance_between_segments(segment, edge(i)));
  return nearest;
}

double ConvexPolygon::distance_to(const ConvexPolygon& other) const {
  if (contains(other.corners_[0]) || other.contains(corners_[0])) return 0.0;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < other.size_; ++i) nearest = std::min(nearest, distance_to(other.edge(i)));
  return nearest;
}

}  // namespace spf
