// Kinematics of a robot on three omni wheels: rim speeds from the motion of the body and back (eq. 14), and
// the rotation between body and world (eq. 16). Eq. 14 as printed swaps sine and cosine of 60 deg, which does
// not describe a robot with wheels every 120 deg (its drive directions are -90, 60 and 120 deg). Here the
// matrix is built from the wheels' angles; the paper's signs are kept. Frames: world; body (x along the axle
// of wheel 1 when first_wheel_angle is 0). A twist is (x, y, yaw rate) [m/s, m/s, rad/s]; wheel speeds are
// speeds of the rim [m/s].
#pragma once

#include <Eigen/Core>

#include "spf/robot/robot_parameters.hpp"

namespace spf {

/// A(heading) of eq. 16: the rotation of a twist, or of a wrench, from body into world. The yaw entry is
/// kept.
[[nodiscard]] Eigen::Matrix3d world_from_body(double heading);

/// The same motion seen from the body frame, and from the world.
[[nodiscard]] Eigen::Vector3d twist_in_body(const Eigen::Vector3d& twist_world, double heading);
[[nodiscard]] Eigen::Vector3d twist_in_world(const Eigen::Vector3d& twist_body, double heading);

/// Immutable. Queries never allocate and never throw.
class OmniKinematics {
 public:
  /// Throws std::invalid_argument on parameters out of range.
  explicit OmniKinematics(const RobotParameters& parameters);

  /// W: row i = [sin(phi_i), -cos(phi_i), -arm] with phi_i = first_wheel_angle + 120 deg * i.
  [[nodiscard]] const Eigen::Matrix3d& wheel_from_body() const { return wheel_from_body_; }
  /// W^-1 = diag(2/3, 2/3, 1 / (3 arm^2)) W^T, exact because the columns of W are orthogonal.
  [[nodiscard]] const Eigen::Matrix3d& body_from_wheel() const { return body_from_wheel_; }

  /// Rim speeds [m/s] of a motion of the body.
  [[nodiscard]] Eigen::Vector3d wheel_speeds(const Eigen::Vector2d& velocity_body, double yaw_rate) const;
  [[nodiscard]] Eigen::Vector3d wheel_speeds_from_world(const Eigen::Vector3d& twist_world,
                                                        double heading) const;
  /// The motion that rim speeds [m/s] cause, without wheel slip.
  [[nodiscard]] Eigen::Vector3d twist_body(const Eigen::Vector3d& wheel_speeds) const;
  [[nodiscard]] Eigen::Vector3d twist_world(const Eigen::Vector3d& wheel_speeds, double heading) const;

  /// Limit of every rim speed [m/s], in both directions.
  [[nodiscard]] double max_wheel_speed() const { return max_wheel_speed_; }
  /// The largest factor by which these wheel speeds may be multiplied within the limits: below 1 when they
  /// exceed them, infinite at standstill. Slowing a motion down in time by it scales all its velocities.
  [[nodiscard]] double scale_to_limit(const Eigen::Vector3d& wheel_speeds) const;
  /// The wheel speeds themselves when within the limits, else scaled down together: the direction of motion
  /// and the ratio of turning to driving are kept. Anything not finite stops the robot.
  [[nodiscard]] Eigen::Vector3d saturated(const Eigen::Vector3d& wheel_speeds) const;

 private:
  Eigen::Matrix3d wheel_from_body_;
  Eigen::Matrix3d body_from_wheel_;
  double max_wheel_speed_;  // [m/s]
};

}  // namespace spf
