#include "spf/robot/footprint.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "spf/math/polygon.hpp"

namespace spf {
namespace {

RobotParameters rectangle(double length, double width) {
  RobotParameters robot;
  robot.length = length;
  robot.width = width;
  return robot;
}

RobotParameters with_corners(std::vector<Eigen::Vector2d> corners) {
  RobotParameters robot;
  robot.footprint = std::move(corners);
  return robot;
}

TEST(Footprint, OfADiscIsTheDisc) {
  RobotParameters robot;
  robot.radius = 0.4;
  const Footprint footprint{robot};
  EXPECT_TRUE(footprint.is_disc());
  EXPECT_EQ(footprint.inscribed_radius(), 0.4);
  EXPECT_EQ(footprint.circumscribed_radius(), 0.4);
  EXPECT_NEAR(footprint.distance_to({1.0, 0.0}), 0.6, 1e-12);
  EXPECT_NEAR(footprint.clearance({0.0, 0.0}, {1.0, 0.0}, 9.0, [](const Eigen::Vector2d&) { return 1.0; }),
              0.6, 1e-12);
}

TEST(Footprint, RectangleHasItsRadii) {
  const Footprint footprint{rectangle(0.51, 0.43)};
  EXPECT_NEAR(footprint.inscribed_radius(), 0.215, 1e-12);
  EXPECT_NEAR(footprint.half_width(), 0.215, 1e-12);
  EXPECT_NEAR(footprint.circumscribed_radius(), 0.5 * std::hypot(0.51, 0.43), 1e-12);
  EXPECT_NEAR(with_radius_of_footprint(rectangle(0.51, 0.43)).radius, 0.5 * std::hypot(0.51, 0.43), 1e-12);
  EXPECT_NEAR(footprint.distance_to({0.3, 0.0}), 0.045, 1e-12);
  EXPECT_NEAR(footprint.distance_to({0.0, 0.2}), -0.015, 1e-12);
}

/// Polygons of many kinds around the centre: corners in order on a stretched and shifted circle.
std::vector<Eigen::Vector2d> drawn_corners(std::mt19937& random) {
  std::uniform_real_distribution<double> uniform{0.0, 1.0};
  const int count = 3 + static_cast<int>(uniform(random) * 6.0);
  const Eigen::Vector2d size{0.2 + uniform(random), 0.2 + uniform(random)};
  const double turn = 6.0 * uniform(random);
  std::vector<Eigen::Vector2d> corners;
  for (int i = 0; i < count; ++i) {
    const double angle = 6.283185 * (i + 0.6 * uniform(random)) / count;
    const Eigen::Vector2d on_circle{size.x() * std::cos(angle), size.y() * std::sin(angle)};
    corners.emplace_back(Eigen::Rotation2Dd{turn} * on_circle);
  }
  return corners;
}

// The cover against the polygon itself: the distance from one point, for any pose.
TEST(Footprint, ClearanceIsThatOfThePolygon) {
  std::mt19937 random{5};
  std::uniform_real_distribution<double> uniform{-1.0, 1.0};
  int polygons = 0;
  int near = 0;
  double coarsest = 0.0;
  while (polygons < 100) {
    const RobotParameters robot = with_corners(drawn_corners(random));
    if (!footprint_problem(robot).empty()) continue;
    ++polygons;
    const Footprint footprint{robot};
    coarsest = std::max(coarsest, footprint.cover_error() / footprint.circumscribed_radius());
    for (int i = 0; i < 200; ++i) {
      const Eigen::Vector2d position{uniform(random), uniform(random)};
      const Eigen::Rotation2Dd turn{3.2 * uniform(random)};
      const Eigen::Vector2d point = 1.5 * Eigen::Vector2d{uniform(random), uniform(random)};
      const double exact = footprint.distance_to(turn.inverse() * (point - position));
      constexpr double kEnough = 0.3;
      const double clearance =
          footprint.clearance(position, turn * Eigen::Vector2d::UnitX(), kEnough,
                              [&](const Eigen::Vector2d& from) { return (from - point).norm(); });
      if (exact > 0.0 && exact < kEnough) {
        ++near;
        EXPECT_LE(clearance, exact + 1e-9);
        EXPECT_GE(clearance, exact - footprint.cover_error() - 1e-9);
      }
      if (exact >= kEnough) {
        EXPECT_GE(clearance, kEnough - footprint.cover_error() - 1e-9);
      }
      if (exact <= 0.0) {
        EXPECT_LE(clearance, 1e-9);
      }
    }
  }
  EXPECT_GT(near, 2000);
  EXPECT_LT(coarsest, 0.02);
  EXPECT_LT(Footprint{rectangle(0.51, 0.43)}.cover_error(), 0.03 * 0.215);
}

TEST(Footprint, RefusesWhatIsNoOutline) {
  EXPECT_EQ(footprint_problem(RobotParameters{}), "");
  EXPECT_EQ(footprint_problem(rectangle(0.5, 0.4)), "");
  EXPECT_EQ(footprint_problem(rectangle(0.5, 0.0)), "width = 0 [m] must be above 0 where length is");
  EXPECT_EQ(footprint_problem(with_corners({{1, 0}, {0, 1}})), "footprint has 2 corners; it needs 3 to 16");
  EXPECT_EQ(footprint_problem(with_corners({{1, 1}, {3, 1}, {3, 3}, {1, 3}})),
            "footprint does not hold the robot's centre, [0, 0]");
  EXPECT_NE(footprint_problem(with_corners({{1, 1}, {0, 0.2}, {-1, 1}, {0, -1}})).find("not convex"),
            std::string::npos);
  const double far = 0.9510565;
  const double near = 0.5877853;
  EXPECT_NE(footprint_problem(with_corners(
                {{0, 1}, {-near, -0.809017}, {far, 0.309017}, {-far, 0.309017}, {near, -0.809017}})),
            "");  // a star
  RobotParameters both = rectangle(0.5, 0.4);
  both.footprint = {{1, 1}, {-1, 1}, {-1, -1}};
  EXPECT_NE(footprint_problem(both), "");
  EXPECT_THROW(Footprint{both}, std::invalid_argument);
}

TEST(Footprint, TakesCornersInEitherOrder) {
  const Footprint one{with_corners({{1, 1}, {-1, 1}, {-1, -1}, {1, -1}})};
  const Footprint other{with_corners({{1, -1}, {-1, -1}, {-1, 1}, {1, 1}})};
  EXPECT_GT(signed_area(other.corners()), 0.0);
  EXPECT_EQ(one.inscribed_radius(), other.inscribed_radius());
}

}  // namespace
}  // namespace spf
