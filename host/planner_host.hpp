// The planning half of a robot behind one door: it owns the RobotAgent, lets nothing to it that an honest
// sensor, clock or peer would not say, makes it brake when what it relies on is missing, and starts it afresh
// from where the robot is after a restart, a relocalisation or a jump of the clock. One thread. Frame: world
// (the fleet's); times are the host's [s].
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "host/peer_witness.hpp"
#include "host/pose_gate.hpp"
#include "host/step_clock.hpp"
#include "spf/team/robot_agent.hpp"

namespace spf::host {

enum class ObservationVerdict {
  accepted,
  malformed,  ///< times not finite, a scan without sense
  future,
  late,  ///< not newer than the last of its kind, or too old to rely on
};
[[nodiscard]] const char* to_string(ObservationVerdict verdict);

/// What was sensed, and of what: a list of no obstacles may mean "none there" or "nobody looked".
struct SensedWorld {
  Observation observation;
  bool has_detections = false;
};

struct Goal {
  Eigen::Vector2d position_world = Eigen::Vector2d::Zero();  ///< [m]
  std::optional<double> heading;                             ///< [rad] any without
};

struct PlannerOutput {
  bool planned = false;                        ///< in this step; only then the rest is new
  TrajectoryMessage plan;                      ///< for the robot's own tracker, after every plan
  double observed = 0.0;                       ///< [s] when the newest observation behind it was made
  std::optional<TrajectoryMessage> broadcast;  ///< for the peers, when there is something to tell
};

/// How the planner stands: the agent's status, or why there is none.
struct PlannerStatus {
  PeerState state = PeerState::stopped;
  std::string reason;  ///< "moving", "arrived", "no pose", "no scan", "waits for the map", ...
  int culprit = -1;
};

struct PlannerCounts {
  std::uint32_t plans = 0;
  std::uint32_t messages_accepted = 0;
  std::uint32_t messages_malformed = 0;
  std::uint32_t messages_old = 0;
  std::uint32_t messages_crowded = 0;  ///< of more peers than a robot keeps in mind
  std::uint32_t inputs_refused = 0;
  std::uint32_t restarts = 0;  ///< of the agent, the first one among them
};

class PlannerHost {
 public:
  /// `first_sequence` numbers the first message: let it grow from process to process (a clock does), and
  /// peers believe a restarted robot at once. Throws std::invalid_argument on parameters out of range.
  PlannerHost(int robot_id, const AgentParameters& agent, const HostParameters& host,
              std::uint32_t first_sequence = 0);

  /// The static map. The robot waits for one, unless it is told that there is none.
  void set_map(OccupancyMap map);
  void go_without_map() { needs_map_ = false; }

  PoseVerdict add_pose(const PoseMeasurement& pose, double now);
  ObservationVerdict add_observation(SensedWorld sensed, double now);
  MessageVerdict add_message(const TrajectoryMessage& message, double now);
  /// False when it is refused: not finite, or beyond all robots.
  bool set_goal(const Goal& goal);
  void cancel();
  void set_paused(bool paused) { paused_ = paused; }
  void set_emergency_stop(bool stop) { emergency_stop_ = stop; }
  /// The host could not even read something.
  void count_malformed_message() { ++counts_.messages_malformed; }
  void count_refused_input() { ++counts_.inputs_refused; }

  /// Call at the rate of the poses; plans when one is due, or at once when something is missing.
  const PlannerOutput& step(double now);

  [[nodiscard]] PlannerStatus status() const;
  [[nodiscard]] PlannerCounts counts() const;
  /// What is missing, pauses apart; empty when all is well.
  [[nodiscard]] std::string fault() const;
  [[nodiscard]] std::uint32_t clock_jumps() const { return clock_.count(); }
  [[nodiscard]] const std::optional<Goal>& goal() const { return goal_; }
  /// Null until it has started.
  [[nodiscard]] const RobotAgent* agent() const { return agent_ ? &*agent_ : nullptr; }
  [[nodiscard]] const AgentParameters& parameters() const { return agent_parameters_; }

 private:
  void meet_clock_jump();
  void forget_agent();
  void start_when_ready(double now);
  [[nodiscard]] bool stands(double now) const;
  [[nodiscard]] std::string hindrance(double now) const;
  void plan(double now);
  void doubt_peers(const Observation& observation);
  [[nodiscard]] bool well_formed(const TrajectoryMessage& message) const;

  int robot_id_;
  AgentParameters agent_parameters_;
  HostParameters host_;
  PoseGate gate_;
  StepClock clock_;
  PeerWitness witness_;
  std::optional<OccupancyMap> map_;
  bool needs_map_ = true;
  std::optional<RobotAgent> agent_;
  std::optional<Goal> goal_;
  bool paused_ = false;
  bool emergency_stop_ = false;

  AgentInput input_;                           // since the last step
  std::vector<PoseMeasurement> recent_poses_;  // before the start, to see whether the robot stands
  std::optional<double> first_pose_time_;      // [s] since it was forgotten
  double last_scan_time_;
  double last_detections_time_;
  std::string hindrance_;  // why the agent is made to stand, empty when it is not
  std::uint32_t sequence_;
  std::uint32_t agent_sequence_ = 0;
  PlannerCounts counts_;
  PlannerOutput output_;
};

}  // namespace spf::host
