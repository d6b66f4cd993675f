#include "spf/math/polygon.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "spf/math/random_stream.hpp"

namespace spf {
namespace {

using Corners = std::vector<Eigen::Vector2d>;

/// A room of 4 m x 3 m whose upper right quarter is missing.
const Corners kAngle{{0.0, 0.0}, {4.0, 0.0}, {4.0, 1.0}, {2.0, 1.0}, {2.0, 3.0}, {0.0, 3.0}};

TEST(Polygon, ReadsTheDistanceToItsOutline) {
  EXPECT_DOUBLE_EQ(signed_distance_to_polygon({1.0, 2.0}, kAngle), -1.0);
  EXPECT_DOUBLE_EQ(signed_distance_to_polygon({3.0, 0.75}, kAngle), -0.25);
  EXPECT_DOUBLE_EQ(signed_distance_to_polygon({3.0, 2.0}, kAngle), 1.0);   // in the missing quarter
  EXPECT_DOUBLE_EQ(signed_distance_to_polygon({7.0, 5.0}, kAngle), 5.0);   // a corner is nearest
  EXPECT_DOUBLE_EQ(signed_distance_to_polygon({-2.0, 1.0}, kAngle), 2.0);  // level with a corner
  EXPECT_DOUBLE_EQ(std::abs(signed_distance_to_polygon({2.0, 2.0}, kAngle)), 0.0);
  EXPECT_TRUE(std::isinf(signed_distance_to_polygon({0.0, 0.0}, {})));
}

TEST(Polygon, IsTheSameInEitherSenseAndFromAnyCorner) {
  RandomStream random{7};
  for (int k = 0; k < 1000; ++k) {
    const Eigen::Vector2d point{random.uniform(-1.0, 5.0), random.uniform(-1.0, 4.0)};
    const bool inside = point.x() > 0.0 && point.y() > 0.0 &&
                        ((point.x() < 4.0 && point.y() < 1.0) || (point.x() < 2.0 && point.y() < 3.0));
    Corners corners = kAngle;
    const double distance = signed_distance_to_polygon(point, corners);
    EXPECT_EQ(distance < 0.0, inside) << point.transpose();
    std::rotate(corners.begin(), corners.begin() + k % 6, corners.end());
    std::reverse(corners.begin(), corners.end());
    EXPECT_NEAR(signed_distance_to_polygon(point, corners), distance, 1e-12) << point.transpose();
  }
}

TEST(Polygon, AreaHasTheSignOfTheSense) {
  EXPECT_DOUBLE_EQ(signed_area(kAngle), 8.0);
  EXPECT_DOUBLE_EQ(signed_area({kAngle.rbegin(), kAngle.rend()}), -8.0);
  EXPECT_EQ(signed_area({{0.0, 0.0}, {1.0, 1.0}, {2.0, 2.0}}), 0.0);
}

}  // namespace
}  // namespace spf
