// The one place that decides whether a robot has to stop for want of something, and for what first: planner
// and controller ask it alike, each with the facts that it knows.
#pragma once

#include "host/host_parameters.hpp"
#include "spf/team/agent_status.hpp"

namespace spf::host {

/// What is looked at. A fact that somebody does not know, or need not mind, stays as it is here: all well.
/// Ages are infinite where there was none yet.
struct WatchFacts {
  bool emergency_stop = false;
  bool paused = false;
  bool clock_jumped = false;       ///< and nothing is known in the new time yet
  double pose_age = 0.0;           ///< [s]
  double localisation_age = 0.0;   ///< [s] of the transform that places the poses
  double scan_age = 0.0;           ///< [s]
  double obstacles_age = 0.0;      ///< [s] of the report of moving obstacles
  double plan_age = 0.0;           ///< [s]
  bool stuck = false;              ///< does not move as it is told, or gets no farther
  double plan_error = 0.0;         ///< [m] between the robot and its plan
  bool controller_failed = false;  ///< had no answer
};

/// What people switch.
struct Switches {
  bool emergency_stop = false;
  bool paused = false;
};

class Watchdog {
 public:
  /// `stale_time` [s] is that of TeamParameters.
  Watchdog(const HostParameters& host, double stale_time)
      : stale_time_{stale_time},
        plan_silence_{host.plan_silence},
        largest_plan_error_{host.largest_plan_error} {}

  /// The gravest cause to stop; `none` when all is well.
  [[nodiscard]] StopCause watch(const WatchFacts& facts) const;
  /// Whether the robot is too far from what it follows [m] to be led back. NaN is far.
  [[nodiscard]] bool far(double error) const { return !(error <= largest_plan_error_); }

 private:
  double stale_time_;          // [s]
  double plan_silence_;        // [s]
  double largest_plan_error_;  // [m]
};

}  // namespace spf::host
