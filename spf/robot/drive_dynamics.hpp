// Dynamics of a robot on any drive: the simulator's plant. Motors with limited torque drive wheels that roll
// without slip; the wheels' forces follow from virtual work, as in omni_dynamics.hpp: the power of the
// motors, sum tau_i v_i / R, equals the power of the wrench for every motion that the drive can do. What a
// differential drive or a car cannot do is held by forces across the wheels, which do no work. Frames: world;
// body (x ahead).
#pragma once

#include <Eigen/Core>

#include "spf/math/pose2.hpp"
#include "spf/robot/drive.hpp"

namespace spf {

/// What moves, and what moves it.
struct DriveBody {
  double mass = 10.0;             ///< [kg]
  double inertia = 0.45;          ///< [kg m^2] about the vertical through the centre
  double wheel_radius = 0.05;     ///< [m]
  double max_wheel_torque = 0.4;  ///< [N m] of one motor; a car has one
  double motor_lag = 0.05;        ///< [s] first-order lag of the speed loops, and of a car's steering
  double friction = 0.8;  ///< [1] of the ground: more force than friction times weight does not reach it
  double max_steering_rate = 2.0;  ///< [rad/s] of a car
};

/// Moves along the body x axis and turns, and sideways if the drive can.
class DriveDynamics {
 public:
  /// Throws std::invalid_argument when a mass, an inertia or a radius is not positive.
  DriveDynamics(const DriveDesign& design, const DriveBody& body, const Pose2& pose_world = {});

  /// Advances by dt > 0 [s] under constant commanded inputs, clipped to their limits. A speed loop with the
  /// time constant motor_lag (0: as fast as the torque allows) asks every motor for a torque, which is
  /// clipped to what the motor and the ground can give. The kinetic energy changes by exactly the work of the
  /// motors. A command that is not finite counts as standstill.
  void step(double dt, const DriveInput& command);

  [[nodiscard]] const Pose2& pose_world() const { return pose_world_; }
  [[nodiscard]] const Eigen::Vector3d& twist_body() const { return twist_body_; }
  [[nodiscard]] Eigen::Vector3d twist_world() const;
  /// Rim speeds [m/s] as the body moves, and a car's steering angle [rad].
  [[nodiscard]] DriveInput input() const;
  /// [N m] of the motors in the last step, after clipping.
  [[nodiscard]] const DriveInput& torques() const { return torques_; }
  /// [J]
  [[nodiscard]] double kinetic_energy() const;
  [[nodiscard]] const Drive& drive() const { return drive_; }

 private:
  void step_omni(double dt, const DriveInput& wanted);
  void step_differential(double dt, const DriveInput& wanted);
  void step_car(double dt, double wanted_speed, double wanted_angle);
  void move_along(double distance, double turn);
  [[nodiscard]] DriveInput motors_for(const Eigen::Vector3d& wrench_body) const;
  [[nodiscard]] DriveInput clipped(const DriveInput& torques) const;
  [[nodiscard]] double curvature() const;

  Drive drive_;
  DriveBody body_;
  double wheel_base_;  // [m]
  Eigen::Vector3d inertia_;
  Pose2 pose_world_;
  Eigen::Vector3d twist_body_ = Eigen::Vector3d::Zero();
  double steering_angle_ = 0.0;  // [rad]
  DriveInput torques_;
};

}  // namespace spf
