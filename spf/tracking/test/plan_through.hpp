// A plan through waypoints at equal times, for tests and benchmarks of the controller.
#pragma once

#include "spf/trajectory/minco.hpp"

namespace spf {

/// Minimum jerk from time 0 on through `waypoints` (a column each, `interval` [s] apart), with the first and
/// last velocity [m/s] given and no acceleration there.
inline Trajectory plan_through(const Eigen::Matrix2Xd& waypoints, double interval,
                               const Eigen::Vector2d& first_velocity, const Eigen::Vector2d& last_velocity,
                               const HeadingProfile& heading) {
  const Eigen::Index pieces = waypoints.cols() - 1;
  MincoEnds ends;
  ends.head.position_world = waypoints.col(0);
  ends.head.velocity_world = first_velocity;
  ends.tail.position_world = waypoints.col(pieces);
  ends.tail.velocity_world = last_velocity;
  Minco minco;
  minco.solve(ends, waypoints.middleCols(1, pieces - 1), Eigen::VectorXd::Constant(pieces, interval));
  Trajectory plan = minco.trajectory(0.0);
  plan.set_heading(heading);
  return plan;
}

}  // namespace spf
