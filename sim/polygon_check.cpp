#include "sim/polygon_check.hpp"

#include <algorithm>
#include <sstream>

#include "sim/geometry.hpp"
#include "spf/math/polygon.hpp"

namespace spf::sim {
namespace {

template <class... Parts>
std::string sentence(const Parts&... parts) {
  std::ostringstream text;
  (text << ... << parts);
  return text.str();
}

Segment side_of(const Polygon& polygon, std::size_t index) {
  return {polygon.corners[index], polygon.corners[(index + 1) % polygon.corners.size()]};
}

std::string crossing_of(const Polygon& polygon) {
  const std::size_t count = polygon.corners.size();
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t j = i + 2; j < count; ++j) {
      const bool neighbours = i == 0 && j + 1 == count;
      if (!neighbours && segments_cross(side_of(polygon, i), side_of(polygon, j)))
        return sentence("must not cross themselves: the sides from corner ", i, " and from corner ", j,
                        " meet");
    }
  return "";
}

}  // namespace

std::string PolygonCheck::problem_of(const Polygon& polygon) {
  const std::size_t count = polygon.corners.size();
  corners_ += count;
  if (count < 3) return sentence("must be at least 3, and are ", count);
  if (count > kMostCorners) return sentence("must be at most ", kMostCorners, ", and are ", count);
  if (corners_ > kMostCornersOfAll)
    return sentence("make more than ", kMostCornersOfAll, " corners of all polygons together");
  for (std::size_t i = 0; i < count; ++i)
    if (!polygon.corners[i].allFinite()) return sentence("must be finite, and corner ", i, " is not");
  for (std::size_t i = 0; i < count; ++i)
    if (polygon.corners[i] == polygon.corners[(i + 1) % count])
      return sentence("must differ from the next, and corner ", i, " does not");
  const std::string crossing = crossing_of(polygon);
  if (!crossing.empty()) return crossing;
  if (signed_area(polygon.corners) == 0.0) return "must enclose an area, and lie on a line";
  return "";
}

}  // namespace spf::sim
