// Parameter group `team`.
#pragma once

#include "spf/math/parameters.hpp"
#include "spf/planning/field/replanning_parameters.hpp"

namespace spf {

/// Rates, time-outs and rules of the agent itself.
struct TeamParameters {
  double plan_period = 0.1;        ///< [s] between planning checks
  double message_period = 0.2;     ///< [s] the committed plan is told again at least this often
  double message_lifetime = 1.5;   ///< [s] after which a peer may no longer rely on it
  double stale_time = 0.3;         ///< [s] without pose or observation until the robot brakes
  double goal_tolerance = 0.05;    ///< [m] within which the robot counts itself arrived
  double reanchor_distance = 0.3;  ///< [m] from the plan beyond which the plan starts anew at the robot
  int priority = 0;  ///< [1] the smaller goes first; among equals the robot with the smaller number
  ReplanningParameters replanning{};  ///< of the paper's method; its keys stand among these

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit("plan_period", self.plan_period, "s", Range{0.01, 2.0}, "time between planning checks");
    visit("message_period", self.message_period, "s", Range{0.01, 10.0},
          "the committed plan is broadcast again at least this often");
    visit("message_lifetime", self.message_lifetime, "s", Range{0.1, 60.0},
          "time after which peers no longer rely on a broadcast");
    visit("stale_time", self.stale_time, "s", Range{0.02, 10.0},
          "time without pose or observation until the robot brakes");
    visit("goal_tolerance", self.goal_tolerance, kMetresBySize, Range{0.001, 1.0},
          "distance within which the robot counts itself arrived");
    visit("reanchor_distance", self.reanchor_distance, kMetresBySize, Range{0.02, 10.0},
          "distance from the plan beyond which it starts anew at the robot");
    visit("priority", self.priority, "1", Range{0, 1000000},
          "the smaller goes first; among equals the robot with the smaller number");
    ReplanningParameters::visit_fields(self.replanning, visit);
  }
};

}  // namespace spf
