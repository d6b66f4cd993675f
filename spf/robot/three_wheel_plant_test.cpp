#include "spf/robot/drive_dynamics.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <limits>

#include "spf/math/angles.hpp"
#include "spf/math/random_stream.hpp"

namespace spf {
namespace {

// Erratum: eq. 15 as printed (M = 10, R = 0.05, I = 0.45, L = 0.2) cannot accelerate along every axis.
TEST(ThreeWheelPlant, PrintedForceMatrixIsSingular) {
  const double mr = 10.0 * 0.05;
  const double ir = 0.45 * 0.05;
  Eigen::Matrix3d printed;
  printed << -std::sqrt(3.0) / (2.0 * mr), -std::sqrt(3.0) / (2.0 * mr), 0.0,  //
      -1.0 / (2.0 * mr), -1.0 / (2.0 * mr), 1.0 / mr,                          //
      -0.2 / ir, -0.2 / ir, -0.2 / ir;
  EXPECT_EQ(printed.col(0), printed.col(1));
  EXPECT_NEAR(printed.determinant(), 0.0, 1e-13);
}

TEST(ThreeWheelPlant, PowerOfMotorsEqualsPowerOfWrench) {
  const RobotParameters parameters;
  const DriveDynamics dynamics{parameters};
  RandomStream random{11};
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector3d torques{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
    const Eigen::Vector3d twist{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
    const Eigen::Vector3d wheel_rates = dynamics.drive().input_for(twist) / parameters.wheel_radius;
    EXPECT_NEAR(torques.dot(wheel_rates), dynamics.wrench_body(torques).dot(twist), 1e-12);
    EXPECT_LT((dynamics.torques_for(dynamics.wrench_body(torques)) - torques).norm(), 1e-14);
  }
}

TEST(ThreeWheelPlant, FollowsTheMotorLagWhileTorqueSuffices) {
  RobotParameters parameters;
  parameters.max_wheel_torque = 100.0;
  parameters.friction = 1000.0;
  const Eigen::Vector3d command{0.4, -0.9, 0.7};
  for (const double dt : {0.001, 0.005, 0.05}) {
    DriveDynamics plant{parameters};
    const int steps = static_cast<int>(std::lround(0.1 / dt));
    for (int i = 0; i < steps; ++i) plant.step(dt, command);
    // Also while it turns (here at up to 2 rad/s): after two time constants 1 - e^-2 of the command, to
    // rounding.
    EXPECT_LT((plant.input() - command * (1.0 - std::exp(-2.0))).norm(), 1e-12) << dt;
  }
}

TEST(ThreeWheelPlant, WithoutLagReachesTheCommandInOneStep) {
  RobotParameters parameters;
  parameters.motor_lag = 0.0;
  parameters.max_wheel_torque = 100.0;
  parameters.friction = 1000.0;
  DriveDynamics plant{parameters};
  const Eigen::Vector3d command{0.4, -0.9, 0.7};
  plant.step(0.005, command);
  EXPECT_LT((plant.input() - command).norm(), 1e-12);
}

TEST(ThreeWheelPlant, WithoutLagAndWithLittleTorqueStillSettlesOnTheCommand) {
  RobotParameters parameters;
  parameters.motor_lag = 0.0;
  DriveDynamics plant{parameters};
  const Eigen::Vector3d command{0.4, -0.9, 0.7};
  for (int i = 0; i < 1000; ++i) {
    plant.step(0.005, command);
    EXPECT_LE(plant.torques().cwiseAbs().maxCoeff(), parameters.max_wheel_torque);
  }
  EXPECT_LT((plant.input() - command).norm(), 1e-12);
}

// The default motors: f <= 8 N a wheel; without moment the forces sum to zero, so the weakest directions are
// along a drive direction, (8, -4, -4) N = 12 N on 10 kg.
TEST(ThreeWheelPlant, AcceleratesInEveryDirection) {
  const DriveDynamics dynamics{RobotParameters{}};
  double weakest = std::numeric_limits<double>::infinity();
  for (int degree = 0; degree < 360; ++degree) {
    const double angle = degree * kPi / 180.0;
    weakest = std::min(weakest, dynamics.max_acceleration_along({std::cos(angle), std::sin(angle)}));
  }
  EXPECT_NEAR(weakest, 1.2, 1e-12);
}

TEST(ThreeWheelPlant, ReachesTheStatedAccelerationAndNotMore) {
  const RobotParameters parameters;
  for (int degree = 0; degree < 360; degree += 7) {
    const Eigen::Vector2d direction{std::cos(degree * kPi / 180.0), std::sin(degree * kPi / 180.0)};
    DriveDynamics plant{parameters};
    const double acceleration = plant.max_acceleration_along(direction);
    const double dt = 0.005;
    // A command that asks for just that acceleration.
    const Eigen::Vector2d change =
        direction * acceleration * dt / (1.0 - std::exp(-dt / parameters.motor_lag));
    plant.step(dt, plant.drive().input_for({change.x(), change.y(), 0.0}));
    EXPECT_NEAR(plant.state().twist_world.head<2>().dot(direction) / dt, acceleration, 1e-9);
    EXPECT_NEAR(plant.torques().cwiseAbs().maxCoeff(), parameters.max_wheel_torque, 1e-12);
    EXPECT_NEAR(plant.state().twist_world.z(), 0.0, 1e-12);
  }
}

TEST(ThreeWheelPlant, KineticEnergyChangesByTheWorkOfTheMotors) {
  const RobotParameters parameters;
  DriveDynamics plant{parameters};
  RandomStream random{17};
  const double dt = 0.005;
  const Eigen::Vector3d inertia{parameters.mass, parameters.mass, parameters.inertia};
  const auto kinetic_energy = [&] {
    const Eigen::Vector3d& twist = plant.state().twist_world;
    return 0.5 * twist.dot(inertia.cwiseProduct(twist));
  };
  Eigen::Vector3d command = Eigen::Vector3d::Zero();
  double worst = 0.0;
  double travelled = 0.0;
  for (int i = 0; i < 4000; ++i) {
    if (i % 10 == 0) command = {random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(-2, 2)};
    const PlantState before = plant.state();
    const double energy = kinetic_energy();
    plant.step(dt, command);
    // Mean twist of the step in the mid-step body frame.
    const double turn = 0.5 * dt * (before.twist_world.z() + plant.state().twist_world.z());
    const Eigen::Vector3d mean_twist = twist_in_body(0.5 * (before.twist_world + plant.state().twist_world),
                                                     before.pose_world.heading + 0.5 * turn);
    const double work = dt * plant.wrench_body(plant.torques()).dot(mean_twist);
    worst = std::max(worst, std::abs(kinetic_energy() - energy - work));
    travelled += (plant.state().pose_world.position_world - before.pose_world.position_world).norm();
  }
  EXPECT_LT(worst, 1e-13);  // joules; energies reach some 10 J
  EXPECT_GT(travelled, 1.0);
}

TEST(ThreeWheelPlant, StaysAtRest) {
  DriveDynamics plant{RobotParameters{}, PlantState{Pose2{{1.0, -2.0}, 0.7}, Eigen::Vector3d::Zero()}};
  for (int i = 0; i < 1000; ++i) plant.step(0.005, Eigen::Vector3d::Zero());
  EXPECT_EQ(plant.state().pose_world.position_world, Eigen::Vector2d(1.0, -2.0));
  EXPECT_EQ(plant.state().pose_world.heading, 0.7);
}

TEST(ThreeWheelPlant, CoastsInABodyCircleWhenTurning) {
  RobotParameters parameters;
  parameters.max_wheel_torque = 10.0;
  DriveDynamics plant{parameters};
  const Eigen::Vector3d command = plant.drive().input_for({0.5, 0.0, 1.0});
  for (int i = 0; i < 200; ++i) plant.step(0.005, command);
  const Eigen::Vector2d start = plant.state().pose_world.position_world;
  const int full_circle = static_cast<int>(std::lround(2.0 * kPi / 0.005));
  for (int i = 0; i < full_circle; ++i) plant.step(0.005, command);
  // Back where it began; 0.5 m/s times the rounding of the circle to whole steps (2.5 ms).
  EXPECT_LT((plant.state().pose_world.position_world - start).norm(), 2e-3);
}

TEST(ThreeWheelPlant, IsIndependentOfWhereAndHowItStands) {
  RandomStream random{23};
  DriveDynamics here{RobotParameters{}};
  DriveDynamics there{RobotParameters{}, PlantState{Pose2{{3.0, 4.0}, 1.0}, Eigen::Vector3d::Zero()}};
  for (int i = 0; i < 400; ++i) {
    const Eigen::Vector3d command{random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(-2, 2)};
    here.step(0.005, command);
    there.step(0.005, command);
  }
  const Eigen::Vector2d moved = here.state().pose_world.position_world;
  const Eigen::Vector3d turned = twist_in_world({moved.x(), moved.y(), 0.0}, 1.0);
  const Eigen::Vector2d expected = Eigen::Vector2d{3.0, 4.0} + turned.head<2>();
  EXPECT_LT((there.state().pose_world.position_world - expected).norm(), 1e-10);
  EXPECT_NEAR(angle_difference(there.state().pose_world.heading, here.state().pose_world.heading), 1.0,
              1e-10);
}

TEST(ThreeWheelPlant, CommandThatIsNotANumberBrakes) {
  DriveDynamics plant{RobotParameters{}};
  for (int i = 0; i < 200; ++i) plant.step(0.005, plant.drive().input_for({0.5, 0.0, 0.0}));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (int i = 0; i < 400; ++i) plant.step(0.005, Eigen::Vector3d{nan, 0.0, 0.0});
  EXPECT_LT(plant.state().twist_world.norm(), 1e-6);
}

TEST(ThreeWheelPlant, PlansRelyOnWhatWheelsGiveHoweverTheRobotIsTurned) {
  const DriveDynamics plant{RobotParameters{}};
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 720; ++k) {
    const double angle = k * kPi / 360.0;
    least = std::min(least, plant.max_acceleration_along({std::cos(angle), std::sin(angle)}));
  }
  EXPECT_NEAR(plant.max_acceleration_anywhere(), least, 1e-3);
  RobotParameters strong;
  strong.max_acceleration = 0.5 * least;
  EXPECT_EQ(within_drive(strong).max_acceleration, 0.5 * least);
  strong.max_acceleration = 2.0 * least;
  EXPECT_EQ(within_drive(strong).max_acceleration, plant.max_acceleration_anywhere());
}

}  // namespace
}  // namespace spf
