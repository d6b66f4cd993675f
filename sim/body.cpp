#include "sim/body.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/geometry.hpp"
#include "spf/math/plane.hpp"

namespace spf::sim {

PlacedPolygon::PlacedPolygon(const Footprint& outline, const Eigen::Vector2d& position, double heading)
    : size_{outline.corners().size()} {
  const Eigen::Vector2d ahead{std::cos(heading), std::sin(heading)};
  const Eigen::Vector2d left{-ahead.y(), ahead.x()};
  for (std::size_t i = 0; i < size_; ++i)
    corners_[i] = position + outline.corners()[i].x() * ahead + outline.corners()[i].y() * left;
}

PlacedPolygon::PlacedPolygon(const Box& box) : size_{4} {
  corners_[0] = box.low;
  corners_[1] = {box.high.x(), box.low.y()};
  corners_[2] = box.high;
  corners_[3] = {box.low.x(), box.high.y()};
}

bool PlacedPolygon::holds(const Eigen::Vector2d& point) const {
  for (std::size_t i = 0; i < size_; ++i) {
    const Segment along = side(i);
    if (cross(along.to - along.from, point - along.from) < 0.0) return false;
  }
  return true;
}

double PlacedPolygon::distance_to(const Eigen::Vector2d& point) const {
  if (holds(point)) return 0.0;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < size_; ++i) nearest = std::min(nearest, distance_to_segment(point, side(i)));
  return nearest;
}

double PlacedPolygon::distance_to(const Segment& segment) const {
  if (holds(segment.from)) return 0.0;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < size_; ++i)
    nearest = std::min(nearest, distance_between_segments(segment, side(i)));
  return nearest;
}

double PlacedPolygon::distance_to(const PlacedPolygon& other) const {
  if (holds(other.corners_[0]) || other.holds(corners_[0])) return 0.0;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < other.size_; ++i) nearest = std::min(nearest, distance_to(other.side(i)));
  return nearest;
}

double PlacedPolygon::depth_in(const Box& border) const {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < size_; ++i) least = std::min(least, depth_inside(corners_[i], border));
  return least;
}

}  // namespace spf::sim
