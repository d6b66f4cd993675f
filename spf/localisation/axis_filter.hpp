// One axis of the pose observer: value z and disturbance velocity d with z' = u + d + noise, d' = noise (eq.
// 17 with b = 1: the second state is the disturbance, not the velocity). Units of z are m or rad.
#pragma once

namespace spf {

/// Noise of one axis.
struct AxisNoise {
  double measurement = 0.0;  ///< [m] standard deviation
  double velocity = 0.0;     ///< [m/sqrt(s)]
  double drift = 0.0;        ///< [m/s/sqrt(s)]
};

/// What an innovation is multiplied by.
struct AxisGain {
  double value = 0.0;
  double disturbance = 0.0;  ///< [1/s]
};

/// Gain of eq. 17 for measurements `interval` [s] apart. The model is integrated exactly between measurements
/// and both poles of the error lie at exp(-w interval), as in eq. 17; for interval -> 0 these are l1 = 2 w
/// and l2 = w^2 times the interval. Holds for any interval, so gaps need no special case.
[[nodiscard]] AxisGain eso_gain(double bandwidth, double interval);

/// The two states with their covariance, which is exact (Joseph form) for any gain, optimal or not.
class AxisFilter {
 public:
  /// Starts at a measurement of the given variance with an unknown disturbance of the given deviation.
  void start(double value, double variance, double disturbance_sigma);
  /// Sets value and variance anew; the disturbance is kept.
  void restart(double value, double variance);

  void predict(double dt, double velocity, const AxisNoise& noise);
  [[nodiscard]] AxisGain kalman_gain(double measurement_sigma) const;
  /// innovation = measurement - value (wrapped by the caller for angles).
  void correct(double innovation, const AxisGain& gain, double measurement_sigma);

  [[nodiscard]] double value() const { return value_; }
  [[nodiscard]] double disturbance() const { return disturbance_; }
  [[nodiscard]] double variance() const { return variance_; }
  void set_value(double value) { value_ = value; }
  void limit_disturbance(double limit);

 private:
  double value_ = 0.0;
  double disturbance_ = 0.0;
  double variance_ = 0.0;              // of the value
  double covariance_ = 0.0;            // of value and disturbance
  double disturbance_variance_ = 0.0;  // of the disturbance
};

}  // namespace spf
