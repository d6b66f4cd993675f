#include "spf/tracking/trajectory_controller.hpp"

#include <cmath>

namespace spf {

TrajectoryController::TrajectoryController(const TrackerParameters& parameters, const Drive& drive,
                                           double motor_lag)
    : parameters_{validated(parameters)}, drive_{drive}, lag_{motor_lag}, mpc_{parameters.mpc, drive} {}

const TrackerOutput& TrajectoryController::stand(TrackerStatus status) {
  output_ = TrackerOutput{};
  output_.wheel_speeds = drive_.standstill();
  output_.status = status;
  mpc_.forget();
  return output_;
}

const TrackerOutput& TrajectoryController::step(double time, const MotionState& state,
                                                const Trajectory& committed) {
  if (!std::isfinite(time)) return stand(TrackerStatus::failed);
  const StateEstimate& estimate = state.estimate;
  if (!estimate.valid) return stand(TrackerStatus::no_estimate);
  if (committed.empty()) return stand(TrackerStatus::no_reference);

  // 1. Where the robot ought to be from now on (eq. 18).
  const MpcParameters& mpc = parameters_.mpc;
  const ReferenceRequest request{
      time, mpc.dt, mpc.horizon, lag_, parameters_.control_period, estimate.pose_world};
  problem_.reference = sample_reference(committed, request, drive_, parameters_.reference);

  // 2. The command that leads there (eq. 19), for the point one motor lag ahead.
  const Eigen::Vector3d twist =
      drive_.twist_world(state.wheel_speeds, estimate.pose_world.heading) + estimate.disturbance_world;
  problem_.initial_pose << estimate.pose_world.position_world, estimate.pose_world.heading;
  problem_.initial_pose += lag_ * twist;
  problem_.disturbance = estimate.disturbance_world;
  problem_.previous_wheel_speeds = state.command;
  const MpcResult& result = mpc_.solve(problem_);
  if (result.status == MpcStatus::invalid_problem) return stand(TrackerStatus::failed);

  output_.status = TrackerStatus::tracking;
  output_.mpc_status = result.status;
  output_.wheel_speeds = result.wheel_speeds[0];
  output_.twist_world = drive_.twist_world(output_.wheel_speeds, estimate.pose_world.heading);
  output_.reference_twist = problem_.reference.twist[0];
  output_.reference_pose = problem_.reference.pose[0] - lag_ * problem_.reference.twist[0];
  return output_;
}

}  // namespace spf
