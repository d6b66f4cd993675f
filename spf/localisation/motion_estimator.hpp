// Where the robot is and how its wheels turn, from measured poses and the command that was applied to its
// motors: the pose observer (eq. 17) run on a model of the motors' lag. It knows no controller: whoever moves
// the robot says what was applied, so that braking by a watchdog or a limit on the way to the motors does not
// mislead it. Frame: world.
#pragma once

#include <Eigen/Core>

#include "spf/localisation/observer.hpp"
#include "spf/robot/omni_kinematics.hpp"

namespace spf {

/// The estimate at one instant, as a controller needs it.
struct MotionState {
  StateEstimate estimate;
  Eigen::Vector3d wheel_speeds =
      Eigen::Vector3d::Zero();                        ///< [m/s] rim speeds, as the motors' lag lets them be
  Eigen::Vector3d command = Eigen::Vector3d::Zero();  ///< [m/s] rim speeds applied and still held
};

/// Never throws or allocates after construction.
class MotionEstimator {
 public:
  /// `motor_lag` is the first-order lag of the wheels that is reckoned with [s], 0 = none. Throws
  /// std::invalid_argument on parameters out of range.
  MotionEstimator(const ObserverParameters& parameters, const OmniKinematics& kinematics, double motor_lag);

  /// A pose measured at a time [s]. One that arrives late, up to half a second, is carried to the present
  /// with the motion meanwhile; an older one is ignored (`invalid`).
  MeasurementOutcome observe(double time, const Pose2& measured_world);
  /// Rim speeds [m/s] that the motors are told from a time [s] on; held until the next.
  void apply(double time, const Eigen::Vector3d& wheel_speeds);
  /// Forgets the estimate and the command, as after the robot was carried away.
  void reset();

  /// Carries the estimate to a time [s]; an earlier one than the last changes nothing.
  void advance_to(double time);
  /// As of the last call.
  [[nodiscard]] MotionState state() const;
  /// Carried to a time not before the last call [s], without changing anything.
  [[nodiscard]] StateEstimate estimate(double time) const;

 private:
  struct Motion {
    PoseObserver observer;
    Eigen::Vector3d wheel_speeds;  // [m/s]
  };
  void advance(Motion& motion, double duration) const;

  OmniKinematics kinematics_;
  double lag_;  // [s]
  Motion motion_;
  Eigen::Vector3d command_ = Eigen::Vector3d::Zero();  // [m/s]
  bool has_time_ = false;
  double time_ = 0.0;  // [s] of the estimate
};

}  // namespace spf
