#include "sim/moving_obstacles.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <memory>

#include "sim/geometry.hpp"
#include "spf/math/angles.hpp"
#include "spf/math/polygon.hpp"

namespace spf::sim {
namespace {

Scenario open_scene(double level, NoiseModel model) {
  Scenario scenario;
  scenario.simulation.noise.level = level;
  scenario.simulation.noise.model = model;
  return scenario;
}

ObstacleState disc_at(double x, double y, double vx, double vy, double radius = 0.4) {
  ObstacleState disc;
  disc.position_world = {x, y};
  disc.velocity_world = {vx, vy};
  disc.radius = radius;
  return disc;
}

TEST(MovingObstacles, WithoutNoiseMoveAtConstantVelocity) {
  Scenario scenario = open_scene(0.0, NoiseModel::walk);
  scenario.moving = {disc_at(1.0, 2.0, 0.5, -0.25)};
  MovingObstacles obstacles{scenario};
  EXPECT_EQ(obstacles.now()[0].position_world, scenario.moving[0].position_world);
  for (int step = 0; step < 100; ++step) obstacles.advance();
  // 100 sums of numbers below 10: rounding stays below 100 * 1e-15.
  EXPECT_LT((obstacles.next()[0].position_world - Eigen::Vector2d{6.0, -0.5}).norm(), 1e-12);
  EXPECT_LT((obstacles.position(0, 0.5) - Eigen::Vector2d{5.975, -0.4875}).norm(), 1e-12);
  EXPECT_LT((obstacles.velocity(0) - Eigen::Vector2d{0.5, -0.25}).norm(), 1e-12);
}

TEST(MovingObstacles, WhiteNoiseHasThePrintedCovarianceAndKeepsTheVelocity) {
  Scenario scenario = open_scene(2.0, NoiseModel::white);
  scenario.moving = {disc_at(0.0, 0.0, 0.6, 0.0), disc_at(5.0, 5.0, 0.0, 0.6)};
  MovingObstacles obstacles{scenario};
  constexpr int kSteps = 20000;
  Eigen::Array2d sum = Eigen::Array2d::Zero();
  Eigen::Array2d sum_of_squares = Eigen::Array2d::Zero();
  for (int step = 0; step < kSteps; ++step) {
    obstacles.advance();
    EXPECT_EQ(obstacles.next()[1].velocity_world, scenario.moving[1].velocity_world);
    const Eigen::Array2d error = obstacles.next()[1].position_world - obstacles.now()[1].position_world -
                                 0.1 * scenario.moving[1].velocity_world;
    sum += error;
    sum_of_squares += error * error;
  }
  // Per step and axis: 2 (1e-2 * 0.1^2 + 1e-4) = 4e-4 m^2; a variance of n normals has deviation sqrt(2 / n).
  const double variance = 2.0 * (1e-2 * 0.01 + 1e-4);
  for (int axis = 0; axis < 2; ++axis) {
    EXPECT_NEAR(sum_of_squares[axis] / kSteps, variance, 5.0 * variance * std::sqrt(2.0 / kSteps));
    EXPECT_NEAR(sum[axis] / kSteps, 0.0, 5.0 * std::sqrt(variance / kSteps));
  }
}

TEST(MovingObstacles, WalkChangesTheVelocityByItsCovarianceAndClipsIt) {
  Scenario scenario = open_scene(0.25, NoiseModel::walk);
  scenario.simulation.noise.speed_limit = 1e6;
  scenario.moving = {disc_at(0.0, 0.0, 0.6, 0.0)};
  MovingObstacles free_walk{scenario};
  constexpr int kSteps = 20000;
  double sum_of_squares = 0.0;
  for (int step = 0; step < kSteps; ++step) {
    free_walk.advance();
    sum_of_squares += (free_walk.next()[0].velocity_world - free_walk.now()[0].velocity_world).squaredNorm();
  }
  const double variance = 0.25 * 1e-2;
  EXPECT_NEAR(sum_of_squares / (2 * kSteps), variance, 5.0 * variance * std::sqrt(2.0 / (2 * kSteps)));

  scenario.simulation.noise.speed_limit = 1.0;
  scenario.simulation.noise.level = 2.0;
  MovingObstacles clipped{scenario};
  double fastest = 0.0;
  for (int step = 0; step < 2000; ++step) {
    clipped.advance();
    fastest = std::max(fastest, clipped.next()[0].velocity_world.norm());
  }
  EXPECT_LE(fastest, 1.0 + 1e-12);
  EXPECT_GT(fastest, 0.999);  // the clip was at work
}

TEST(MovingObstacles, ReflectAtTheBorder) {
  Scenario scenario = open_scene(0.0, NoiseModel::white);
  scenario.border = square(Eigen::Vector2d::Zero(), 10.0);
  scenario.moving = {disc_at(4.55, 0.0, 1.0, 0.3)};
  MovingObstacles obstacles{scenario};
  obstacles.advance();  // 4.65 would be 0.05 beyond 5 - 0.4: mirrored to 4.55
  EXPECT_NEAR(obstacles.next()[0].position_world.x(), 4.55, 1e-12);
  EXPECT_EQ(obstacles.next()[0].velocity_world, Eigen::Vector2d(-1.0, 0.3));
}

TEST(MovingObstacles, AreTurnedBackBySquares) {
  Scenario scenario = open_scene(0.0, NoiseModel::white);
  scenario.boxes = {square({0.0, 0.0}, 2.0)};
  scenario.moving = {disc_at(-1.45, 0.2, 1.0, 0.5)};
  MovingObstacles obstacles{scenario};
  obstacles.advance();  // (-1.35, 0.25) is 0.05 deep in the square grown to 1.4
  EXPECT_NEAR(obstacles.next()[0].position_world.x(), -1.4, 1e-12);
  EXPECT_NEAR(obstacles.next()[0].position_world.y(), 0.25, 1e-12);
  EXPECT_EQ(obstacles.next()[0].velocity_world, Eigen::Vector2d(-1.0, 0.5));
}

TEST(MovingObstacles, StayInTheFieldAndOutOfStaticShapes) {
  Scenario scenario = open_scene(2.0, NoiseModel::walk);
  scenario.border = square(Eigen::Vector2d::Zero(), 12.0);
  scenario.boxes = {square({2.0, 2.0}, 1.5)};
  scenario.discs = {{{-3.0, 0.0}, 0.7}};
  scenario.walls = {{{-1.0, -4.0}, {3.0, -2.0}}};
  scenario.moving = {disc_at(0.0, 0.0, 1.0, 0.2), disc_at(4.0, -4.0, -0.5, 0.9)};
  MovingObstacles obstacles{scenario};
  for (int step = 0; step < 5000; ++step) {
    obstacles.advance();
    for (const ObstacleState& disc : obstacles.next()) {
      ASSERT_GE(depth_inside(disc.position_world, *scenario.border), disc.radius - 1e-9);
      ASSERT_GE(distance_to_box(disc.position_world, scenario.boxes[0]), disc.radius - 1e-9);
      ASSERT_GE((disc.position_world - scenario.discs[0].center).norm(), 0.7 + disc.radius - 1e-9);
      ASSERT_GE(distance_to_segment(disc.position_world, scenario.walls[0]), disc.radius - 1e-9);
    }
  }
}

/// Walls of many pieces turn a disc back as one wall does: along them it keeps its speed.
TEST(MovingObstacles, SlideAlongWallsOfAMapAndStayInItsRooms) {
  Scenario scenario = open_scene(0.0, NoiseModel::white);
  const std::size_t side = 200;
  std::vector<std::int8_t> values(side * side, 0);
  for (std::size_t i = 0; i < side; ++i) values[100 * side + i] = 100;  // a wall from edge to edge
  const double heading = 0.5;
  scenario.map = std::make_shared<const StaticMap>(Pose2{{0.0, 0.0}, heading}, 0.1, side, side, values);
  const Eigen::Rotation2Dd turn{heading};
  ObstacleState disc;
  disc.position_world = turn * Eigen::Vector2d{3.0, 5.0};
  disc.velocity_world = turn * Eigen::Vector2d{0.3, 0.7};
  disc.radius = 0.4;
  scenario.moving = {disc};
  scenario.polygons = {{{turn * Eigen::Vector2d{15.0, 2.0}, turn * Eigen::Vector2d{17.0, 2.0},
                         turn * Eigen::Vector2d{16.0, 4.0}}}};
  MovingObstacles obstacles{scenario};
  int turns = 0;
  double before = 0.7;
  for (int step = 0; step < 3000; ++step) {
    obstacles.advance();
    const ObstacleState& now = obstacles.next()[0];
    const Eigen::Vector2d at = turn.inverse() * now.position_world;
    ASSERT_GE(std::min(at.x(), at.y()), 0.4 - 1e-6) << step;
    ASSERT_LE(at.y(), 10.0 - 0.4 + 1e-6) << step;
    ASSERT_LE(at.x(), 20.0 - 0.4 + 1e-6) << step;
    ASSERT_GE(signed_distance_to_polygon(now.position_world, scenario.polygons[0].corners), 0.4 - 1e-6);
    ASSERT_NEAR(now.velocity_world.norm(), disc.velocity_world.norm(), 1e-9);
    if (step < 300) {  // until it comes to the triangle
      const Eigen::Vector2d velocity = turn.inverse() * now.velocity_world;
      ASSERT_NEAR(velocity.x(), 0.3, 1e-9) << step;
      if (velocity.y() * before < 0.0) ++turns;
      before = velocity.y();
    }
  }
  EXPECT_GE(turns, 2);
}

TEST(MovingObstacles, FirstDiscsDrawTheSameWhateverFollows) {
  Scenario one = open_scene(1.0, NoiseModel::white);
  one.moving = {disc_at(0.0, 0.0, 0.6, 0.0)};
  Scenario other_level = one;
  other_level.simulation.noise.level = 2.0;
  MovingObstacles first{one};
  MovingObstacles again{one};
  MovingObstacles other{other_level};
  for (int step = 0; step < 10; ++step) {
    first.advance();
    again.advance();
    other.advance();
  }
  EXPECT_EQ(first.next()[0].position_world, again.next()[0].position_world);
  EXPECT_NE(first.next()[0].position_world, other.next()[0].position_world);
}

}  // namespace
}  // namespace spf::sim
