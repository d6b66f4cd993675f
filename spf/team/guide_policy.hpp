// When the guide, the cost-to-go towards the goal, is computed anew, and where it leads when the goal is cut
// off. Frame: world.
#pragma once

#include <Eigen/Core>

#include <optional>
#include <vector>

#include "spf/planning/cost_to_go.hpp"
#include "spf/team/agent_parameters.hpp"
#include "spf/team/agent_status.hpp"

namespace spf {

/// What a method wants of the guide: see Planner.
struct GuideNeeds {
  bool approaches_cut_off_goal = true;
  bool passes_narrow_gaps = false;

  [[nodiscard]] static GuideNeeds of(const Planner& planner) {
    return {planner.approaches_cut_off_goal(), planner.passes_narrow_gaps()};
  }
};

/// The guide for a robot, by its size and by what its method wants.
[[nodiscard]] CostToGo make_guide(const AgentParameters& parameters, const GuideNeeds& needs);

class GuidePolicy {
 public:
  GuidePolicy(const AgentParameters& parameters, const GuideNeeds& needs, double time);

  /// Other parameters from now on; a guide with another clearance or resolution is computed anew.
  void reconfigure(const AgentParameters& parameters, const GuideNeeds& needs);

  /// Brings the guide up to date where that is due, for a robot at `here`: for a new goal at once, else in
  /// slices over the next calls. What stands in the world is gone round where that is shorter than to wait.
  void refresh(double time, const WorldSnapshot& world, const Eigen::Vector2d& goal_world,
               const Eigen::Vector2d& here);

  /// [s] The guide follows a changing map at most this often ...
  static constexpr double kPeriod = 0.5;
  /// [s] ... and, while its path stays clear, at most this often.
  static constexpr double kIdlePeriod = 2.0;

  [[nodiscard]] const CostToGo& cost_to_go() const { return cost_to_go_; }
  /// No path leads to the goal, and the guide to the nearest position that one leads to.
  [[nodiscard]] bool cut_off() const { return cut_off_; }
  /// None when the guide does not stand for this goal [m] yet.
  [[nodiscard]] std::optional<GoalAccess> access(const Eigen::Vector2d& goal_world) const;
  /// Is the robot at `here` as near to the goal as it can get?
  [[nodiscard]] bool goal_out_of_reach(const Eigen::Vector2d& here) const;

 private:
  // [20 ns] Of an update, a call of refresh(): while the robot can go on as before a fifth of a millisecond,
  // or for large windows so much that an update takes some twenty calls ...
  static constexpr std::int64_t kLeastSlice = 10'000;
  static constexpr std::int64_t kSliceOfNode = 1;
  // ... and while its path is blocked all that fits beside a plan into a millisecond.
  static constexpr std::int64_t kMostSlice = 30'000;

  void start(const WorldSnapshot& world, const Eigen::Vector2d& goal_world, const Eigen::Vector2d& here);
  void go_on(const OccupancyMap& map, const Eigen::Vector2d& here);
  [[nodiscard]] bool goes_round() const;
  [[nodiscard]] bool wants_update(double time, const WorldSnapshot& world, const Eigen::Vector2d& here);
  [[nodiscard]] bool hurries(const OccupancyMap& map, const Eigen::Vector2d& here);
  [[nodiscard]] bool path_clear(const OccupancyMap& map, const Eigen::Vector2d& here);
  [[nodiscard]] Eigen::Vector2d last_free_position(const CostToGo& guide, const OccupancyMap& map,
                                                   const Eigen::Vector2d& here);
  void choose_standing(const WorldSnapshot& world, const Eigen::Vector2d& here, bool same_goal);
  [[nodiscard]] bool stands_on(const std::vector<Eigen::Vector2d>& path, const StandingDisc& disc) const;

  GuideNeeds needs_;
  double goal_tolerance_;  // [m]
  CostToGo cost_to_go_;
  CostToGo next_;                         // replaces it when done
  std::vector<Eigen::Vector2d> corners_;  // [m] kept for its memory
  std::vector<StandingDisc> standing_;    // likewise
  double max_speed_;                      // [m/s]
  double saved_;                          // [m] by which heading along the path makes the robot narrower
  double beside_;                         // [m] what stands so far beside the path matters too
  std::optional<Eigen::Vector2d> goal_;   // [m] that the guide stands for
  bool cut_off_ = false;
  bool approaching_ = false;   // likewise of next_
  bool urgent_ = false;        // the update under way
  double next_time_;           // [s]
  double update_time_ = -1e9;  // [s]
};

}  // namespace spf
