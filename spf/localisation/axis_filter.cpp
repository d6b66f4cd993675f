#include "spf/localisation/axis_filter.hpp"

#include <algorithm>
#include <cmath>

namespace spf {

AxisGain eso_gain(double bandwidth, double interval) {
  if (interval <= 0.0) return {};
  const double pole_distance = -std::expm1(-bandwidth * interval);  // 1 - exp(-w T)
  return {pole_distance * (2.0 - pole_distance), pole_distance * pole_distance / interval};
}

void AxisFilter::start(double value, double variance, double disturbance_sigma) {
  value_ = value;
  disturbance_ = 0.0;
  variance_ = variance;
  covariance_ = 0.0;
  disturbance_variance_ = disturbance_sigma * disturbance_sigma;
}

void AxisFilter::restart(double value, double variance) {
  value_ = value;
  variance_ = variance;
  covariance_ = 0.0;
}

void AxisFilter::predict(double dt, double velocity, const AxisNoise& noise) {
  value_ += dt * (velocity + disturbance_);
  const double drift = noise.drift * noise.drift;
  variance_ += dt * (2.0 * covariance_ + dt * disturbance_variance_) + noise.velocity * noise.velocity * dt +
               drift * dt * dt * dt / 3.0;
  covariance_ += dt * disturbance_variance_ + 0.5 * drift * dt * dt;
  disturbance_variance_ += drift * dt;
}

AxisGain AxisFilter::kalman_gain(double measurement_sigma) const {
  const double innovation_variance = variance_ + measurement_sigma * measurement_sigma;
  // This happens only when an exact value is measured twice at one instant.
  if (innovation_variance <= 0.0) return {1.0, 0.0};
  return {variance_ / innovation_variance, covariance_ / innovation_variance};
}

void AxisFilter::correct(double innovation, const AxisGain& gain, double measurement_sigma) {
  value_ += gain.value * innovation;
  disturbance_ += gain.disturbance * innovation;
  const double noise = measurement_sigma * measurement_sigma;
  const double keep = 1.0 - gain.value;
  const double variance = keep * keep * variance_ + gain.value * gain.value * noise;
  const double covariance =
      keep * (covariance_ - gain.disturbance * variance_) + gain.value * gain.disturbance * noise;
  disturbance_variance_ +=
      -2.0 * gain.disturbance * covariance_ + gain.disturbance * gain.disturbance * (variance_ + noise);
  disturbance_variance_ = std::max(disturbance_variance_, 0.0);
  variance_ = variance;
  covariance_ = covariance;
}

void AxisFilter::limit_disturbance(double limit) {
  disturbance_ = std::clamp(disturbance_, -limit, limit);
}

}  // namespace spf
