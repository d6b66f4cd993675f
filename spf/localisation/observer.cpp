#include "spf/localisation/observer.hpp"

#include <algorithm>
#include <cmath>

#include "spf/math/angles.hpp"
#include "spf/math/believable.hpp"

namespace spf {
namespace {

constexpr double kHeadingVelocityNoise = 0.02;  // [rad/sqrt(s)] white noise of the yaw rate
constexpr double kHeadingDriftNoise = 0.02;     // [rad/s/sqrt(s)] random walk of the yaw disturbance
constexpr double kGate = 6.0;  // [1] innovations beyond this many sigma (plus the floor) are outliers
constexpr double kHeadingGateFloor = 0.1;  // [rad]
constexpr int kReinitialiseCount = 5;      // outliers in a row that agree with each other are believed
constexpr std::size_t kHeading = 2;
// Deviation of the unknown disturbance at the start [m/s], [rad/s]: a few centimetres a second of wheel slip.
constexpr double kInitialDisturbanceSigma = 0.05;
// Outliers that do not agree with each other are accepted after this many times kReinitialiseCount: the
// declared noise is then wrong, and a bad measurement is better than none for ever.
constexpr int kInconsistentFactor = 4;
constexpr double kLargestTurn = 1.0;  // [rad] of a sensor's jump
// Measured noise counts where its variance exceeds the declared one clearly.
constexpr int kNoiseMemory = 100;       // measurements over which it is averaged
constexpr double kClearly = 4.0;        // [1] times the declared variance
constexpr double kFloorShare = 0.25;    // [1] of gate_floor: at least, as a deviation
constexpr double kHeadingFloor = 5e-3;  // [rad] likewise

}  // namespace

PoseObserver::PoseObserver(const ObserverParameters& parameters)
    : parameters_{validated(parameters)},
      meters_{NoiseMeter{kNoiseMemory}, NoiseMeter{kNoiseMemory}, NoiseMeter{kNoiseMemory}} {
  const AxisNoise position{parameters_.pose_sigma, parameters_.velocity_noise, parameters_.drift_noise};
  noise_ = {position, position,
            AxisNoise{parameters_.heading_sigma, kHeadingVelocityNoise, kHeadingDriftNoise}};
}

void PoseObserver::reset() {
  started_ = false;
  since_measurement_ = 0.0;
  agreeing_outliers_ = 0;
  outliers_in_a_row_ = 0;
  reinitialising_ = false;
  measured_before_ = false;
}

void PoseObserver::start(const Triple& measured) {
  for (std::size_t i = 0; i < 3; ++i)
    axes_[i].start(measured[i], noise_[i].measurement * noise_[i].measurement, kInitialDisturbanceSigma);
  started_ = true;
}

void PoseObserver::predict(double dt, const Eigen::Vector3d& applied_twist_world) {
  if (!started_ || !(dt > 0.0) || !std::isfinite(dt)) return;
  since_measurement_ += dt;
  if (parameters_.kind == ObserverKind::none) return;
  const bool usable = applied_twist_world.allFinite();
  for (std::size_t i = 0; i < 3; ++i) {
    const double velocity = usable ? applied_twist_world[static_cast<Eigen::Index>(i)] : 0.0;
    axes_[i].predict(dt, velocity, noise_[i]);
    applied_[i] += dt * velocity;
    outlier_mean_[i] += dt * (velocity + axes_[i].disturbance());
  }
  axes_[kHeading].set_value(wrap_angle(axes_[kHeading].value()));
}

MeasurementOutcome PoseObserver::correct(const Pose2& measured_world) {
  if (!believable(measured_world.position_world) || !std::isfinite(measured_world.heading))
    return MeasurementOutcome::invalid;
  const Triple measured{measured_world.position_world.x(), measured_world.position_world.y(),
                        wrap_angle(measured_world.heading)};
  if (!started_ || parameters_.kind == ObserverKind::none) {
    start(measured);
    since_measurement_ = 0.0;
    return MeasurementOutcome::used;
  }
  const Triple difference =
      innovation(measured, {axes_[0].value(), axes_[1].value(), axes_[kHeading].value()});
  if (reinitialising_) return reinitialise_onto(difference);
  // The gate is fixed at the first outlier: it must not widen with the variance while outliers are counted.
  if (outliers_in_a_row_ == 0)
    gate_variance_ = {axes_[0].variance(), axes_[1].variance(), axes_[kHeading].variance()};
  if (!within_gate(difference, gate_variance_)) return reject(measured);
  if (parameters_.kind == ObserverKind::kalman) learn_noise(measured);
  apply(difference);
  for (std::size_t i = 0; i < 3; ++i) {
    // The exact measurement itself, without rounding.
    if (parameters_.kind == ObserverKind::kalman && noise_[i].measurement == 0.0)
      axes_[i].set_value(measured[i]);
  }
  return MeasurementOutcome::used;
}

void PoseObserver::learn_noise(const Triple& measured) {
  if (measured_before_) {
    const Triple change = innovation(measured, last_measured_);
    for (std::size_t i = 0; i < 3; ++i) meters_[i].note(change[i] - applied_[i]);
    const double position = 0.5 * (meters_[0].variance() + meters_[1].variance());
    const auto reckoned = [](double declared, double floor, double variance) {
      const bool clearly = variance > kClearly * declared * declared + floor * floor;
      return clearly ? std::sqrt(variance) : declared;
    };
    noise_[0].measurement = noise_[1].measurement =
        reckoned(parameters_.pose_sigma, kFloorShare * parameters_.gate_floor, position);
    noise_[kHeading].measurement =
        reckoned(parameters_.heading_sigma, kHeadingFloor, meters_[kHeading].variance());
  }
  measured_before_ = true;
  last_measured_ = measured;
  applied_ = {};
}

PoseObserver::Triple PoseObserver::innovation(const Triple& measured, const Triple& from) const {
  return {measured[0] - from[0], measured[1] - from[1], angle_difference(measured[2], from[2])};
}

bool PoseObserver::within_gate(const Triple& innovation, const Triple& variance) const {
  for (std::size_t i = 0; i < 3; ++i) {
    const double sigma = std::sqrt(variance[i] + noise_[i].measurement * noise_[i].measurement);
    const double floor = i == kHeading ? kHeadingGateFloor : parameters_.gate_floor;
    if (!(std::abs(innovation[i]) <= kGate * sigma + floor)) return false;
  }
  return true;
}

void PoseObserver::apply(const Triple& innovation) {
  const bool fixed_poles = parameters_.kind == ObserverKind::eso;
  for (std::size_t i = 0; i < 3; ++i) {
    const double bandwidth = i == kHeading ? parameters_.heading_bandwidth : parameters_.bandwidth;
    const AxisGain gain =
        fixed_poles ? eso_gain(bandwidth, since_measurement_) : axes_[i].kalman_gain(noise_[i].measurement);
    axes_[i].correct(innovation[i], gain, noise_[i].measurement);
    axes_[i].limit_disturbance(parameters_.max_disturbance);
  }
  axes_[kHeading].set_value(wrap_angle(axes_[kHeading].value()));
  since_measurement_ = 0.0;
  agreeing_outliers_ = 0;
  outliers_in_a_row_ = 0;
}

MeasurementOutcome PoseObserver::reject(const Triple& measured) {
  ++outliers_in_a_row_;
  measured_before_ = false;  // it says nothing of noise
  // A mean of n and one more measurement differ with variance (1 + 1/n) of a measurement.
  const Triple difference = innovation(measured, outlier_mean_);
  Triple mean_variance{};
  for (std::size_t i = 0; i < 3 && agreeing_outliers_ > 0; ++i)
    mean_variance[i] = noise_[i].measurement * noise_[i].measurement / agreeing_outliers_;
  if (agreeing_outliers_ > 0 && within_gate(difference, mean_variance)) {
    ++agreeing_outliers_;
    for (std::size_t i = 0; i < 3; ++i) outlier_mean_[i] += difference[i] / agreeing_outliers_;
  } else {
    agreeing_outliers_ = 1;
    outlier_mean_ = measured;
  }
  if (agreeing_outliers_ < kReinitialiseCount &&
      outliers_in_a_row_ < kInconsistentFactor * kReinitialiseCount)
    return MeasurementOutcome::rejected;

  agreeing_outliers_ = std::max(agreeing_outliers_, 1);
  const Triple jump =
      innovation(outlier_mean_, {axes_[0].value(), axes_[1].value(), axes_[kHeading].value()});
  reinitialising_ = is_sensor_jump(jump);
  jump_ = jump;
  for (std::size_t i = 0; i < 3 && !reinitialising_; ++i) {
    const double variance = noise_[i].measurement * noise_[i].measurement;
    // From an exact sensor the last measurement is taken, from a noisy one the mean of those that agree.
    axes_[i].restart(variance > 0.0 ? outlier_mean_[i] : measured[i], variance / agreeing_outliers_);
  }
  axes_[kHeading].set_value(wrap_angle(axes_[kHeading].value()));
  since_measurement_ = 0.0;
  agreeing_outliers_ = 0;
  outliers_in_a_row_ = 0;
  return MeasurementOutcome::reinitialised;
}

bool PoseObserver::is_sensor_jump(const Triple& jump) const {
  if (parameters_.kind != ObserverKind::kalman || parameters_.settling_time <= 0.0) return false;
  return std::hypot(jump[0], jump[1]) <= parameters_.largest_jump && std::abs(jump[kHeading]) <= kLargestTurn;
}

// Mostly dead reckoning: the estimate converges to the measured pose with the settling time until the two
// agree again.
MeasurementOutcome PoseObserver::reinitialise_onto(const Triple& innovation) {
  constexpr double kSmoothing = 0.2;  // of about five measurements
  Triple change{};
  for (std::size_t i = 0; i < 3; ++i) change[i] = innovation[i] - jump_[i];
  if (within_gate(change, gate_variance_)) {
    for (std::size_t i = 0; i < 3; ++i) jump_[i] += kSmoothing * change[i];
  } else {
    if (++outliers_in_a_row_ < kReinitialiseCount) return MeasurementOutcome::rejected;
    jump_ = innovation;  // it has jumped again
  }
  outliers_in_a_row_ = 0;
  const double share = -std::expm1(-since_measurement_ / parameters_.settling_time);
  bool settled = true;
  for (std::size_t i = 0; i < 3; ++i) {
    axes_[i].correct(innovation[i], {share, 0.0}, std::hypot(noise_[i].measurement, jump_[i]));
    const double floor = i == kHeading ? kHeadingGateFloor : parameters_.gate_floor;
    settled = settled && std::abs(jump_[i]) <= std::max(floor, noise_[i].measurement);
  }
  axes_[kHeading].set_value(wrap_angle(axes_[kHeading].value()));
  since_measurement_ = 0.0;
  reinitialising_ = !settled;
  return MeasurementOutcome::used;
}

StateEstimate PoseObserver::estimate() const {
  StateEstimate estimate;
  estimate.valid = started_;
  if (!started_) return estimate;
  estimate.pose_world = Pose2{{axes_[0].value(), axes_[1].value()}, axes_[kHeading].value()};
  for (std::size_t i = 0; i < 3; ++i)
    estimate.disturbance_world[static_cast<Eigen::Index>(i)] = axes_[i].disturbance();
  estimate.position_variance = 0.5 * (axes_[0].variance() + axes_[1].variance());
  estimate.heading_variance = axes_[kHeading].variance();
  estimate.age = since_measurement_;
  return estimate;
}

}  // namespace spf
