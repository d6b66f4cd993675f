#include "spf/math/polygon.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>

#include "spf/math/plane.hpp"
#include "spf/math/segment.hpp"

namespace spf {

double signed_distance_to_polygon(const Eigen::Vector2d& point, const std::vector<Eigen::Vector2d>& corners) {
  double nearest = std::numeric_limits<double>::infinity();
  bool inside = false;  // a ray from the point to the right crosses the outline an odd number of times
  for (std::size_t i = 0, last = corners.size() - 1; i < corners.size(); last = i++) {
    const Eigen::Vector2d along = corners[i] - corners[last];
    const Eigen::Vector2d offset = point - corners[last];
    nearest = std::min(nearest, distance_to_segment(point, {corners[last], corners[i]}));
    const bool crosses_height = (corners[i].y() > point.y()) != (corners[last].y() > point.y());
    if (crosses_height && (cross(along, offset) > 0.0) == (along.y() > 0.0)) inside = !inside;
  }
  return inside ? -nearest : nearest;
}

double signed_area(const std::vector<Eigen::Vector2d>& corners) {
  double twice = 0.0;
  for (std::size_t i = 0, last = corners.size() - 1; i < corners.size(); last = i++)
    twice += cross(corners[last] - corners.front(), corners[i] - corners.front());
  return 0.5 * twice;
}

}  // namespace spf
