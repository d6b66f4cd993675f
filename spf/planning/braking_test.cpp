#include "spf/planning/braking.hpp"

#include <gtest/gtest.h>

#include "spf/math/random_stream.hpp"

namespace spf {
namespace {

FlatState draw_head(RandomStream& random, const RobotParameters& robot) {
  FlatState head;
  head.position_world = 3.0 * random.normal2();
  head.velocity_world = robot.max_speed * random.uniform() * random.normal2().normalized();
  head.acceleration_world = robot.max_acceleration * random.uniform() * random.normal2().normalized();
  return head;
}

TEST(Braking, EndsAtRestWithinTheLimits) {
  RandomStream random{31};
  const RobotParameters robot;
  for (int i = 0; i < 300; ++i) {
    SCOPED_TRACE(i);
    const FlatState head = draw_head(random, robot);
    const Trajectory braking = braking_trajectory(head, {0.4, 1.0}, 5.0, robot);
    const FlatState start = braking.state(5.0);
    EXPECT_LT((start.position_world - head.position_world).norm(), 1e-12);
    EXPECT_LT((start.velocity_world - head.velocity_world).norm(), 1e-12);
    EXPECT_LT((start.acceleration_world - head.acceleration_world).norm(), 1e-12);
    const QuinticPiece& last = braking.piece(braking.piece_count() - 1);
    EXPECT_LT(last.velocity(last.duration).norm(), 1e-12);
    EXPECT_LT(last.acceleration(last.duration).norm(), 1e-12);
    EXPECT_LE(braking.max_acceleration(), robot.max_acceleration + 1e-9);
    // Within the time and distance of a constant deceleration plus the ramps' and what the head still
    // accelerates.
    const double speed = head.velocity_world.norm();
    EXPECT_LE(braking.duration(), speed / robot.max_acceleration + 0.25);
    EXPECT_LE((braking.tail_position() - head.position_world).norm(),
              speed * speed / (2.0 * robot.max_acceleration) + 0.25 * speed + 0.02);
  }
}

TEST(Braking, IsContinuousUpToTheAcceleration) {
  RandomStream random{37};
  const RobotParameters robot;
  for (int i = 0; i < 100; ++i) {
    const Trajectory braking = braking_trajectory(draw_head(random, robot), {}, 0.0, robot);
    for (int k = 0; k + 1 < braking.piece_count(); ++k) {
      const QuinticPiece& a = braking.piece(k);
      const QuinticPiece& b = braking.piece(k + 1);
      EXPECT_LT((a.position(a.duration) - b.position(0.0)).norm(), 1e-12);
      EXPECT_LT((a.velocity(a.duration) - b.velocity(0.0)).norm(), 1e-12);
      EXPECT_LT((a.acceleration(a.duration) - b.acceleration(0.0)).norm(), 1e-12);
    }
  }
}

TEST(Braking, StaysStraightOnAStraightRun) {
  FlatState head;
  head.velocity_world = {0.6, 0.8};
  head.acceleration_world = {0.3, 0.4};
  const Trajectory braking = braking_trajectory(head, {}, 0.0, RobotParameters{});
  for (int i = 0; i <= 20; ++i) {
    const Eigen::Vector2d p = braking.position(braking.duration() * i / 20.0);
    EXPECT_NEAR(p.x() * 0.8 - p.y() * 0.6, 0.0, 1e-12);
  }
}

TEST(Braking, StandsWhenAtRest) {
  const Trajectory standing = braking_trajectory({}, {}, 1.0, RobotParameters{});
  EXPECT_EQ(standing.max_speed(), 0.0);
  EXPECT_GT(standing.duration(), 0.0);
}

TEST(Braking, StopsTheHeadingToo) {
  const RobotParameters robot;
  for (const double yaw_rate : {1.2, -0.7}) {
    FlatState head;
    head.velocity_world = {1.0, 0.0};
    const Trajectory braking = braking_trajectory(head, {3.0, yaw_rate}, 2.0, robot);
    EXPECT_NEAR(braking.heading_state(2.0).yaw_rate, yaw_rate, 1e-12);
    const double stop_time = std::abs(yaw_rate) / robot.max_yaw_acceleration;
    EXPECT_NEAR(braking.heading_state(2.0 + stop_time + 1e-6).yaw_rate, 0.0, 1e-5);
  }
}

}  // namespace
}  // namespace spf
