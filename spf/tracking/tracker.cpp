#include "spf/tracking/tracker.hpp"

#include <algorithm>
#include <cmath>

#include "spf/math/angles.hpp"

namespace spf {
namespace {

constexpr double kLongestDelay = 0.5;      // [s] of a measurement
constexpr double kIntegrationStep = 0.02;  // [s]: turns 2 deg at 1.5 rad/s, second-order accurate
constexpr int kMostSteps = 50;             // in one call; a longer gap is bridged with longer steps

}  // namespace

Tracker::Tracker(const TrackerParameters& parameters, const RobotParameters& robot)
    : parameters_{validated(parameters)},
      kinematics_{robot},
      lag_{parameters.compensate_lag ? robot.motor_lag : 0.0},
      motion_{PoseObserver{parameters.observer}, Eigen::Vector3d::Zero()},
      mpc_{parameters.mpc, kinematics_} {}

void Tracker::reset() {
  motion_.observer.reset();
  motion_.wheel_speeds.setZero();
  mpc_.forget();
  output_ = TrackerOutput{};
  has_time_ = false;
}

void Tracker::advance_to(double time) {
  if (has_time_ && time > time_) advance(motion_, time - time_);
  if (!has_time_ || time > time_) time_ = time;
  has_time_ = true;
}

// The observer is fed the mean speed of every step under the held command.
void Tracker::advance(Motion& motion, double duration) const {
  const int steps =
      std::clamp(static_cast<int>(std::ceil(std::min(duration, 1e3) / kIntegrationStep)), 1, kMostSteps);
  const double dt = duration / steps;
  const double decay = lag_ > 0.0 ? std::exp(-dt / lag_) : 0.0;
  for (int i = 0; i < steps; ++i) {
    const Eigen::Vector3d missing = motion.wheel_speeds - output_.wheel_speeds;
    const Eigen::Vector3d mean = output_.wheel_speeds + (lag_ / dt * (1.0 - decay)) * missing;
    motion.wheel_speeds = output_.wheel_speeds + decay * missing;
    const StateEstimate estimate = motion.observer.estimate();
    const double yaw_rate = kinematics_.twist_body(mean).z() + estimate.disturbance_world.z();
    const double mid_heading = estimate.pose_world.heading + 0.5 * dt * yaw_rate;
    motion.observer.predict(dt, kinematics_.twist_world(mean, mid_heading));
  }
}

MeasurementOutcome Tracker::observe(double time, const Pose2& measured_world) {
  if (!std::isfinite(time)) return MeasurementOutcome::invalid;
  const double delay = has_time_ ? time_ - time : 0.0;
  if (delay > kLongestDelay) return MeasurementOutcome::invalid;
  advance_to(time);
  Pose2 present = measured_world;
  if (delay > 0.0) {
    const StateEstimate estimate = motion_.observer.estimate();
    const Eigen::Vector3d moved =
        delay *
        (kinematics_.twist_world(motion_.wheel_speeds, measured_world.heading) + estimate.disturbance_world);
    present.position_world += moved.head<2>();
    present.heading += moved.z();
  }
  return motion_.observer.correct(present);
}

const TrackerOutput& Tracker::stop(double time) {
  if (std::isfinite(time)) advance_to(time);
  return stand(TrackerStatus::no_reference);
}

const TrackerOutput& Tracker::stand(TrackerStatus status) {
  output_ = TrackerOutput{};
  output_.status = status;
  mpc_.forget();
  return output_;
}

const TrackerOutput& Tracker::step(double time, const Trajectory& committed) {
  if (!std::isfinite(time)) return stand(TrackerStatus::failed);
  // 1. Where the robot is, and with which speed its wheels turn.
  advance_to(time);
  const StateEstimate estimate = motion_.observer.estimate();
  if (!estimate.valid) return stand(TrackerStatus::no_estimate);
  if (committed.empty()) return stand(TrackerStatus::no_reference);

  // 2. Where it ought to be from now on (eq. 18).
  const MpcParameters& mpc = parameters_.mpc;
  const ReferenceRequest request{
      time, mpc.dt, mpc.horizon, lag_, parameters_.control_period, estimate.pose_world};
  problem_.reference = sample_reference(committed, request, kinematics_, parameters_.reference);

  // 3. The command that leads there (eq. 19), for the point one motor lag ahead.
  const Eigen::Vector3d twist =
      kinematics_.twist_world(motion_.wheel_speeds, estimate.pose_world.heading) + estimate.disturbance_world;
  problem_.initial_pose << estimate.pose_world.position_world, estimate.pose_world.heading;
  problem_.initial_pose += lag_ * twist;
  problem_.disturbance = estimate.disturbance_world;
  problem_.previous_wheel_speeds = output_.wheel_speeds;
  const MpcResult& result = mpc_.solve(problem_);
  if (result.status == MpcStatus::invalid_problem) return stand(TrackerStatus::failed);

  output_.status = TrackerStatus::tracking;
  output_.mpc_status = result.status;
  output_.wheel_speeds = result.wheel_speeds[0];
  if (lag_ <= 0.0) motion_.wheel_speeds = output_.wheel_speeds;
  output_.twist_world = kinematics_.twist_world(output_.wheel_speeds, estimate.pose_world.heading);
  output_.reference_twist = problem_.reference.twist[0];
  output_.reference_pose = problem_.reference.pose[0] - lag_ * problem_.reference.twist[0];
  output_.slip = problem_.reference.slip;
  output_.slip_limited = problem_.reference.slip_limited;
  return output_;
}

StateEstimate Tracker::estimate(double time) const {
  Motion motion = motion_;
  if (has_time_ && time > time_) advance(motion, time - time_);
  return motion.observer.estimate();
}

}  // namespace spf
