#include "sim/body.hpp"

#include <algorithm>
#include <limits>

#include "sim/geometry.hpp"

namespace spf::sim {

ConvexPolygon polygon_of(const Box& box) {
  ConvexPolygon polygon;
  polygon.add(box.low);
  polygon.add({box.high.x(), box.low.y()});
  polygon.add(box.high);
  polygon.add({box.low.x(), box.high.y()});
  return polygon;
}

double depth_inside(const ConvexPolygon& polygon, const Box& border) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < polygon.size(); ++i)
    least = std::min(least, depth_inside(polygon.corner(i), border));
  return least;
}

}  // namespace spf::sim
