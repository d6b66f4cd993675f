// Parameters of the tracker: observer, reference and MPC.
#pragma once

#include "spf/localisation/observer_parameters.hpp"
#include "spf/math/parameters.hpp"
#include "spf/robot/robot_parameters.hpp"
#include "spf/tracking/mpc.hpp"
#include "spf/tracking/reference_sampler.hpp"

namespace spf {

struct TrackerParameters {
  double control_period = 0.05;  ///< [s] between control ticks
  bool compensate_lag = true;    ///< model RobotParameters::motor_lag; the paper does not
  ObserverParameters observer;
  ReferenceParameters reference;
  MpcParameters mpc;

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit("control_period", self.control_period, "s", Range{1e-3, 1.0},
          "time between control ticks; our choice");
    visit("compensate_lag", self.compensate_lag,
          "model the first-order lag of the motors in observer and MPC; our addition");
    visit.group("observer", self.observer);
    visit.group("reference", self.reference);
    visit.group("mpc", self.mpc);
  }
};

/// Lag of the motors that estimator and controller reckon with [s].
[[nodiscard]] inline double reckoned_lag(const TrackerParameters& parameters, const RobotParameters& robot) {
  return parameters.compensate_lag ? robot.motor_lag : 0.0;
}

}  // namespace spf
