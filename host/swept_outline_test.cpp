#include "host/swept_outline.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "host/arc_centre_test.hpp"
#include "spf/math/angles.hpp"
#include "spf/math/random_stream.hpp"

namespace spf::host {
namespace {

Footprint rectangle() {
  RobotParameters robot;
  robot.length = 0.8;
  robot.width = 0.4;
  return Footprint{robot};
}

/// The outline's distance from a point with its centre at a place and a heading.
double gap(const Footprint& outline, const Eigen::Vector2d& centre, double heading,
           const Eigen::Vector2d& point) {
  return outline.distance_to(Eigen::Rotation2Dd{-heading} * (point - centre));
}

TEST(SweptOutline, FindsTheFirstTouchThatASearchFinds) {
  const Footprint outline = rectangle();
  RandomStream random{7};
  int touched = 0;
  for (int i = 0; i < 400; ++i) {
    const double heading = random.uniform(-kPi, kPi);
    const double direction = i % 2 == 0 ? heading : random.uniform(-kPi, kPi);
    const double curvature = i % 4 == 0 ? 0.0 : random.uniform(-4.0, 4.0);
    const Eigen::Vector2d point{random.uniform(-1.5, 1.5), random.uniform(-1.5, 1.5)};
    if (gap(outline, {0.0, 0.0}, heading, point) < 0.01) continue;
    const SweptOutline swept{outline, heading, {std::cos(direction), std::sin(direction)}, curvature};
    const double distance = swept.distance_to(point);
    const auto gap_after = [&](double way) {
      return gap(outline, centre_after(way, direction, curvature), heading + curvature * way, point);
    };
    const double turn = curvature == 0.0 ? 5.0 : std::min(5.0, 2.0 * kPi / std::abs(curvature));
    double searched = std::numeric_limits<double>::infinity();
    for (double way = 0.0; way < turn && std::isinf(searched); way += 1e-3)
      if (gap_after(way) <= 0.0) searched = way;
    if (std::isinf(searched)) {
      // A search in steps misses what it only grazes.
      if (!std::isinf(distance)) {
        EXPECT_NEAR(gap_after(distance), 0.0, 1e-9);
      }
      continue;
    }
    ++touched;
    EXPECT_NEAR(distance, searched, 2e-3);
  }
  EXPECT_GT(touched, 40);
}

TEST(SweptOutline, TurningOnTheSpotItsCornersSweep) {
  const SweptOutline swept{rectangle(), 0.0, {1.0, 0.0}, 0.0};
  // Beside the middle of its long side, nearer than the corners: that side comes, which is so far from the
  // centre short of its end.
  const double turned = std::acos(0.2 / 0.44);
  EXPECT_NEAR(swept.turn_to({0.0, 0.44}, true), turned, 1e-12);
  EXPECT_NEAR(swept.turn_to({0.0, 0.44}, false), turned, 1e-12);
  EXPECT_TRUE(std::isinf(swept.turn_to({0.0, 0.46}, true)));  // beyond the corners
  EXPECT_TRUE(std::isinf(swept.turn_to({0.0, 0.1}, true)));   // held already
}

TEST(SweptOutline, LeavesWhatItHoldsBehind) {
  const SweptOutline swept{rectangle(), 0.0, {1.0, 0.0}, 0.0};
  EXPECT_EQ(swept.distance_to({0.3, 0.1}), 0.0);
  EXPECT_TRUE(std::isinf(swept.distance_to({-0.3, 0.1})));
  EXPECT_TRUE(std::isinf(swept.distance_to({1.0, 0.21})));
  EXPECT_NEAR(swept.distance_to({1.0, 0.19}), 0.6, 1e-12);
}

}  // namespace
}  // namespace spf::host
