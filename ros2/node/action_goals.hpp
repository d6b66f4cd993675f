// What an action server knows of its goals: how each stands, which a request to cancel means, and what is
// told of them.
#pragma once

#include <map>
#include <ros2_messages/action_msgs/CancelGoal.hpp>
#include <ros2_messages/action_msgs/GoalStatusArray.hpp>
#include <vector>

#include "ros2/node/time.hpp"

namespace ros2 {

using GoalId = std::array<std::uint8_t, 16>;

class ActionGoals {
 public:
  /// For how long a goal that has ended is remembered, with its result [ns]; and how many are at most.
  static constexpr Nanoseconds kMemory = 900 * kSecond;
  static constexpr std::size_t kMostGoals = 100;

  /// Accepted, and executed from now on. False when there is one of this id, or are too many that have not
  /// ended.
  bool add(const GoalId& id, Nanoseconds now);
  /// As if it had never been.
  void remove(const GoalId& id) { goals_.erase(id); }
  [[nodiscard]] bool knows(const GoalId& id) const { return goals_.count(id) > 0; }
  /// Neither unknown nor ended.
  [[nodiscard]] bool active(const GoalId& id) const;
  /// As in action_msgs/GoalStatus; STATUS_UNKNOWN when there is none.
  [[nodiscard]] std::int8_t status(const GoalId& id) const;
  /// Returns the goals that are forgotten for it.
  std::vector<GoalId> set_status(const GoalId& id, std::int8_t status, Nanoseconds now);

  /// The active goals that a request means: one by its id, all that were accepted up to its stamp, both, or
  /// (neither id nor stamp) all.
  [[nodiscard]] std::vector<GoalId> meant_by(const action_msgs::GoalInfo& request) const;
  /// Why a request means none (action_msgs/CancelGoal_Response).
  [[nodiscard]] std::int8_t why_none(const action_msgs::GoalInfo& request) const;

  [[nodiscard]] action_msgs::GoalInfo info(const GoalId& id) const;
  /// In the order in which they were accepted.
  [[nodiscard]] action_msgs::GoalStatusArray message() const;

 private:
  struct Goal {
    std::uint64_t number = 0;  // in the order of acceptance
    Nanoseconds accepted = 0;
    Nanoseconds ended = 0;
    std::int8_t status = 0;
  };
  std::map<GoalId, Goal> goals_;
  std::uint64_t count_ = 0;
};

}  // namespace ros2
