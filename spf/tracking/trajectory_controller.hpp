// From an estimate and the committed trajectory to wheel speeds: self-sampling (eq. 18) and MPC (eq. 19). It
// keeps no estimate of its own.
//
// Motor lag. Wheels with the first-order lag T obey w' = (u - w) / T. The point y = z + T z', one lag ahead
// of the pose z, then obeys y' = u + d exactly, without lag; so the MPC steers y along the reference moved
// ahead likewise. Frame: world.
#pragma once

#include <Eigen/Core>

#include "spf/localisation/motion_estimator.hpp"
#include "spf/robot/drive.hpp"
#include "spf/tracking/mpc.hpp"
#include "spf/tracking/reference_sampler.hpp"
#include "spf/tracking/tracker_parameters.hpp"
#include "spf/trajectory/trajectory.hpp"

namespace spf {

enum class TrackerStatus {
  tracking,
  no_estimate,   ///< nothing was measured yet: stand
  no_reference,  ///< the trajectory is empty: stand
  failed,        ///< the reference or the estimate is not finite: stand
};

struct TrackerOutput {
  TrackerStatus status = TrackerStatus::no_estimate;
  DriveInput wheel_speeds;                                    ///< within the limits; hold until the next tick
  Eigen::Vector3d twist_world = Eigen::Vector3d::Zero();      ///< [m/s, m/s, rad/s] that they command
  Eigen::Vector3d reference_pose = Eigen::Vector3d::Zero();   ///< where the plan wants the robot now
  Eigen::Vector3d reference_twist = Eigen::Vector3d::Zero();  ///< and how fast
  MpcStatus mpc_status = MpcStatus::invalid_problem;
};

/// Never throws or allocates after construction.
class TrajectoryController {
 public:
  /// `motor_lag` as the estimator reckons with it [s]. Throws std::invalid_argument on parameters out of
  /// range.
  TrajectoryController(const TrackerParameters& parameters, const Drive& drive, double motor_lag);

  /// One control tick at a time [s], with the state at that time.
  const TrackerOutput& step(double time, const MotionState& state, const Trajectory& committed);
  /// Commands standstill instead of a tick.
  const TrackerOutput& stop() { return stand(TrackerStatus::no_reference); }
  /// Forgets the last command.
  void reset() { stand(TrackerStatus::no_estimate); }

 private:
  const TrackerOutput& stand(TrackerStatus status);

  TrackerParameters parameters_;
  Drive drive_;
  double lag_;  // [s] reckoned with
  ModelPredictiveController mpc_;
  MpcProblem problem_;
  TrackerOutput output_;
};

}  // namespace spf
