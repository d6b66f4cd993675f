#include "spf/localisation/motion_estimator.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "spf/robot/robot_parameters.hpp"
#include "spf/testing/allocation_guard.hpp"

namespace spf {
namespace {

constexpr double kLag = 0.2;  // [s]

Drive drive() {
  return Drive{RobotParameters{}};
}

Eigen::Vector3d wheels_for(const Eigen::Vector3d& twist_body) {
  return drive().input_from_world(twist_body, 0.0);
}

// The closed form of a first-order lag from rest: v t - v T (1 - exp(-t / T)).
TEST(MotionEstimator, FollowsTheAppliedCommandThroughTheLag) {
  MotionEstimator estimator{ObserverParameters{}, drive(), kLag};
  estimator.observe(0.0, Pose2{});
  estimator.apply(0.0, wheels_for({0.8, 0.0, 0.0}));
  const double expected = 0.8 * (0.5 - kLag * (1.0 - std::exp(-0.5 / kLag)));
  EXPECT_NEAR(estimator.estimate(0.5).pose_world.position_world.x(), expected, 1e-9);
  estimator.advance_to(0.5);
  EXPECT_NEAR(estimator.state().wheel_speeds.norm(),
              (1.0 - std::exp(-0.5 / kLag)) * wheels_for({0.8, 0.0, 0.0}).norm(), 1e-9);
}

// What a controller asked for does not matter: something else made the robot stop.
TEST(MotionEstimator, BelievesTheCommandThatWasApplied) {
  MotionEstimator estimator{ObserverParameters{}, drive(), 0.0};
  estimator.observe(0.0, Pose2{});
  estimator.apply(0.0, wheels_for({1.0, 0.0, 0.0}));
  estimator.apply(0.3, Eigen::Vector3d::Zero());
  EXPECT_NEAR(estimator.estimate(2.0).pose_world.position_world.x(), 0.3, 1e-9);
  EXPECT_EQ(estimator.state().command, Eigen::Vector3d::Zero());
}

TEST(MotionEstimator, EstimateChangesNothing) {
  MotionEstimator estimator{ObserverParameters{}, drive(), kLag};
  estimator.observe(0.0, Pose2{});
  estimator.apply(0.0, wheels_for({0.5, 0.2, 0.3}));
  const StateEstimate first = estimator.estimate(0.7);
  EXPECT_EQ(estimator.estimate(0.7).pose_world.position_world, first.pose_world.position_world);
  estimator.advance_to(0.7);
  EXPECT_EQ(estimator.state().estimate.pose_world.position_world, first.pose_world.position_world);
  estimator.advance_to(0.1);  // time does not go back
  EXPECT_EQ(estimator.state().estimate.pose_world.position_world, first.pose_world.position_world);
}

TEST(MotionEstimator, SurvivesWhatIsNotFinite) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  MotionEstimator estimator{ObserverParameters{}, drive(), kLag};
  EXPECT_EQ(estimator.observe(kNan, Pose2{}), MeasurementOutcome::invalid);
  EXPECT_EQ(estimator.observe(0.0, Pose2{{kNan, 0.0}, 0.0}), MeasurementOutcome::invalid);
  EXPECT_FALSE(estimator.state().estimate.valid);
  estimator.observe(0.0, Pose2{{1.0, 2.0}, 0.5});
  estimator.apply(0.1, Eigen::Vector3d{kNan, 1.0, 1.0});  // counts as stopped
  estimator.apply(kNan, wheels_for({1.0, 0.0, 0.0}));
  estimator.advance_to(kNan);
  EXPECT_TRUE(estimator.estimate(5.0).pose_world.position_world.allFinite());
}

TEST(MotionEstimator, ForgetsWhenReset) {
  MotionEstimator estimator{ObserverParameters{}, drive(), kLag};
  estimator.observe(0.0, Pose2{{1.0, 2.0}, 0.5});
  estimator.apply(0.0, wheels_for({1.0, 0.0, 0.0}));
  estimator.reset();
  EXPECT_FALSE(estimator.state().estimate.valid);
  EXPECT_EQ(estimator.state().command, Eigen::Vector3d::Zero());
  // Another clock may begin earlier.
  EXPECT_NE(estimator.observe(-100.0, Pose2{{5.0, 0.0}, 0.0}), MeasurementOutcome::invalid);
  EXPECT_NEAR(estimator.estimate(-99.0).pose_world.position_world.x(), 5.0, 1e-9);
}

TEST(MotionEstimator, DoesNotAllocate) {
  MotionEstimator estimator{ObserverParameters{}, drive(), kLag};
  const AllocationGuard guard;
  for (int i = 0; i < 50; ++i) {
    estimator.observe(0.01 * i, Pose2{{0.01 * i, 0.0}, 0.0});
    estimator.apply(0.01 * i, Eigen::Vector3d::Constant(0.1));
    EXPECT_TRUE(estimator.estimate(0.01 * i + 0.1).valid);
  }
  EXPECT_EQ(guard.allocations(), 0);
}

}  // namespace
}  // namespace spf
