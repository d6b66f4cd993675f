// The tracker: from measured poses and the committed trajectory to wheel speeds (observer eq. 17,
// self-sampling eq. 18, MPC eq. 19). The host calls observe() for every measurement and step() at every
// control tick.
//
// Motor lag. Wheels with the first-order lag T obey w' = (u - w) / T. The point y = z + T z', one lag ahead
// of the pose z, then obeys y' = u + d exactly, without lag; so the MPC steers y along the reference moved
// ahead likewise, and the observer is fed the lagged speeds. Frame: world.
#pragma once

#include <Eigen/Core>

#include "spf/math/pose2.hpp"
#include "spf/robot/omni_kinematics.hpp"
#include "spf/tracking/mpc.hpp"
#include "spf/tracking/observer.hpp"
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
  Eigen::Vector3d wheel_speeds =
      Eigen::Vector3d::Zero();  ///< [m/s] within the limits; hold until the next tick
  Eigen::Vector3d twist_world = Eigen::Vector3d::Zero();      ///< [m/s, m/s, rad/s] that they command
  Eigen::Vector3d reference_pose = Eigen::Vector3d::Zero();   ///< where the plan wants the robot now
  Eigen::Vector3d reference_twist = Eigen::Vector3d::Zero();  ///< and how fast
  double slip = 0.0;  ///< [s] departure from the schedule (ReferenceParameters::nearest_start)
  bool slip_limited = false;
  MpcStatus mpc_status = MpcStatus::invalid_problem;
};

/// Never throws or allocates after construction.
class Tracker {
 public:
  /// Throws std::invalid_argument on parameters out of range.
  Tracker(const TrackerParameters& parameters, const RobotParameters& robot);

  /// A pose measured at a time [s]. One that arrives late, up to half a second, is carried to the present
  /// with the motion meanwhile; an older one is ignored (`invalid`).
  MeasurementOutcome observe(double time, const Pose2& measured_world);
  /// One control tick.
  const TrackerOutput& step(double time, const Trajectory& committed);
  /// Commands standstill instead of a tick; the observer learns of it.
  const TrackerOutput& stop(double time);
  /// Forgets the estimate and the command, as after the robot was carried away.
  void reset();

  /// The estimate carried to a time not before the last call [s], without changing anything.
  [[nodiscard]] StateEstimate estimate(double time) const;
  [[nodiscard]] const TrackerOutput& last_output() const { return output_; }
  [[nodiscard]] const Reference& last_reference() const { return problem_.reference; }
  /// With predicted poses (one motor lag ahead when the lag is compensated), work done and optimality.
  [[nodiscard]] const MpcResult& last_mpc() const { return mpc_.last(); }
  [[nodiscard]] const TrackerParameters& parameters() const { return parameters_; }

 private:
  struct Motion {
    PoseObserver observer;
    Eigen::Vector3d wheel_speeds;  // [m/s] as the motors' lag lets them be
  };
  void advance_to(double time);
  void advance(Motion& motion, double duration) const;
  const TrackerOutput& stand(TrackerStatus status);

  TrackerParameters parameters_;
  OmniKinematics kinematics_;
  double lag_;  // [s] reckoned with
  Motion motion_;
  ModelPredictiveController mpc_;
  MpcProblem problem_;
  TrackerOutput output_;
  bool has_time_ = false;
  double time_ = 0.0;  // [s] of the estimate
};

}  // namespace spf
