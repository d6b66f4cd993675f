// Speed that follows sight and brakes: the robot can always stand within what it knows to be free, before
// what may come from beyond its sight. Frame: world.
#pragma once

#include <Eigen/Core>

#include <vector>

#include "spf/planning/planner.hpp"
#include "spf/robot/robot_parameters.hpp"

namespace spf {

/// Largest speed [m/s] from which a robot that goes on for `reaction` [s] and then brakes stands before
/// something at `gap` [m] reaches it that comes straight at it with `closing_speed` [m/s] all the while: the
/// positive root of v^2 / (2 a) + v (reaction + closing / a) + closing * reaction = gap, at least 0.
[[nodiscard]] double stoppable_speed(double gap, double closing_speed, double reaction, double deceleration);

class SightLimit {
 public:
  /// `margin` [m]: gap that is left when the robot stands.
  SightLimit(const RobotParameters& robot, double margin);

  /// Looks along the guide, which must be ready. Allocates only for a path of more corners than ever before.
  void prepare(const PlanRequest& request);

  /// Largest speed on the guide's path [m/s], up to the robot's: it stands before the first position that is
  /// unknown, and before whatever comes from beyond its sight. Never less than a crawl, so that the robot
  /// can have a look.
  [[nodiscard]] double speed() const { return speed_; }
  /// That for what comes from beyond the sight alone, which holds in any direction [m/s].
  [[nodiscard]] double open_speed() const { return open_speed_; }
  /// What share of the distance that a robot with this state needs to stop, and of its own length ahead, is
  /// unknown [0, 1]; 0 where all is known.
  [[nodiscard]] double blind_share(const Eigen::Vector2d& position_world,
                                   const Eigen::Vector2d& velocity_world) const;

 private:
  [[nodiscard]] double explored_length(const Eigen::Vector2d& from, const Eigen::Vector2d& to) const;
  [[nodiscard]] double explored_path_length(const CostToGo& guide, const Eigen::Vector2d& from,
                                            double enough);

  RobotParameters robot_;
  double margin_;  // [m]
  double reach_;   // [m] how far from a position a beam may pass that shows it to be free
  const OccupancyMap* map_ = nullptr;
  double speed_ = 0.0;       // [m/s]
  double open_speed_ = 0.0;  // [m/s]
  std::vector<Eigen::Vector2d> path_;
};

}  // namespace spf
