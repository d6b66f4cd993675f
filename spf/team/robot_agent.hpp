// The whole robot behind one door: what it senses and hears goes in, wheel speeds and its broadcast come out.
// The simulator and the ROS nodes are two hosts of it, so "simulated or real" is a choice of host and nothing
// else.
#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "spf/planning/planner.hpp"
#include "spf/team/agent_parameters.hpp"
#include "spf/team/agent_status.hpp"
#include "spf/world/heard_message.hpp"
#include "spf/world/observation.hpp"
#include "spf/world/occupancy_map.hpp"
#include "spf/world/peer_table.hpp"

namespace spf {

/// What arrived since the last step; empty members mean "nothing new".
struct AgentInput {
  std::vector<PoseMeasurement> poses;
  std::optional<Observation> observation;
  std::vector<HeardMessage> messages;
};

/// Where the agent takes its own position from. Not a parameter: the host knows how it moves the robot.
enum class StateSource {
  measured,    ///< from pose measurements, by its observer
  as_planned,  ///< the host moves the robot exactly as planned: it is where its plan says, and needs no poses
};

struct AgentOutput {
  bool planned = false;     ///< a plan was made in this step: see RobotAgent::last_plan()
  bool controlled = false;  ///< `wheel_speeds` was renewed in this step
  Eigen::Vector3d wheel_speeds = Eigen::Vector3d::Zero();  ///< [m/s] rim speeds, held until the next
  std::optional<TrajectoryMessage> broadcast;
};

class RobotAgent {
 public:
  /// `map` is the known static map (or an empty one of the right frame when the map is to be sensed), `time`
  /// [s] the present. Throws std::invalid_argument when parameters are out of range.
  RobotAgent(int robot_id, const AgentParameters& parameters, const OccupancyMap& map, const Pose2& start,
             double time, StateSource source = StateSource::measured);
  ~RobotAgent();
  RobotAgent(RobotAgent&&) noexcept;
  RobotAgent& operator=(RobotAgent&&) noexcept;

  /// Throws std::invalid_argument when the goal is not finite.
  void set_goal(const Eigen::Vector2d& goal_world, std::optional<double> goal_heading = std::nullopt);
  void clear_goal();
  void set_paused(bool paused);
  /// Keep every candidate in last_plan(), for display (allocates).
  void set_keep_candidates(bool keep);
  /// Peers (sorted) whose discs mask no scan returns, since they are not where they say: what is seen there
  /// is static. They are kept away from as before. Replaces the ones named before.
  void set_distrusted(std::vector<int> robot_ids);

  /// The sequential form: receive, then plan and track where due. Call it at the rate of the pose
  /// measurements or faster; plans and control ticks happen at their own rates (AgentParameters). Times must
  /// not go back.
  AgentOutput step(double time, const AgentInput& input);

  // The halves of step(), for hosts that time them or run them on threads of their own.
  void receive(double time, const AgentInput& input);
  [[nodiscard]] bool plan_due(double time) const;
  [[nodiscard]] bool control_due(double time) const;
  /// Plans and commits; returns the message to broadcast when there is one.
  std::optional<TrajectoryMessage> plan(double time);
  /// One control tick; returns the rim speeds of the wheels [m/s], to be held until the next.
  Eigen::Vector3d track(double time);

  [[nodiscard]] int robot_id() const;
  [[nodiscard]] const AgentParameters& parameters() const;
  [[nodiscard]] const PlanResult& last_plan() const;
  /// The trajectory under way (never empty: standing at the start before the first plan).
  [[nodiscard]] const Trajectory& committed() const;
  [[nodiscard]] AgentEstimate estimate() const;
  [[nodiscard]] AgentStatus status() const;
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
