// Estimator and controller together for tests and benchmarks, where the command is applied as it was
// computed: from measured poses and the committed trajectory to wheel speeds (observer eq. 17, self-sampling
// eq. 18, MPC eq. 19). Robots have host::Localiser and host::TrackerHost. Frame: world.
#pragma once

#include "spf/localisation/motion_estimator.hpp"
#include "spf/math/pose2.hpp"
#include "spf/robot/robot_parameters.hpp"
#include "spf/tracking/tracker_parameters.hpp"
#include "spf/tracking/trajectory_controller.hpp"
#include "spf/trajectory/trajectory.hpp"

namespace spf {

/// Never throws or allocates after construction.
class Tracker {
 public:
  /// Throws std::invalid_argument on parameters out of range.
  Tracker(const TrackerParameters& parameters, const RobotParameters& robot)
      : drive_{robot},
        estimator_{validated(parameters).observer, drive_, reckoned_lag(parameters, robot)},
        controller_{parameters, drive_, reckoned_lag(parameters, robot)} {}

  /// A pose measured at a time [s] (MotionEstimator::observe).
  MeasurementOutcome observe(double time, const Pose2& measured_world) {
    return estimator_.observe(time, measured_world);
  }
  /// One control tick.
  const TrackerOutput& step(double time, const Trajectory& committed) {
    estimator_.advance_to(time);
    return apply(time, controller_.step(time, estimator_.state(), committed));
  }
  /// Commands standstill instead of a tick; the observer learns of it.
  const TrackerOutput& stop(double time) {
    estimator_.advance_to(time);
    return apply(time, controller_.stop());
  }
  /// Forgets the estimate and the command, as after the robot was carried away.
  void reset() {
    estimator_.reset();
    controller_.reset();
  }

  /// The estimate carried to a time not before the last call [s], without changing anything.
  [[nodiscard]] StateEstimate estimate(double time) const { return estimator_.estimate(time); }
  [[nodiscard]] const TrackerOutput& last_output() const { return output_; }
  [[nodiscard]] const TrajectoryController& controller() const { return controller_; }

 private:
  const TrackerOutput& apply(double time, const TrackerOutput& output) {
    estimator_.apply(time, output.wheel_speeds);
    return output_ = output;
  }

  Drive drive_;
  MotionEstimator estimator_;
  TrajectoryController controller_;
  TrackerOutput output_;
};

}  // namespace spf
