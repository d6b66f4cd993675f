#include "sim/geometry.hpp"

#include <algorithm>
#include <cmath>

namespace spf::sim {
namespace {

/// Slab test: does the segment enter the filled box?
bool enters(const Segment& segment, const Box& box) {
  double first = 0.0;
  double last = 1.0;
  for (int axis = 0; axis < 2; ++axis) {
    const double start = segment.from[axis];
    const double step = segment.to[axis] - start;
    if (step == 0.0) {
      if (start < box.low[axis] || start > box.high[axis]) return false;
      continue;
    }
    const double a = (box.low[axis] - start) / step;
    const double b = (box.high[axis] - start) / step;
    first = std::max(first, std::min(a, b));
    last = std::min(last, std::max(a, b));
  }
  return first <= last;
}

}  // namespace

double distance_to_box(const Eigen::Vector2d& point, const Box& box) {
  const double dx = std::max({box.low.x() - point.x(), 0.0, point.x() - box.high.x()});
  const double dy = std::max({box.low.y() - point.y(), 0.0, point.y() - box.high.y()});
  return std::hypot(dx, dy);
}

double distance_between_boxes(const Box& a, const Box& b) {
  const double dx = std::max({a.low.x() - b.high.x(), 0.0, b.low.x() - a.high.x()});
  const double dy = std::max({a.low.y() - b.high.y(), 0.0, b.low.y() - a.high.y()});
  return std::hypot(dx, dy);
}

double distance_between(const Segment& segment, const Box& box) {
  if (enters(segment, box)) return 0.0;
  // Two convex shapes that do not meet are nearest at a corner of one of them.
  double nearest = std::min(distance_to_box(segment.from, box), distance_to_box(segment.to, box));
  for (const Eigen::Vector2d& corner : {box.low, box.high, Eigen::Vector2d{box.low.x(), box.high.y()},
                                        Eigen::Vector2d{box.high.x(), box.low.y()}})
    nearest = std::min(nearest, distance_to_segment(corner, segment));
  return nearest;
}

double depth_inside(const Eigen::Vector2d& point, const Box& border) {
  return std::min((point - border.low).minCoeff(), (border.high - point).minCoeff());
}

Box square(const Eigen::Vector2d& center, double side) {
  const Eigen::Vector2d half = Eigen::Vector2d::Constant(0.5 * side);
  return {center - half, center + half};
}

}  // namespace spf::sim
