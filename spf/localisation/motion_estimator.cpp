#include "spf/localisation/motion_estimator.hpp"

#include <algorithm>
#include <cmath>

namespace spf {
namespace {

constexpr double kLongestDelay = 0.5;      // [s] of a measurement
constexpr double kIntegrationStep = 0.02;  // [s]: turns 2 deg at 1.5 rad/s, second-order accurate
constexpr int kMostSteps = 50;             // in one call; a longer gap is bridged with longer steps

}  // namespace

MotionEstimator::MotionEstimator(const ObserverParameters& parameters, const Drive& drive, double motor_lag)
    : drive_{drive},
      lag_{motor_lag},
      motion_{PoseObserver{parameters}, drive.standstill()},
      command_{drive.standstill()} {}

void MotionEstimator::reset() {
  motion_.observer.reset();
  motion_.wheel_speeds.setZero();
  command_.setZero();
  has_time_ = false;
}

void MotionEstimator::advance_to(double time) {
  if (!std::isfinite(time)) return;
  if (has_time_ && time > time_) advance(motion_, time - time_);
  if (!has_time_ || time > time_) time_ = time;
  has_time_ = true;
}

// The observer is fed the mean speed of every step under the held command.
void MotionEstimator::advance(Motion& motion, double duration) const {
  const int steps =
      std::clamp(static_cast<int>(std::ceil(std::min(duration, 1e3) / kIntegrationStep)), 1, kMostSteps);
  const double dt = duration / steps;
  const double decay = lag_ > 0.0 ? std::exp(-dt / lag_) : 0.0;
  for (int i = 0; i < steps; ++i) {
    const DriveInput missing = motion.wheel_speeds - command_;
    const DriveInput mean = command_ + (lag_ / dt * (1.0 - decay)) * missing;
    motion.wheel_speeds = command_ + decay * missing;
    const StateEstimate estimate = motion.observer.estimate();
    const double yaw_rate = drive_.twist_body(mean).z() + estimate.disturbance_world.z();
    const double mid_heading = estimate.pose_world.heading + 0.5 * dt * yaw_rate;
    motion.observer.predict(dt, drive_.twist_world(mean, mid_heading));
  }
}

MeasurementOutcome MotionEstimator::observe(double time, const Pose2& measured_world) {
  if (!std::isfinite(time)) return MeasurementOutcome::invalid;
  const double delay = has_time_ ? time_ - time : 0.0;
  if (delay > kLongestDelay) return MeasurementOutcome::invalid;
  advance_to(time);
  Pose2 present = measured_world;
  if (delay > 0.0) {
    const StateEstimate estimate = motion_.observer.estimate();
    const Eigen::Vector3d moved = delay * (drive_.twist_world(motion_.wheel_speeds, measured_world.heading) +
                                           estimate.disturbance_world);
    present.position_world += moved.head<2>();
    present.heading += moved.z();
  }
  return motion_.observer.correct(present);
}

void MotionEstimator::apply(double time, const DriveInput& wheel_speeds) {
  advance_to(time);
  const bool usable = wheel_speeds.size() == command_.size() && wheel_speeds.allFinite();
  command_ = usable ? wheel_speeds : drive_.standstill();
  if (lag_ <= 0.0) motion_.wheel_speeds = command_;
}

MotionState MotionEstimator::state() const {
  return {motion_.observer.estimate(), motion_.wheel_speeds, command_};
}

StateEstimate MotionEstimator::estimate(double time) const {
  Motion motion = motion_;
  if (has_time_ && time > time_) advance(motion, time - time_);
  return motion.observer.estimate();
}

}  // namespace spf
