// The tracker in closed loop with the torque-limited plant (plant 200 Hz, pose 100 Hz, control 20 Hz).
#include "spf/tracking/test/closed_loop.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <limits>
#include <vector>

#include "spf/math/angles.hpp"
#include "spf/math/random_stream.hpp"
#include "spf/robot/drive_dynamics.hpp"
#include "spf/testing/allocation_guard.hpp"
#include "spf/tracking/test/plan_through.hpp"

namespace spf {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// A circle of 1 m radius, from rest to 1 m/s in 2 s and back to rest at the end of 8 s: 1 m/s^2 across at
/// full speed.
Trajectory circle(const HeadingProfile& heading) {
  const auto speed = [](double t) {
    const double ramp = std::clamp(std::min(t, 8.0 - t) / 2.0, 0.0, 1.0);
    return ramp * ramp * (3.0 - 2.0 * ramp);
  };
  Eigen::Matrix2Xd positions(2, 33);
  double angle = 0.0;
  constexpr int kSub = 2500;
  for (int i = 0; i <= 32; ++i) {
    positions.col(i) << std::cos(angle), std::sin(angle);
    for (int j = 0; j < kSub; ++j) angle += 0.25 / kSub * speed(0.25 * i + 0.25 * (j + 0.5) / kSub);
  }
  return plan_through(positions, 0.25, Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero(), heading);
}

struct LoopOptions {
  double pose_sigma = 0.0;
  double heading_sigma = 0.0;
  double wheel_slip = 0.0;  ///< share of the true velocity that is missing from the pose
  double duration = 9.0;
  double motor_lag = 0.05;
};

struct LoopResult {
  double largest_error = 0.0;    // [m] after the first 0.5 s
  double rms_error = 0.0;        // [m]
  double largest_heading = 0.0;  // [rad]
  double final_error = 0.0;      // [m]
  double fastest_wheel = 0.0;    // [m/s] commanded
};

LoopResult run_loop(const TrackerParameters& parameters, const Trajectory& trajectory,
                    const LoopOptions& options) {
  const RobotParameters robot;
  Tracker tracker{parameters, robot};
  const FlatState head = trajectory.state(0.0);
  DriveDynamics plant{
      robot, PlantState{Pose2{head.position_world, trajectory.heading_state(0.0).heading}, {0, 0, 0}}};
  RandomStream random{123};
  LoopResult result;
  Eigen::Vector3d command = Eigen::Vector3d::Zero();
  double sum = 0.0;
  const int steps = static_cast<int>(options.duration * 200.0);
  for (int i = 0; i < steps; ++i) {
    const double time = i * 0.005;
    if (i % 2 == 0) {
      Pose2 measured = plant.state().pose_world;
      measured.position_world += options.pose_sigma * random.normal2();
      measured.heading += options.heading_sigma * random.normal();
      tracker.observe(time, measured);
    }
    if (i % 10 == 0) {
      command = tracker.step(time, trajectory).wheel_speeds;
      result.fastest_wheel = std::max(result.fastest_wheel, command.cwiseAbs().maxCoeff());
    }
    const Eigen::Vector2d before = plant.state().pose_world.position_world;
    plant.step(0.005, command);
    PlantState state = plant.state();
    state.pose_world.position_world -= options.wheel_slip * (state.pose_world.position_world - before);
    plant = DriveDynamics{robot, state};

    const double now = time + 0.005;
    const double error = (state.pose_world.position_world - trajectory.position(now)).norm();
    const double heading = angle_difference(state.pose_world.heading, trajectory.heading_state(now).heading);
    if (now > 0.5) result.largest_error = std::max(result.largest_error, error);
    result.largest_heading = std::max(result.largest_heading, std::abs(heading));
    sum += error * error;
    result.final_error = error;
  }
  result.rms_error = std::sqrt(sum / steps);
  return result;
}

void print(const char* what, const LoopResult& result) {
  std::cout << what << ": largest " << 1000.0 * result.largest_error << " mm, rms "
            << 1000.0 * result.rms_error << " mm, heading " << result.largest_heading << " rad, final "
            << 1000.0 * result.final_error << " mm\n";
}

// 1 m/s and 1 m/s^2 with motors of 50 ms lag that give 1.2 m/s^2 at worst.
TEST(Tracker, FollowsACurveWithExactPoses) {
  const LoopResult result = run_loop(TrackerParameters{}, circle(HeadingProfile{0.0}), LoopOptions{});
  print("exact poses", result);
  EXPECT_LT(result.largest_error, 0.02);
  EXPECT_LT(result.final_error, 0.002);
}

TEST(Tracker, FollowsACurveWhileTurning) {
  const HeadingProfile turn{1.0, HeadingState{}, 2.5, 1.0, 2.0};
  const LoopResult result = run_loop(TrackerParameters{}, circle(turn), LoopOptions{});
  print("turning", result);
  EXPECT_LT(result.largest_error, 0.03);
  EXPECT_LT(result.largest_heading, 0.08);
}

TEST(Tracker, CompensatesSlowMotors) {
  TrackerParameters plain;
  plain.compensate_lag = false;
  LoopOptions options;
  options.motor_lag = 0.2;
  const LoopResult without = run_loop(plain, circle(HeadingProfile{0.0}), options);
  const LoopResult with = run_loop(TrackerParameters{}, circle(HeadingProfile{0.0}), options);
  print("0.2 s of lag, compensated", with);
  print("0.2 s of lag, not compensated", without);
  EXPECT_LT(with.largest_error, 0.02);
  EXPECT_LT(with.rms_error, 0.7 * without.rms_error);
}

// A wheel slip of 10 % of the speed turns round the circle with the velocity; the observer's disturbance
// follows it late.
TEST(Tracker, CopesWithSlip) {
  LoopOptions options;
  options.wheel_slip = 0.1;
  const LoopResult result = run_loop(TrackerParameters{}, circle(HeadingProfile{0.0}), options);
  print("10 % wheel slip", result);
  EXPECT_LT(result.largest_error, 0.06);
}

// Pose noise as in the paper's Table 3: the error is the estimate's (0.1 m per axis at 100 Hz), not the
// noise's.
TEST(Tracker, FollowsUnderHeavyPoseNoise) {
  TrackerParameters parameters;
  parameters.observer.pose_sigma = 1.0;
  parameters.observer.heading_sigma = 0.1 * kPi / 180.0;
  LoopOptions options;
  options.pose_sigma = 1.0;
  options.heading_sigma = parameters.observer.heading_sigma;
  const LoopResult kalman = run_loop(parameters, circle(HeadingProfile{0.0}), options);
  parameters.observer.kind = ObserverKind::eso;
  const LoopResult eso = run_loop(parameters, circle(HeadingProfile{0.0}), options);
  parameters.observer.kind = ObserverKind::none;
  const LoopResult none = run_loop(parameters, circle(HeadingProfile{0.0}), options);
  print("1 m noise, kalman", kalman);
  print("1 m noise, eso", eso);
  print("1 m noise, none", none);
  // Measured 0.11, 0.25 and 1.3 m. The fixed gains are slow to forget the first measurement (1 m off) and to
  // see the spin that clipped torques cause; hence the Kalman gains are the default.
  EXPECT_LT(kalman.rms_error, 0.2);
  EXPECT_LT(eso.rms_error, 0.5);
  EXPECT_GT(none.rms_error, 0.8);
}

// The ablation holds plan points 0.5 s apart: half of that at 1 m/s is a quarter of a metre of lag.
TEST(Tracker, SelfSamplingHelps) {
  TrackerParameters held;
  held.reference.self_sampling = false;
  const LoopResult without = run_loop(held, circle(HeadingProfile{0.0}), LoopOptions{});
  print("without self-sampling", without);
  EXPECT_GT(without.rms_error, 0.05);
  EXPECT_LT(without.largest_error, 0.8);
  EXPECT_LT(run_loop(TrackerParameters{}, circle(HeadingProfile{0.0}), LoopOptions{}).rms_error,
            0.2 * without.rms_error);
}

TEST(Tracker, StandsBeforeTheFirstMeasurement) {
  Tracker tracker{TrackerParameters{}, RobotParameters{}};
  const TrackerOutput& output = tracker.step(0.0, circle(HeadingProfile{0.0}));
  EXPECT_EQ(output.status, TrackerStatus::no_estimate);
  EXPECT_EQ(output.wheel_speeds, Eigen::Vector3d::Zero());
  EXPECT_EQ(tracker.observe(0.0, Pose2{{kNan, 0.0}, 0.0}), MeasurementOutcome::invalid);
  EXPECT_EQ(tracker.step(0.05, circle(HeadingProfile{0.0})).status, TrackerStatus::no_estimate);
}

TEST(Tracker, StandsWithoutATrajectory) {
  Tracker tracker{TrackerParameters{}, RobotParameters{}};
  tracker.observe(0.0, Pose2{});
  EXPECT_EQ(tracker.step(0.0, Trajectory{}).status, TrackerStatus::no_reference);
  EXPECT_EQ(tracker.last_output().wheel_speeds, Eigen::Vector3d::Zero());
}

TEST(Tracker, SurvivesBadInputAndGoesOn) {
  const Trajectory trajectory = circle(HeadingProfile{0.0});
  Tracker tracker{TrackerParameters{}, RobotParameters{}};
  tracker.observe(0.0, Pose2{{1.0, 0.0}, 0.0});
  EXPECT_EQ(tracker.step(kNan, trajectory).status, TrackerStatus::failed);
  EXPECT_EQ(tracker.observe(kNan, Pose2{}), MeasurementOutcome::invalid);
  for (int i = 1; i < 40; ++i) {
    const double time = 0.05 * i;
    Pose2 pose{trajectory.position(time), 0.0};
    if (i % 5 == 0) pose.heading = kNan;
    if (i % 7 == 0) pose.position_world += Eigen::Vector2d{100.0, -50.0};  // one wild jump at a time
    tracker.observe(time, pose);
    const TrackerOutput& output = tracker.step(time, trajectory);
    ASSERT_EQ(output.status, TrackerStatus::tracking) << i;
    EXPECT_LE(output.wheel_speeds.cwiseAbs().maxCoeff(), RobotParameters{}.max_wheel_speed);
    EXPECT_LT((tracker.estimate(time).pose_world.position_world - trajectory.position(time)).norm(), 0.3);
  }
}

TEST(Tracker, StandsStillAtTheEnd) {
  const Trajectory trajectory = Trajectory::standing({2.0, 3.0}, 0.0, 1.0, HeadingProfile{0.5});
  Tracker tracker{TrackerParameters{}, RobotParameters{}};
  tracker.observe(5.0, Pose2{{2.0, 3.0}, 0.5});
  EXPECT_LT(tracker.step(5.0, trajectory).wheel_speeds.norm(), 1e-12);
}

TEST(Tracker, CarriesALateMeasurementToThePresent) {
  const Trajectory trajectory = circle(HeadingProfile{0.0});
  Tracker tracker{TrackerParameters{}, RobotParameters{}};
  tracker.observe(3.0, Pose2{trajectory.position(3.0), 0.0});
  for (int i = 0; i < 10; ++i) tracker.step(3.0 + 0.05 * i, trajectory);
  const Pose2 present = tracker.estimate(3.45).pose_world;
  Pose2 late = tracker.estimate(3.45).pose_world;
  late.position_world -= 0.05 * tracker.last_output().twist_world.head<2>();
  EXPECT_NE(tracker.observe(3.40, late), MeasurementOutcome::invalid);
  // The command changes by some 5 cm/s in the 50 ms.
  EXPECT_LT((tracker.estimate(3.45).pose_world.position_world - present.position_world).norm(), 0.005);
  EXPECT_EQ(tracker.observe(1.0, late), MeasurementOutcome::invalid);
}

TEST(Tracker, ReportsReferenceAndCommand) {
  const Trajectory trajectory = circle(HeadingProfile{0.3});
  Tracker tracker{TrackerParameters{}, RobotParameters{}};
  tracker.observe(4.0, Pose2{trajectory.position(4.0), 0.3});
  const TrackerOutput& output = tracker.step(4.0, trajectory);
  EXPECT_LT((output.reference_pose.head<2>() - trajectory.position(4.0)).norm(), 1e-12);
  EXPECT_NEAR(output.reference_pose.z(), 0.3, 1e-12);
  const Drive drive{RobotParameters{}};
  EXPECT_LT((drive.twist_world(output.wheel_speeds, 0.3) - output.twist_world).norm(), 1e-12);
}

TEST(Tracker, DoesNotAllocate) {
  const Trajectory trajectory = circle(HeadingProfile{0.0});
  Tracker tracker{TrackerParameters{}, RobotParameters{}};
  tracker.observe(0.0, Pose2{{1.0, 0.0}, 0.0});
  const AllocationGuard guard;
  for (int i = 0; i < 50; ++i) {
    tracker.observe(0.05 * i, Pose2{trajectory.position(0.05 * i), 0.0});
    tracker.step(0.05 * i, trajectory);
  }
  EXPECT_EQ(guard.allocations(), 0);
}

TEST(Tracker, RefusesParametersOutOfRange) {
  TrackerParameters parameters;
  parameters.mpc.dt = 0.0;
  parameters.observer.bandwidth = -1.0;
  try {
    const Tracker tracker{parameters, RobotParameters{}};
    FAIL() << "accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string{error.what()}.find("mpc.dt"), std::string::npos);
    EXPECT_NE(std::string{error.what()}.find("observer.bandwidth"), std::string::npos);
  }
}

}  // namespace
}  // namespace spf
