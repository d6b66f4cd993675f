// The motion of robots that cannot move sideways (differential drives and cars): speed and yaw rate instead
// of a velocity. It rolls out how such a robot takes up a velocity that it is asked for, within the limits of
// speed, acceleration (along and across its path together), yaw, and turning radius. Frame: world.
#pragma once

#include <Eigen/Core>

#include "spf/robot/drive.hpp"
#include "spf/robot/footprint.hpp"
#include "spf/robot/robot_parameters.hpp"
#include "spf/trajectory/trajectory.hpp"

namespace spf {

/// Of drives that cannot move sideways.
[[nodiscard]] constexpr bool steers(DriveType drive) {
  return drive == DriveType::differential || drive == DriveType::car;
}

/// Robots that plan to drive along their heading: those, and all with corners, so that they fit through where
/// they point.
[[nodiscard]] inline bool steers(const RobotParameters& robot) {
  return steers(robot.drive) || has_corners(robot);
}

struct SteeredState {
  Eigen::Vector2d position_world = Eigen::Vector2d::Zero();  ///< [m]
  double heading = 0.0;                                      ///< [rad]
  double speed = 0.0;                                        ///< [m/s] along the heading, < 0 backwards
  double yaw_rate = 0.0;                                     ///< [rad/s]
  double curvature = 0.0;  ///< [1/m] of a car's steering, also while it stands

  [[nodiscard]] Eigen::Vector2d ahead() const { return {std::cos(heading), std::sin(heading)}; }
  [[nodiscard]] Eigen::Vector2d velocity_world() const { return speed * ahead(); }
};

/// Which way the robot drives while it takes up a velocity.
enum class Gear { forward, reverse };

/// A value. Never throws or allocates after construction.
class Steering {
 public:
  /// Throws std::invalid_argument on parameters out of range.
  explicit Steering(const RobotParameters& robot);

  /// Of the flat state, what such a robot can do: its motion along the heading.
  [[nodiscard]] SteeredState state_of(const FlatState& head, const HeadingState& heading) const;

  /// One step of dt > 0 [s] towards a velocity [m/s] wanted in world: it turns towards it, and drives the
  /// faster the less it still has to turn. Zero: it brakes. A car turns while it drives.
  void step(const Eigen::Vector2d& velocity_world, Gear gear, double dt, SteeredState& state) const;
  /// Likewise towards a heading [rad] on the spot, as far as the drive can.
  void turn(double heading, double dt, SteeredState& state) const;

  /// How much longer [s] the way to a position is than for a robot that faces it, driving forward or, where
  /// that is shorter, backward at a price: a turn on the spot, or on a car's least circle.
  [[nodiscard]] double turning_time(const SteeredState& state, const Eigen::Vector2d& target_world) const;

  /// Appends the motion from one state to another within `duration` [s], which must be short: a cubic in
  /// position and in heading.
  static void append(const SteeredState& from, const SteeredState& to, double duration,
                     Trajectory& trajectory);
  /// Appends braking to rest in at most `pieces` pieces, nothing at rest.
  void append_braking(SteeredState state, int pieces, Trajectory& trajectory) const;
  [[nodiscard]] double braking_time(const SteeredState& state) const;

  [[nodiscard]] bool turns_on_the_spot() const { return radius_ <= 0.0; }
  [[nodiscard]] bool may_reverse() const { return may_reverse_; }

 private:
  void change(double speed, double yaw_rate, double dt, SteeredState& state) const;
  [[nodiscard]] double loop_length(const Eigen::Vector2d& target_body) const;

  double max_speed_;             // [m/s]
  double max_acceleration_;      // [m/s^2]
  double max_yaw_rate_;          // [rad/s]
  double max_yaw_acceleration_;  // [rad/s^2]
  double radius_;                // [m] least, 0: it turns on the spot
  double curvature_rate_;        // [1/(m s)] of a car
  bool may_reverse_;
};

/// What a robot that steers makes of a trajectory for one that can move every way: it follows its positions
/// in time as well as it can, for as long as fits, and brakes.
[[nodiscard]] Trajectory steered_along(const Trajectory& wanted, const FlatState& head,
                                       const HeadingState& heading, const RobotParameters& robot);

}  // namespace spf
