#include "spf/tracking/reference_sampler.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "spf/math/angles.hpp"

namespace spf {
namespace {

struct PoseAndTwist {
  Eigen::Vector3d pose;
  Eigen::Vector3d twist;
};

PoseAndTwist evaluate(const Trajectory& trajectory, double time) {
  const FlatState flat = trajectory.state(time);
  const HeadingState heading = trajectory.heading_state(time);
  return {{flat.position_world.x(), flat.position_world.y(), heading.heading},
          {flat.velocity_world.x(), flat.velocity_world.y(), heading.yaw_rate}};
}

/// The plan's last discrete point at or before a time, with zero twist.
PoseAndTwist evaluate_held(const Trajectory& trajectory, double time, double interval) {
  // A point counts as reached slightly (by rounding) before its time, so that ticks at multiples of the
  // interval use it.
  const double index = std::floor((time - trajectory.start_time()) / interval + 1e-9);
  PoseAndTwist held = evaluate(trajectory, trajectory.start_time() + std::max(index, 0.0) * interval);
  held.twist.setZero();
  return held;
}

}  // namespace

Reference sample_reference(const Trajectory& trajectory, const ReferenceRequest& request, const Drive& drive,
                           const ReferenceParameters& parameters) {
  assert(!trajectory.empty() && request.dt > 0.0);
  assert(1 <= request.steps && request.steps <= kMaxHorizon);
  Reference reference;
  reference.steps = request.steps;
  double heading = request.robot_world.heading;
  for (int k = 0; k <= request.steps; ++k) {
    const double time = request.time + k * request.dt;
    PoseAndTwist point = parameters.self_sampling
                             ? evaluate(trajectory, time)
                             : evaluate_held(trajectory, time, parameters.plan_point_interval);
    heading += angle_difference(point.pose.z(), heading);
    point.pose.z() = heading;
    reference.pose[static_cast<std::size_t>(k)] = point.pose + request.preview * point.twist;
    reference.twist[static_cast<std::size_t>(k)] = point.twist;
  }
  if (parameters.self_sampling && 0.0 < request.hold_time && request.hold_time < request.dt) {
    PoseAndTwist next = evaluate(trajectory, request.time + request.hold_time);
    next.pose.z() = reference.pose[0].z() + angle_difference(next.pose.z(), reference.pose[0].z());
    const Eigen::Vector3d held_mean =
        (next.pose + request.preview * next.twist - reference.pose[0]) / request.hold_time;
    const Eigen::Vector3d shift = reference.pose[0] + request.dt * held_mean - reference.pose[1];
    for (std::size_t k = 1; k <= static_cast<std::size_t>(request.steps); ++k) reference.pose[k] += shift;
  }
  for (std::size_t k = 0; k < static_cast<std::size_t>(request.steps); ++k) {
    Eigen::Vector3d twist = Eigen::Vector3d::Zero();  // held points ask for zero velocity
    if (parameters.self_sampling) twist = (reference.pose[k + 1] - reference.pose[k]) / request.dt;
    reference.wheel_speeds[k] = drive.saturated(drive.input_from_world(twist, reference.pose[k].z()));
  }
  return reference;
}

}  // namespace spf
