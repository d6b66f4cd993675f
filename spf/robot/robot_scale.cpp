#include "spf/robot/robot_scale.hpp"

#include "spf/robot/footprint.hpp"

namespace spf {
namespace {

double stopping_distance(const RobotParameters& robot) {
  return robot.max_speed * robot.max_speed / robot.max_acceleration;
}

/// Time to stop and to clear the robot's own footprint: 1.3 s for the standard robot.
double response_time(const RobotParameters& robot) {
  return robot.max_speed / robot.max_acceleration + robot.radius / robot.max_speed;
}

}  // namespace

RobotScale::RobotScale(const RobotParameters& robot, const RobotParameters& standard)
    : size_{Footprint{robot}.half_width() / standard.radius},
      distance_{std::max(robot.radius, 0.3 * stopping_distance(robot)) /
                std::max(standard.radius, 0.3 * stopping_distance(standard))},
      speed_{robot.max_speed / standard.max_speed},
      time_{response_time(robot) / response_time(standard)} {}

double RobotScale::factor(Scale scale) const {
  switch (scale) {
    case Scale::size:
      return size_;
    case Scale::stopping_distance:
      return distance_;
    case Scale::speed:
      return speed_;
    case Scale::time:
      return time_;
    case Scale::area:
      return size_ * size_;
    case Scale::acceleration:
      return speed_ / time_;
    case Scale::velocity_diffusion:
      return speed_ * speed_ / time_;
    case Scale::position_diffusion:
      return distance_ * distance_ / time_;
  }
  return 1.0;
}

}  // namespace spf
