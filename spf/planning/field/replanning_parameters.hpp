// When the paper's planner runs again, and what is done when it finds nothing.
#pragma once

#include "spf/math/parameters.hpp"

namespace spf {

struct ReplanningParameters {
  double replan_period = 1.0;   ///< [s] a plan is renewed at least this often
  double emergency_time = 1.0;  ///< [s] predicted contact sooner than this (or than braking takes): brake
  bool retreat = true;  ///< step aside when no plan is found and something would run into the stopped robot

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit("replan_period", self.replan_period, "s", Range{0.05, 10.0},
          "a plan of the paper's planner is renewed at least this often");
    visit("emergency_time", self.emergency_time, "s", Range{0.0, 10.0},
          "a predicted contact sooner than this makes the robot brake when it finds no plan");
    visit("retreat", self.retreat,
          "step aside when no plan is found and something would run into the stopped robot");
  }
};

}  // namespace spf
