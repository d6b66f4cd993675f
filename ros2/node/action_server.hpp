// An action server: three services and two topics below NAME/_action. An Action has the types Goal, Result,
// Feedback and those that travel, as the generated ones have. Goals are executed from the moment that they
// are accepted.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "ros2/node/action_goals.hpp"
#include "ros2/node/node.hpp"

namespace ros2 {

template <class Action>
class ActionServer {
 public:
  using Goal = typename Action::Goal;
  using Result = typename Action::Result;
  using Feedback = typename Action::Feedback;
  /// True when it is accepted, and is executed from now on.
  using OnGoal = std::function<bool(const GoalId& id, const Goal& goal)>;
  /// Told that a goal is to be cancelled; whoever executes it ends it, at once or later.
  using OnCancel = std::function<void(const GoalId& id)>;

  ActionServer(Node& node, const std::string& name, OnGoal on_goal, OnCancel on_cancel)
      : node_{node},
        on_goal_{std::move(on_goal)},
        on_cancel_{std::move(on_cancel)},
        feedback_{node.advertise<typename Action::FeedbackMessage>(name + "/_action/feedback")},
        status_{node.advertise<action_msgs::GoalStatusArray>(name + "/_action/status", Qos::latched())} {
    using namespace action_msgs;  // NOLINT: the two types of one service
    node.serve<typename Action::SendGoalRequest, typename Action::SendGoalResponse>(
        name + "/_action/send_goal", [this](const auto& request) { return accept(request); });
    node.serve<CancelGoal_Request, CancelGoal_Response>(
        name + "/_action/cancel_goal", [this](const auto& request) { return cancel(request); });
    node.serve_later<typename Action::GetResultRequest, typename Action::GetResultResponse>(
        name + "/_action/get_result",
        [this](const auto& request, const auto& reply) { tell_result(request.goal_id.uuid, reply); });
    status_.publish(goals_.message());
  }
  ActionServer(const ActionServer&) = delete;
  ActionServer& operator=(const ActionServer&) = delete;

  void tell(const GoalId& id, const Feedback& feedback) const {
    typename Action::FeedbackMessage message;
    message.goal_id.uuid = id;
    message.feedback = feedback;
    feedback_.publish(message);
  }
  /// Ends a goal: GoalStatus::STATUS_SUCCEEDED, STATUS_CANCELED or STATUS_ABORTED.
  void end(const GoalId& id, std::int8_t status, const Result& result) {
    if (!goals_.active(id)) return;
    typename Action::GetResultResponse response;
    response.status = status;
    response.result = result;
    results_[id] = response;
    for (const GoalId& forgotten : goals_.set_status(id, status, node_.clock().now())) {
      results_.erase(forgotten);
      waiting_.erase(forgotten);
    }
    for (const auto& reply : waiting_[id]) reply.send(response);
    waiting_.erase(id);
    status_.publish(goals_.message());
  }
  [[nodiscard]] const ActionGoals& goals() const { return goals_; }

 private:
  using ResultReply = Reply<typename Action::GetResultResponse>;
  /// Whoever asks for a result that is not there yet waits, up to so many of one goal.
  static constexpr std::size_t kMostWaiting = 100;

  typename Action::SendGoalResponse accept(const typename Action::SendGoalRequest& request) {
    const GoalId& id = request.goal_id.uuid;
    const Nanoseconds now = node_.clock().now();
    typename Action::SendGoalResponse response;
    response.stamp = time_of(now);
    if (!goals_.add(id, now)) return response;
    response.accepted = on_goal_(id, request.goal);
    if (!response.accepted) goals_.remove(id);
    status_.publish(goals_.message());
    return response;
  }

  action_msgs::CancelGoal_Response cancel(const action_msgs::CancelGoal_Request& request) {
    action_msgs::CancelGoal_Response response;
    const std::vector<GoalId> meant = goals_.meant_by(request.goal_info);
    if (meant.empty()) response.return_code = goals_.why_none(request.goal_info);
    for (const GoalId& id : meant) {
      response.goals_canceling.push_back(goals_.info(id));
      (void)goals_.set_status(id, action_msgs::GoalStatus::STATUS_CANCELING, node_.clock().now());
    }
    status_.publish(goals_.message());
    for (const GoalId& id : meant) on_cancel_(id);
    return response;
  }

  void tell_result(const GoalId& id, const ResultReply& reply) {
    if (const auto result = results_.find(id); result != results_.end()) return reply.send(result->second);
    if (!goals_.knows(id)) return reply.send({});  // STATUS_UNKNOWN
    std::vector<ResultReply>& waiting = waiting_[id];
    if (waiting.size() < kMostWaiting) waiting.push_back(reply);
  }

  Node& node_;
  OnGoal on_goal_;
  OnCancel on_cancel_;
  ActionGoals goals_;
  std::map<GoalId, typename Action::GetResultResponse> results_;
  std::map<GoalId, std::vector<ResultReply>> waiting_;
  Publisher<typename Action::FeedbackMessage> feedback_;
  Publisher<action_msgs::GoalStatusArray> status_;
};

}  // namespace ros2
