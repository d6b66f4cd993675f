// The planning half of a robot: it owns the RobotAgent, lets nothing to it that an honest sensor, clock or
// peer would not say, makes it brake when what it relies on is missing, and starts it afresh from where the
// robot is after a restart, a relocalisation or a jump of the clock. Where the robot is it is told by a
// Localiser; none means that the robot is moved exactly as it plans. One thread. Frame: world (the fleet's);
// times are the host's [s] and have passed a StepClock.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "host/goal.hpp"
#include "host/health.hpp"
#include "host/localiser.hpp"
#include "host/peer_watch.hpp"
#include "host/recovery.hpp"
#include "host/standing_detector.hpp"
#include "host/watchdog.hpp"
#include "spf/team/robot_agent.hpp"

namespace spf::host {

enum class ObservationVerdict {
  accepted,
  malformed,  ///< times not finite, a scan without sense
  blind,      ///< a scan more than half of whose beams have no reading
  future,
  late,  ///< not newer than the last of its kind, or too old to rely on
};
[[nodiscard]] const char* to_string(ObservationVerdict verdict);

/// The verdict on the finite time of an observation (`timeliness`); `newer` than the last of its kind.
[[nodiscard]] ObservationVerdict time_verdict(double observed, double now, double stale_time,
                                              double clock_error, bool newer);

/// What was sensed, and of what: a list of no obstacles may mean "none there" or "nobody looked".
struct SensedWorld {
  Observation observation;
  bool has_detections = false;
};

struct PlannerOutput {
  bool planned = false;        ///< it was decided what to do in this step; only then the rest is new
  bool asked_planner = false;  ///< for that: not when there was a cause to stop
  TrajectoryMessage plan;      ///< for the robot's own tracker, after every plan
  double observed = 0.0;       ///< [s] when the newest observation behind it was made
  std::optional<HeardMessage> broadcast;  ///< for the peers, when there is something to tell
};

/// How the planner stands: the agent's status, or why there is none.
struct PlannerStatus {
  PeerState state = PeerState::stopped;
  std::string reason;  ///< "moving", "arrived", "no pose", "no scan", "waits for the map", ...
  int blocking_id = -1;
};

struct PlannerCounts {
  std::uint32_t plans = 0;  ///< calls of the planner
  std::uint32_t messages_accepted = 0;
  std::uint32_t messages_malformed = 0;
  std::uint32_t messages_old = 0;
  std::uint32_t messages_crowded = 0;  ///< of more peers than a robot keeps in mind
  std::uint32_t inputs_refused = 0;    ///< observations and goals
  std::uint32_t restarts = 0;          ///< of the agent, the first one among them
};

class PlannerHost {
 public:
  /// `first_sequence` numbers the first message: let it grow from process to process (a clock does), and
  /// peers believe a restarted robot at once. Throws std::invalid_argument on parameters out of range, and on
  /// those that contradict each other (contradictions.hpp).
  PlannerHost(int robot_id, const AgentParameters& agent, const HostParameters& host,
              std::uint32_t first_sequence = 0);

  /// The static map. The robot waits for one, unless it is told that there is none. Another one than before
  /// (a map that is still being made) is planned with from then on; what was sensed is kept.
  void set_map(OccupancyMap map);
  void go_without_map() { needs_map_ = false; }
  /// Starts at once, without waiting to see the robot stand: the caller knows that it stands at this pose,
  /// with nothing unseen around it.
  void start(const OccupancyMap& map, const Pose2& pose_world, double now);

  /// What the Localiser said of a pose: until the agent has started, it is to be seen to stand. After a
  /// relocalisation what was sensed lies where it would, had the robot been there before.
  void note_pose(const PoseMeasurement& pose, PoseVerdict verdict, const Localiser& localiser);
  ObservationVerdict add_observation(const SensedWorld& sensed, double now, const Localiser* localiser);
  MessageVerdict add_message(const HeardMessage& message, double now);
  /// False when it is refused: not finite, or beyond all robots.
  bool set_goal(const Goal& goal);
  void cancel();
  void set_switches(const Switches& switches) { switches_ = switches; }
  /// RobotAgent::reconfigure, also of the agents of later starts. The gates, the watchdog and the controller
  /// keep to the limits that they began with, so max_speed is to be no higher than theirs; the tracker is
  /// told of a lower one (TrackerHost::set_speed_limit). Throws std::invalid_argument as the constructor
  /// does; all then stays as it was.
  void reconfigure(const AgentParameters& agent);
  /// Every candidate of a plan is kept for display from the next start on (allocates).
  void set_keep_candidates(bool keep) { keep_candidates_ = keep; }
  /// Something is wrong with a peer; and so is with one whose message could not even be read.
  void complain(int robot_id, PeerFault fault, const std::string& text, double now) {
    peer_watch_.complain(robot_id, fault, text, now);
  }
  void refuse_message(int robot_id, PeerFault fault, const std::string& why, double now) {
    ++counts_.messages_malformed;
    peer_watch_.complain(robot_id, fault, why, now);
  }
  void count_refused_input() { ++counts_.inputs_refused; }
  /// Everything that was known is forgotten, but for the goal, the map, and what was sensed of it.
  void meet_clock_jump();
  /// Likewise, of a robot that is where its plan says: it starts afresh `now` where it was at `then` [s].
  void restart_where_planned(double then, double now);

