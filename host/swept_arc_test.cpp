#include "host/swept_arc.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "host/arc_centre_test.hpp"
#include "spf/math/angles.hpp"
#include "spf/math/random_stream.hpp"

namespace spf::host {
namespace {

constexpr double kNeverTouches = std::numeric_limits<double>::infinity();

double searched_distance(const Eigen::Vector2d& point, double heading, double curvature, double radius) {
  constexpr double kStep = 1e-3;
  const double turn = curvature == 0.0 ? 20.0 : 2.0 * kPi / std::abs(curvature);
  for (double distance = 0.0; distance < std::min(turn, 20.0); distance += kStep)
    if ((point - centre_after(distance, heading, curvature)).norm() <= radius) return distance;
  return kNeverTouches;
}

TEST(SweptArc, FindsTheFirstTouchThatASearchFinds) {
  RandomStream random{5};
  int touched = 0;
  for (int i = 0; i < 400; ++i) {
    const double heading = random.uniform(-kPi, kPi);
    const double curvature = i % 4 == 0 ? 0.0 : random.uniform(-4.0, 4.0);
    const Eigen::Vector2d point{random.uniform(-1.5, 1.5), random.uniform(-1.5, 1.5)};
    if (point.norm() <= 0.31) continue;
    const SweptArc arc{{std::cos(heading), std::sin(heading)}, curvature, 0.3};
    const double expected = searched_distance(point, heading, curvature, 0.3);
    const double distance = arc.distance_to(point);
    // A search in steps misses what it only grazes.
    if (std::isinf(expected) && !std::isinf(distance)) {
      EXPECT_NEAR((point - centre_after(distance, heading, curvature)).norm(), 0.3, 1e-4);
      continue;
    }
    if (std::isinf(expected)) continue;
    ++touched;
    EXPECT_NEAR(distance, expected, 2e-3) << point.transpose() << ", " << heading << ", " << curvature;
  }
  EXPECT_GT(touched, 40);
}

TEST(SweptArc, ALargeTurnIsAStraightLineToTheLastMillimetre) {
  const Eigen::Vector2d ahead{1.0, 0.0};
  for (const double aside : {-0.29, -0.1, 0.0, 0.2}) {
    const double straight = SweptArc{ahead, 0.0, 0.3}.distance_to({5.0, aside});
    for (const double curvature : {1.1e-6, -1.1e-6, 1e-8})
      EXPECT_NEAR(SweptArc(ahead, curvature, 0.3).distance_to({5.0, aside}), straight, 1e-3);
  }
}

TEST(SweptArc, WhatItTouchesEndsTheWayTowardsItAlone) {
  for (const double curvature : {0.0, 1.0, -3.0}) {
    const SweptArc arc{{1.0, 0.0}, curvature, 0.3};
    EXPECT_EQ(arc.distance_to({0.2, 0.1}), 0.0);
    EXPECT_EQ(arc.distance_to({-0.2, 0.1}), kNeverTouches);
    EXPECT_EQ(arc.distance_to({0.0, 0.29}), kNeverTouches);
  }
  EXPECT_EQ(SweptArc(Eigen::Vector2d{1.0, 0.0}, 0.0, 0.3).distance_to({5.0, 0.31}), kNeverTouches);
  EXPECT_EQ(SweptArc(Eigen::Vector2d{1.0, 0.0}, 0.0, 0.3).distance_to({-5.0, 0.0}), kNeverTouches);
}

}  // namespace
}  // namespace spf::host
