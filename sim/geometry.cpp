#include "sim/geometry.hpp"

#include <algorithm>
#include <cmath>

#include "spf/math/plane.hpp"

namespace spf::sim {
namespace {

/// True when `point`, which must lie on the segment's line, lies between its ends.
bool between_ends(const Eigen::Vector2d& point, const Segment& segment) {
  return std::min(segment.from.x(), segment.to.x()) <= point.x() &&
         point.x() <= std::max(segment.from.x(), segment.to.x()) &&
         std::min(segment.from.y(), segment.to.y()) <= point.y() &&
         point.y() <= std::max(segment.from.y(), segment.to.y());
}

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

Eigen::Vector2d nearest_on_segment(const Eigen::Vector2d& point, const Segment& segment) {
  const Eigen::Vector2d along = segment.to - segment.from;
  const double squared_length = along.squaredNorm();
  if (squared_length == 0.0) return segment.from;
  const double share = std::clamp((point - segment.from).dot(along) / squared_length, 0.0, 1.0);
  return segment.from + share * along;
}

double distance_to_segment(const Eigen::Vector2d& point, const Segment& segment) {
  return (point - nearest_on_segment(point, segment)).norm();
}

bool segments_cross(const Segment& a, const Segment& b) {
  const double b_from = cross(a.to - a.from, b.from - a.from);
  const double b_to = cross(a.to - a.from, b.to - a.from);
  const double a_from = cross(b.to - b.from, a.from - b.from);
  const double a_to = cross(b.to - b.from, a.to - b.from);
  const bool split_b = (b_from < 0.0 && b_to > 0.0) || (b_from > 0.0 && b_to < 0.0);
  const bool split_a = (a_from < 0.0 && a_to > 0.0) || (a_from > 0.0 && a_to < 0.0);
  if (split_a && split_b) return true;
  return (b_from == 0.0 && between_ends(b.from, a)) || (b_to == 0.0 && between_ends(b.to, a)) ||
         (a_from == 0.0 && between_ends(a.from, b)) || (a_to == 0.0 && between_ends(a.to, b));
}

double distance_between_segments(const Segment& a, const Segment& b) {
  if (segments_cross(a, b)) return 0.0;
  return std::min({distance_to_segment(a.from, b), distance_to_segment(a.to, b),
                   distance_to_segment(b.from, a), distance_to_segment(b.to, a)});
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
