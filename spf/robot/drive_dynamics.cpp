#include "spf/robot/drive_dynamics.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "spf/math/angles.hpp"

namespace spf {
namespace {

constexpr double kGravity = 9.81;  // [m/s^2]

/// Of one motor: more than friction times its share of the weight does not reach the ground.
double largest_torque(const RobotParameters& robot, int motors) {
  return std::min(robot.max_wheel_torque,
                  robot.friction * robot.mass * kGravity * robot.wheel_radius / motors);
}

int motors_of(const Drive& drive) {
  return drive.type() == DriveType::car ? 1 : drive.inputs();
}

}  // namespace

DriveDynamics::DriveDynamics(const RobotParameters& robot, const PlantState& initial)
    : DriveDynamics{robot, Drive{robot}, initial} {}

DriveDynamics::DriveDynamics(const RobotParameters& robot, const Drive& drive, const PlantState& initial)
    : robot_{validated(robot)},
      drive_{drive},
      inertia_{robot_.mass, robot_.mass, robot_.inertia},
      largest_torque_{largest_torque(robot_, motors_of(drive))},
      state_{initial},
      torques_{DriveInput::Zero(motors_of(drive))} {
  if (drive_.holonomic()) return;
  const Eigen::Vector3d possible = drive_.possible(twist_body());
  state_.twist_world = twist_in_world(possible, state_.pose_world.heading);
  if (drive_.type() == DriveType::car) steering_angle_ = drive_.input_for(possible)[1];
}

DriveInput DriveDynamics::input() const {
  return drive_.input_for(twist_body(), steering_angle_);
}

double DriveDynamics::kinetic_energy() const {
  return 0.5 * state_.twist_world.dot(inertia_.cwiseProduct(state_.twist_world));
}

double DriveDynamics::curvature() const {
  return std::tan(steering_angle_) / robot_.wheel_base;
}

Eigen::Vector3d DriveDynamics::wrench_body(const DriveInput& torques) const {
  if (drive_.type() == DriveType::car) return {torques[0] / robot_.wheel_radius, 0.0, 0.0};
  if (drive_.inputs() == 3) {
    const Eigen::Matrix3d wheels = drive_.wheel_from_body();
    return wheels.transpose() * torques.head<3>() / robot_.wheel_radius;
  }
  return drive_.wheel_from_body().transpose() * torques / robot_.wheel_radius;
}

DriveInput DriveDynamics::torques_for(const Eigen::Vector3d& wrench_body) const {
  if (drive_.type() == DriveType::car) return DriveInput::Constant(1, robot_.wheel_radius * wrench_body.x());
  const DriveJacobian body_from_wheel = drive_.jacobian(drive_.standstill());
  if (drive_.inputs() == 3) {
    const Eigen::Matrix3d of_three = body_from_wheel;
    return robot_.wheel_radius * (of_three.transpose() * wrench_body);
  }
  return robot_.wheel_radius * (body_from_wheel.transpose() * wrench_body);
}

DriveInput DriveDynamics::clipped(const DriveInput& torques) const {
  return torques.cwiseMax(-largest_torque_).cwiseMin(largest_torque_);
}

double DriveDynamics::max_acceleration_along(const Eigen::Vector2d& direction_body) const {
  const Eigen::Vector2d unit = drive_.holonomic() ? direction_body.normalized() : Eigen::Vector2d{1.0, 0.0};
  return largest_torque_ /
         torques_for(inertia_.cwiseProduct(Eigen::Vector3d{unit.x(), unit.y(), 0.0})).cwiseAbs().maxCoeff();
}

double DriveDynamics::max_acceleration_anywhere() const {
  if (!drive_.holonomic()) return max_acceleration_along({1.0, 0.0});
  // A wheel is strained most by a motion along its own rim.
  double least = std::numeric_limits<double>::infinity();
  for (int wheel = 0; wheel < drive_.inputs(); ++wheel)
    least = std::min(least, max_acceleration_along(drive_.wheel_from_body().row(wheel).head<2>()));
  return least;
}

double DriveDynamics::max_yaw_acceleration() const {
  if (!drive_.turns_on_the_spot()) return 0.0;
  return largest_torque_ / torques_for({0.0, 0.0, inertia_.z()}).cwiseAbs().maxCoeff();
}

void DriveDynamics::step(double dt, const DriveInput& command) {
  assert(dt > 0.0);
  DriveInput wanted = drive_.standstill();
  if (command.size() == wanted.size() && command.allFinite())
    wanted = command.cwiseMax(drive_.lower()).cwiseMin(drive_.upper());
  // What the speed loops demand at the end of the step.
  const double approach = robot_.motor_lag > 0.0 ? -std::expm1(-dt / robot_.motor_lag) : 1.0;
  const DriveInput now = input();
  wanted = now + approach * (wanted - now);
  switch (drive_.type()) {
    case DriveType::omni:
    case DriveType::mecanum:
      return step_holonomic(dt, wanted);
    case DriveType::differential:
      return step_differential(dt, wanted);
    case DriveType::car:
      return step_car(dt, wanted[0], wanted[1]);
  }
}

void DriveDynamics::step_holonomic(double dt, const DriveInput& wanted) {
  const double heading = state_.pose_world.heading;
  const Eigen::Vector3d twist_world = state_.twist_world;
  const Eigen::Vector3d wanted_body = drive_.twist_body(wanted);

  // 1. The wrench and the torques that lead there. Wrenches act along the body axes of the mid-step, so that
  // the force
  //    that turns the velocity with the body (centripetal) is part of the demand.
  const double wanted_turn = 0.5 * dt * (twist_world.z() + wanted_body.z());
  const Eigen::Vector3d wanted_change = twist_in_world(wanted_body, heading + wanted_turn) - twist_world;
  const Eigen::Vector3d wanted_wrench =
      twist_in_body(inertia_.cwiseProduct(wanted_change) / dt, heading + 0.5 * wanted_turn);
  torques_ = clipped(torques_for(wanted_wrench));

  // 2. The motion under the clipped torques: yaw first, since the force turns with the body; then trapezoids,
  // for which
  //    the work of the force is exactly the change of kinetic energy.
  const Eigen::Vector3d wrench = wrench_body(torques_);
  const double yaw_rate = twist_world.z() + dt * wrench.z() / inertia_.z();
  const double turn = 0.5 * dt * (twist_world.z() + yaw_rate);
  const Eigen::Vector3d wrench_world = twist_in_world(wrench, heading + 0.5 * turn);
  state_.twist_world += dt * wrench_world.cwiseQuotient(inertia_);
  state_.pose_world.position_world += 0.5 * dt * (twist_world + state_.twist_world).head<2>();
  state_.pose_world.heading = wrap_angle(heading + turn);
}

void DriveDynamics::step_differential(double dt, const DriveInput& wanted) {
  const Eigen::Vector3d before = twist_body();
  const Eigen::Vector3d change = drive_.twist_body(wanted) - before;
  torques_ = clipped(torques_for(inertia_.cwiseProduct(change) / dt));
  const Eigen::Vector3d after = before + dt * wrench_body(torques_).cwiseQuotient(inertia_);
  const Eigen::Vector3d mean = 0.5 * (before + after);
  move_along(dt * mean.x(), dt * mean.z(), {after.x(), 0.0, after.z()});
}

// One freedom: at the steering angle a, with the curvature c(a), the kinetic energy is m(a) v^2 / 2 for m(a)
// = mass + inertia c^2. Steering changes m; with p = sqrt(m) v the work of the force is exactly the change of
// p^2 / 2.
void DriveDynamics::step_car(double dt, double wanted_speed, double wanted_angle) {
  const double before = curvature();
  const double speed = twist_body().x();
  const double farthest = robot_.max_steering_rate * dt;
  steering_angle_ += std::clamp(wanted_angle - steering_angle_, -farthest, farthest);
  const double after = curvature();
  const auto root_of_mass = [this](double c) { return std::sqrt(robot_.mass + robot_.inertia * c * c); };
  const double middle = root_of_mass(0.5 * (before + after));
  const double momentum = root_of_mass(before) * speed;
  const double force = (root_of_mass(after) * wanted_speed - momentum) * middle / dt;
  torques_ = clipped(DriveInput::Constant(1, robot_.wheel_radius * force));
  const double momentum_after = momentum + dt * torques_[0] / robot_.wheel_radius / middle;
  const double new_speed = momentum_after / root_of_mass(after);
  const double distance = dt * (momentum + momentum_after) / (2.0 * middle);
  move_along(distance, 0.5 * (before + after) * distance, {new_speed, 0.0, new_speed * after});
}

/// Along an arc: its chord lies along the heading of the mid-step. Then the body moves by a twist.
void DriveDynamics::move_along(double distance, double turn, const Eigen::Vector3d& twist_body) {
  Pose2& pose = state_.pose_world;
  const double half = 0.5 * turn;
  const double chord = std::abs(half) < 1e-6 ? distance : distance * std::sin(half) / half;
  const double middle = pose.heading + half;
  pose.position_world += chord * Eigen::Vector2d{std::cos(middle), std::sin(middle)};
  pose.heading = wrap_angle(pose.heading + turn);
  state_.twist_world = twist_in_world(twist_body, pose.heading);
}

RobotParameters within_drive(RobotParameters robot) {
  robot.max_acceleration = std::min(robot.max_acceleration, DriveDynamics{robot}.max_acceleration_anywhere());
  return robot;
}

}  // namespace spf
