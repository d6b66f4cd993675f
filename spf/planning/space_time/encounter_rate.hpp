// How crowded it is: how often a robot that drove on without looking would touch something that moves. In the
// open, risk is best waited out. In a crowd to wait is no safer than to go on, since people keep coming, and
// who prices every risk ahead as if it would pass never gets through; so there the price of risk falls.
#pragma once

#include <Eigen/Core>

#include "spf/planning/planner.hpp"

namespace spf {

/// The encounter rate of the kinetic theory of gases in the plane, sum_i 2 R_i hypot(v, v_i) / area, with R_i
/// the sum of both radii, over the part of a disc around the robot that it sees: what hides behind others
/// counts neither as moving nor as free. Averaged over some seconds. Never allocates.
class EncounterRate {
 public:
  /// `range` [m]: how far around the robot; `memory` [s]: time constant of the average.
  EncounterRate(double robot_radius, double max_speed, double range, double memory);

  /// Takes in what is seen at the request's time; tracks that stand do not count.
  void update(const PlanRequest& request);
  [[nodiscard]] double per_second() const { return rate_; }

 private:
  double robot_radius_;  // [m]
  double max_speed_;     // [m/s]
  double range_;         // [m]
  double memory_;        // [s]
  double rate_ = 0.0;    // [1/s]
  double time_ = 0.0;    // [s] of the last update
};

}  // namespace spf
