// The risk of static surfaces along a roll-out: the probability that the error across the path reaches one,
// where the robot comes nearest by its speed there. Frame: world.
#pragma once

#include <Eigen/Core>

#include "spf/planning/planner.hpp"
#include "spf/planning/space_time/motion_primitive.hpp"
#include "spf/planning/space_time/space_time_parameters.hpp"
#include "spf/robot/footprint.hpp"

namespace spf {

class SurfaceRisk {
 public:
  SurfaceRisk(const SpaceTimeParameters& parameters, const RobotParameters& robot);

  /// [1] factor on the probability where there is room: what a robot that has waited before a gap takes.
  void set_price(double price) { price_ = price; }

  /// Along the roll-out and on to `stop`, where the robot then stands [1]. It is not discounted: a wall will
  /// still be there, and a discounted risk would be put off for ever. Grows with depth beyond 1, so that a
  /// robot inside the margin is led out of it. Not exact from `enough` on.
  [[nodiscard]] double chance(const RollOut& roll_out, const Eigen::Vector2d& stop,
                              const PlanRequest& request, double enough) const;

 private:
  struct Look;
  template <class Visit>
  void look_along(const RollOut& roll_out, const Eigen::Vector2d& stop, const Visit& visit) const;

  SpaceTimeParameters parameters_;
  double max_speed_;  // [m/s]
  Footprint footprint_;
  double price_ = 1.0;
};

}  // namespace spf
