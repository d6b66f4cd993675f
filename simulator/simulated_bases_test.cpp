#include "simulator/simulated_bases.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace spf::simulator {
namespace {

constexpr double kPeriod = 0.05;  // [s]

SimulatedBases two_bases() {
  return {std::vector<spf::RobotParameters>(2), kPeriod};
}

TEST(SimulatedBases, TurnAVelocityIntoTheWheelSpeedsThatCauseIt) {
  SimulatedBases bases = two_bases();
  const Eigen::Vector3d twist{0.3, -0.2, 0.4};
  bases.command_twist(1, twist, 0.0);
  const spf::Drive drive{spf::RobotParameters{}};
  EXPECT_TRUE(drive.twist_body(bases.wheels(1, 0.0)).isApprox(twist, 1e-12));
  EXPECT_EQ(bases.wheels(0, 0.0), Eigen::Vector3d::Zero());
  EXPECT_EQ(bases.record(1).cut, 0);
}

TEST(SimulatedBases, SlowDownWhatTheWheelsCannotDoWithoutChangingItsDirection) {
  SimulatedBases bases = two_bases();
  bases.command_twist(0, {30.0, 10.0, 2.0}, 0.0);
  const spf::Drive drive{spf::RobotParameters{}};
  EXPECT_NEAR(bases.wheels(0, 0.0).cwiseAbs().maxCoeff(), drive.max_wheel_speed(), 1e-12);
  const Eigen::Vector3d twist = drive.twist_body(bases.wheels(0, 0.0));
  EXPECT_NEAR(twist.y() / twist.x(), 10.0 / 30.0, 1e-12);
  EXPECT_NEAR(twist.z() / twist.x(), 2.0 / 30.0, 1e-12);
  EXPECT_EQ(bases.record(0).cut, 1);
}

TEST(SimulatedBases, ClipEachWheelOfAWheelCommand) {
  SimulatedBases bases = two_bases();
  const double limit = spf::Drive{spf::RobotParameters{}}.max_wheel_speed();
  bases.command_wheels(0, {0.5 * limit, -3.0 * limit, 0.1 * limit}, 0.0);
  EXPECT_TRUE(bases.wheels(0, 0.0).isApprox(Eigen::Vector3d{0.5 * limit, -limit, 0.1 * limit}));
  EXPECT_EQ(bases.record(0).cut, 1);
}

TEST(SimulatedBases, StopTheirWheelsWhenCommandsStop) {
  SimulatedBases bases = two_bases();
  bases.command_twist(0, {0.5, 0.0, 0.0}, 1.0);
  EXPECT_NE(bases.wheels(0, 1.49), Eigen::Vector3d::Zero());
  EXPECT_EQ(bases.wheels(0, 1.51), Eigen::Vector3d::Zero());
  bases.command_twist(0, {0.5, 0.0, 0.0}, 2.0);
  EXPECT_NE(bases.wheels(0, 2.0), Eigen::Vector3d::Zero());
}

TEST(SimulatedBases, RefuseWhatIsNoCommand) {
  SimulatedBases bases = two_bases();
  bases.command_twist(0, {0.5, 0.0, 0.0}, 0.0);
  const Eigen::Vector3d before = bases.wheels(0, 0.1);
  bases.command_twist(0, {std::nan(""), 0.0, 0.0}, 0.1);
  bases.command_wheels(0, {0.1, 0.2}, 0.1);
  bases.command_wheels(0, {0.1, 0.2, std::numeric_limits<double>::infinity()}, 0.1);
  EXPECT_EQ(bases.wheels(0, 0.1), before);
  EXPECT_EQ(bases.record(0).refused, 3);
  EXPECT_EQ(bases.wheels(0, 0.6), Eigen::Vector3d::Zero());  // a refused command keeps nobody going
}

TEST(SimulatedBases, CountCommandsThatCameLate) {
  SimulatedBases bases = two_bases();
  for (const double time : {0.0, 0.05, 0.1, 0.18, 0.23})
    bases.command_twist(0, Eigen::Vector3d::Zero(), time);
  EXPECT_EQ(bases.record(0).count, 5);
  EXPECT_EQ(bases.record(0).late, 1);
  EXPECT_NEAR(bases.record(0).longest_gap, 0.08, 1e-12);
}

}  // namespace
}  // namespace spf::simulator
