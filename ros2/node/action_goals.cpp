#include "ros2/node/action_goals.hpp"

#include <algorithm>

namespace ros2 {
namespace {

using action_msgs::GoalStatus;

bool has_ended(std::int8_t status) {
  return status >= GoalStatus::STATUS_SUCCEEDED || status == GoalStatus::STATUS_UNKNOWN;
}

}  // namespace

bool ActionGoals::add(const GoalId& id, Nanoseconds now) {
  if (knows(id) || goals_.size() >= 2 * kMostGoals) return false;
  goals_[id] = {++count_, now, 0, GoalStatus::STATUS_EXECUTING};
  return true;
}

bool ActionGoals::active(const GoalId& id) const {
  return !has_ended(status(id));
}

std::int8_t ActionGoals::status(const GoalId& id) const {
  const auto goal = goals_.find(id);
  return goal == goals_.end() ? GoalStatus::STATUS_UNKNOWN : goal->second.status;
}

std::vector<GoalId> ActionGoals::set_status(const GoalId& id, std::int8_t status, Nanoseconds now) {
  if (const auto goal = goals_.find(id); goal != goals_.end())
    goal->second = {goal->second.number, goal->second.accepted, now, status};
  std::vector<GoalId> ended;
  for (const auto& [other, goal] : goals_)
    if (has_ended(goal.status)) ended.push_back(other);
  std::sort(ended.begin(), ended.end(), [this](const GoalId& one, const GoalId& other) {
    return goals_[one].number < goals_[other].number;
  });
  std::vector<GoalId> forgotten;
  for (const GoalId& old : ended) {
    if (ended.size() - forgotten.size() <= kMostGoals && now - goals_[old].ended <= kMemory) continue;
    goals_.erase(old);
    forgotten.push_back(old);
  }
  return forgotten;
}

std::vector<GoalId> ActionGoals::meant_by(const action_msgs::GoalInfo& request) const {
  const bool by_id = request.goal_id.uuid != GoalId{};
  const Nanoseconds until = nanoseconds_of(request.stamp);
  std::vector<GoalId> meant;
  for (const auto& [id, goal] : goals_) {
    const bool wanted = (by_id && id == request.goal_id.uuid) || (until != 0 && goal.accepted <= until) ||
                        (!by_id && until == 0);
    if (wanted && !has_ended(goal.status)) meant.push_back(id);
  }
  return meant;
}

std::int8_t ActionGoals::why_none(const action_msgs::GoalInfo& request) const {
  using Response = action_msgs::CancelGoal_Response;
  if (request.goal_id.uuid == GoalId{}) return Response::ERROR_REJECTED;
  return knows(request.goal_id.uuid) ? Response::ERROR_GOAL_TERMINATED : Response::ERROR_UNKNOWN_GOAL_ID;
}

action_msgs::GoalInfo ActionGoals::info(const GoalId& id) const {
  action_msgs::GoalInfo info;
  info.goal_id.uuid = id;
  if (const auto goal = goals_.find(id); goal != goals_.end()) info.stamp = time_of(goal->second.accepted);
  return info;
}

action_msgs::GoalStatusArray ActionGoals::message() const {
  std::map<std::uint64_t, GoalId> by_number;
  for (const auto& [id, goal] : goals_) by_number[goal.number] = id;
  action_msgs::GoalStatusArray message;
  for (const auto& [number, id] : by_number) {
    auto& status = message.status_list.emplace_back();
    status.goal_info = info(id);
    status.status = this->status(id);
  }
  return message;
}

}  // namespace ros2
