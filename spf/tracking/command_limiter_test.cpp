#include "spf/tracking/command_limiter.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "spf/math/random_stream.hpp"

namespace spf {
namespace {

constexpr double kLimiterPeriod = 0.05;  // [s]
constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();

struct LimiterTest : testing::Test {
  RobotParameters robot;
  Drive drive{robot};
  CommandLimiter limiter{robot, drive, kLimiterPeriod};

  void renew() {
    drive = Drive{robot};
    limiter = CommandLimiter{robot, drive, kLimiterPeriod};
  }
  [[nodiscard]] Eigen::Vector3d wheels(double x, double y, double yaw_rate) const {
    return drive.input_for({x, y, yaw_rate});
  }
};

TEST_F(LimiterTest, LetsThroughWhatKeepsTheLimits) {
  const Eigen::Vector3d previous = wheels(0.5, 0.2, 0.3);
  const Eigen::Vector3d wanted = wheels(0.53, 0.21, 0.35);
  EXPECT_EQ(limiter.limited(wanted, previous, kLimiterPeriod), wanted);  // to the bit
  EXPECT_EQ(limiter.limited(wanted, wanted, kLimiterPeriod), wanted);
}

// Whatever is asked for, step by step: the commands never exceed a limit, nor change by more than they may.
TEST_F(LimiterTest, NoCommandExceedsALimitWhateverIsWanted) {
  RandomStream random{5};
  for (const double first_wheel_angle : {0.0, 0.4})
    for (const double max_wheel_speed : {1.5, 1.05}) {  // ample, and hardly enough to drive and turn at once
      robot.first_wheel_angle = first_wheel_angle;
      robot.max_wheel_speed = max_wheel_speed;
      renew();
      Eigen::Vector3d command = Eigen::Vector3d::Zero();
      double heading = 0.0;
      for (int i = 0; i < 20000; ++i) {
        Eigen::Vector3d wanted = 3.0 * Eigen::Vector3d{random.normal(), random.normal(), random.normal()};
        if (i % 97 == 0) wanted.setConstant(kNotANumber);
        const double elapsed = i % 13 == 0 ? random.uniform(0.0, 3.0) : kLimiterPeriod;
        const double counted = std::min(elapsed, kLimiterPeriod);
        const Eigen::Vector3d next = limiter.limited(wanted, command, elapsed);
        const Eigen::Vector3d before = drive.twist_world(command, heading);
        heading += counted * before.z();
        const Eigen::Vector3d twist = drive.twist_world(next, heading);
        const Eigen::Vector3d change = twist - before;
        ASSERT_LE(next.lpNorm<Eigen::Infinity>(), robot.max_wheel_speed * (1.0 + 1e-9));
        ASSERT_LE(twist.head<2>().norm(), 1.01 * robot.max_speed);
        ASSERT_LE(std::abs(twist.z()), 1.01 * robot.max_yaw_rate);
        ASSERT_LE(change.head<2>().norm(), 1.1 * robot.max_acceleration * counted + 1e-9) << i;
        ASSERT_LE(std::abs(change.z()), 1.1 * robot.max_yaw_acceleration * counted + 1e-9) << i;
        command = next;
      }
    }
}

// A robot that drives straight on and turns: in its own frame the velocity turns fast, in world not at all.
TEST_F(LimiterTest, LetsARobotTurnThatDrivesStraightOn) {
  robot.max_wheel_speed = 3.0;
  renew();
  double heading = 0.3;
  Eigen::Vector3d command = drive.input_from_world({1.0, 0.0, 1.5}, heading);
  for (int i = 0; i < 40; ++i) {
    heading += kLimiterPeriod * 1.5;
    const Eigen::Vector3d wanted = drive.input_from_world({1.0, 0.0, 1.5}, heading);
    ASSERT_EQ(limiter.limited(wanted, command, kLimiterPeriod), wanted);
    command = wanted;
  }
}

// One that has spun up to the limit of its wheels is not kept from driving: it turns less.
TEST_F(LimiterTest, GetsFromAnyMotionToAnyOther) {
  robot.max_wheel_speed = 1.05;
  renew();
  RandomStream random{7};
  for (int pair = 0; pair < 200; ++pair) {
    Eigen::Vector3d command = Eigen::Vector3d::Zero();
    for (int leg = 0; leg < 2; ++leg) {
      const double course = random.uniform(-3.0, 3.0);
      const double yaw_rate = random.uniform(-1.4, 1.4);
      const Eigen::Vector3d wanted =
          drive.saturated(wheels(0.9 * std::cos(course), 0.9 * std::sin(course), yaw_rate));
      // Turning on at the same time, the limits of the wheels turn with the body: only a steady one is met.
      const Eigen::Vector3d steady = drive.saturated(wheels(0.9 * std::cos(course), 0.0, 0.0));
      for (int i = 0; i < 100; ++i) command = limiter.limited(wanted, command, kLimiterPeriod);
      for (int i = 0; i < 100; ++i) command = limiter.limited(steady, command, kLimiterPeriod);
      ASSERT_LT((command - steady).norm(), 1e-9) << pair;
    }
  }
}

// Who sees the commands alone does not know how far the body has turned between two.
TEST_F(LimiterTest, KeepsTheLimitAsSeenFromTheBodyWhileItHardlyTurns) {
  RandomStream random{11};
  Eigen::Vector3d command = Eigen::Vector3d::Zero();
  for (int i = 0; i < 20000; ++i) {
    const Eigen::Vector3d wanted =
        wheels(2.0 * random.normal(), 2.0 * random.normal(), random.uniform(-0.3, 0.3));
    const Eigen::Vector3d next = limiter.limited(wanted, command, kLimiterPeriod);
    const Eigen::Vector3d change = drive.twist_body(next) - drive.twist_body(command);
    ASSERT_LE(change.head<2>().norm(), 1.1 * robot.max_acceleration * kLimiterPeriod) << i;
    command = next;
  }
}

TEST_F(LimiterTest, BrakesStraightAndToTheEnd) {
  Eigen::Vector3d command = wheels(0.6, 0.6, 1.0);
  double heading = 0.0;
  int ticks = 0;
  while (!command.isZero() && ticks < 100) {
    const Eigen::Vector3d twist = drive.twist_world(command, heading);
    EXPECT_NEAR(twist.x(), twist.y(), 0.1 * twist.head<2>().norm() + 1e-9);
    command = limiter.limited(Eigen::Vector3d::Zero(), command, kLimiterPeriod);
    heading += kLimiterPeriod * twist.z();
    ++ticks;
  }
  const double speed = 0.6 * std::sqrt(2.0);
  EXPECT_NEAR(ticks * kLimiterPeriod, speed / robot.max_acceleration, 0.1);
}

// A base that was driven by hand, or whose limits were lowered while it drove.
TEST_F(LimiterTest, LeadsBackWhatIsBeyondTheLimits) {
  robot.max_speed = 0.3;
  renew();
  Eigen::Vector3d command = wheels(1.2, 0.0, 0.0);
  double last = 1.2;
  for (int i = 0; i < 30; ++i) {
    command = limiter.limited(wheels(2.0, 0.0, 0.0), command, kLimiterPeriod);
    const double speed = drive.twist_body(command).x();
    EXPECT_LE(speed, last);
    EXPECT_LE(last - speed, 1.1 * robot.max_acceleration * kLimiterPeriod);
    last = speed;
  }
  EXPECT_NEAR(last, robot.max_speed, 0.01 * robot.max_speed);
}

TEST_F(LimiterTest, ALowerLimitIsBrakedToAndLiftedAgain) {
  Eigen::Vector3d command = wheels(1.0, 0.0, 0.0);
  const Eigen::Vector3d wanted = command;
  const auto speed_after = [&](double seconds) {
    for (int tick = 0; tick < std::lround(seconds / kLimiterPeriod); ++tick)
      command = limiter.limited(wanted, command, kLimiterPeriod);
    return drive.twist_body(command).head<2>().norm();
  };
  limiter.set_max_speed(0.3);
  const double braked = 0.5 * CommandLimiter::kAccelerationSpare * robot.max_acceleration;
  EXPECT_NEAR(speed_after(0.5), 1.0 - braked, 1e-9);
  EXPECT_NEAR(speed_after(1.0), 0.3 * CommandLimiter::kSpeedSpare, 1e-9);
  for (const double nonsense : {0.0, -1.0, kNotANumber}) limiter.set_max_speed(nonsense);
  EXPECT_NEAR(speed_after(1.0), 0.3 * CommandLimiter::kSpeedSpare, 1e-9);
  limiter.set_max_speed(10.0);  // no higher than the robot's own
  command = wheels(1.0, 0.0, 0.0);
  const double own = CommandLimiter::kSpeedSpare * robot.max_speed;
  EXPECT_LE(drive.twist_body(limiter.limited(wheels(1.02, 0.0, 0.0), command, kLimiterPeriod)).x(),
            own + 1e-9);
}

TEST_F(LimiterTest, WhatIsNotANumberIsAWishToStand) {
  const Eigen::Vector3d previous = wheels(0.5, 0.0, 0.0);
  const Eigen::Vector3d braked =
      limiter.limited(Eigen::Vector3d::Constant(kNotANumber), previous, kLimiterPeriod);
  EXPECT_LT(drive.twist_body(braked).x(), 0.5);
  EXPECT_GT(drive.twist_body(braked).x(), 0.4);
  EXPECT_TRUE(limiter.limited(previous, Eigen::Vector3d::Constant(kNotANumber), kLimiterPeriod).isZero());
  EXPECT_TRUE(limiter.limited(previous, previous, kNotANumber).isZero());
}

}  // namespace
}  // namespace spf
