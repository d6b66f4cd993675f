// The robot: size, limits, drive. Shared by planner (limits), controller (kinematics) and simulator (plant).
#pragma once

#include "spf/math/parameters.hpp"

namespace spf {

struct RobotParameters {
  double radius = 0.3;                ///< [m]
  double max_speed = 1.0;             ///< [m/s] of the centre
  double max_acceleration = 1.0;      ///< [m/s^2]
  double max_jerk = 20.0;             ///< [m/s^3] bound of the planned motion
  double max_yaw_rate = 1.5;          ///< [rad/s]
  double max_yaw_acceleration = 3.0;  ///< [rad/s^2]
  double first_wheel_angle = 0.0;     ///< [rad] angle of wheel 1's axle in the body frame
  double wheel_arm = 0.2;             ///< [m] centre to wheel contact (L of eq. 14)
  double max_wheel_speed = 1.5;       ///< [m/s] rim speed of a wheel
  double wheel_radius = 0.05;         ///< [m] (R of eq. 15)
  double max_wheel_torque = 0.4;      ///< [N m]
  double mass = 10.0;                 ///< [kg] (M of eq. 15)
  double inertia = 0.45;              ///< [kg m^2] (I of eq. 15)
  double motor_lag = 0.05;            ///< [s] first-order lag of the wheel speed loop

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit("radius", self.radius, "m", Range{0.01, 5.0}, "radius of the robot's disc");
    visit("max_speed", self.max_speed, "m/s", Range{0.01, 20.0}, "largest planned speed of the centre");
    visit("max_acceleration", self.max_acceleration, "m/s^2", Range{0.01, 50.0},
          "largest planned acceleration");
    visit("max_jerk", self.max_jerk, "m/s^3", Range{0.1, 1000.0}, "largest planned jerk (a soft limit)");
    visit("max_yaw_rate", self.max_yaw_rate, "rad/s", Range{1e-3, 50.0}, "largest planned yaw rate");
    visit("max_yaw_acceleration", self.max_yaw_acceleration, "rad/s^2", Range{0.01, 500.0},
          "largest planned yaw acceleration");
    visit("first_wheel_angle", self.first_wheel_angle, "rad", Range{-6.3, 6.3},
          "angle of wheel 1's axle in the body frame (0 in the paper)");
    visit("wheel_arm", self.wheel_arm, "m", Range{0.001, 5.0},
          "distance from the centre to a wheel, L of eq. 14");
    visit("max_wheel_speed", self.max_wheel_speed, "m/s", Range{0.01, 50.0}, "largest rim speed of a wheel");
    visit("wheel_radius", self.wheel_radius, "m", Range{0.001, 1.0}, "wheel radius, R of eq. 15");
    visit("max_wheel_torque", self.max_wheel_torque, "N m", Range{1e-4, 1000.0},
          "largest torque of one wheel");
    visit("mass", self.mass, "kg", Range{0.01, 10000.0}, "mass, M of eq. 15");
    visit("inertia", self.inertia, "kg m^2", Range{1e-6, 10000.0},
          "moment of inertia about the vertical, I of eq. 15");
    visit("motor_lag", self.motor_lag, "s", Range{0.0, 2.0},
          "first-order time constant of the wheel speed loop");
  }
};

}  // namespace spf
