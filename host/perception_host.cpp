#include "host/perception_host.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "host/scan_check.hpp"

namespace spf::host {
namespace {

constexpr double kSmoothing = 0.1;  // [1] of the newest age of a scan
constexpr double kSpareForScans =
    0.9;  // [1] of the time after which a scan is stale: it would brake now and then

}  // namespace

PerceptionHost::PerceptionHost(const AgentParameters& agent, const HostParameters& host)
    : stale_time_{validated(agent).team.stale_time},
      host_{validated(host)},
      drive_{agent.robot},
      clock_{host.clock_jump} {}

void PerceptionHost::meet_clock_jump() {
  scan_time_ = kNever;
  detections_time_ = kNever;
  motion_time_ = kNever;
}

ObservationVerdict PerceptionHost::judge(double time, double last, double now) const {
  if (!std::isfinite(time)) return ObservationVerdict::malformed;
  return time_verdict(time, now, stale_time_, host_.clock_error, time > last);
}

ObservationVerdict PerceptionHost::judge(const DriverScan& scan) const {
  if (!sensible(scan.scan) || !sensible(scan.mount.in_body) || !std::isfinite(scan.min_range) ||
      !std::isfinite(scan.duration))
    return ObservationVerdict::malformed;
  return blind_share_ > kHalfBlind ? ObservationVerdict::blind : ObservationVerdict::accepted;
}

bool PerceptionHost::refuse(ObservationVerdict verdict) {
  verdict_ = verdict;
  if (verdict == ObservationVerdict::accepted) return false;
  ++refused_;
  refusal_ = to_string(verdict);
  if (verdict == ObservationVerdict::blind)
    refusal_ += ": " + std::to_string(std::lround(100.0 * blind_share_)) +
                " % of its beams have no reading (host.no_return: which readings mean \"nothing there\")";
  return true;
}

std::optional<SensedWorld> PerceptionHost::add_scan(double time, DriverScan scan, double now) {
  if (clock_.jumped(now)) meet_clock_jump();
  make_plain(scan, host_.no_return);
  blind_share_ = host::blind_share(scan.scan);
  ObservationVerdict verdict = judge(scan);
  if (verdict == ObservationVerdict::accepted) verdict = judge(time, scan_time_, clock_.now());
  if (refuse(verdict)) return {};
  if (scan_time_ != kNever) {
    const double oldest = std::min(clock_.now() - scan_time_, 2.0 * stale_time_);
    oldest_scan_ += kSmoothing * (oldest - oldest_scan_);
  }
  scan_time_ = time;
  const bool moves = time - motion_time_ <= host_.command_silence;
  SensedWorld sensed;
  sensed.observation.time = time;
  sensed.observation.scan = seen_from_centre(scan, moves ? motion_ : BodyMotion{});
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

void PerceptionHost::applied(double time, const DriveInput& wheel_speeds) {
  if (!std::isfinite(time) || wheel_speeds.size() != drive_.inputs() || !wheel_speeds.allFinite()) return;
  const Eigen::Vector3d twist = drive_.twist_body(wheel_speeds);
  motion_ = {twist.head<2>(), twist.z()};
  motion_time_ = time;
}

Health PerceptionHost::health(double now) const {
  Health health;
  if (host_.relies_on_scan && scan_age(now) > stale_time_) worsen(health, Level::error, "no scan");
  if (host_.relies_on_obstacles && detections_age(now) > stale_time_)
    worsen(health, Level::error, "no report of obstacles");
  if (health.text.empty()) health.text = "sensing";
  if (host_.relies_on_scan && oldest_scan_ > kSpareForScans * stale_time_) {
    char text[128];
    std::snprintf(text, sizeof text,
                  "scans grow %.2f s old before the next comes: agent.team.stale_time is %.2f s",
                  oldest_scan_, stale_time_);
    worsen(health, Level::warn, text);
  }
  return health;
}

}  // namespace spf::host
