// The last resort of the paper's planner: when no plan is found and standing (or braking) would be run into,
// the short sidestep that stays clear longest. Frame: world.
#pragma once

#include "spf/planning/clearance.hpp"
#include "spf/robot/robot_parameters.hpp"
#include "spf/trajectory/trajectory.hpp"

namespace spf {

struct EmergencyManoeuvre {
  Trajectory trajectory;        ///< ends standing
  ClearanceReport report;       ///< of that trajectory, up to `until`
  bool sidestep = false;        ///< false: braking is the best there is
  double time_in_fields = 0.0;  ///< [s] until it is out of the danger regions for good
};

/// Braking and 16 sidesteps (half a second towards a velocity of full or half speed, then braking), all
/// within the limits. The clear one with the largest clearance wins, braking at equal clearance; when none is
/// clear, the one whose first conflict is latest; a sidestep into a static surface is never taken. From a
/// place in a danger region, where nothing is clear and standing is to wait for the obstacle, the way that
/// is out of the regions first wins, and among those that are not out in time the one that ends farthest
/// out, as long as no peer is touched; sidesteps of a second count there too. `model` is prepared for the
/// present; conflicts are looked for until the absolute time `until` [s].
[[nodiscard]] EmergencyManoeuvre best_emergency_manoeuvre(const FlatState& head, const HeadingState& heading,
                                                          double time, double until,
                                                          const ClearanceModel& model,
                                                          const RobotParameters& robot);

}  // namespace spf
