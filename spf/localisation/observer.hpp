// The pose observer (eq. 17): the robot's pose and the disturbance of its velocity, from measured poses and
// the commanded motion. Run it at the rate of the measurements and feed it the command as applied, after
// saturation. With exact measurements (sigma 0) the default observer reports the measurement itself, unless
// they turn out to be clearly noisier than was declared: then it reckons with the noise that they show.
// Frame: world.
#pragma once

#include <Eigen/Core>

#include <array>

#include "spf/localisation/axis_filter.hpp"
#include "spf/localisation/noise_meter.hpp"
#include "spf/localisation/observer_parameters.hpp"
#include "spf/math/pose2.hpp"

namespace spf {

struct StateEstimate {
  bool valid = false;  ///< false until the first measurement
  Pose2 pose_world;
  Eigen::Vector3d disturbance_world =
      Eigen::Vector3d::Zero();     ///< [m/s, m/s, rad/s] motion beyond the command
  double position_variance = 0.0;  ///< [m^2] per axis, from the noise levels
  double heading_variance = 0.0;   ///< [rad^2]
  double age = 0.0;                ///< [s] since the last measurement that was used
};

enum class MeasurementOutcome {
  used,
  rejected,       ///< an outlier
  reinitialised,  ///< outliers that agree with each other: the estimate jumps to them, or begins to
                  ///< converge to them
  invalid,        ///< not a number, ignored
};

class PoseObserver {
 public:
  /// Throws std::invalid_argument on parameters out of range.
  explicit PoseObserver(const ObserverParameters& parameters);

  /// Advances by dt >= 0 [s] with the motion applied during it. Bridges gaps of any length; before the first
  /// measurement there is nothing to advance. Input that is not finite counts as standing still.
  void predict(double dt, const Eigen::Vector3d& applied_twist_world);
  /// Takes in a pose measured now.
  MeasurementOutcome correct(const Pose2& measured_world);
  /// Forgets everything.
  void reset();

  [[nodiscard]] StateEstimate estimate() const;
  [[nodiscard]] const ObserverParameters& parameters() const { return parameters_; }

 private:
  using Triple = std::array<double, 3>;  // x, y, heading

  void start(const Triple& measured);
  [[nodiscard]] Triple innovation(const Triple& measured, const Triple& from) const;
  [[nodiscard]] bool within_gate(const Triple& innovation, const Triple& variance) const;
  void learn_noise(const Triple& measured);
  void apply(const Triple& innovation);
  MeasurementOutcome reject(const Triple& measured);
  [[nodiscard]] bool is_sensor_jump(const Triple& jump) const;
  MeasurementOutcome reinitialise_onto(const Triple& innovation);

  ObserverParameters parameters_;
  std::array<AxisNoise, 3> noise_;
  std::array<AxisFilter, 3> axes_;
  bool started_ = false;
  double since_measurement_ = 0.0;  // [s]
  // The noise that measurements show: by what they differ from the one before and the motion applied since.
  std::array<NoiseMeter, 3> meters_;
  Triple last_measured_{};
  Triple applied_{};  // [m, m, rad] since then
  bool measured_before_ = false;
  // Consecutive outliers: their mean, propagated with the commanded motion, while they agree.
  Triple outlier_mean_{};
  int agreeing_outliers_ = 0;
  int outliers_in_a_row_ = 0;
  Triple gate_variance_{};  // of the estimate at the first of them
  // During slow convergence to a jump of the measured pose: the remaining difference to the estimate,
  // smoothed.
  bool reinitialising_ = false;
  Triple jump_{};
};

}  // namespace spf
