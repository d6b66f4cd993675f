#include "spf/tracking/reference_sampler.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "spf/math/angles.hpp"

namespace spf {
namespace {

struct PoseAndTwist {
  Eigen::Vector3d pose;
  Eigen::Vector3d twist;
};

PoseAndTwist evaluate(const Trajectory& trajectory, double time) {
  const FlatState flat = trajectory.state(time);
  const HeadingState heading = trajectory.heading().state(time);
  return {{flat.position_world.x(), flat.position_world.y(), heading.heading},
          {flat.velocity_world.x(), flat.velocity_world.y(), heading.yaw_rate}};
}

/// The plan's last discrete point at or before a time, standing.
PoseAndTwist evaluate_held(const Trajectory& trajectory, double time, double interval) {
  // A point counts as reached a rounding before its time, so that ticks at multiples of the interval see it.
  const double index = std::floor((time - trajectory.start_time()) / interval + 1e-9);
  PoseAndTwist held = evaluate(trajectory, trajectory.start_time() + std::max(index, 0.0) * interval);
  held.twist.setZero();
  return held;
}

double squared_distance(const Trajectory& trajectory, double time, const Eigen::Vector2d& position_world) {
  return (trajectory.position(time) - position_world).squaredNorm();
}

/// Time in [time - max_slip, time + max_slip] at which the trajectory is nearest: the best of a grid, then a
/// golden section around it. Among equals (the robot stands, the plan stands) the one nearest to the
/// schedule.
double nearest_time(const Trajectory& trajectory, const ReferenceRequest& request, double max_slip) {
  constexpr int kHalfGrid = 20;
  constexpr int kSections = 24;
  const double spacing = max_slip / kHalfGrid;
  const Eigen::Vector2d& robot = request.robot_world.position_world;
  double best = request.time;
  double least = squared_distance(trajectory, best, robot);
  for (int i = 1; i <= kHalfGrid; ++i) {
    for (const double time : {request.time - i * spacing, request.time + i * spacing}) {
      const double distance = squared_distance(trajectory, time, robot);
      if (distance < least - 1e-12) {
        least = distance;
        best = time;
      }
    }
  }
  const double golden = 0.5 * (std::sqrt(5.0) - 1.0);
  double low = std::max(best - spacing, request.time - max_slip);
  double high = std::min(best + spacing, request.time + max_slip);
  for (int i = 0; i < kSections; ++i) {
    const double first = high - golden * (high - low);
    const double second = low + golden * (high - low);
    if (squared_distance(trajectory, first, robot) < squared_distance(trajectory, second, robot))
      high = second;
    else
      low = first;
  }
  const double refined = 0.5 * (low + high);
  return squared_distance(trajectory, refined, robot) < least - 1e-12 ? refined : best;
}

QuinticPiece hermite_cubic(const PlanPoint& from, const PlanPoint& to) {
  QuinticPiece piece;
  const double t = to.time - from.time;
  const Eigen::Vector2d slope = (to.position_world - from.position_world) / t;
  piece.duration = t;
  piece.coefficients.row(0) = from.position_world;
  piece.coefficients.row(1) = from.velocity_world;
  piece.coefficients.row(2) = (3.0 * slope - 2.0 * from.velocity_world - to.velocity_world) / t;
  piece.coefficients.row(3) = (from.velocity_world + to.velocity_world - 2.0 * slope) / (t * t);
  return piece;
}

QuinticPiece hermite_quintic(const PlanPoint& from, const PlanPoint& to) {
  QuinticPiece piece;
  const double t = to.time - from.time;
  const Eigen::Vector2d& start = *from.acceleration_world;
  // What is left for the upper three coefficients after continuing from the first point, in powers of 1/t.
  const Eigen::Vector2d position =
      (to.position_world - from.position_world - t * from.velocity_world - 0.5 * t * t * start) / (t * t * t);
  const Eigen::Vector2d velocity = (to.velocity_world - from.velocity_world - t * start) / (t * t);
  const Eigen::Vector2d acceleration = (*to.acceleration_world - start) / t;
  piece.duration = t;
  piece.coefficients.row(0) = from.position_world;
  piece.coefficients.row(1) = from.velocity_world;
  piece.coefficients.row(2) = 0.5 * start;
  piece.coefficients.row(3) = 10.0 * position - 4.0 * velocity + 0.5 * acceleration;
  piece.coefficients.row(4) = (-15.0 * position + 7.0 * velocity - acceleration) / t;
  piece.coefficients.row(5) = (6.0 * position - 3.0 * velocity + 0.5 * acceleration) / (t * t);
  return piece;
}

void check_points(const std::vector<PlanPoint>& points) {
  if (points.size() < 2) throw std::invalid_argument("a plan needs at least two points");
  for (std::size_t i = 0; i < points.size(); ++i) {
    const PlanPoint& point = points[i];
    const bool finite = std::isfinite(point.time) && point.position_world.allFinite() &&
                        point.velocity_world.allFinite() &&
                        (!point.acceleration_world || point.acceleration_world->allFinite());
    const bool grows = i == 0 || points[i - 1].time < point.time;
    if (finite && grows) continue;
    std::ostringstream reason;
    reason << "plan point " << i << " at " << point.time << " s "
           << (finite ? "does not come after the one before" : "is not finite");
    throw std::invalid_argument(reason.str());
  }
}

}  // namespace

Reference sample_reference(const Trajectory& trajectory, const ReferenceRequest& request,
                           const OmniKinematics& kinematics, const ReferenceParameters& parameters) {
  assert(!trajectory.empty() && request.dt > 0.0);
  assert(1 <= request.steps && request.steps <= kMaxHorizon);
  Reference reference;
  reference.steps = request.steps;
  double start = request.time;
  if (parameters.nearest_start && parameters.max_slip > 0.0) {
    start = nearest_time(trajectory, request, parameters.max_slip);
    reference.slip = start - request.time;
    reference.slip_limited = std::abs(reference.slip) >= 0.999 * parameters.max_slip;
  }

  double heading = request.robot_world.heading;
  for (int k = 0; k <= request.steps; ++k) {
    const double time = start + k * request.dt;
    PoseAndTwist point = parameters.self_sampling
                             ? evaluate(trajectory, time)
                             : evaluate_held(trajectory, time, parameters.plan_point_interval);
    heading += angle_difference(point.pose.z(), heading);
    point.pose.z() = heading;
    reference.pose[static_cast<std::size_t>(k)] = point.pose + request.lead * point.twist;
    reference.twist[static_cast<std::size_t>(k)] = point.twist;
  }
  if (parameters.self_sampling && 0.0 < request.hold && request.hold < request.dt) {
    PoseAndTwist next = evaluate(trajectory, start + request.hold);
    next.pose.z() = reference.pose[0].z() + angle_difference(next.pose.z(), reference.pose[0].z());
    const Eigen::Vector3d held_mean =
        (next.pose + request.lead * next.twist - reference.pose[0]) / request.hold;
    const Eigen::Vector3d shift = reference.pose[0] + request.dt * held_mean - reference.pose[1];
    for (std::size_t k = 1; k <= static_cast<std::size_t>(request.steps); ++k) reference.pose[k] += shift;
  }
  for (std::size_t k = 0; k < static_cast<std::size_t>(request.steps); ++k) {
    Eigen::Vector3d twist = Eigen::Vector3d::Zero();  // held points ask for no speed of their own
    if (parameters.self_sampling) twist = (reference.pose[k + 1] - reference.pose[k]) / request.dt;
    reference.wheel_speeds[k] =
        kinematics.saturated(kinematics.wheel_speeds_from_world(twist, reference.pose[k].z()));
  }
  return reference;
}

Trajectory fit_trajectory(const std::vector<PlanPoint>& points, double from_time,
                          const HeadingProfile& heading) {
  check_points(points);
  std::size_t first = 0;
  if (points.size() - 1 > static_cast<std::size_t>(Trajectory::kMaxPieces)) {
    while (first + 2 < points.size() && points[first + 1].time <= from_time) ++first;
  }
  const std::size_t last =
      std::min(points.size() - 1, first + static_cast<std::size_t>(Trajectory::kMaxPieces));
  Trajectory trajectory{points[first].time};
  for (std::size_t i = first; i < last; ++i) {
    const bool quintic = points[i].acceleration_world && points[i + 1].acceleration_world;
    trajectory.append(quintic ? hermite_quintic(points[i], points[i + 1])
                              : hermite_cubic(points[i], points[i + 1]));
  }
  trajectory.set_heading(heading);
  return trajectory;
}

}  // namespace spf
