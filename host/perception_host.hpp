// The sensing part of a robot behind one door: scans and reports of obstacles in, observations for the
// planner out. It keeps no map and no tracks: those are the planner's, for people too. One thread. Frame:
// world (the fleet's) but for scans; times are the host's [s].
#pragma once

#include <cstdint>
#include <optional>

#include "host/planner_host.hpp"
#include "host/step_clock.hpp"
#include "spf/team/agent_parameters.hpp"

namespace spf::host {

class PerceptionHost {
 public:
  /// Throws std::invalid_argument on parameters out of range.
  PerceptionHost(const AgentParameters& agent, const HostParameters& host);

  /// What the planner is to learn from it; nothing when it is refused (last_verdict() says why).
  [[nodiscard]] std::optional<SensedWorld> add_scan(double time, const RangeScan& scan,
                                                    const Pose2& sensor_in_body, double now);
  [[nodiscard]] std::optional<SensedWorld> add_detections(double time, const std::vector<Detection>& seen,
                                                          double now);

  [[nodiscard]] ObservationVerdict last_verdict() const { return verdict_; }
  [[nodiscard]] std::uint32_t refused() const { return refused_; }
  [[nodiscard]] double scan_age(double now) const { return now - scan_time_; }  ///< [s] infinite without one
  [[nodiscard]] double detections_age(double now) const { return now - detections_time_; }

 private:
  [[nodiscard]] ObservationVerdict judge(double time, double last, double now) const;
  bool refuse(ObservationVerdict verdict);
  void meet_clock_jump();

  double stale_time_;   // [s]
  double clock_error_;  // [s]
  StepClock clock_;
  double scan_time_ = kNever;
  double detections_time_ = kNever;
  ObservationVerdict verdict_ = ObservationVerdict::accepted;
  std::uint32_t refused_ = 0;
};

}  // namespace spf::host
