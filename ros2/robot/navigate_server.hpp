// The action navigate_to_pose (nav2_msgs/NavigateToPose), one goal at a time. Its result differs by
// distribution of ROS 2: nothing (Humble), a code (Iron), a code and a text (since Jazzy).
#pragma once

#include <functional>
#include <memory>
#include <ros2_messages/geometry_msgs/PoseStamped.hpp>
#include <string>

#include "ros2/node/node.hpp"

namespace spf_ros2 {

struct NavigateFeedback {
  ros2::geometry_msgs::PoseStamped pose;
  double time = 0.0;       ///< [s] since the goal was accepted
  double time_left = 0.0;  ///< [s] of the plan under way
  double distance = 0.0;   ///< [m] straight to the goal
};

class NavigateServer {
 public:
  /// What a result's code says when the goal was not reached; 0 when it was.
  static constexpr std::uint16_t kFailed = 1;

  /// True when the goal is pursued from now on: the one before it has been ended then.
  using OnGoal = std::function<bool(const ros2::geometry_msgs::PoseStamped& pose)>;
  using OnCancel = std::function<void()>;

  virtual ~NavigateServer() = default;
  /// Is there somebody who waits for the result of the goal that is pursued?
  [[nodiscard]] virtual bool active() const = 0;
  virtual void tell(const NavigateFeedback& feedback) = 0;
  /// Ends the goal, if there is one, by a status of action_msgs/GoalStatus.
  virtual void end(std::int8_t status, const std::string& text) = 0;
};

/// `distribution` as ROS_DISTRO names it; others are taken to be like Jazzy.
[[nodiscard]] std::unique_ptr<NavigateServer> make_navigate_server(ros2::Node& node,
                                                                   const std::string& distribution,
                                                                   NavigateServer::OnGoal on_goal,
                                                                   NavigateServer::OnCancel on_cancel);

}  // namespace spf_ros2
