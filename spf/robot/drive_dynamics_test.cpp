#include "spf/robot/drive_dynamics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "spf/math/angles.hpp"
#include "spf/math/random_stream.hpp"

namespace spf {
namespace {

std::vector<RobotParameters> plants() {
  std::vector<RobotParameters> robots(5);
  robots[1].drive = DriveType::mecanum;
  robots[2].drive = DriveType::differential;
  robots[3].drive = DriveType::car;
  robots[4].wheels = 4;
  return robots;
}

DriveInput random_command(const Drive& drive, RandomStream& random) {
  DriveInput command = drive.standstill();
  for (int i = 0; i < drive.inputs(); ++i) command[i] = random.uniform(drive.lower()[i], drive.upper()[i]);
  return command;
}

/// Work of the motors in one step, from the motion that it made.
double work(const DriveDynamics& plant, const DriveInput& rims_before, double radius, double dt) {
  const DriveInput mean = 0.5 * (rims_before + plant.input());
  return dt * plant.torques().dot(mean.head(plant.torques().size())) / radius;
}

TEST(DriveDynamics, EnergyIsTheWorkOfTheMotors) {
  RandomStream random{3};
  for (const RobotParameters& robot : plants()) {
    if (robot.drive == DriveType::omni || robot.drive == DriveType::mecanum) continue;  // ThreeWheelPlant
    DriveDynamics plant{robot};
    for (int i = 0; i < 300; ++i) {
      const DriveInput before = plant.input();
      const double energy = plant.kinetic_energy();
      DriveInput command = random_command(plant.drive(), random);
      if (robot.drive == DriveType::car) command[1] = 0.2;
      plant.step(0.01, command);
      if (robot.drive == DriveType::car && i < 100)
        continue;  // while it still steers the rims' mean is not exact
      EXPECT_NEAR(plant.kinetic_energy() - energy, work(plant, before, robot.wheel_radius, 0.01), 1e-9)
          << enum_name(robot.drive);
    }
  }
}

TEST(DriveDynamics, SteeringAloneGivesACarNoEnergy) {
  RobotParameters robot;
  robot.drive = DriveType::car;
  robot.max_wheel_torque = 10.0;
  DriveDynamics driven{robot};
  for (int i = 0; i < 200; ++i) driven.step(0.01, Eigen::Vector2d(1.0, 0.0));
  const double energy = driven.kinetic_energy();
  EXPECT_GT(energy, 4.0);
  // Coasting: the speed loop asks for little while the command is the speed that steering leaves.
  for (int i = 0; i < 100; ++i) driven.step(0.01, Eigen::Vector2d(driven.input()[0], i < 50 ? 0.5 : -0.5));
  EXPECT_NEAR(driven.kinetic_energy(), energy, 0.1 * energy);
  robot.max_wheel_torque = 1e-4;
  DriveDynamics weak{robot};
  weak.step(0.01, Eigen::Vector2d(1.0, 0.5));
  EXPECT_LT(weak.kinetic_energy(), 1e-8);
}

TEST(DriveDynamics, FollowsTheMotorLagWhileTorqueSuffices) {
  for (RobotParameters robot : plants()) {
    robot.max_wheel_torque = 1e3;
    robot.friction = 1e3;
    robot.max_steering_rate = 50.0;
    DriveDynamics plant{robot};
    const DriveInput command =
        plant.drive().saturated(plant.drive().input_for(plant.drive().possible({0.6, 0.2, 0.5})));
    for (int i = 0; i < 20; ++i) plant.step(0.005, command);
    EXPECT_LT((plant.input() - command * (1.0 - std::exp(-2.0))).norm(), 1e-9) << enum_name(robot.drive);
  }
}

TEST(DriveDynamics, DifferentialAndCarNeverSlideSideways) {
  for (RobotParameters robot : plants()) {
    if (robot.drive != DriveType::differential && robot.drive != DriveType::car) continue;
    robot.max_wheel_torque = 4.0;
    DriveDynamics plant{robot};
    // On a circle it comes back to where it was.
    const DriveInput circle = plant.drive().input_for({0.6, 0.0, 0.8});
    for (int i = 0; i < 400; ++i) plant.step(0.01, circle);
    EXPECT_NEAR(plant.twist_body().y(), 0.0, 1e-15);
    EXPECT_NEAR(plant.twist_body().z(), 0.8, 1e-6);
    const Pose2 before = plant.state().pose_world;
    const double period = 2.0 * kPi / plant.twist_body().z();
    for (int i = 0; i < 100; ++i) plant.step(0.01 * period, circle);
    EXPECT_LT((plant.state().pose_world.position_world - before.position_world).norm(), 1e-4)
        << enum_name(robot.drive);
  }
}

TEST(DriveDynamics, GroundLimitsTheForce) {
  for (RobotParameters robot : plants()) {
    robot.max_wheel_torque = 100.0;
    robot.motor_lag = 0.0;
    robot.friction = 0.2;
    DriveDynamics plant{robot};
    plant.step(0.1, plant.drive().input_for({1.0, 0.0, 0.0}));
    EXPECT_LE(plant.twist_body().norm(), 0.2 * 9.81 * 0.1 * (1.0 + 1e-9)) << enum_name(robot.drive);
    EXPECT_GT(plant.twist_body().x(), 0.05);
  }
}

TEST(DriveDynamics, BeginsWithTheMotionThatItsDriveCanDo) {
  for (const RobotParameters& robot : plants()) {
    const DriveDynamics plant{robot, PlantState{Pose2{{1.0, 2.0}, 0.5}, {0.4, 0.3, 0.1}}};
    const Eigen::Vector3d twist = twist_in_body({0.4, 0.3, 0.1}, 0.5);
    EXPECT_LT((plant.twist_body() - plant.drive().possible(twist)).norm(), 1e-12) << enum_name(robot.drive);
    EXPECT_LT((plant.drive().twist_body(plant.input()) - plant.twist_body()).norm(), 1e-12);
  }
}

TEST(DriveDynamics, StandsOnACommandThatIsNone) {
  for (const RobotParameters& robot : plants()) {
    DriveDynamics plant{robot};
    DriveInput command = plant.drive().standstill();
    command[0] = std::nan("");
    plant.step(0.01, command);
    plant.step(0.01, DriveInput::Ones(plant.drive().inputs() % kMaxDriveInputs + 1));
    EXPECT_EQ(plant.twist_body(), Eigen::Vector3d::Zero());
  }
}

}  // namespace
}  // namespace spf
