#include "spf/robot/drive_dynamics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <vector>

#include "spf/math/angles.hpp"
#include "spf/math/random_stream.hpp"
#include "spf/robot/omni_dynamics.hpp"

namespace spf {
namespace {

std::vector<DriveDesign> designs_of_plants() {
  std::vector<DriveDesign> designs(4);
  designs[1].type = DriveType::mecanum;
  designs[2].type = DriveType::differential;
  designs[3].type = DriveType::car;
  designs.push_back({});
  designs.back().wheel_angles = {0.0, 0.5 * kPi, kPi, 1.5 * kPi};
  return designs;
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
  const DriveBody body;
  for (const DriveDesign& design : designs_of_plants()) {
    if (design.type == DriveType::omni || design.type == DriveType::mecanum) continue;  // OmniDynamics
    DriveDynamics plant{design, body};
    for (int i = 0; i < 300; ++i) {
      const DriveInput before = plant.input();
      const double energy = plant.kinetic_energy();
      DriveInput command = random_command(plant.drive(), random);
      if (design.type == DriveType::car) command[1] = 0.2;
      plant.step(0.01, command);
      if (design.type == DriveType::car && i < 100)
        continue;  // while it still steers the rims' mean is not exact
      EXPECT_NEAR(plant.kinetic_energy() - energy, work(plant, before, body.wheel_radius, 0.01), 1e-9)
          << enum_name(design.type);
    }
  }
}

TEST(DriveDynamics, SteeringAloneGivesACarNoEnergy) {
  DriveDesign design;
  design.type = DriveType::car;
  DriveBody body;
  body.max_wheel_torque = 1e-9;
  DriveDynamics fast{design, body};
  DriveBody strong = body;
  strong.max_wheel_torque = 10.0;
  DriveDynamics driven{design, strong};
  for (int i = 0; i < 200; ++i) driven.step(0.01, Eigen::Vector2d(1.0, 0.0));
  const double energy = driven.kinetic_energy();
  EXPECT_GT(energy, 4.0);
  // Coasting: the speed loop asks for nothing while the command is the speed that steering leaves.
  for (int i = 0; i < 100; ++i) driven.step(0.01, Eigen::Vector2d(driven.input()[0], i < 50 ? 0.5 : -0.5));
  EXPECT_NEAR(driven.kinetic_energy(), energy, 0.1 * energy);
  fast.step(0.01, Eigen::Vector2d(1.0, 0.5));
  EXPECT_LT(fast.kinetic_energy(), 1e-12);
}

TEST(DriveDynamics, FollowsTheMotorLagWhileTorqueSuffices) {
  DriveBody body;
  body.max_wheel_torque = 1e4;
  body.friction = 1e4;
  body.max_steering_rate = 1e3;
  for (const DriveDesign& design : designs_of_plants()) {
    DriveDynamics plant{design, body};
    const DriveInput command =
        plant.drive().saturated(plant.drive().input_for(plant.drive().possible({0.6, 0.2, 0.5})));
    for (int i = 0; i < 20; ++i) plant.step(0.005, command);
    EXPECT_LT((plant.input() - command * (1.0 - std::exp(-2.0))).norm(), 1e-9) << enum_name(design.type);
  }
}

TEST(DriveDynamics, OfThreeOmniWheelsIsThePapersPlant) {
  const RobotParameters robot;
  OmniDynamics paper{robot};
  DriveBody body;
  body.friction = 100.0;
  DriveDynamics plant{DriveDesign{}, body};
  RandomStream random{4};
  for (int i = 0; i < 300; ++i) {
    const DriveInput command = random_command(plant.drive(), random);
    paper.step(0.01, command);
    plant.step(0.01, command);
  }
  EXPECT_LT((paper.state().pose_world.position_world - plant.pose_world().position_world).norm(), 1e-9);
  EXPECT_LT((paper.state().twist_world - plant.twist_world()).norm(), 1e-9);
}

TEST(DriveDynamics, DifferentialAndCarNeverSlideSideways) {
  for (const DriveDesign& design : designs_of_plants()) {
    if (design.type != DriveType::differential && design.type != DriveType::car) continue;
    DriveBody body;
    body.max_wheel_torque = 4.0;
    DriveDynamics plant{design, body};
    // On a circle it comes back to where it was.
    const DriveInput circle = plant.drive().input_for({0.6, 0.0, 0.8});
    for (int i = 0; i < 400; ++i) plant.step(0.01, circle);
    EXPECT_EQ(plant.twist_body().y(), 0.0);
    EXPECT_NEAR(plant.twist_body().z(), 0.8, 1e-6);
    const Pose2 before = plant.pose_world();
    const double period = 2.0 * kPi / plant.twist_body().z();
    for (int i = 0; i < 100; ++i) plant.step(0.01 * period, circle);
    EXPECT_LT((plant.pose_world().position_world - before.position_world).norm(), 1e-4)
        << enum_name(design.type);
  }
}

TEST(DriveDynamics, GroundLimitsTheForce) {
  DriveBody body;
  body.max_wheel_torque = 100.0;
  body.motor_lag = 0.0;
  body.friction = 0.2;
  for (const DriveDesign& design : designs_of_plants()) {
    DriveDynamics plant{design, body};
    plant.step(0.1, plant.drive().input_for({1.0, 0.0, 0.0}));
    EXPECT_LE(plant.twist_body().norm(), 0.2 * 9.81 * 0.1 * (1.0 + 1e-9)) << enum_name(design.type);
    EXPECT_GT(plant.twist_body().x(), 0.05);
  }
}

TEST(DriveDynamics, RefusesABodyWithoutMass) {
  DriveBody body;
  body.mass = 0.0;
  EXPECT_THROW((DriveDynamics{DriveDesign{}, body}), std::invalid_argument);
}

TEST(DriveDynamics, StandsOnACommandThatIsNone) {
  for (const DriveDesign& design : designs_of_plants()) {
    DriveDynamics plant{design, DriveBody{}};
    DriveInput command = plant.drive().standstill();
    command[0] = std::nan("");
    plant.step(0.01, command);
    plant.step(0.01, DriveInput::Ones(7));
    EXPECT_EQ(plant.twist_body(), Eigen::Vector3d::Zero());
  }
}

}  // namespace
}  // namespace spf
