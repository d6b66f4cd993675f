#include "spf/math/convex_polygon.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "spf/math/polygon.hpp"
#include "spf/math/random_stream.hpp"

namespace spf {
namespace {

ConvexPolygon polygon_through(const std::vector<Eigen::Vector2d>& corners) {
  ConvexPolygon polygon;
  for (const Eigen::Vector2d& corner : corners) polygon.add(corner);
  return polygon;
}

const std::vector<Eigen::Vector2d> kPentagon{{1.0, 0.0}, {0.5, 1.0}, {-0.6, 0.8}, {-1.0, -0.2}, {0.2, -0.9}};

TEST(ConvexPolygon, IsAsFarFromAPointAsAnyPolygon) {
  const ConvexPolygon polygon = polygon_through(kPentagon);
  RandomStream random{4};
  for (int i = 0; i < 500; ++i) {
    const Eigen::Vector2d point{random.uniform(-2.0, 2.0), random.uniform(-2.0, 2.0)};
    const double signed_distance = signed_distance_to_polygon(point, kPentagon);
    EXPECT_EQ(polygon.contains(point), signed_distance < 0.0);
    EXPECT_NEAR(polygon.distance_to(point), std::max(0.0, signed_distance), 1e-12);
  }
}

// Against the points of the segment, and those of the other's sides.
TEST(ConvexPolygon, IsAsFarFromSegmentsAndPolygonsAsTheirNearestPoints) {
  constexpr int kParts = 2000;
  const ConvexPolygon polygon = polygon_through(kPentagon);
  RandomStream random{5};
  int apart = 0;
  for (int i = 0; i < 100; ++i) {
    const auto draw = [&] {
      const double x = random.uniform(-3.0, 3.0);
      return Eigen::Vector2d{x, random.uniform(-3.0, 3.0)};
    };
    const Eigen::Vector2d corner = draw();
    const ConvexPolygon triangle =
        polygon_through({corner, corner + Eigen::Vector2d{0.7, 0.2}, corner + Eigen::Vector2d{0.1, 0.6}});
    double to_side = 1e9;
    double to_triangle = polygon.contains(corner) || triangle.contains(kPentagon[0]) ? 0.0 : 1e9;
    for (std::size_t side = 0; side < triangle.size(); ++side)
      for (int k = 0; k <= kParts; ++k) {
        const LineSegment along = triangle.edge(side);
        const Eigen::Vector2d point = along.from + (along.to - along.from) * k / kParts;
        const double distance = polygon.distance_to(point);
        to_triangle = std::min(to_triangle, distance);
        if (side == 0) to_side = std::min(to_side, distance);
      }
    EXPECT_NEAR(polygon.distance_to(triangle.edge(0)), to_side, 1e-3);
    EXPECT_NEAR(polygon.distance_to(triangle), to_triangle, 1e-3);
    EXPECT_EQ(polygon.distance_to(triangle), triangle.distance_to(polygon));
    apart += to_triangle > 0.0 ? 1 : 0;
  }
  EXPECT_GT(apart, 30);
  EXPECT_LT(apart, 95);
}

}  // namespace
}  // namespace spf
