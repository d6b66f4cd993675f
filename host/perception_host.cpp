#include "host/perception_host.hpp"

#include <cmath>

#include "host/scan_check.hpp"
#include "host/sensed_map.hpp"

namespace spf::host {
namespace {

constexpr double kExplained = 0.5;  // [radii of the robot] beyond a tracked disc: returns there are its own

}  // namespace

PerceptionHost::PerceptionHost(const AgentParameters& agent, const HostParameters& host)
    : agent_{validated(agent)},
      host_{validated(host)},
      gate_{host_, agent_.robot},
      clock_{host_.clock_jump},
      tracker_{agent_.obstacles},
      scan_time_{kNever},
      detections_time_{kNever} {}

void PerceptionHost::meet_clock_jump() {
  gate_.reset();
  tracker_ = ObstacleTracker{agent_.obstacles};
  scan_time_ = kNever;
  detections_time_ = kNever;
}

PoseVerdict PerceptionHost::add_pose(const PoseMeasurement& pose, double now) {
  if (clock_.jumped(now)) meet_clock_jump();
  const PoseVerdict verdict = gate_.judge(pose, clock_.now());
  if (!believed(verdict)) ++refused_;
  return verdict;
}

ObservationVerdict PerceptionHost::judge(double time, double last, double now) const {
  if (!std::isfinite(time)) return ObservationVerdict::malformed;
  if (time > now + host_.clock_error) return ObservationVerdict::future;
  if (time <= last || now - time > agent_.team.stale_time) return ObservationVerdict::late;
  return ObservationVerdict::accepted;
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
  if (gate_.last()) {
    const Pose2& here = gate_.last()->pose_world;
    if (!map_) map_ = sensed_map(here.position_world, host_, agent_.occupancy);
    std::vector<IgnoredDisc> explained;
    for (const ObstacleTrack& track : tracker_.tracks())
      explained.push_back({track.state.position_world + (time - track.time) * track.state.velocity_world,
                           track.state.radius + kExplained * agent_.robot.radius});
    map_->integrate(*sensed.observation.scan, here, explained);
  }
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
  tracker_.update(sensed.observation);
  return sensed;
}

}  // namespace spf::host
