#include "spf/math/segment.hpp"

#include <algorithm>

#include "spf/math/plane.hpp"

namespace spf {
namespace {

/// True when `point`, which must lie on the segment's line, lies between its ends.
bool between_ends(const Eigen::Vector2d& point, const LineSegment& segment) {
  return std::min(segment.from.x(), segment.to.x()) <= point.x() &&
         point.x() <= std::max(segment.from.x(), segment.to.x()) &&
         std::min(segment.from.y(), segment.to.y()) <= point.y() &&
         point.y() <= std::max(segment.from.y(), segment.to.y());
}

}  // namespace

bool segments_cross(const LineSegment& a, const LineSegment& b) {
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

double distance_between_segments(const LineSegment& a, const LineSegment& b) {
  if (segments_cross(a, b)) return 0.0;
  return std::min({distance_to_segment(a.from, b), distance_to_segment(a.to, b),
                   distance_to_segment(b.from, a), distance_to_segment(b.to, a)});
}

}  // namespace spf
