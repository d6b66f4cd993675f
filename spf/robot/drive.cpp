#include "spf/robot/drive.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "spf/math/angles.hpp"

namespace spf {
namespace {

constexpr double kLeastSpeed = 1e-9;  // [m/s] slower, a car stands

std::vector<double> around(int wheels, double first_angle) {
  std::vector<double> angles;
  angles.reserve(static_cast<std::size_t>(wheels));
  for (int i = 0; i < wheels; ++i) angles.push_back(first_angle + 2.0 * kPi / wheels * i);
  return angles;
}

}  // namespace

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

Drive::Drive(const RobotParameters& robot)
    : type_{validated(robot).drive}, wheel_base_{robot.wheel_base}, min_turning_radius_{0.0} {
  if (type_ == DriveType::car) {
    min_turning_radius_ = robot.min_turning_radius;
    const double largest_angle = std::atan(wheel_base_ / min_turning_radius_);
    upper_ = Eigen::Vector2d{robot.max_wheel_speed, largest_angle};
    lower_ = Eigen::Vector2d{robot.may_reverse ? -robot.max_wheel_speed : 0.0, -largest_angle};
    return;
  }
  set_wheels(robot);
  upper_ = DriveInput::Constant(wheel_from_body_.rows(), robot.max_wheel_speed);
  lower_ = -upper_;
}

Drive::Drive(const RobotParameters& robot, const std::vector<double>& wheel_angles)
    : type_{DriveType::omni}, wheel_base_{validated(robot).wheel_base}, min_turning_radius_{0.0} {
  const auto count = wheel_angles.size();
  if (count < 3 || count > kMaxDriveInputs)
    throw std::invalid_argument("a robot has 3 to " + std::to_string(kMaxDriveInputs) + " omni wheels, not " +
                                std::to_string(count));
  set_omni_wheels(wheel_angles, robot.wheel_arm);
  const Eigen::Matrix3d gram = wheel_from_body_.transpose() * wheel_from_body_;
  Eigen::FullPivLU<Eigen::Matrix3d> solver{gram};
  solver.setThreshold(1e-6);
  if (!gram.allFinite() || !solver.isInvertible())
    throw std::invalid_argument("omni wheels at these angles cannot move the robot every way");
  keep_inverse(solver.solve(wheel_from_body_.transpose()));
  upper_ = DriveInput::Constant(wheel_from_body_.rows(), robot.max_wheel_speed);
  lower_ = -upper_;
}

// The columns of these are orthogonal, so that the pseudo-inverse is exact: the transpose over their squares.
void Drive::set_wheels(const RobotParameters& robot) {
  const double arm = robot.wheel_arm;
  Eigen::Vector3d squares{4.0, 4.0, 4.0 * arm * arm};
  switch (type_) {
    case DriveType::omni:
      set_omni_wheels(around(robot.wheels, robot.first_wheel_angle), arm);
      squares = {0.5 * robot.wheels, 0.5 * robot.wheels, robot.wheels * arm * arm};
      break;
    case DriveType::mecanum:
      wheel_from_body_.resize(4, 3);
      wheel_from_body_ << 1, -1, -arm, 1, 1, arm, 1, 1, -arm, 1, -1, arm;
      break;
    case DriveType::differential:
      wheel_from_body_.resize(2, 3);
      wheel_from_body_ << 1, 0, -arm, 1, 0, arm;
      squares = {2.0, 1.0, 2.0 * arm * arm};  // of the second any: the column is zero
      break;
    case DriveType::car:
      break;
  }
  keep_inverse(squares.cwiseInverse().asDiagonal() * wheel_from_body_.transpose());
}

/// W: row i = [sin(phi_i), -cos(phi_i), -arm].
void Drive::set_omni_wheels(const std::vector<double>& angles, double arm) {
  wheel_from_body_.resize(static_cast<Eigen::Index>(angles.size()), 3);
  Eigen::Index row = 0;
  for (const double angle : angles) wheel_from_body_.row(row++) << std::sin(angle), -std::cos(angle), -arm;
}

void Drive::keep_inverse(const DriveJacobian& body_from_wheel) {
  body_from_wheel_ = body_from_wheel;
  if (wheel_from_body_.rows() != 3) return;
  three_from_body_ = wheel_from_body_;
  body_from_three_ = body_from_wheel_;
}

Eigen::Vector3d Drive::twist_body(const DriveInput& input) const {
  if (type_ == DriveType::car) return {input[0], 0.0, input[0] * std::tan(input[1]) / wheel_base_};
  if (input.size() == 3) return body_from_three_ * input.head<3>();
  return body_from_wheel_ * input;
}

Eigen::Vector3d Drive::twist_world(const DriveInput& input, double heading) const {
  return twist_in_world(twist_body(input), heading);
}

DriveJacobian Drive::jacobian(const DriveInput& input) const {
  if (type_ != DriveType::car) return body_from_wheel_;
  const double curvature = std::tan(input[1]) / wheel_base_;
  const double cosine = std::cos(input[1]);
  DriveJacobian jacobian(3, 2);
  jacobian << 1.0, 0.0, 0.0, 0.0, curvature, input[0] / (wheel_base_ * cosine * cosine);
  return jacobian;
}

DriveInput Drive::input_for(const Eigen::Vector3d& twist_body, double steering_angle) const {
  if (inputs() == 3) return three_from_body_ * twist_body;
  if (type_ != DriveType::car) return wheel_from_body_ * twist_body;
  const double speed = twist_body.x();
  if (std::abs(speed) > kLeastSpeed) steering_angle = std::atan(wheel_base_ * twist_body.z() / speed);
  return Eigen::Vector2d{speed, steering_angle};
}

double Drive::scale_to_limit(const DriveInput& input) const {
  double scale = std::numeric_limits<double>::infinity();
  const Eigen::Index driven = type_ == DriveType::car ? 1 : input.size();
  for (Eigen::Index i = 0; i < driven; ++i) {
    if (input[i] == 0.0) continue;
    scale = std::min(scale, (input[i] > 0.0 ? upper_[i] : lower_[i]) / input[i]);
  }
  return scale;
}

DriveInput Drive::saturated(const DriveInput& input) const {
  if (input.size() != upper_.size() || !input.allFinite()) return standstill();
  DriveInput result = input;
  const double scale = scale_to_limit(input);
  if (scale < 1.0) {
    if (type_ == DriveType::car)
      result[0] *= scale;
    else
      result *= scale;
  }
  return result.cwiseMax(lower_).cwiseMin(upper_);  // rounding may leave the fastest wheel an ulp outside
}

Eigen::Vector3d Drive::possible(const Eigen::Vector3d& twist_body) const {
  if (holonomic()) return twist_body;
  Eigen::Vector3d twist{twist_body.x(), 0.0, twist_body.z()};
  if (type_ == DriveType::car) {
    if (!may_reverse()) twist.x() = std::max(0.0, twist.x());
    const double fastest_turn = std::abs(twist.x()) / min_turning_radius_;
    twist.z() = std::clamp(twist.z(), -fastest_turn, fastest_turn);
  }
  return twist;
}

}  // namespace spf
