// The robot's goals on ROS 2: the action `navigate_to_pose`, and the topics `goal`, `goal_pose` (as RViz
// names it) and `cancel`. There is one goal at a time, and a newer one replaces it. What becomes of it is
// host::GoalSupervisor's word; here it is told to whoever sent it.
#pragma once

#include <functional>
#include <memory>
#include <ros2_messages/geometry_msgs/PoseStamped.hpp>
#include <string>

#include "host/goal_supervisor.hpp"
#include "host/split_host.hpp"
#include "ros2/robot/frames.hpp"
#include "ros2/robot/navigate_server.hpp"
#include "ros2/robot/robot_config.hpp"

namespace spf_ros2 {

class Goals {
 public:
  /// Told of goals that are refused: what, and why.
  using Refuse = std::function<void(const char* what, const std::string& why)>;

  /// All that is referred to must outlive it.
  Goals(ros2::Node& node, const RobotConfig& config, spf::host::PlannerProcess& host, const Frames& frames,
        Refuse refuse);
  Goals(const Goals&) = delete;
  Goals& operator=(const Goals&) = delete;

  /// Tolerances at once, the patience for the goals to come.
  void reconfigure(const spf::AgentParameters& agent, const spf::host::HostParameters& host);
  /// After every step of the planner, at the same time [s].
  void step(double now);

  [[nodiscard]] spf::host::GoalOutcome outcome() const { return supervisor_.outcome(); }

 private:
  /// False, and told, when it is refused; the goal before it then stays. It is given up after `patience` [s]
  /// without a path.
  bool pursue(const ros2::geometry_msgs::PoseStamped& pose, double patience);
  void take_away(spf::host::GoalOutcome outcome);
  void cancel();
  void conclude();
  void tell_feedback(double distance, double now);

  ros2::Node& node_;
  std::string frame_;
  spf::host::PlannerProcess& host_;
  const Frames& frames_;
  Refuse refuse_;
  double patience_;                           // [s]
  double begun_ = 0.0, next_feedback_ = 0.0;  // [s]
  spf::host::GoalSupervisor supervisor_;
  std::unique_ptr<NavigateServer> server_;
};

}  // namespace spf_ros2
