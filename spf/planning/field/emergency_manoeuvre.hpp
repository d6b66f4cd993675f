// Last resort of the paper's planner, for when no plan is found and something would run into the stopping
// robot: the short sidestep that stays clear longest. Frame: world.
#pragma once

#include "spf/planning/clearance.hpp"
#include "spf/robot/robot_parameters.hpp"
#include "spf/trajectory/trajectory.hpp"

namespace spf {

struct EmergencyManoeuvre {
  Trajectory trajectory;        ///< ends at rest
  ClearanceReport report;       ///< of that trajectory, up to `until`
  bool sidestep = false;        ///< false: braking is the best
  double time_in_fields = 0.0;  ///< [s] until it has left the danger regions for good
};

/// Best of braking and sidesteps in 16 directions (half a second towards a velocity of full or half speed,
/// then braking), all within the limits. Sidesteps into static surfaces are excluded. Outside danger regions:
/// clear ones before others; of these the one with the largest clearance, braking at equal clearance; if none
/// is clear, the one whose first conflict is latest. Inside a danger region, where stopping means waiting for
/// the obstacle, the regions are no conflict, sidesteps of a second are tried too, and among the clear ones
/// those that lead out win, then the one that leaves the regions first, then the one that ends farthest
/// outside. `model` is prepared for the present; conflicts are searched up to the absolute time `until` [s].
[[nodiscard]] EmergencyManoeuvre best_emergency_manoeuvre(const FlatState& head, const HeadingState& heading,
                                                          double time, double until,
                                                          const ClearanceModel& model,
                                                          const RobotParameters& robot);

}  // namespace spf
