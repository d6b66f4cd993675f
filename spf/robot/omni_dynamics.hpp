// Dynamics of a robot on three omni wheels: the simulator's plant. Motors with limited torque drive wheels
// that roll without slip. Eq. 15 as printed is singular (its first two columns are equal), so the wrench
// follows from virtual work instead: the power of the motors, sum tau_i v_i / R, equals the power F . twist
// for every twist, hence F = W^T tau / R. Frames: body and world as in omni_kinematics.hpp; a wrench is (x
// force, y force, yaw moment) [N, N, N m].
#pragma once

#include <Eigen/Core>

#include "spf/math/pose2.hpp"
#include "spf/robot/omni_kinematics.hpp"
#include "spf/robot/robot_parameters.hpp"

namespace spf {

struct PlantState {
  Pose2 pose_world;
  Eigen::Vector3d twist_world = Eigen::Vector3d::Zero();  ///< [m/s, m/s, rad/s]
};

class OmniDynamics {
 public:
  /// Throws std::invalid_argument on parameters out of range.
  explicit OmniDynamics(const RobotParameters& parameters, const PlantState& initial = {});

  /// Advances by dt > 0 [s] under constant commanded wheel speeds [m/s], which the motors clip to their
  /// limit. A speed loop with the time constant motor_lag (0: as fast as the torque allows) asks every motor
  /// for a torque, each motor clips it to max_wheel_torque, and the clipped torques move the body. While no
  /// torque is clipped the wheel speeds follow the first-order lag exactly, for any dt; the kinetic energy
  /// always changes by exactly the work of the motors. A command that is not finite counts as zero.
  void step(double dt, const Eigen::Vector3d& commanded_wheel_speeds);

  [[nodiscard]] const PlantState& state() const { return state_; }
  /// Rim speeds [m/s] now; they follow from the motion of the body.
  [[nodiscard]] Eigen::Vector3d wheel_speeds() const;
  /// Torques [N m] of the last step, after clipping.
  [[nodiscard]] const Eigen::Vector3d& wheel_torques() const { return wheel_torques_; }

  [[nodiscard]] Eigen::Vector3d wrench_body(const Eigen::Vector3d& wheel_torques) const;
  /// Wheel torques [N m] that exert a wrench on the body.
  [[nodiscard]] Eigen::Vector3d torques_for(const Eigen::Vector3d& wrench_body) const;
  /// Wheel torques [N m] that accelerate the body from rest [m/s^2, m/s^2, rad/s^2].
  [[nodiscard]] Eigen::Vector3d torques_for_acceleration(const Eigen::Vector3d& acceleration_body) const;
  /// The largest acceleration [m/s^2] without turning, from rest, along a direction of the body (any length >
  /// 0) within the torque limits.
  [[nodiscard]] double max_acceleration_along(const Eigen::Vector2d& direction_body) const;

  /// The same along the worst direction: what the robot can rely on, however it is turned.
  [[nodiscard]] double max_acceleration_anywhere() const;

  [[nodiscard]] const OmniKinematics& kinematics() const { return kinematics_; }

 private:
  RobotParameters parameters_;
  OmniKinematics kinematics_;
  Eigen::Vector3d inertia_;  // diagonal of the mass matrix [kg, kg, kg m^2]
  PlantState state_;
  Eigen::Vector3d wheel_torques_ = Eigen::Vector3d::Zero();
};

/// The robot as plans may rely on it: max_acceleration is no more than its wheels give in every direction.
[[nodiscard]] RobotParameters within_drive(RobotParameters robot);

}  // namespace spf
