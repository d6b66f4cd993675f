#include "spf/robot/drive.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "spf/math/angles.hpp"
#include "spf/math/random_stream.hpp"
#include "spf/robot/omni_kinematics.hpp"

namespace spf {
namespace {

DriveDesign design_of(DriveType type) {
  DriveDesign design;
  design.type = type;
  return design;
}

DriveDesign omni_with(int wheels) {
  DriveDesign design;
  design.wheel_angles.clear();
  for (int i = 0; i < wheels; ++i) design.wheel_angles.push_back(0.3 + 2.0 * kPi * i / wheels);
  return design;
}

std::vector<DriveDesign> all_designs() {
  return {omni_with(3),
          omni_with(4),
          omni_with(8),
          design_of(DriveType::mecanum),
          design_of(DriveType::differential),
          design_of(DriveType::car)};
}

Eigen::Vector3d random_twist(RandomStream& random) {
  return {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
}

TEST(Drive, GivesBackEveryMotionThatItCanDo) {
  RandomStream random{5};
  for (const DriveDesign& design : all_designs()) {
    const Drive drive{design};
    for (int i = 0; i < 100; ++i) {
      const Eigen::Vector3d twist = drive.possible(random_twist(random));
      EXPECT_LT((drive.twist_body(drive.input_for(twist)) - twist).norm(), 1e-12) << enum_name(drive.type());
    }
  }
}

TEST(Drive, OfThreeOmniWheelsIsThePapers) {
  const RobotParameters robot;
  const OmniKinematics paper{robot};
  const Drive drive{DriveDesign{}};
  RandomStream random{6};
  for (int i = 0; i < 50; ++i) {
    const Eigen::Vector3d twist = random_twist(random);
    EXPECT_LT((drive.input_for(twist) - paper.wheel_speeds(twist.head<2>(), twist.z())).norm(), 1e-14);
    const DriveInput rims = drive.input_for(twist);
    EXPECT_LT((drive.twist_world(rims, 0.7) - paper.twist_world(rims, 0.7)).norm(), 1e-14);
    EXPECT_LT((drive.saturated(3.0 * rims) - paper.saturated(3.0 * rims)).norm(), 1e-14);
  }
}

TEST(Drive, JacobianIsThatOfTheTwist) {
  RandomStream random{7};
  for (const DriveDesign& design : all_designs()) {
    const Drive drive{design};
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
  const Drive differential{design_of(DriveType::differential)};
  EXPECT_EQ(differential.possible({0.5, 0.4, 0.3}), Eigen::Vector3d(0.5, 0.0, 0.3));
  EXPECT_LT((differential.twist_body(differential.input_for({0.5, 0.4, 0.3})) - Eigen::Vector3d(0.5, 0, 0.3))
                .norm(),
            1e-14);
  const Drive car{design_of(DriveType::car)};
  EXPECT_EQ(car.possible({0.0, 0.0, 1.0}), Eigen::Vector3d::Zero());
  EXPECT_NEAR(car.possible({-0.3, 0.0, 1.0}).z(), 0.5, 1e-12);
  EXPECT_EQ(car.input_for({0.0, 0.0, 0.0}, 0.2)[1], 0.2);
  DriveDesign forward = design_of(DriveType::car);
  forward.may_reverse = false;
  EXPECT_EQ(Drive{forward}.possible({-0.3, 0.0, 0.1}), Eigen::Vector3d::Zero());
  EXPECT_EQ(Drive{forward}.saturated(Eigen::Vector2d(-0.3, 0.1))[0], 0.0);
}

TEST(Drive, TurnsLeftWithTheRightWheelFaster) {
  const DriveInput turn = Drive{design_of(DriveType::differential)}.input_for({0.0, 0.0, 1.0});
  EXPECT_LT(turn[0], 0.0);
  EXPECT_GT(turn[1], 0.0);
  const Eigen::Vector3d arc = Drive{design_of(DriveType::car)}.twist_body(Eigen::Vector2d(0.5, 0.3));
  EXPECT_GT(arc.z(), 0.0);
}

TEST(Drive, SlowsDownOnItsPathAtTheLimits) {
  for (const DriveDesign& design : all_designs()) {
    const Drive drive{design};
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
    EXPECT_EQ(drive.saturated(DriveInput::Zero(7)), drive.standstill());
  }
}

TEST(Drive, RefusesWhatCannotMove) {
  EXPECT_THROW(Drive{omni_with(2)}, std::invalid_argument);
  EXPECT_THROW(Drive{omni_with(9)}, std::invalid_argument);
  DriveDesign line;
  line.wheel_angles = {0.0, kPi, 0.0};
  EXPECT_THROW(Drive{line}, std::invalid_argument);
  DriveDesign flat = design_of(DriveType::car);
  flat.wheel_base = 0.0;
  EXPECT_THROW(Drive{flat}, std::invalid_argument);
  DriveDesign stuck = design_of(DriveType::mecanum);
  stuck.max_wheel_speed = std::nan("");
  EXPECT_THROW(Drive{stuck}, std::invalid_argument);
}

}  // namespace
}  // namespace spf