  /// A plan is due at agent.team.plan_period, or for an observation that has come (least_plan_interval).
  [[nodiscard]] bool plan_due(double now) const { return agent_ && agent_->plan_due(now); }
  /// Call at the rate of the poses, and where a plan is due; plans then, or at once when something is
  /// missing.
  const PlannerOutput& step(double now, const Localiser* localiser);

  [[nodiscard]] PlannerStatus status() const;
  [[nodiscard]] PlannerCounts counts() const;
  /// What is missing, pauses apart; empty when all is well.
  [[nodiscard]] std::string fault() const;
  /// The robot as its planner knows it: well only while it goes to its goal, has arrived or has none, lacks
  /// nothing, and is at odds with nobody.
  [[nodiscard]] Health health(double now) const;
  [[nodiscard]] const PeerWatch& peer_watch() const { return peer_watch_; }
  [[nodiscard]] const std::optional<Goal>& goal() const { return goal_; }
  /// Null until it has started.
  [[nodiscard]] const RobotAgent* agent() const { return agent_ ? &*agent_ : nullptr; }
  /// The map that is planned with; until it has started the given one, if any.
  [[nodiscard]] const OccupancyMap* map() const { return agent_ ? &agent_->map() : map_ ? &*map_ : nullptr; }
  /// The map that it was told, of which known shapes alone count; null before there is one. Where there is
  /// none to be told, the bounds of what can be sensed.
  [[nodiscard]] const OccupancyMap* given_map() const { return map_ ? &*map_ : nullptr; }
  /// It was stuck, and goes elsewhere before it goes on to its goal.
  [[nodiscard]] bool backs_off() const { return recovery_.aside().has_value(); }
  /// What forced it to stop in the last step.
  [[nodiscard]] StopCause forced_stop() const { return stop_cause_; }
  [[nodiscard]] const AgentParameters& parameters() const { return agent_parameters_; }

 private:
  void forget_agent(const Pose2& correction = {});
  void make_agent(const Pose2& pose_world, double now);
  void start_when_ready(double now, const Localiser& localiser);
  [[nodiscard]] ObservationVerdict judge(const SensedWorld& sensed, double now) const;
  [[nodiscard]] StopCause stop_cause(double now, const Localiser* localiser) const;
  [[nodiscard]] std::optional<Hold> hold(const Localiser* localiser) const;
  void recover(double now, const Localiser& localiser);
  void tell_goal();
  void let_go(double now);
  [[nodiscard]] StateEstimate estimate(double now, const Localiser* localiser) const;
  void plan(double now, const Localiser* localiser);
  void doubt_peers(const Observation& observation, const Pose2& pose_world);
  [[nodiscard]] bool well_formed(const TrajectoryMessage& message) const;

  int robot_id_;
  AgentParameters agent_parameters_;
  HostParameters host_;
  Watchdog watchdog_;
  PeerWatch peer_watch_;
  StandingDetector standing_;
  Recovery recovery_;
  std::optional<OccupancyMap> map_;
  bool needs_map_ = true;
  std::optional<RobotAgent> agent_;
  std::optional<Goal> goal_;
  Switches switches_;
  bool keep_candidates_ = false;

  double last_scan_time_ = kNever;
  double last_detections_time_ = kNever;
  double vouched_time_ = kNever;  // [s] when the caller said that there is nothing unseen
  StopCause stop_cause_ = StopCause::none;
  struct {
    std::uint32_t before;        // the agent began
    std::uint32_t of_agent = 0;  // of its last message
  } sequence_;
  PlannerCounts counts_;
  PlannerOutput output_;
};

}  // namespace spf::host
