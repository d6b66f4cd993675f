// The robot: size, limits, drive. Shared by planner (limits), controller (kinematics) and simulator (plant).
#pragma once

#include <Eigen/Core>

#include <array>
#include <utility>
#include <vector>

#include "spf/math/parameters.hpp"

namespace spf {

enum class DriveType { omni, mecanum, differential, car };

template <>
struct EnumNames<DriveType> {
  static constexpr std::array<std::pair<DriveType, const char*>, 4> values{
      {{DriveType::omni, "omni"},
       {DriveType::mecanum, "mecanum"},
       {DriveType::differential, "differential"},
       {DriveType::car, "car"}}};
};

inline constexpr int kMaxDriveInputs = 6;

struct RobotParameters {
  DriveType drive = DriveType::omni;
  double radius = 0.3;                     ///< [m] of the disc, or of the one around the corners
  double length = 0.0;                     ///< [m] along x of a rectangle around the centre; 0: it is none
  double width = 0.0;                      ///< [m] along y
  std::vector<Eigen::Vector2d> footprint;  ///< [m] corners of a convex polygon, in the body frame
  double max_speed = 1.0;                  ///< [m/s] of the centre
  double max_acceleration = 1.0;           ///< [m/s^2]
  double max_jerk = 20.0;                  ///< [m/s^3] bound of the planned motion
  double max_yaw_rate = 1.5;               ///< [rad/s]
  double max_yaw_acceleration = 3.0;       ///< [rad/s^2]
  int wheels = 3;                          ///< [1] omni wheels, evenly around the body
  double first_wheel_angle = 0.0;          ///< [rad] angle of wheel 1's axle in the body frame
  /// [m] omni: centre to wheel contact (L of eq. 14); differential: half the distance of the wheels; mecanum:
  /// half of length plus width between the wheels' contacts.
  double wheel_arm = 0.2;
  double wheel_base = 0.4;  ///< [m] of a car, between the axles; its centre is the middle of the rear axle
  double min_turning_radius = 0.6;  ///< [m] of a car's centre, by the stop of its steering
  bool may_reverse = true;          ///< of a car
  double max_steering_rate = 2.0;   ///< [rad/s] of a car
  double max_wheel_speed = 1.5;     ///< [m/s] rim speed of a wheel
  double wheel_radius = 0.05;       ///< [m] (R of eq. 15)
  double max_wheel_torque = 0.4;    ///< [N m]
  double mass = 10.0;               ///< [kg] (M of eq. 15)
  double inertia = 0.45;            ///< [kg m^2] (I of eq. 15)
  double motor_lag = 0.05;          ///< [s] first-order lag of the wheel speed loop, and of a car's steering
  double friction = 0.8;  ///< [1] of the ground: more force than friction times weight does not reach it

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit("drive", self.drive, "omni wheels (the paper's), mecanum wheels, a differential drive, or a car");
    visit("radius", self.radius, "m", Range{0.01, 5.0},
          "radius of the robot's disc; with corners it is that of the disc around them, whatever is set");
    visit("length", self.length, "m", Range{0.0, 10.0},
          "of a rectangular robot, along x, with its centre in the middle; 0: it is a disc, or has a "
          "footprint");
    visit("width", self.width, "m", Range{0.0, 10.0}, "of a rectangular robot, along y");
    visit.values("footprint", self.footprint, "m", Range{-5.0, 5.0},
                 "corners of the robot's outline, a convex polygon around its centre, in the body frame");
    visit("max_speed", self.max_speed, "m/s", Range{0.01, 20.0}, "largest planned speed of the centre");
    visit("max_acceleration", self.max_acceleration, "m/s^2", Range{0.01, 50.0},
          "largest planned acceleration");
    visit("max_jerk", self.max_jerk, "m/s^3", Range{0.1, 1000.0}, "largest planned jerk (a soft limit)");
    visit("max_yaw_rate", self.max_yaw_rate, "rad/s", Range{1e-3, 50.0}, "largest planned yaw rate");
    visit("max_yaw_acceleration", self.max_yaw_acceleration, "rad/s^2", Range{0.01, 500.0},
          "largest planned yaw acceleration");
    visit("wheels", self.wheels, "1", Range{3, kMaxDriveInputs},
          "omni wheels, evenly around the body (3 in the paper)");
    visit("first_wheel_angle", self.first_wheel_angle, "rad", Range{-6.3, 6.3},
          "angle of wheel 1's axle in the body frame (0 in the paper)");
    visit("wheel_arm", self.wheel_arm, "m", Range{0.001, 5.0},
          "distance from the centre to a wheel, L of eq. 14; half the track of a differential drive; "
          "mecanum: half of "
          "length plus width between the wheels");
    visit("wheel_base", self.wheel_base, "m", Range{0.01, 20.0}, "car: distance of its axles");
    visit("min_turning_radius", self.min_turning_radius, "m", Range{0.01, 50.0},
          "car: of the middle of its rear axle");
    visit("may_reverse", self.may_reverse, "car: it may drive backwards");
    visit("max_steering_rate", self.max_steering_rate, "rad/s", Range{0.01, 50.0},
          "car: of its steering angle");
    visit("max_wheel_speed", self.max_wheel_speed, "m/s", Range{0.01, 50.0}, "largest rim speed of a wheel");
    visit("wheel_radius", self.wheel_radius, "m", Range{0.001, 1.0}, "wheel radius, R of eq. 15");
    visit("max_wheel_torque", self.max_wheel_torque, "N m", Range{1e-4, 1000.0},
          "largest torque of one wheel");
    visit("mass", self.mass, "kg", Range{0.01, 10000.0}, "mass, M of eq. 15");
    visit("inertia", self.inertia, "kg m^2", Range{1e-6, 10000.0},
          "moment of inertia about the vertical, I of eq. 15");
    visit("friction", self.friction, "1", Range{0.01, 1000.0}, "of the ground under the wheels");
    visit("motor_lag", self.motor_lag, "s", Range{0.0, 2.0},
          "first-order time constant of the wheel speed loop");
  }
};

}  // namespace spf
