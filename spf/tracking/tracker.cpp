#include "spf/tracking/tracker.hpp"

namespace spf {
Tracker::Tracker(const TrackerParameters& parameters, const RobotParameters& robot)
    : kinematics_{robot},
      estimator_{validated(parameters).observer, kinematics_, reckoned_lag(parameters, robot)},
      controller_{parameters, kinematics_, reckoned_lag(parameters, robot)} {}

void Tracker::reset() {
  estimator_.reset();
  controller_.reset();
}

const TrackerOutput& Tracker::step(double time, const Trajectory& committed) {
  estimator_.advance_to(time);
  return apply(time, controller_.step(time, estimator_.state(), committed));
}

const TrackerOutput& Tracker::stop(double time) {
  estimator_.advance_to(time);
  return apply(time, controller_.stop());
}

const TrackerOutput& Tracker::apply(double time, const TrackerOutput& output) {
  estimator_.apply(time, output.wheel_speeds);
  return output;
}

}  // namespace spf
