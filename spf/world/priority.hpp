// Which of two robots in conflict goes first: the one rule, for every method.
#pragma once

namespace spf {

/// A robot's rank in the fleet.
struct Rank {
  int priority = 0;  ///< the smaller goes first
  int robot_id = 0;  ///< likewise, among equal priorities (the paper's rule)
};

[[nodiscard]] constexpr bool goes_first(const Rank& one, const Rank& other) {
  return one.priority != other.priority ? one.priority < other.priority : one.robot_id < other.robot_id;
}

}  // namespace spf
