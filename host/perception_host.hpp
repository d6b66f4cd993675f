// The sensing part of a robot behind one door: scans and reports of obstacles in, observations for the
// planner out. It keeps no map and no tracks: those are the planner's, for people too. One thread. Frame:
// world (the fleet's) but for scans; times are the host's [s].
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "host/driver_scan.hpp"
#include "host/health.hpp"
#include "host/planner_host.hpp"
#include "host/step_clock.hpp"
#include "spf/robot/drive.hpp"
#include "spf/team/agent_parameters.hpp"

namespace spf::host {

class PerceptionHost {
 public:
  /// Throws std::invalid_argument on parameters out of range.
  PerceptionHost(const AgentParameters& agent, const HostParameters& host);

  /// What the planner is to learn from it; nothing when it is refused (last_verdict() and last_refusal() say
  /// why). `time` is that of the first beam.
  [[nodiscard]] std::optional<SensedWorld> add_scan(double time, DriverScan scan, double now);
  [[nodiscard]] std::optional<SensedWorld> add_detections(double time, const std::vector<Detection>& seen,
                                                          double now);
  /// Rim speeds [m/s] that the motors are told from a time on: how the robot moves while a scan is made.
  [[nodiscard]] int drive_inputs() const { return drive_.inputs(); }
  void applied(double time, const DriveInput& wheel_speeds);

  [[nodiscard]] ObservationVerdict last_verdict() const { return verdict_; }
  [[nodiscard]] const std::string& last_refusal() const { return refusal_; }
  [[nodiscard]] std::uint32_t refused() const { return refused_; }
  [[nodiscard]] double scan_age(double now) const { return now - scan_time_; }  ///< [s] infinite without one
  [[nodiscard]] double detections_age(double now) const { return now - detections_time_; }
  /// Share of the last scan's beams without a reading, in [0, 1].
  [[nodiscard]] double blind_share() const { return blind_share_; }
  /// Well while everything is fresh that the robot relies on.
  [[nodiscard]] Health health(double now) const;

 private:
  [[nodiscard]] ObservationVerdict judge(double time, double last, double now) const;
  [[nodiscard]] ObservationVerdict judge(const DriverScan& scan) const;
  bool refuse(ObservationVerdict verdict);
  void meet_clock_jump();

  double stale_time_;  // [s]
  HostParameters host_;
  Drive drive_;
  StepClock clock_;
  double scan_time_ = kNever;
  double detections_time_ = kNever;
  double oldest_scan_ = 0.0;  // [s] age that a scan reaches before the next one comes, smoothed
  double blind_share_ = 0.0;
  BodyMotion motion_;
  double motion_time_ = kNever;  // [s]
  ObservationVerdict verdict_ = ObservationVerdict::accepted;
  std::string refusal_;
  std::uint32_t refused_ = 0;
};

}  // namespace spf::host
