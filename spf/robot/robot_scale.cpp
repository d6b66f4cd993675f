#include "spf/robot/robot_scale.hpp"

namespace spf {
namespace {

double stopping_way(const RobotParameters& robot) {
  return robot.max_speed * robot.max_speed / robot.max_acceleration;
}

/// Time to stop, and to leave the place that the robot takes: 1.3 s for the standard robot.
double response_time(const RobotParameters& robot) {
  return robot.max_speed / robot.max_acceleration + robot.radius / robot.max_speed;
}

}  // namespace

RobotScale::RobotScale(const RobotParameters& robot, const RobotParameters& standard)
    : size_{robot.radius / standard.radius},
      way_{std::max(robot.radius, 0.3 * stopping_way(robot)) /
           std::max(standard.radius, 0.3 * stopping_way(standard))},
      speed_{robot.max_speed / standard.max_speed},
      time_{response_time(robot) / response_time(standard)} {}

double RobotScale::factor(Scale scale) const {
  switch (scale) {
    case Scale::size:
      return size_;
    case Scale::stopping_distance:
      return way_;
    case Scale::speed:
      return speed_;
    case Scale::time:
      return time_;
    case Scale::area:
      return size_ * size_;
    case Scale::velocity_diffusion:
      return speed_ * speed_ / time_;
    case Scale::position_diffusion:
      return way_ * way_ / time_;
  }
  return 1.0;
}

}  // namespace spf
