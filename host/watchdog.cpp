#include "host/watchdog.hpp"

#include <cmath>

namespace spf::host {

StopCause Watchdog::watch(const WatchFacts& facts) const {
  if (facts.emergency_stop) return StopCause::emergency_stop;
  if (facts.paused) return StopCause::paused;
  if (facts.clock_jumped) return StopCause::clock_jump;
  if (std::isinf(facts.pose_age)) return StopCause::no_pose;
  if (facts.pose_age > stale_time_) return StopCause::stale_pose;
  if (facts.localisation_age > stale_time_) return StopCause::stale_localisation;
  if (facts.scan_age > stale_time_) return StopCause::no_scan;
  if (facts.obstacles_age > stale_time_) return StopCause::no_obstacles;
  if (std::isinf(facts.plan_age)) return StopCause::no_plan;
  if (facts.plan_age > plan_silence_) return StopCause::stale_plan;
  if (facts.stuck) return StopCause::stuck;
  if (far(facts.plan_error)) return StopCause::far_from_plan;
  if (facts.controller_failed) return StopCause::control_failed;
  return StopCause::none;
}

}  // namespace spf::host
