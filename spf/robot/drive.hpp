// The drive of a ground robot as a value: what its wheels can do, whatever their number and kind. A closed
// set: omni wheels (three or more), four mecanum wheels, a differential drive, a car. Everything else asks
// it. Omni wheels are those of eq. 14, whose matrix as printed swaps sine and cosine of 60 deg, which does
// not describe a robot with wheels every 120 deg (its drive directions are -90, 60 and 120 deg); here it is
// built from the wheels' angles, with the paper's signs. Frames: world; body (x ahead; along the axle of
// wheel 1 when first_wheel_angle is 0). A twist is (x, y, yaw rate) [m/s, m/s, rad/s].
#pragma once

#include <Eigen/Core>

#include <vector>

#include "spf/robot/robot_parameters.hpp"

namespace spf {

/// What is commanded: rim speeds [m/s] of the wheels, of omni wheels around the body, of
/// others left before right and front before rear; of a car the rim speed of
/// its rear axle [m/s] and the steering angle [rad], positive to the left. Never allocates.
using DriveInput = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, kMaxDriveInputs, 1>;
/// Of a twist by the inputs.
using DriveJacobian = Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::ColMajor, 3, kMaxDriveInputs>;

/// How many of them are rim speeds, the first ones.
[[nodiscard]] constexpr int rims_of(DriveType drive, int inputs) {
  return drive == DriveType::car ? 1 : inputs;
}

/// Rotation of a twist, or of a wrench, between world and body (A of eq. 16). The yaw entry is kept.
[[nodiscard]] Eigen::Matrix3d world_from_body(double heading);
[[nodiscard]] Eigen::Vector3d twist_in_body(const Eigen::Vector3d& twist_world, double heading);
[[nodiscard]] Eigen::Vector3d twist_in_world(const Eigen::Vector3d& twist_body, double heading);

/// Immutable. Queries never allocate and never throw.
class Drive {
 public:
  /// Throws std::invalid_argument on parameters out of range.
  explicit Drive(const RobotParameters& robot);
  /// Omni wheels whose axles stand at these angles [rad] in the body. Throws std::invalid_argument, too, when
  /// there are fewer than three or they cannot move the robot every way.
  Drive(const RobotParameters& robot, const std::vector<double>& wheel_angles);

  [[nodiscard]] DriveType type() const { return type_; }
  [[nodiscard]] int inputs() const { return static_cast<int>(upper_.size()); }
  /// May move along and turn about every axis at once.
  [[nodiscard]] bool holonomic() const { return type_ == DriveType::omni || type_ == DriveType::mecanum; }
  [[nodiscard]] bool turns_on_the_spot() const { return type_ != DriveType::car; }
  [[nodiscard]] bool may_reverse() const { return lower_[0] < 0.0; }
  /// [m] 0 where it turns on the spot.
  [[nodiscard]] double min_turning_radius() const { return min_turning_radius_; }

  /// The motion that inputs cause, without wheel slip; of too many rim speeds for three freedoms the
  /// least-squares one.
  [[nodiscard]] Eigen::Vector3d twist_body(const DriveInput& input) const;
  [[nodiscard]] Eigen::Vector3d twist_world(const DriveInput& input, double heading) const;
  /// Likewise of the motion in world.
  [[nodiscard]] DriveInput input_from_world(const Eigen::Vector3d& twist_world, double heading) const {
    return input_for(twist_in_body(twist_world, heading));
  }
  /// Of twist_body() at an input; constant but for a car.
  [[nodiscard]] DriveJacobian jacobian(const DriveInput& input) const;
  /// Inputs for a motion of the body, perhaps beyond the limits. What the drive cannot do is left out:
  /// sideways motion of differential drives and cars, turning on the spot of cars, which keep the
  /// `steering_angle` [rad] they have when they stand.
  [[nodiscard]] DriveInput input_for(const Eigen::Vector3d& twist_body, double steering_angle = 0.0) const;
  /// All zero; a car steers straight ahead.
  [[nodiscard]] DriveInput standstill() const { return DriveInput::Zero(inputs()); }

  /// The first so many inputs are rim speeds.
  [[nodiscard]] int rims() const { return rims_of(type_, inputs()); }
  [[nodiscard]] double max_wheel_speed() const { return upper_[0]; }  ///< [m/s] of a rim
  [[nodiscard]] const DriveInput& lower() const { return lower_; }    ///< limits of the inputs
  [[nodiscard]] const DriveInput& upper() const { return upper_; }
  /// The inputs themselves when within the limits. Else rim speeds are scaled down together, so that the path
  /// is kept; a steering angle is clipped. Anything not finite stops the robot.
  [[nodiscard]] DriveInput saturated(const DriveInput& input) const;
  /// The largest factor by which the motion may be sped up within the limits: below 1 when they are exceeded,
  /// infinite at standstill.
  [[nodiscard]] double scale_to_limit(const DriveInput& input) const;
  /// The nearest motion that the drive can do, apart from its limits of speed: no sideways motion, no tighter
  /// turn.
  [[nodiscard]] Eigen::Vector3d possible(const Eigen::Vector3d& twist_body) const;

  /// Rows: rim speeds by the motion of the body. Empty for a car.
  [[nodiscard]] const Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::ColMajor, kMaxDriveInputs, 3>&
  wheel_from_body() const {
    return wheel_from_body_;
  }

 private:
  void set_wheels(const RobotParameters& robot);
  void set_omni_wheels(const std::vector<double>& angles, double arm);
  void keep_inverse(const DriveJacobian& body_from_wheel);

  DriveType type_;
  double wheel_base_;          // [m]
  double min_turning_radius_;  // [m]
  Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::ColMajor, kMaxDriveInputs, 3> wheel_from_body_;
  DriveJacobian body_from_wheel_;
  // Of three wheels, again: products of fixed size are quicker.
  Eigen::Matrix3d three_from_body_, body_from_three_;
  DriveInput lower_, upper_;
};

}  // namespace spf
