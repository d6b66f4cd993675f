#include "spf/robot/robot_scale.hpp"

#include <gtest/gtest.h>

namespace spf {
namespace {

struct Numbers {
  double margin = 0.1;     // [m]
  double distance = 10.0;  // [m]
  double speed = 0.5;      // [m/s]
  double response = 2.0;   // [s]
  double diffusion = 0.4;  // [m^2/s^3]
  double period = 0.1;     // [s] of a sensor, say: independent of the robot
  int count = 3;

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit("margin", self.margin, kMetresBySize, Range{0.0, 0.3}, "margin");
    visit("distance", self.distance, kMetresByStopping, Range{0.0, 1000.0}, "distance");
    visit("speed", self.speed, kSpeedByRobot, Range{0.0, 10.0}, "speed");
    visit("response", self.response, kSecondsByRobot, Range{0.0, 100.0}, "response");
    visit("diffusion", self.diffusion, ScaledUnit{"m^2/s^3", Scale::velocity_diffusion}, Range{0.0, 1.0},
          "diffusion");
    visit("period", self.period, "s", Range{0.0, 100.0}, "period");
    visit("count", self.count, "1", Range{0, 100}, "count");
  }
};

struct Constants {
  double tolerance = 0.1;  // [m]
  int count = 3;

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit("count", self.count, "1", Range{0, 100}, "count");
  }
  template <class Self, class Visitor>
  static void visit_constants(Self& self, Visitor&& visit) {
    visit(self.tolerance, Scale::size, Range{0.0, 0.3});
  }
};

struct Outer {
  Numbers inner;
  Constants constants;
  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit.group("inner", self.inner);
    visit.group("constants", self.constants);
  }
};

RobotParameters robot_of(double radius, double speed, double acceleration) {
  RobotParameters robot;
  robot.radius = radius;
  robot.max_speed = speed;
  robot.max_acceleration = acceleration;
  return robot;
}

TEST(RobotScale, LeavesTheStandardRobotsDefaultsAlone) {
  const Numbers numbers = scaled(Numbers{}, RobotScale{RobotParameters{}});
  EXPECT_EQ(numbers.margin, 0.1);  // exact: factors are 1
  EXPECT_EQ(numbers.distance, 10.0);
  EXPECT_EQ(numbers.speed, 0.5);
  EXPECT_EQ(numbers.response, 2.0);
}

// Half as large and half as fast, in the same time: a model of the standard robot at scale 1 : 2.
TEST(RobotScale, HalvesLengthsAndSpeedsButNoTimesOfAModelAtHalfScale) {
  const Outer outer = scaled(Outer{}, RobotScale{robot_of(0.15, 0.5, 0.5)});
  EXPECT_DOUBLE_EQ(outer.inner.margin, 0.05);
  EXPECT_DOUBLE_EQ(outer.inner.distance, 5.0);
  EXPECT_DOUBLE_EQ(outer.inner.speed, 0.25);
  EXPECT_DOUBLE_EQ(outer.inner.response, 2.0);
  EXPECT_DOUBLE_EQ(outer.inner.diffusion, 0.1);
  EXPECT_EQ(outer.inner.period, 0.1);
  EXPECT_EQ(outer.inner.count, 3);
}

TEST(RobotScale, ScalesWhatIsNoSettingToo) {
  EXPECT_DOUBLE_EQ(scaled(Outer{}, RobotScale{robot_of(0.15, 0.5, 0.5)}).constants.tolerance, 0.05);
  EXPECT_DOUBLE_EQ(scaled(Constants{}, RobotScale{robot_of(0.6, 2.0, 2.0)}).tolerance, 0.2);
  EXPECT_EQ(scaled(Constants{}, RobotScale{robot_of(3.0, 1.0, 1.0)}).tolerance, 0.3);
  EXPECT_TRUE(problems(Constants{}).empty());
}

TEST(RobotScale, GivesARobotThatStopsSlowlyMoreTimeAndWay) {
  const RobotScale scale{robot_of(0.3, 1.0, 0.1)};
  EXPECT_EQ(scale.factor(Scale::size), 1.0);
  EXPECT_NEAR(scale.factor(Scale::time), (10.0 + 0.3) / 1.3, 1e-12);
  EXPECT_NEAR(scale.factor(Scale::stopping_distance), 10.0, 1e-12);
}

// Slow robots take long to clear their own footprint, however well they brake.
TEST(RobotScale, GivesARobotThatIsSlowForItsSizeMoreTime) {
  EXPECT_NEAR(RobotScale(robot_of(0.3, 0.1, 1.0)).factor(Scale::time), 3.1 / 1.3, 1e-12);
}

TEST(RobotScale, KeepsDefaultsWithinTheirRange) {
  EXPECT_EQ(scaled(Numbers{}, RobotScale{robot_of(3.0, 1.0, 1.0)}).margin, 0.3);
}

TEST(RobotScale, ComparesAnyTwoRobots) {
  const RobotParameters small = robot_of(0.05, 0.3, 0.5);
  const RobotParameters large = robot_of(0.10, 0.6, 1.0);
  EXPECT_DOUBLE_EQ(RobotScale(large, small).factor(Scale::size), 2.0);
  EXPECT_DOUBLE_EQ(RobotScale(large, small).factor(Scale::time), 1.0);
}

}  // namespace
}  // namespace spf
