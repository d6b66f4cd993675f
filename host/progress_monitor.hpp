// Whether a robot that goes gets anywhere, whatever the reason may be: slower than MotionMonitor, and without
// regard to what the wheels were told. Frame: world; times are the host's [s].
#pragma once

#include <Eigen/Core>

#include <algorithm>

#include "host/attempts.hpp"
#include "spf/robot/robot_parameters.hpp"

namespace spf::host {

class ProgressMonitor {
 public:
  explicit ProgressMonitor(const RobotParameters& robot) { reconfigure(robot); }
  /// Less is asked of a robot that is to go slowly.
  void reconfigure(const RobotParameters& robot) {
    least_distance_ = std::min(robot.radius, 0.1 * robot.max_speed * kTime);
    braking_time_ = robot.max_speed / robot.max_acceleration;
  }

  /// Where it is [m], and whether it goes by its own account: it has a goal, and no cause to stand.
  void note(double now, const Eigen::Vector2d& position_world, bool goes) {
    const double distance = (position_world - from_world_).norm();
    if (goes && since_ != kNever && distance < least_distance_ && now - since_ <= kTime) return;
    if (goes && since_ != kNever && distance < least_distance_) attempts_.fail(now, braking_time_);
    if (goes && since_ != kNever && distance >= least_distance_) attempts_.succeed();
    since_ = goes ? now : kNever;
    from_world_ = position_world;
  }
  void reset() {
    since_ = kNever;
    attempts_.reset();
  }
  /// From the moment it has got nowhere for too long until it may try again.
  [[nodiscard]] bool stuck(double now) const { return attempts_.waiting(now); }

  static constexpr double kTime = 10.0;  ///< [s] for a distance of the robot's radius

 private:
  double least_distance_ = 0.0;                           // [m]
  double braking_time_ = 0.0;                             // [s]
  double since_ = kNever;                                 // [s] when it was at:
  Eigen::Vector2d from_world_ = Eigen::Vector2d::Zero();  // [m]
  Attempts attempts_;
};

}  // namespace spf::host
