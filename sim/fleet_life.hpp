// When what happens to the robots of a trial: events whose time or condition has come, and the next goal of
// who has reached one. Times in s of the trial.
#pragma once

#include <functional>
#include <vector>

#include "sim/goal_source.hpp"

namespace spf::sim {

class FleetLife {
 public:
  explicit FleetLife(const Scenario& scenario);

  /// A robot has reached a goal at `time`, for the `reached`-th time; `taken` as for GoalSource.
  void reached_goal(double time, std::size_t robot, int reached, const Eigen::Vector2d& position_world,
                    const std::vector<std::optional<host::Goal>>& taken);
  /// Lets what is due at `time` happen, in the order of the events, and adds it to `orders`. `happens`
  /// returns false where that is not possible now: it is tried again next time.
  void pass_on(double time, const std::function<bool(const FleetOrder&)>& happens,
               std::vector<FleetOrder>& orders);

  /// Adds what is to happen.
  void add(const FleetEvent& event) { pending_.push_back({event, event.after_robot < 0}); }

  /// Whether more will happen for certain: its time is known.
  [[nodiscard]] bool goes_on() const;
  /// A goal is to come after the one that the robot has reached last.
  [[nodiscard]] bool goal_to_come(std::size_t robot) const;

 private:
  struct Pending {
    FleetEvent event;
    bool timed = true;  // its condition, if any, has come true: event.time counts
  };
  GoalSource source_;
  double goal_pause_;  // [s]
  std::vector<Pending> pending_;
};

}  // namespace spf::sim
