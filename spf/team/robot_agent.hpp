// What a robot decides: from what it sees and hears, where it is and whether it has to stop, to the
// trajectory that it is committed to and what it tells its peers. It plans; who measures its pose, drives its
// wheels and watches over both composes it with a localiser and a controller (host/robot_host.hpp).
#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "spf/localisation/observer.hpp"
#include "spf/planning/planner.hpp"
#include "spf/team/agent_parameters.hpp"
#include "spf/team/agent_status.hpp"
#include "spf/world/heard_message.hpp"
#include "spf/world/observation.hpp"
#include "spf/world/occupancy_map.hpp"
#include "spf/world/peer_table.hpp"

namespace spf {

/// Times [s] must not go back. Frame: world.
class RobotAgent {
 public:
  /// `map` is the known static map (or an empty one of the right frame when the map is to be sensed). It
  /// stands at `start` from `time` on. Throws std::invalid_argument when parameters are out of range.
  RobotAgent(int robot_id, const AgentParameters& parameters, const OccupancyMap& map, const Pose2& start,
             double time);
  ~RobotAgent();
  RobotAgent(RobotAgent&&) noexcept;
  RobotAgent& operator=(RobotAgent&&) noexcept;

  /// Throws std::invalid_argument when the goal is not finite.
  void set_goal(const Eigen::Vector2d& goal_world, std::optional<double> goal_heading = std::nullopt);
  void clear_goal();
  /// Another static map than before: plans go on in it, and what was sensed is kept.
  void set_map(OccupancyMap map);
  /// Other parameters to plan by, from the next plan on: the robot's limits, heading mode, goal tolerance,
  /// priority, and what planner and guide take. Rates, and what map, tracks and peers take, stay as they
  /// were. A plan under way that was made for a higher max_speed is not gone on with: the next one slows down
  /// within max_acceleration, or the robot brakes. Throws std::invalid_argument when parameters are out of
  /// range.
  void reconfigure(const AgentParameters& parameters);
  /// Keep every candidate in last_plan(), for display (allocates).
  void set_keep_candidates(bool keep);
  /// Peers (sorted) whose discs mask no scan returns, since they are not where they say: what is seen there
  /// is static. They are kept away from as before. Replaces the ones named before.
  void set_distrusted(std::vector<int> robot_ids);

  /// A message of a peer, heard now.
  MessageVerdict hear(const HeardMessage& message, double now);
  /// What was seen, from where: without a pose its scan tells nothing. Ignored when it does not tell about
  /// the present (`timeliness`, spf/team/schedule.hpp).
  void observe(const Observation& observation, const std::optional<Pose2>& pose_world, double now);

  /// At least every plan_period, and a little later after a plan that plan_soon() has brought forward.
  [[nodiscard]] bool plan_due(double now) const;
  /// What was observed by now is not to wait for the period: a plan is due at once, but not within
  /// `least_interval` [s] of the last one of this kind. With an interval of plan_period or more the period
  /// alone counts.
  void plan_soon(double now, double least_interval);
  /// Plans and commits, or brakes where there is a cause to stop that no plan can mend; returns the message
  /// to broadcast when there is one. `state` is where the robot is now; one that is not valid says nothing,
  /// and the plan goes on from the trajectory under way. A robot that is held plans from where it is.
  std::optional<TrajectoryMessage> plan(double now, const StateEstimate& state,
                                        StopCause stop = StopCause::none,
                                        const std::optional<Hold>& hold = std::nullopt);

  [[nodiscard]] int robot_id() const;
  [[nodiscard]] const AgentParameters& parameters() const;
  /// What the planner returned when it was last asked.
  [[nodiscard]] const PlanResult& last_plan() const;
  /// Why the last call of plan() did not ask the planner; `none` when it did.
  [[nodiscard]] StopCause stop_cause() const;
  /// The trajectory under way (never empty: standing at the start before the first plan).
  [[nodiscard]] const Trajectory& committed() const;
  /// As of the last plan.
  [[nodiscard]] AgentStatus status() const;
  /// How the map lets it come to its goal, as of the last plan; none before there was one for this goal.
  [[nodiscard]] std::optional<GoalAccess> goal_access() const;
  [[nodiscard]] const OccupancyMap& map() const;
  [[nodiscard]] const std::vector<ObstacleTrack>& tracks() const;
  [[nodiscard]] const std::vector<Peer>& peers() const;
  /// How many messages of peers got this verdict.
  [[nodiscard]] std::uint64_t message_count(MessageVerdict verdict) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace spf
