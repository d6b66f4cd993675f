#include "spf/robot/drive_dynamics.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <stdexcept>

#include "spf/math/angles.hpp"
#include "spf/robot/omni_kinematics.hpp"

namespace spf {
namespace {

constexpr double kGravity = 9.81;  // [m/s^2]

}  // namespace

DriveDynamics::DriveDynamics(const DriveDesign& design, const DriveBody& body, const Pose2& pose_world)
    : drive_{design},
      body_{body},
      wheel_base_{design.wheel_base},
      inertia_{body.mass, body.mass, body.inertia},
      pose_world_{pose_world} {
  if (!(body.mass > 0.0 && body.inertia > 0.0 && body.wheel_radius > 0.0 && body.friction > 0.0))
    throw std::invalid_argument("mass, inertia, wheel_radius and friction must be positive");
  torques_ = DriveInput::Zero(drive_.type() == DriveType::car ? 1 : drive_.inputs());
}

Eigen::Vector3d DriveDynamics::twist_world() const {
  return twist_in_world(twist_body_, pose_world_.heading);
}

DriveInput DriveDynamics::input() const {
  return drive_.input_for(twist_body_, steering_angle_);
}

double DriveDynamics::kinetic_energy() const {
  return 0.5 * twist_body_.dot(inertia_.cwiseProduct(twist_body_));
}

double DriveDynamics::curvature() const {
  return std::tan(steering_angle_) / wheel_base_;
}

void DriveDynamics::step(double dt, const DriveInput& command) {
  assert(dt > 0.0);
  DriveInput wanted = drive_.standstill();
  if (command.size() == wanted.size() && command.allFinite())
    wanted = command.cwiseMax(drive_.lower()).cwiseMin(drive_.upper());
  // What the speed loops demand at the end of the step.
  const double approach = body_.motor_lag > 0.0 ? -std::expm1(-dt / body_.motor_lag) : 1.0;
  const DriveInput now = input();
  wanted = now + approach * (wanted - now);
  switch (drive_.type()) {
    case DriveType::omni:
    case DriveType::mecanum:
      return step_omni(dt, wanted);
    case DriveType::differential:
      return step_differential(dt, wanted);
    case DriveType::car:
      return step_car(dt, wanted[0], wanted[1]);
  }
}

/// The least torques that exert a wrench: W^+^T R wrench.
DriveInput DriveDynamics::motors_for(const Eigen::Vector3d& wrench_body) const {
  return body_.wheel_radius * (drive_.jacobian(drive_.standstill()).transpose() * wrench_body);
}

DriveInput DriveDynamics::clipped(const DriveInput& torques) const {
  // Every driven wheel carries its share of the weight.
  const double grip = body_.friction * body_.mass * kGravity * body_.wheel_radius /
                      static_cast<double>(std::max<Eigen::Index>(1, torques.size()));
  const double most = std::min(body_.max_wheel_torque, grip);
  return torques.cwiseMax(-most).cwiseMin(most);
}

// As OmniDynamics::step(): the force turns with the body, so it acts along the axes of the mid-step.
void DriveDynamics::step_omni(double dt, const DriveInput& wanted) {
  const double heading = pose_world_.heading;
  const Eigen::Vector3d before = twist_world();
  const Eigen::Vector3d wanted_body = drive_.twist_body(wanted);
  const double wanted_turn = 0.5 * dt * (before.z() + wanted_body.z());
  const Eigen::Vector3d wanted_change = twist_in_world(wanted_body, heading + wanted_turn) - before;
  const Eigen::Vector3d wanted_wrench =
      twist_in_body(inertia_.cwiseProduct(wanted_change) / dt, heading + 0.5 * wanted_turn);
  torques_ = clipped(motors_for(wanted_wrench));
  const Eigen::Vector3d wrench = drive_.wheel_from_body().transpose() * torques_ / body_.wheel_radius;
  const double turn = dt * (before.z() + 0.5 * dt * wrench.z() / inertia_.z());
  const Eigen::Vector3d after =
      before + dt * twist_in_world(wrench, heading + 0.5 * turn).cwiseQuotient(inertia_);
  pose_world_.position_world += 0.5 * dt * (before + after).head<2>();
  pose_world_.heading = wrap_angle(heading + turn);
  twist_body_ = twist_in_body(after, heading + turn);
}

void DriveDynamics::step_differential(double dt, const DriveInput& wanted) {
  const Eigen::Vector3d before = twist_body_;
  const Eigen::Vector3d change = drive_.twist_body(wanted) - before;
  torques_ = clipped(motors_for(inertia_.cwiseProduct(change) / dt));
  const Eigen::Vector3d wrench = drive_.wheel_from_body().transpose() * torques_ / body_.wheel_radius;
  twist_body_ = before + dt * wrench.cwiseQuotient(inertia_);
  const Eigen::Vector3d mean = 0.5 * (before + twist_body_);
  move_along(dt * mean.x(), dt * mean.z());
}

// One freedom: at the steering angle a, with the curvature c(a), the kinetic energy is m(a) v^2 / 2 for m(a)
// = mass + inertia c^2. Steering changes m; with p = sqrt(m) v the work of the force is exactly the change of
// p^2 / 2.
void DriveDynamics::step_car(double dt, double wanted_speed, double wanted_angle) {
  const double before = curvature();
  const double speed = twist_body_.x();
  const double farthest = body_.max_steering_rate * dt;
  steering_angle_ += std::clamp(wanted_angle - steering_angle_, -farthest, farthest);
  const double after = curvature();
  const auto root_of_mass = [this](double c) { return std::sqrt(body_.mass + body_.inertia * c * c); };
  const double middle = root_of_mass(0.5 * (before + after));
  const double momentum = root_of_mass(before) * speed;
  const double force = (root_of_mass(after) * wanted_speed - momentum) * middle / dt;
  torques_ = clipped(DriveInput::Constant(1, body_.wheel_radius * force));
  const double momentum_after = momentum + dt * torques_[0] / body_.wheel_radius / middle;
  const double new_speed = momentum_after / root_of_mass(after);
  const double distance = dt * (momentum + momentum_after) / (2.0 * middle);
  twist_body_ = {new_speed, 0.0, new_speed * after};
  move_along(distance, 0.5 * (before + after) * distance);
}

/// Along an arc: its chord lies along the heading of the mid-step.
void DriveDynamics::move_along(double distance, double turn) {
  const double half = 0.5 * turn;
  const double chord = std::abs(half) < 1e-6 ? distance : distance * std::sin(half) / half;
  const double middle = pose_world_.heading + half;
  pose_world_.position_world += chord * Eigen::Vector2d{std::cos(middle), std::sin(middle)};
  pose_world_.heading = wrap_angle(pose_world_.heading + turn);
}

}  // namespace spf
