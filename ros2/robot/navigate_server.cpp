#include "ros2/robot/navigate_server.hpp"

#include <optional>
#include <ros2_messages/humble/nav2_msgs/NavigateToPose.hpp>
#include <ros2_messages/iron/nav2_msgs/NavigateToPose.hpp>
#include <ros2_messages/nav2_msgs/NavigateToPose.hpp>
#include <utility>

#include "ros2/node/action_server.hpp"

namespace spf_ros2 {
namespace {

using ros2::action_msgs::GoalStatus;

ros2::builtin_interfaces::Duration duration_of(double seconds) {
  const ros2::builtin_interfaces::Time time = ros2::time_of(ros2::nanoseconds_of(seconds));
  ros2::builtin_interfaces::Duration duration;
  duration.sec = time.sec;
  duration.nanosec = time.nanosec;
  return duration;
}

void fill(std::uint16_t /*code*/, const std::string& /*text*/,
          ros2::humble::nav2_msgs::NavigateToPose_Result& /*result*/) {}
void fill(std::uint16_t code, const std::string& /*text*/,
          ros2::iron::nav2_msgs::NavigateToPose_Result& result) {
  result.error_code = code;
}
void fill(std::uint16_t code, const std::string& text, ros2::nav2_msgs::NavigateToPose_Result& result) {
  result.error_code = code;
  if (code != 0) result.error_msg = text;
}

template <class Action>
class ServerOf : public NavigateServer {
 public:
  ServerOf(ros2::Node& node, OnGoal on_goal, OnCancel on_cancel)
      : server_{node, "navigate_to_pose",
                [this, on_goal = std::move(on_goal)](const ros2::GoalId& id, const auto& goal) {
                  const bool accepted = on_goal(goal.pose);
                  if (accepted) pursued_ = id;
                  return accepted;
                },
                [this, on_cancel = std::move(on_cancel)](const ros2::GoalId& id) {
                  if (pursued_ == id) on_cancel();
                }} {}

  [[nodiscard]] bool active() const override { return pursued_.has_value(); }

  void tell(const NavigateFeedback& feedback) override {
    if (!pursued_) return;
    typename Action::Feedback message;
    message.current_pose = feedback.pose;
    message.navigation_time = duration_of(feedback.time);
    message.estimated_time_remaining = duration_of(feedback.time_left);
    message.distance_remaining = static_cast<float>(feedback.distance);
    server_.tell(*pursued_, message);
  }

  void end(std::int8_t status, const std::string& text) override {
    if (!pursued_) return;
    const ros2::GoalId id = *pursued_;
    pursued_.reset();
    typename Action::Result result;
    fill(status == GoalStatus::STATUS_SUCCEEDED ? std::uint16_t{0} : kFailed, text, result);
    server_.end(id, status, result);
  }

 private:
  std::optional<ros2::GoalId> pursued_;
  ros2::ActionServer<Action> server_;
};

}  // namespace

std::unique_ptr<NavigateServer> make_navigate_server(ros2::Node& node, const std::string& distribution,
                                                     NavigateServer::OnGoal on_goal,
                                                     NavigateServer::OnCancel on_cancel) {
  if (distribution == "humble")
    return std::make_unique<ServerOf<ros2::humble::nav2_msgs::NavigateToPose>>(node, std::move(on_goal),
                                                                               std::move(on_cancel));
  if (distribution == "iron")
    return std::make_unique<ServerOf<ros2::iron::nav2_msgs::NavigateToPose>>(node, std::move(on_goal),
                                                                             std::move(on_cancel));
  return std::make_unique<ServerOf<ros2::nav2_msgs::NavigateToPose>>(node, std::move(on_goal),
                                                                     std::move(on_cancel));
}

}  // namespace spf_ros2
