#include "spf/robot/drive.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include "spf/math/angles.hpp"
#include "spf/math/random_stream.hpp"

namespace spf {
namespace {

RobotParameters robot_with(DriveType type, int wheels = 3) {
  RobotParameters robot;
  robot.drive = type;
  robot.wheels = wheels;
  robot.first_wheel_angle = 0.3;
  return robot;
}

std::vector<RobotParameters> robots_of_all_drives() {
  return {robot_with(DriveType::omni),    robot_with(DriveType::omni, 4),      robot_with(DriveType::omni, 6),
          robot_with(DriveType::mecanum), robot_with(DriveType::differential), robot_with(DriveType::car)};
}

Eigen::Vector3d random_twist(RandomStream& random) {
  return {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
}

TEST(Drive, GivesBackEveryMotionThatItCanDo) {
  RandomStream random{5};
  for (const RobotParameters& robot : robots_of_all_drives()) {
    const Drive drive{robot};
    for (int i = 0; i < 100; ++i) {
      const Eigen::Vector3d twist = drive.possible(random_twist(random));
      EXPECT_LT((drive.twist_body(drive.input_for(twist)) - twist).norm(), 1e-12) << enum_name(drive.type());
    }
  }
}

TEST(Drive, OfOmniWheelsAtTheSameAnglesIsTheSame) {
  const RobotParameters robot = robot_with(DriveType::omni, 4);
  const Drive even{robot};
  const Drive by_angles{robot, {0.3, 0.3 + 0.5 * kPi, 0.3 + kPi, 0.3 + 1.5 * kPi}};
  RandomStream random{6};
  for (int i = 0; i < 50; ++i) {
    const Eigen::Vector3d twist = random_twist(random);
    const DriveInput rims = even.input_for(twist);
    EXPECT_LT((rims - by_angles.input_for(twist)).norm(), 1e-14);
    EXPECT_LT((even.twist_body(rims) - by_angles.twist_body(rims)).norm(), 1e-13);
  }
  const Drive uneven{robot, {0.0, 1.0, 2.5}};
  EXPECT_LT((uneven.twist_body(uneven.input_for({0.3, -0.2, 0.4})) - Eigen::Vector3d(0.3, -0.2, 0.4)).norm(),
            1e-13);
}

TEST(Drive, JacobianIsThatOfTheTwist) {
  RandomStream random{7};
  for (const RobotParameters& robot : robots_of_all_drives()) {
    const Drive drive{robot};
    const DriveInput at = drive.input_for(drive.possible({0.5, 0.2, 0.3}));
    const DriveJacobian jacobian = drive.jacobian(at);
    for (int i = 0; i < drive.inputs(); ++i) {
      DriveInput plus = at, minus = at;
      plus[i] += 1e-5;
      minus[i] -= 1e-5;
      const Eigen::Vector3d slope = (drive.twist_body(plus) - drive.twist_body(minus)) / 2e-5;
      EXPECT_LT((slope - jacobian.col(i)).norm(), 1e-8) << enum_name(drive.type());
    }
  }
}

TEST(Drive, LeavesOutWhatItCannotDo) {
  const Drive differential{robot_with(DriveType::differential)};
  EXPECT_EQ(differential.possible({0.5, 0.4, 0.3}), Eigen::Vector3d(0.5, 0.0, 0.3));
  EXPECT_LT((differential.twist_body(differential.input_for({0.5, 0.4, 0.3})) - Eigen::Vector3d(0.5, 0, 0.3))
                .norm(),
            1e-14);
  const Drive car{robot_with(DriveType::car)};
  EXPECT_EQ(car.possible({0.0, 0.0, 1.0}), Eigen::Vector3d::Zero());
  EXPECT_NEAR(car.possible({-0.3, 0.0, 1.0}).z(), 0.5, 1e-12);
  EXPECT_EQ(car.input_for({0.0, 0.0, 0.0}, 0.2)[1], 0.2);
  RobotParameters forward = robot_with(DriveType::car);
  forward.may_reverse = false;
  EXPECT_EQ(Drive{forward}.possible({-0.3, 0.0, 0.1}), Eigen::Vector3d::Zero());
  EXPECT_EQ(Drive{forward}.saturated(Eigen::Vector2d(-0.3, 0.1))[0], 0.0);
}

TEST(Drive, TurnsLeftWithTheRightWheelFaster) {
  const DriveInput turn = Drive{robot_with(DriveType::differential)}.input_for({0.0, 0.0, 1.0});
  EXPECT_LT(turn[0], 0.0);
  EXPECT_GT(turn[1], 0.0);
  const Eigen::Vector3d arc = Drive{robot_with(DriveType::car)}.twist_body(Eigen::Vector2d(0.5, 0.3));
  EXPECT_GT(arc.z(), 0.0);
}

TEST(Drive, SlowsDownOnItsPathAtTheLimits) {
  for (const RobotParameters& robot : robots_of_all_drives()) {
    const Drive drive{robot};
    const Eigen::Vector3d twist = drive.possible({4.0, 1.0, 2.0});
    const DriveInput fast = drive.input_for(twist);
    const DriveInput kept = drive.saturated(fast);
    EXPECT_TRUE((kept.array() <= drive.upper().array()).all() &&
                (kept.array() >= drive.lower().array()).all());
    const Eigen::Vector3d slowed = drive.twist_body(kept);
    EXPECT_LT((slowed - slowed.x() / twist.x() * twist).norm(), 1e-12) << enum_name(drive.type());
    EXPECT_NEAR(drive.scale_to_limit(kept), 1.0, 1e-12);
    EXPECT_EQ(drive.scale_to_limit(drive.standstill()), std::numeric_limits<double>::infinity());
    DriveInput bad = fast;
    bad[0] = std::nan("");
    EXPECT_EQ(drive.saturated(bad), drive.standstill());
    EXPECT_EQ(drive.saturated(DriveInput::Zero(drive.inputs() - 1)), drive.standstill());
  }
}

TEST(Drive, RefusesWhatCannotMove) {
  const RobotParameters robot;
  EXPECT_THROW((Drive{robot, {0.0, 2.0}}), std::invalid_argument);
  EXPECT_THROW((Drive{robot, std::vector<double>(7, 1.0)}), std::invalid_argument);
  EXPECT_THROW((Drive{robot, {0.0, kPi, 0.0}}), std::invalid_argument);
  EXPECT_THROW((Drive{robot, {0.0, 1.0, std::nan("")}}), std::invalid_argument);
  RobotParameters flat = robot_with(DriveType::car);
  flat.wheel_base = 0.0;
  EXPECT_THROW(Drive{flat}, std::invalid_argument);
  EXPECT_THROW(Drive{robot_with(DriveType::omni, 2)}, std::invalid_argument);
}

}  // namespace
}  // namespace spf
