// The last stage before the wheels: no command leaves it beyond the robot's limits of speed, acceleration,
// yaw and wheels, whatever asked for it. The controller knows the wheels' limits alone, and a robot that was
// held, pushed or relocalised is far from its reference, so that it would ask for all that they give.
#pragma once

#include <Eigen/Core>

#include "spf/robot/drive.hpp"
#include "spf/robot/robot_parameters.hpp"

namespace spf {

/// A value. Never throws or allocates after construction.
class CommandLimiter {
 public:
  /// Throws std::invalid_argument on parameters out of range. `period` [s]: the time between two commands.
  CommandLimiter(const RobotParameters& robot, const Drive& drive, double period);

  /// Rim speeds [m/s] nearest to the wanted ones that the limits allow after `previous` ones, which have been
  /// in force for `elapsed` [s]; wanted ones within the limits come back as they are. Acceleration is the
  /// change of the velocity in world, so that a robot may turn while it drives straight on; where it hardly
  /// turns it is that of the velocity in body as well, as those see it who look at commands alone. Speed and
  /// yaw rate are limited apart where the wheels allow it. No more than one period's change is given, so that
  /// a late tick is no harder than others. Previous ones beyond the limits are led back at the largest
  /// acceleration. Wanted ones that are not finite count as a wish to stand; after previous ones that are not
  /// finite the robot stands.
  [[nodiscard]] DriveInput limited(const DriveInput& wanted, const DriveInput& previous,
                                   double elapsed) const;

  /// [m/s] A limit of speed from now on, no higher than the robot's; what is not positive is ignored.
  /// Commands beyond it are led back at the largest acceleration.
  void set_max_speed(double max_speed);

  [[nodiscard]] double period() const { return period_; }  ///< [s]

  /// [1] of max_acceleration and max_yaw_acceleration: what is left to the controller to make up for errors
  /// while a plan uses all of them.
  static constexpr double kAccelerationSpare = 1.08;
  /// [1] of max_speed and max_yaw_rate, likewise.
  static constexpr double kSpeedSpare = 1.008;

 private:
  [[nodiscard]] bool keeps_limits(const DriveInput& wheel_speeds, const Eigen::Vector3d& twist_body,
                                  const Eigen::Vector3d& before_body, double duration) const;
  [[nodiscard]] Eigen::Vector3d possible(const Eigen::Vector3d& twist_body) const;
  [[nodiscard]] double share_within_wheels(const Eigen::Vector3d& from_body,
                                           const Eigen::Vector3d& to_body) const;

  Drive drive_;
  double largest_speed_;         // [m/s] the robot's own
  double max_speed_;             // [m/s] now
  double max_acceleration_;      // [m/s^2]
  double max_yaw_rate_;          // [rad/s]
  double max_yaw_acceleration_;  // [rad/s^2]
  double period_;                // [s]
};

}  // namespace spf
