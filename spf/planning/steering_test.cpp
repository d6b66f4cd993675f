// What a robot that cannot move sideways is asked to do, and what it does.
#include "spf/planning/steering.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "spf/math/angles.hpp"
#include "spf/math/random_stream.hpp"
#include "spf/planning/braking.hpp"

namespace spf {
namespace {

constexpr double kStepTime = 0.1;  // [s]

RobotParameters robot_on(DriveType drive) {
  RobotParameters robot;
  robot.drive = drive;
  return robot;
}

/// Largest breach of what the drive can do along a trajectory.
struct Breaches {
  double sideways = 0.0;      // [m/s]
  double speed = 0.0;         // [m/s]
  double acceleration = 0.0;  // [m/s^2]
  double yaw_rate = 0.0;      // [rad/s]
  double curvature = 0.0;     // [1/m]
};

Breaches breaches_of(const Trajectory& trajectory) {
  Breaches found;
  for (double time = trajectory.start_time(); time <= trajectory.end_time(); time += 0.01) {
    const FlatState flat = trajectory.state(time);
    const HeadingState heading = trajectory.heading_state(time);
    const Eigen::Vector3d twist =
        twist_in_body({flat.velocity_world.x(), flat.velocity_world.y(), heading.yaw_rate}, heading.heading);
    found.sideways = std::max(found.sideways, std::abs(twist.y()));
    found.speed = std::max(found.speed, std::abs(twist.x()));
    found.acceleration = std::max(found.acceleration, flat.acceleration_world.norm());
    found.yaw_rate = std::max(found.yaw_rate, std::abs(twist.z()));
    if (std::abs(twist.x()) > 0.1)
      found.curvature = std::max(found.curvature, std::abs(twist.z() / twist.x()));
  }
  return found;
}

/// Rolled out towards velocities that change at random, then braked.
Trajectory random_drive(const RobotParameters& robot, std::uint64_t seed) {
  const Steering steering{robot};
  RandomStream random{seed};
  Trajectory trajectory{2.0};
  SteeredState state;
  state.heading = random.uniform(-kPi, kPi);
  for (int piece = 0; piece < 20; ++piece) {
    const double angle = random.uniform(-kPi, kPi);
    const Eigen::Vector2d wanted =
        random.uniform(0.0, 1.2) * Eigen::Vector2d{std::cos(angle), std::sin(angle)};
    const SteeredState from = state;
    const Gear gear = random.uniform() < 0.3 ? Gear::reverse : Gear::forward;
    steering.step(wanted, gear, kStepTime, state);
    Steering::append(from, state, kStepTime, trajectory);
  }
  steering.append_braking(state, 8, trajectory);
  return trajectory;
}

TEST(Steering, NeverMovesSidewaysNorBeyondTheLimits) {
  for (const DriveType drive : {DriveType::differential, DriveType::car}) {
    const RobotParameters robot = robot_on(drive);
    for (std::uint64_t seed = 0; seed < 50; ++seed) {
      const Trajectory trajectory = random_drive(robot, seed);
      const Breaches found = breaches_of(trajectory);
      EXPECT_LT(found.sideways, 0.02) << "seed " << seed;  // of a cubic that is driven as an arc
      EXPECT_LT(found.speed, 1.01 * robot.max_speed) << "seed " << seed;
      EXPECT_LT(found.acceleration, 1.15 * robot.max_acceleration) << "seed " << seed;
      EXPECT_LT(found.yaw_rate, 1.02 * robot.max_yaw_rate) << "seed " << seed;
      if (drive == DriveType::car) {
        EXPECT_LT(found.curvature, 1.05 / robot.min_turning_radius) << "seed " << seed;
      }
      const double end = trajectory.end_time();
      EXPECT_LT(trajectory.state(end).velocity_world.norm(), 1e-9);
      EXPECT_LT(std::abs(trajectory.heading_state(end).yaw_rate), 0.005);
    }
  }
}

TEST(Steering, TakesUpAVelocityAsSoonAsItFacesIt) {
  const Steering steering{robot_on(DriveType::differential)};
  for (const double aim : {0.0, 0.7, -1.6, 3.1}) {
    SteeredState state;
    const Eigen::Vector2d wanted{0.8 * std::cos(aim), 0.8 * std::sin(aim)};
    for (int k = 0; k < 50; ++k) steering.step(wanted, Gear::forward, kStepTime, state);
    EXPECT_LT((state.velocity_world() - wanted).norm(), 1e-3) << aim;
    SteeredState back;
    for (int k = 0; k < 50; ++k) steering.step(wanted, Gear::reverse, kStepTime, back);
    EXPECT_LT((back.velocity_world() - wanted).norm(), 1e-3) << aim;
    EXPECT_LT(back.speed, 0.0);
  }
}

TEST(Steering, TurnsOnTheSpotOnlyWhereTheDriveCan) {
  SteeredState state;
  for (int k = 0; k < 60; ++k) Steering{robot_on(DriveType::differential)}.turn(2.5, kStepTime, state);
  EXPECT_NEAR(state.heading, 2.5, 1e-6);
  EXPECT_LT(state.position_world.norm(), 1e-12);
  SteeredState car;
  for (int k = 0; k < 60; ++k) Steering{robot_on(DriveType::car)}.turn(2.5, kStepTime, car);
  EXPECT_EQ(car.heading, 0.0);
}

// Straight on, a quarter and a half circle, and to the side, where the circles of both sides are too wide.
TEST(Steering, TurningTimeIsThatOfTheShortestWay) {
  RobotParameters robot = robot_on(DriveType::car);
  robot.may_reverse = false;
  const double radius = robot.min_turning_radius;
  const Steering car{robot};
  const auto time_to = [&](double x, double y) { return car.turning_time(SteeredState{}, {x, y}); };
  EXPECT_NEAR(time_to(5.0, 0.0), 0.0, 1e-9);
  EXPECT_NEAR(time_to(radius, radius + 2.0), 0.5 * kPi * radius + 2.0 - std::hypot(radius, radius + 2.0),
              1e-9);
  EXPECT_NEAR(time_to(-3.0, 2.0 * radius), kPi * radius + 3.0 - std::hypot(3.0, 2.0 * radius), 1e-9);
  EXPECT_NEAR(time_to(0.0, 2.0 * radius), kPi * radius - 2.0 * radius, 1e-6);
  EXPECT_NEAR(time_to(-3.0, -2.0 * radius), time_to(-3.0, 2.0 * radius), 1e-9);
  EXPECT_GT(time_to(0.0, 0.3 * radius), 1.5 * kPi * radius);  // a whole loop
  const Steering reverses{robot_on(DriveType::car)};
  EXPECT_LT(reverses.turning_time(SteeredState{}, {-2.0, 0.0}), 1.0);
  const Steering differential{robot_on(DriveType::differential)};
  EXPECT_NEAR(differential.turning_time(SteeredState{}, {0.0, 1.0}), 0.5 * kPi / (0.9 * 1.5), 1e-9);
}

TEST(Steering, BrakingStaysOnTheHeading) {
  for (const DriveType drive : {DriveType::differential, DriveType::car}) {
    RobotParameters robot = robot_on(drive);
    for (const double slow : {1.0, 0.2}) {
      robot.max_acceleration = slow;
      const FlatState head{{1.0, 2.0}, {0.6, 0.8}, {}};
      const HeadingState heading{std::atan2(0.8, 0.6), 0.4};
      const Trajectory braking = braking_trajectory(head, heading, 3.0, robot);
      const Breaches found = breaches_of(braking);
      EXPECT_LT(found.sideways, 0.03);
      EXPECT_LT(found.acceleration, 1.2 * std::hypot(slow, 0.4));
      EXPECT_LT((braking.state(3.0).velocity_world - head.velocity_world).norm(), 1e-9);
      EXPECT_LT(braking.state(braking.end_time()).velocity_world.norm(), 1e-9);
      EXPECT_LT(braking.length(), 1.2 * 0.5 / slow);
    }
  }
}

// A path made for robots that move every way, with a corner: it is followed with a turn.
TEST(Steering, FollowsATrajectoryMadeForOtherRobots) {
  Trajectory wanted{1.0};
  QuinticPiece piece;
  piece.duration = 3.0;
  piece.coefficients(1, 0) = 0.6;
  wanted.append(piece);
  piece.coefficients.setZero();
  piece.coefficients(0, 0) = 1.8;
  piece.coefficients(1, 1) = 0.6;
  wanted.append(piece);
  const RobotParameters robot = robot_on(DriveType::differential);
  const Trajectory steered = steered_along(wanted, FlatState{}, HeadingState{}, robot);
  ASSERT_TRUE(steered.steered());
  EXPECT_LT(breaches_of(steered).sideways, 0.03);
  EXPECT_LT((steered.position(1.0 + 3.0) - wanted.position(1.0 + 3.0)).norm(), 0.4);
  EXPECT_LT((steered.position(steered.end_time()) - Eigen::Vector2d{1.8, 1.8}).norm(), 0.15);
}

}  // namespace
}  // namespace spf
