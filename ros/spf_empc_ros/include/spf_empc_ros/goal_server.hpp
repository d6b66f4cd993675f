// The robot's goals on ROS: the action `move_base` and the topics `goal` and `cancel`. There is one goal at a
// time, and a newer one replaces it. What becomes of it is host::GoalSupervisor's word; here it is told to
// whoever sent it. A goal outlives the process (GoalMemory).
#pragma once

#include <actionlib/server/action_server.h>
#include <geometry_msgs/PoseStamped.h>
#include <move_base_msgs/MoveBaseAction.h>
#include <ros/message_event.h>
#include <ros/node_handle.h>
#include <ros/subscriber.h>
#include <std_msgs/Empty.h>

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "host/goal_supervisor.hpp"
#include "host/split_host.hpp"
#include "spf_empc_ros/frames.hpp"
#include "spf_empc_ros/goal_memory.hpp"
#include "spf_empc_ros/robot_config.hpp"

namespace spf_empc_ros {

class GoalServer {
 public:
  /// Told of goals that are refused: what, and why.
  using Refuse = std::function<void(const char* what, const std::string& why)>;

  /// `node` is in the robot's namespace, `own` its private one. All that is referred to must outlive it.
  GoalServer(ros::NodeHandle node, const ros::NodeHandle& own, const RobotConfig& config,
             spf::host::PlannerProcess& host, const Frames& frames, ParameterStore& store, Refuse refuse);
  GoalServer(const GoalServer&) = delete;
  GoalServer& operator=(const GoalServer&) = delete;

  /// Tolerances at once, the timeout for the goals to come.
  void reconfigure(const spf::AgentParameters& agent, const spf::host::HostParameters& host);
  /// After every step of the planner, at the same time [s].
  void step(double now);

  [[nodiscard]] spf::host::GoalOutcome outcome() const { return supervisor_.outcome(); }

 private:
  using ActionSpec = move_base_msgs::MoveBaseAction;
  using Handle = actionlib::ServerGoalHandle<ActionSpec>;

  /// One that can begin with a goal that it had accepted in a life before.
  class Server : public actionlib::ActionServer<ActionSpec> {
   public:
    using actionlib::ActionServer<ActionSpec>::ActionServer;
    /// Before start(). The goal callback is called with its handle.
    void resume(const RememberedGoal& remembered);
  };

  void take_up_what_was_left();
  void on_action_goal(Handle handle);
  void on_action_cancel(Handle handle);
  void on_goal(const ros::MessageEvent<geometry_msgs::PoseStamped const>& event);
  void on_cancel(const std_msgs::Empty::ConstPtr& cancel);
  [[nodiscard]] Converted<spf::host::Goal> in_fleets_frame(const geometry_msgs::PoseStamped& pose) const;
  /// False, and told, when it is refused; the goal before it then stays.
  bool pursue(const Converted<spf::host::Goal>& goal, std::optional<Handle> handle);
  void take_away(spf::host::GoalOutcome outcome);
  void conclude();
  void tell_feedback(double now);

  std::string frame_;
  spf::host::PlannerProcess& host_;
  const Frames& frames_;
  Refuse refuse_;
  double goal_timeout_;  // [s]
  spf::host::GoalSupervisor supervisor_;
  GoalMemory memory_;
  std::optional<RememberedGoal> resumed_;  // while it is taken up again
  std::optional<Handle> handle_;           // of the goal that is pursued, when it came by the action
  ros::Time next_feedback_;
  Server server_;
  std::vector<ros::Subscriber> subscribers_;
};

}  // namespace spf_empc_ros
