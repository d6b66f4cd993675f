// Pose and wheel speeds of the robot, from measured poses and the command that was applied to its motors: the
// pose observer (eq. 17) run on a model of the motors' lag. It is independent of the controller and is fed
// the applied command, so that braking by a watchdog, or a limit between controller and motors, does not
// mislead it. Frame: world.
#pragma once

#include <Eigen/Core>

#include "spf/localisation/observer.hpp"
#include "spf/robot/drive.hpp"

namespace spf {

/// The estimate at one instant, as a controller needs it.
struct MotionState {
  StateEstimate estimate;
  DriveInput wheel_speeds;  ///< after the motors' lag
  DriveInput command;       ///< applied and still held
};

/// Never throws or allocates after construction.
class MotionEstimator {
 public:
  /// `motor_lag` is the first-order lag of the wheels in the model [s], 0 = none. Throws
  /// std::invalid_argument on parameters out of range.
  MotionEstimator(const ObserverParameters& parameters, const Drive& drive, double motor_lag);

  /// Takes in a pose measured at a time [s]. One that arrives late, up to half a second, is propagated to the
  /// present with the motion since then; an older one is ignored (`invalid`).
  MeasurementOutcome observe(double time, const Pose2& measured_world);
  /// Rim speeds [m/s] applied to the motors from a time [s] on; held until the next call.
  void apply(double time, const DriveInput& wheel_speeds);
  /// Forgets the estimate and the command, as after the robot was carried away.
  void reset();

  /// Propagates the estimate to a time [s]; a time before the last one changes nothing.
  void advance_to(double time);
  /// [s] Of the estimate; meaningless before the first call that had one.
  [[nodiscard]] double time() const { return time_; }
  /// As of the last call.
  [[nodiscard]] MotionState state() const;
  /// The estimate propagated to a time not before the last call [s]; the state does not change.
  [[nodiscard]] StateEstimate estimate(double time) const;

 private:
  struct Motion {
    PoseObserver observer;
    DriveInput wheel_speeds;
  };
  void advance(Motion& motion, double duration) const;

  Drive drive_;
  double lag_;  // [s]
  Motion motion_;
  DriveInput command_;
  bool has_time_ = false;
  double time_ = 0.0;  // [s] of the estimate
};

}  // namespace spf
