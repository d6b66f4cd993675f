#include "spf/robot/omni_kinematics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "spf/math/angles.hpp"

namespace spf {

Eigen::Matrix3d world_from_body(double heading) {
  const double c = std::cos(heading);
  const double s = std::sin(heading);
  Eigen::Matrix3d rotation;
  rotation << c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0;
  return rotation;
}

Eigen::Vector3d twist_in_body(const Eigen::Vector3d& twist_world, double heading) {
  const double c = std::cos(heading);
  const double s = std::sin(heading);
  return {c * twist_world.x() + s * twist_world.y(), -s * twist_world.x() + c * twist_world.y(),
          twist_world.z()};
}

Eigen::Vector3d twist_in_world(const Eigen::Vector3d& twist_body, double heading) {
  return twist_in_body(twist_body, -heading);
}

OmniKinematics::OmniKinematics(const RobotParameters& parameters) {
  const RobotParameters checked = validated(parameters);
  for (int wheel = 0; wheel < 3; ++wheel) {
    const double angle = checked.first_wheel_angle + 2.0 * kPi / 3.0 * wheel;
    wheel_from_body_.row(wheel) << std::sin(angle), -std::cos(angle), -checked.wheel_arm;
  }
  const Eigen::Vector3d column_norms{1.5, 1.5, 3.0 * checked.wheel_arm * checked.wheel_arm};
  body_from_wheel_ = column_norms.cwiseInverse().asDiagonal() * wheel_from_body_.transpose();
  max_wheel_speed_ = checked.max_wheel_speed;
}

Eigen::Vector3d OmniKinematics::wheel_speeds(const Eigen::Vector2d& velocity_body, double yaw_rate) const {
  return wheel_from_body_ * Eigen::Vector3d{velocity_body.x(), velocity_body.y(), yaw_rate};
}

Eigen::Vector3d OmniKinematics::wheel_speeds_from_world(const Eigen::Vector3d& twist_world,
                                                        double heading) const {
  return wheel_from_body_ * twist_in_body(twist_world, heading);
}

Eigen::Vector3d OmniKinematics::twist_body(const Eigen::Vector3d& wheel_speeds) const {
  return body_from_wheel_ * wheel_speeds;
}

Eigen::Vector3d OmniKinematics::twist_world(const Eigen::Vector3d& wheel_speeds, double heading) const {
  return twist_in_world(body_from_wheel_ * wheel_speeds, heading);
}

double OmniKinematics::scale_to_limit(const Eigen::Vector3d& wheel_speeds) const {
  const double fastest = wheel_speeds.cwiseAbs().maxCoeff();
  return fastest > 0.0 ? max_wheel_speed_ / fastest : std::numeric_limits<double>::infinity();
}

Eigen::Vector3d OmniKinematics::saturated(const Eigen::Vector3d& wheel_speeds) const {
  if (!wheel_speeds.allFinite()) return Eigen::Vector3d::Zero();
  const double scale = scale_to_limit(wheel_speeds);
  if (scale >= 1.0) return wheel_speeds;
  // Rounding may leave the fastest wheel an ulp outside.
  return (scale * wheel_speeds).cwiseMax(-max_wheel_speed_).cwiseMin(max_wheel_speed_);
}

}  // namespace spf
