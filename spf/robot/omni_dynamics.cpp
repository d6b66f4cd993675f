#include "spf/robot/omni_dynamics.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "spf/math/angles.hpp"

namespace spf {

OmniDynamics::OmniDynamics(const RobotParameters& parameters, const PlantState& initial)
    : parameters_{validated(parameters)},
      kinematics_{parameters_},
      inertia_{parameters_.mass, parameters_.mass, parameters_.inertia},
      state_{initial} {}

Eigen::Vector3d OmniDynamics::wheel_speeds() const {
  return kinematics_.wheel_speeds_from_world(state_.twist_world, state_.pose_world.heading);
}

Eigen::Vector3d OmniDynamics::wrench_body(const Eigen::Vector3d& wheel_torques) const {
  return kinematics_.wheel_from_body().transpose() * wheel_torques / parameters_.wheel_radius;
}

Eigen::Vector3d OmniDynamics::torques_for(const Eigen::Vector3d& wrench_body) const {
  return parameters_.wheel_radius * (kinematics_.body_from_wheel().transpose() * wrench_body);
}

Eigen::Vector3d OmniDynamics::torques_for_acceleration(const Eigen::Vector3d& acceleration_body) const {
  return torques_for(inertia_.cwiseProduct(acceleration_body));
}

double OmniDynamics::max_acceleration_along(const Eigen::Vector2d& direction_body) const {
  const Eigen::Vector2d unit = direction_body.normalized();
  return parameters_.max_wheel_torque /
         torques_for_acceleration({unit.x(), unit.y(), 0.0}).cwiseAbs().maxCoeff();
}

void OmniDynamics::step(double dt, const Eigen::Vector3d& commanded_wheel_speeds) {
  assert(dt > 0.0);
  const double limit = parameters_.max_wheel_speed;
  const double lag = parameters_.motor_lag;
  Eigen::Vector3d command = Eigen::Vector3d::Zero();
  if (commanded_wheel_speeds.allFinite()) command = commanded_wheel_speeds.cwiseMax(-limit).cwiseMin(limit);

  // 1. The twist that the speed loop demands at the end of the step.
  const double heading = state_.pose_world.heading;
  const Eigen::Vector3d twist_world = state_.twist_world;
  const double approach = lag > 0.0 ? -std::expm1(-dt / lag) : 1.0;
  const Eigen::Vector3d speeds = wheel_speeds();
  const Eigen::Vector3d wanted_body = kinematics_.twist_body(speeds + approach * (command - speeds));

  // 2. The wrench and the torques that lead there. Wrenches act along the body axes of the mid-step, so
  //    that the force that turns the velocity with the body (centripetal) is part of the demand.
  const double wanted_turn = 0.5 * dt * (twist_world.z() + wanted_body.z());
  const Eigen::Vector3d wanted_change = twist_in_world(wanted_body, heading + wanted_turn) - twist_world;
  const Eigen::Vector3d wanted_wrench =
      twist_in_body(inertia_.cwiseProduct(wanted_change) / dt, heading + 0.5 * wanted_turn);
  const double max_torque = parameters_.max_wheel_torque;
  wheel_torques_ = torques_for(wanted_wrench).cwiseMax(-max_torque).cwiseMin(max_torque);

  // 3. The motion under the clipped torques: yaw first, since the force turns with the body; then
  //    trapezoids, for which the work of the force is exactly the change of kinetic energy.
  const Eigen::Vector3d wrench = wrench_body(wheel_torques_);
  const double yaw_rate = twist_world.z() + dt * wrench.z() / inertia_.z();
  const double turn = 0.5 * dt * (twist_world.z() + yaw_rate);
  const Eigen::Vector3d wrench_world = twist_in_world(wrench, heading + 0.5 * turn);
  state_.twist_world += dt * wrench_world.cwiseQuotient(inertia_);
  state_.pose_world.position_world += 0.5 * dt * (twist_world + state_.twist_world).head<2>();
  state_.pose_world.heading = wrap_angle(heading + turn);
}

double OmniDynamics::max_acceleration_anywhere() const {
  // A wheel is strained most by a motion along its own rim.
  double least = std::numeric_limits<double>::infinity();
  for (int wheel = 0; wheel < 3; ++wheel)
    least = std::min(least, max_acceleration_along(kinematics_.wheel_from_body().row(wheel).head<2>()));
  return least;
}

RobotParameters within_drive(RobotParameters robot) {
  robot.max_acceleration = std::min(robot.max_acceleration, OmniDynamics{robot}.max_acceleration_anywhere());
  return robot;
}

}  // namespace spf
