// Dynamics of a robot on any drive: the simulator's plant. Motors with limited torque drive wheels that roll
// without slip; the wheels' forces follow from virtual work, (eq. 15 as printed is singular: its first two
// columns are equal): the power of the motors, sum tau_i v_i / R, equals the power of the wrench for every
// motion that the drive can do. What a differential drive or a car cannot do is held by forces across the
// wheels, which do no work. Frames: world; body (x ahead).
#pragma once

#include <Eigen/Core>

#include "spf/math/pose2.hpp"
#include "spf/robot/drive.hpp"

namespace spf {

struct PlantState {
  Pose2 pose_world;
  Eigen::Vector3d twist_world = Eigen::Vector3d::Zero();  ///< [m/s, m/s, rad/s]
};

/// Moves along the body x axis and turns, and sideways if the drive can.
class DriveDynamics {
 public:
  /// Throws std::invalid_argument on parameters out of range. Of the initial motion the drive keeps what it
  /// can do.
  explicit DriveDynamics(const RobotParameters& robot, const PlantState& initial = {});
  /// With another drive than the parameters'.
  DriveDynamics(const RobotParameters& robot, const Drive& drive, const PlantState& initial = {});

  /// Advances by dt > 0 [s] under constant commanded inputs, clipped to their limits. A speed loop with the
  /// time constant motor_lag (0: as fast as the torque allows) asks every motor for a torque, which is
  /// clipped to what the motor and the ground can give. The kinetic energy changes by exactly the work of the
  /// motors. A command that is not finite counts as standstill.
  void step(double dt, const DriveInput& command);

  [[nodiscard]] const PlantState& state() const { return state_; }
  [[nodiscard]] Eigen::Vector3d twist_body() const {
    return twist_in_body(state_.twist_world, state_.pose_world.heading);
  }
  /// Rim speeds [m/s] as the body moves, and a car's steering angle [rad].
  [[nodiscard]] DriveInput input() const;
  /// [N m] of the motors in the last step, after clipping.
  [[nodiscard]] const DriveInput& torques() const { return torques_; }
  /// [J]
  [[nodiscard]] double kinetic_energy() const;

  /// The force [N, N, N m] that torques of the motors [N m] exert on a body of this motion.
  [[nodiscard]] Eigen::Vector3d wrench_body(const DriveInput& torques) const;
  /// The least torques [N m] that exert it.
  [[nodiscard]] DriveInput torques_for(const Eigen::Vector3d& wrench_body) const;
  /// The largest acceleration [m/s^2] without turning, from rest, along a direction of the body (any length >
  /// 0; ahead or back where it cannot move sideways) within the limits of motors and ground.
  [[nodiscard]] double max_acceleration_along(const Eigen::Vector2d& direction_body) const;
  /// The same along the worst direction that it can move along: what the robot can rely on.
  [[nodiscard]] double max_acceleration_anywhere() const;
  /// [rad/s^2] on the spot, or of a car 0.
  [[nodiscard]] double max_yaw_acceleration() const;

  [[nodiscard]] const Drive& drive() const { return drive_; }

 private:
  void step_holonomic(double dt, const DriveInput& wanted);
  void step_differential(double dt, const DriveInput& wanted);
  void step_car(double dt, double wanted_speed, double wanted_angle);
  void move_along(double distance, double turn, const Eigen::Vector3d& twist_body);
  [[nodiscard]] DriveInput clipped(const DriveInput& torques) const;
  [[nodiscard]] double curvature() const;

  RobotParameters robot_;
  Drive drive_;
  Eigen::Vector3d inertia_;  // diagonal of the mass matrix [kg, kg, kg m^2]
  double largest_torque_;    // [N m] of one motor, by itself and the ground
  PlantState state_;
  double steering_angle_ = 0.0;  // [rad] of a car
  DriveInput torques_;
};

/// The robot as plans may rely on it: max_acceleration is no more than its drive gives in every direction.
[[nodiscard]] RobotParameters within_drive(RobotParameters robot);

}  // namespace spf
