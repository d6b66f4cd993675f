#include "spf/robot/drive.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "spf/robot/omni_kinematics.hpp"

namespace spf {
namespace {

constexpr double kLeastSpeed = 1e-9;  // [m/s] slower, a car stands

void require_positive(const char* name, double value) {
  if (value > 0.0 && std::isfinite(value)) return;
  throw std::invalid_argument(std::string{name} + " = " + std::to_string(value) + " must be positive");
}

}  // namespace

Drive::Drive(const DriveDesign& design)
    : type_{design.type}, wheel_base_{design.wheel_base}, min_turning_radius_{0.0} {
  require_positive("max_wheel_speed", design.max_wheel_speed);
  if (type_ == DriveType::car) {
    require_positive("wheel_base", design.wheel_base);
    require_positive("min_turning_radius", design.min_turning_radius);
    min_turning_radius_ = design.min_turning_radius;
    const double largest_angle = std::atan(wheel_base_ / min_turning_radius_);
    upper_ = Eigen::Vector2d{design.max_wheel_speed, largest_angle};
    lower_ = Eigen::Vector2d{design.may_reverse ? -design.max_wheel_speed : 0.0, -largest_angle};
    return;
  }
  require_positive("wheel_arm", design.wheel_arm);
  set_wheels(design);
  upper_ = DriveInput::Constant(wheel_from_body_.rows(), design.max_wheel_speed);
  lower_ = -upper_;
}

void Drive::set_wheels(const DriveDesign& design) {
  const double arm = design.wheel_arm;
  switch (type_) {
    case DriveType::omni: {
      const auto count = static_cast<int>(design.wheel_angles.size());
      if (count < 3 || count > kMaxDriveInputs)
        throw std::invalid_argument("a robot has 3 to " + std::to_string(kMaxDriveInputs) +
                                    " omni wheels, not " + std::to_string(count));
      wheel_from_body_.resize(count, 3);
      for (int i = 0; i < count; ++i) {
        const double angle = design.wheel_angles[static_cast<std::size_t>(i)];
        wheel_from_body_.row(i) << std::sin(angle), -std::cos(angle), -arm;
      }
      break;
    }
    case DriveType::mecanum:  // front left, front right, rear left, rear right
      wheel_from_body_.resize(4, 3);
      wheel_from_body_ << 1, -1, -arm, 1, 1, arm, 1, 1, -arm, 1, -1, arm;
      break;
    case DriveType::differential:  // left, right
      wheel_from_body_.resize(2, 3);
      wheel_from_body_ << 1, 0, -arm, 1, 0, arm;
      break;
    case DriveType::car:
      return;
  }
  // The pseudo-inverse on the motions that the drive can do.
  Eigen::Matrix3d gram = wheel_from_body_.transpose() * wheel_from_body_;
  if (type_ == DriveType::differential) gram(1, 1) = 1.0;
  Eigen::FullPivLU<Eigen::Matrix3d> solver{gram};
  solver.setThreshold(1e-6);
  if (!gram.allFinite() || !solver.isInvertible())
    throw std::invalid_argument("omni wheels at these angles cannot move the robot every way");
  body_from_wheel_ = solver.solve(wheel_from_body_.transpose());
}

Eigen::Vector3d Drive::twist_body(const DriveInput& input) const {
  if (type_ == DriveType::car) return {input[0], 0.0, input[0] * std::tan(input[1]) / wheel_base_};
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
