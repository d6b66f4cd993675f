// Adds up the ground-truth figures of a trial while it runs (docs/protocol.md, Figures).
#pragma once

#include <optional>
#include <vector>

#include "sim/contact_monitor.hpp"
#include "sim/dynamic_obstacles.hpp"
#include "sim/robot_truth.hpp"
#include "sim/trial_result.hpp"

namespace spf::sim {

class TrialMeter {
 public:
  explicit TrialMeter(const Scenario& scenario);

  /// To be called at `time` [s] after the robots have moved along their `motion`. Sets `arrived` of those
  /// that arrive.
  void moved(double time, std::vector<RobotTruth>& robots);
  /// Numbers of the robots that reached their goal in the last call of moved().
  [[nodiscard]] const std::vector<int>& arrivals() const { return arrivals_; }
  /// From here on the robot is to go to another goal, or to none, which ends its way to the last.
  void set_goal(std::size_t robot, const Eigen::Vector2d& from, const std::optional<host::Goal>& goal);
  /// It begins at another place, on its way to the same goal.
  void begin_anew(std::size_t robot, const Eigen::Vector2d& from) { ways_[robot].from = from; }
  /// Where the robots are to go, or have arrived; by robot.
  [[nodiscard]] const std::vector<std::optional<host::Goal>>& goals() const { return goals_; }
  [[nodiscard]] int goals_reached(std::size_t robot) const { return robots_[robot].life.goals_reached; }
  /// Adds all present positions to the digest.
  void digest(const std::vector<RobotTruth>& robots, const std::vector<DynamicObstacle>& dynamic_obstacles);

  /// Nothing more is asked of the robot: it has no goal, has been taken away, or is broken.
  [[nodiscard]] bool excused(std::size_t robot, const RobotTruth& truth) const;
  /// Fills the figures into the result; the trial ended at `time` [s].
  void finish(double time, const std::vector<RobotTruth>& robots, const ContactMonitor& monitor,
              TrialResult& result);

 private:
  /// The way to the present goal, and of those before.
  struct Way {
    Eigen::Vector2d from = Eigen::Vector2d::Zero();  // [m] where it began
    bool ended = false;                              // at the goal
    double under_way = 0.0;                          // [s] to the present goal, while not held
    double straight_before = 0.0;                    // [m] of all before
    double fastest_before = 0.0;                     // [s] likewise, rest to rest, alone
    double idle = 0.0;                               // [s] in which it had nowhere to go
    double stands = 0.0;                             // [s] at a stretch, though it has
  };
  [[nodiscard]] double fastest(std::size_t robot, double distance) const;
  [[nodiscard]] double straight(std::size_t robot) const;
  void close_way(std::size_t robot, const Eigen::Vector2d& at);
  void measure(double time, std::size_t robot, const RobotTruth& truth);

  TrialParameters parameters_;
  std::vector<RobotParameters> kinds_;  // by robot
  std::vector<std::optional<host::Goal>> goals_;
  std::vector<Way> ways_;
  std::vector<RobotResult> robots_;
  std::vector<int> arrivals_;
  double time_ = 0.0;  // [s] of the last call of moved()
  std::uint64_t digest_ = 0;
};

}  // namespace spf::sim
