// The sensing half of a robot behind one door: scans and reports of obstacles in, observations for the
// planner out. It also keeps the map and the tracks that follow from them, for people to look at. One thread.
// Frame: world (the fleet's) but for scans; times are the host's [s].
#pragma once

#include <cstdint>
#include <optional>

#include "host/planner_host.hpp"
#include "host/pose_gate.hpp"
#include "host/step_clock.hpp"
#include "spf/team/agent_parameters.hpp"
#include "spf/world/obstacle_tracker.hpp"
#include "spf/world/occupancy_map.hpp"

namespace spf::host {

class PerceptionHost {
 public:
  /// Throws std::invalid_argument on parameters out of range.
  PerceptionHost(const AgentParameters& agent, const HostParameters& host);

  void set_map(const OccupancyMap& map) { map_ = map; }
  PoseVerdict add_pose(const PoseMeasurement& pose, double now);
  /// What the planner is to learn from it; nothing when it is refused (last_verdict() says why).
  [[nodiscard]] std::optional<SensedWorld> add_scan(double time, const RangeScan& scan,
                                                    const Pose2& sensor_in_body, double now);
  [[nodiscard]] std::optional<SensedWorld> add_detections(double time, const std::vector<Detection>& seen,
                                                          double now);

  [[nodiscard]] ObservationVerdict last_verdict() const { return verdict_; }
  [[nodiscard]] std::uint32_t refused() const { return refused_; }
  [[nodiscard]] double pose_age(double now) const { return gate_.age(now); }  ///< [s] infinite without one
  [[nodiscard]] double scan_age(double now) const { return now - scan_time_; }
  [[nodiscard]] double detections_age(double now) const { return now - detections_time_; }
  /// Null without a map or a pose around which to begin one.
  [[nodiscard]] const OccupancyMap* map() const { return map_ ? &*map_ : nullptr; }
  [[nodiscard]] const ObstacleTracker& tracker() const { return tracker_; }
  [[nodiscard]] const std::optional<PoseMeasurement>& pose() const { return gate_.last(); }

 private:
  [[nodiscard]] ObservationVerdict judge(double time, double last, double now) const;
  bool refuse(ObservationVerdict verdict);
  void meet_clock_jump();

  AgentParameters agent_;
  HostParameters host_;
  PoseGate gate_;
  StepClock clock_;
  ObstacleTracker tracker_;
  std::optional<OccupancyMap> map_;
  double scan_time_;
  double detections_time_;
  ObservationVerdict verdict_ = ObservationVerdict::accepted;
  std::uint32_t refused_ = 0;
};

}  // namespace spf::host
