// The dynamic obstacles of a trial: the scenario's moving discs, its recorded crowd, and its people with
// waypoints, in steps of 0.1 s within which each moves linearly. Frame: world.
#pragma once

#include <vector>

#include "sim/contact.hpp"
#include "sim/crowd.hpp"
#include "sim/moving_obstacles.hpp"
#include "sim/robot_truth.hpp"
#include "sim/walkers.hpp"

namespace spf::sim {

struct DynamicObstacle {
  int id = 0;  ///< as the detector reports it: discs 0, 1, 2, ...; those recorded follow after the last disc,
               ///< then those with waypoints
  bool person = false;
  bool appears = false;                                      ///< may be anywhere at first: a recorded person
  double radius = 0.0;                                       ///< [m]
  Motion motion;                                             ///< over the current step
  Eigen::Vector2d velocity_world = Eigen::Vector2d::Zero();  ///< [m/s] what an exact detector reports
};

class DynamicObstacles {
 public:
  static constexpr double kStep = MovingObstacles::kStep;  ///< [s]

  explicit DynamicObstacles(const Scenario& scenario);

  /// Begins the step at `time` [s], a multiple of kStep. People who react do so to the robots as they are.
  void advance(double time, const std::vector<RobotTruth>& robots = {});

  /// As MovingObstacles::change_shapes and Walkers::change.
  void change(const Scenario& scenario) {
    discs_.change_shapes(scenario);
    walkers_.change(scenario);
  }
  /// Puts the moving disc or person `id` elsewhere [m], from the next step on.
  void place(int id, const Eigen::Vector2d& position_world);

  [[nodiscard]] const std::vector<DynamicObstacle>& all() const { return dynamic_obstacles_; }

 private:
  void advance_walkers(const std::vector<RobotTruth>& robots);

  MovingObstacles discs_;
  Crowd crowd_;
  double person_radius_;  // [m] of those recorded
  Walkers walkers_;
  int first_walker_;  // its id
  std::vector<DynamicObstacle> dynamic_obstacles_;
};

}  // namespace spf::sim
