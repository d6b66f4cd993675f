#include "host/perception_host.hpp"

#include <cmath>

#include "host/scan_check.hpp"

namespace spf::host {

PerceptionHost::PerceptionHost(const AgentParameters& agent, const HostParameters& host)
    : stale_time_{validated(agent).team.stale_time},
      clock_error_{validated(host).clock_error},
      clock_{host.clock_jump} {}

void PerceptionHost::meet_clock_jump() {
  scan_time_ = kNever;
  detections_time_ = kNever;
}

ObservationVerdict PerceptionHost::judge(double time, double last, double now) const {
  if (!std::isfinite(time)) return ObservationVerdict::malformed;
  return time_verdict(time, now, stale_time_, clock_error_, time > last);
}

bool PerceptionHost::refuse(ObservationVerdict verdict) {
  verdict_ = verdict;
  if (verdict == ObservationVerdict::accepted) return false;
  ++refused_;
  return true;
}

std::optional<SensedWorld> PerceptionHost::add_scan(double time, const RangeScan& scan,
                                                    const Pose2& sensor_in_body, double now) {
  if (clock_.jumped(now)) meet_clock_jump();
  const bool makes_sense = sensible(scan) && sensible(sensor_in_body) && !blind(scan);
  if (refuse(makes_sense ? judge(time, scan_time_, clock_.now()) : ObservationVerdict::malformed)) return {};
  scan_time_ = time;
  SensedWorld sensed;
  sensed.observation.time = time;
  sensed.observation.scan = seen_from_centre(scan, sensor_in_body);
  return sensed;
}

std::optional<SensedWorld> PerceptionHost::add_detections(double time, const std::vector<Detection>& seen,
                                                          double now) {
  if (clock_.jumped(now)) meet_clock_jump();
  if (refuse(sensible(seen) ? judge(time, detections_time_, clock_.now()) : ObservationVerdict::malformed))
    return {};
  detections_time_ = time;
  SensedWorld sensed;
  sensed.observation.time = time;
  sensed.observation.detections = seen;
  sensed.has_detections = true;
  return sensed;
}

}  // namespace spf::host
