#include "spf/planning/evasion.hpp"

#include <algorithm>
#include <cmath>

#include "spf/planning/braking.hpp"

namespace spf {
namespace {

constexpr int kDirections = 16;
constexpr double kSidestepTime = 0.5;           // [s] towards the velocity before braking
constexpr double kEnoughClearance = 0.5 / 0.3;  // [radii of the robot] more is not better

/// Constant acceleration towards a velocity for kSidestepTime, then constant braking to rest.
Trajectory sidestep(const FlatState& head, const Eigen::Vector2d& velocity, double time,
                    const RobotParameters& robot) {
  const Eigen::Vector2d change = velocity - head.velocity_world;
  const double share = std::min(1.0, robot.max_acceleration * kSidestepTime / std::max(change.norm(), 1e-9));
  const Eigen::Vector2d reached = head.velocity_world + share * change;
  Trajectory trajectory{time};
  QuinticPiece away;
  away.duration = kSidestepTime;
  away.coefficients.row(0) = head.position_world.transpose();
  away.coefficients.row(1) = head.velocity_world.transpose();
  away.coefficients.row(2) = (reached - head.velocity_world).transpose() / (2.0 * kSidestepTime);
  trajectory.append(away);
  const double stop = reached.norm() / robot.max_acceleration;
  if (stop > 1e-6) {
    QuinticPiece brake;
    brake.duration = stop;
    brake.coefficients.row(0) = away.position(kSidestepTime).transpose();
    brake.coefficients.row(1) = reached.transpose();
    brake.coefficients.row(2) = -reached.transpose() / (2.0 * stop);
    trajectory.append(brake);
  }
  return trajectory;
}

bool better(const ClearanceReport& candidate, const ClearanceReport& best, double enough) {
  if (candidate.clear() != best.clear()) return candidate.clear();
  if (candidate.clear()) {
    return std::min(candidate.min_clearance, enough) > std::min(best.min_clearance, enough);
  }
  return candidate.time > best.time + 1e-9;
}

}  // namespace

Evasion best_evasion(const FlatState& head, const HeadingState& heading, double time, double until,
                     const ClearanceModel& model, const RobotParameters& robot) {
  const double enough = kEnoughClearance * robot.radius;
  const ClearanceWindow window{time, until, until, 0.5};
  Evasion best;
  best.trajectory = braking_trajectory(head, heading, time, robot);
  best.report = model.check(best.trajectory, window);
  if (best.report.clear() && best.report.min_clearance >= enough) return best;
  const ClearanceWindow only_static{time, until, time, 0.5};
  for (int i = 0; i < kDirections; ++i) {
    const double angle = 2.0 * kPi * i / kDirections;
    const Eigen::Vector2d direction{std::cos(angle), std::sin(angle)};
    for (const double part : {1.0, 0.5}) {
      Trajectory trial = sidestep(head, part * robot.max_speed * direction, time, robot);
      if (!model.check(trial, only_static).clear()) continue;  // never into a wall to gain time
      const ClearanceReport report = model.check(trial, window);
      if (!better(report, best.report, enough)) continue;
      trial.set_heading(stopping_heading(heading, time, robot));
      best = {trial, report, true};
    }
  }
  return best;
}

}  // namespace spf
