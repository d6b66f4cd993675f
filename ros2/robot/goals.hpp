// The robot's goals on ROS 2: the topics `goal`, `goal_pose` (as RViz names it) and `cancel`. There is one
// goal at a time, and a newer one replaces it. What becomes of it is host::GoalSupervisor's word.
#pragma once

#include <functional>
#include <ros2_messages/geometry_msgs/PoseStamped.hpp>
#include <string>

#include "host/goal_supervisor.hpp"
#include "host/split_host.hpp"
#include "ros2/robot/frames.hpp"
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

  void reconfigure(const spf::AgentParameters& agent, const spf::host::HostParameters& host) {
    supervisor_.reconfigure(agent, host);
  }
  /// After every step of the planner, at the same time [s].
  void step(double now);

  [[nodiscard]] spf::host::GoalOutcome outcome() const { return supervisor_.outcome(); }

 private:
  void on_goal(const ros2::geometry_msgs::PoseStamped& pose);
  void on_cancel();

  ros2::Node& node_;
  std::string frame_;
  spf::host::PlannerProcess& host_;
  const Frames& frames_;
  Refuse refuse_;
  spf::host::GoalSupervisor supervisor_;
};

}  // namespace spf_ros2
