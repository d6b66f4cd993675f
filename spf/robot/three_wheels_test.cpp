#include "spf/robot/drive.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <limits>

#include "spf/math/angles.hpp"
#include "spf/math/random_stream.hpp"

namespace spf {
namespace {

constexpr double kRounding = 1e-14;  // a few dozen roundings of numbers of order one

RobotParameters with_wheels(double first_angle, double arm) {
  RobotParameters parameters;
  parameters.first_wheel_angle = first_angle;
  parameters.wheel_arm = arm;
  return parameters;
}

double drive_direction(double x, double y) {
  return std::atan2(y, x) * 180.0 / kPi;
}

// Erratum: eq. 14 as printed.
TEST(ThreeWheels, PrintedMatrixIsNoRobotWithEvenlySpacedWheels) {
  const double c = std::cos(kPi / 3.0);
  const double s = std::sin(kPi / 3.0);
  EXPECT_NEAR(drive_direction(0.0, -1.0), -90.0, 1e-12);
  EXPECT_NEAR(drive_direction(c, s), 60.0, 1e-12);
  EXPECT_NEAR(drive_direction(-c, s), 120.0, 1e-12);
  EXPECT_GT(Eigen::Vector2d(0.0, -1.0 + 2.0 * s).norm(), 0.7);  // the directions do not cancel
}

// Our reading: sine and cosine exchanged in rows 2 and 3.
TEST(ThreeWheels, MendsThePrintedMatrix) {
  const Drive drive{with_wheels(0.0, 0.04)};
  const double c = std::cos(kPi / 3.0);
  const double s = std::sin(kPi / 3.0);
  Eigen::Matrix3d mended;
  mended << 0.0, -1.0, -0.04, s, c, -0.04, -s, c, -0.04;
  EXPECT_LT((drive.wheel_from_body() - mended).norm(), kRounding);
}

TEST(ThreeWheels, DirectionsAreEvenlySpaced) {
  for (const double first : {0.0, 0.5, kPi / 2.0, -2.0}) {
    const Eigen::Matrix3d wheels = Drive{with_wheels(first, 0.2)}.wheel_from_body();
    EXPECT_LT(wheels.leftCols<2>().colwise().sum().norm(), kRounding);
    for (int i = 0; i < 3; ++i)
      EXPECT_NEAR(wheels.row(i).head<2>().dot(wheels.row((i + 1) % 3).head<2>()), -0.5, kRounding);
  }
}

TEST(ThreeWheels, ColumnsAreOrthogonal) {
  for (const double arm : {0.04, 0.2, 1.0}) {
    const Eigen::Matrix3d wheels = Drive{with_wheels(0.3, arm)}.wheel_from_body();
    const Eigen::Matrix3d expected = Eigen::Vector3d{1.5, 1.5, 3.0 * arm * arm}.asDiagonal();
    EXPECT_LT((wheels.transpose() * wheels - expected).norm(), kRounding);
  }
}

TEST(ThreeWheels, InverseMatchesDenseInverse) {
  for (const double arm : {0.04, 0.2, 1.0}) {
    const Drive drive{with_wheels(-1.1, arm)};
    const Eigen::Matrix3d dense = Eigen::Matrix3d{drive.wheel_from_body()}.inverse();
    EXPECT_LT((Eigen::Matrix3d{drive.jacobian(drive.standstill())} - dense).norm(),
              kRounding * dense.norm() * 10.0);
    EXPECT_LT((Eigen::Matrix3d{drive.jacobian(drive.standstill())} * drive.wheel_from_body() -
               Eigen::Matrix3d::Identity())
                  .norm(),
              kRounding * dense.norm());
  }
}

TEST(ThreeWheels, PureRotationTurnsAllWheelsAlike) {
  const Drive drive{with_wheels(0.7, 0.2)};
  const Eigen::Vector3d speeds = drive.input_for({0.0, 0.0, 2.0});
  EXPECT_LT((speeds - Eigen::Vector3d::Constant(-0.4)).norm(), kRounding);
}

TEST(ThreeWheels, DrivesAlongTheCommandedWorldDirection) {
  const Drive drive{RobotParameters{}};
  RandomStream random{3};
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector3d twist{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-2, 2)};
    const double heading = random.uniform(-kPi, kPi);
    const Eigen::Vector3d speeds = drive.input_from_world(twist, heading);
    EXPECT_LT((drive.twist_world(speeds, heading) - twist).norm(), kRounding);
    EXPECT_LT((world_from_body(heading) * drive.twist_body(speeds) - twist).norm(), kRounding);
    EXPECT_LT((drive.input_for(twist_in_body(twist, heading)) - speeds).norm(), kRounding);
  }
}

TEST(ThreeWheels, BodyXAxisTurnsCounterClockwiseWithHeading) {
  const Eigen::Vector3d forward = twist_in_world({1.0, 0.0, 0.0}, kPi / 2.0);
  EXPECT_NEAR(forward.y(), 1.0, kRounding);
}

TEST(ThreeWheels, SaturationKeepsDirection) {
  const Drive drive{RobotParameters{}};
  RandomStream random{5};
  for (int i = 0; i < 500; ++i) {
    const Eigen::Vector3d speeds{random.uniform(-4, 4), random.uniform(-4, 4), random.uniform(-4, 4)};
    const Eigen::Vector3d limited = drive.saturated(speeds);
    const double fastest = speeds.cwiseAbs().maxCoeff();
    EXPECT_LE(limited.cwiseAbs().maxCoeff(), drive.max_wheel_speed());
    if (fastest <= drive.max_wheel_speed()) {
      EXPECT_EQ(limited, speeds);
      EXPECT_GE(drive.scale_to_limit(speeds), 1.0);
    } else {
      EXPECT_NEAR(limited.cwiseAbs().maxCoeff(), drive.max_wheel_speed(), kRounding);
      EXPECT_LT(limited.cross(speeds).norm(), 1e-13);
      EXPECT_GT(limited.dot(speeds), 0.0);
      EXPECT_NEAR(drive.scale_to_limit(speeds) * fastest, drive.max_wheel_speed(), kRounding);
    }
  }
}

TEST(ThreeWheels, StandstillMayBeScaledWithoutLimit) {
  const Drive drive{RobotParameters{}};
  EXPECT_EQ(drive.scale_to_limit(Eigen::Vector3d::Zero()), std::numeric_limits<double>::infinity());
  EXPECT_EQ(drive.saturated(Eigen::Vector3d::Zero()), Eigen::Vector3d::Zero());
}

TEST(ThreeWheels, NotANumberStops) {
  const Drive drive{RobotParameters{}};
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(drive.saturated(Eigen::Vector3d{0.5, nan, 0.5}), Eigen::Vector3d::Zero());
}

TEST(ThreeWheels, RefusesParametersOutOfRange) {
  EXPECT_THROW(Drive{with_wheels(0.0, 0.0)}, std::invalid_argument);
}

}  // namespace
}  // namespace spf
