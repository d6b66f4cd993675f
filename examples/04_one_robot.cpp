// One robot past a box and a person: the smallest host of a robot outside the project, one target and one
// class (RobotHost::step). The robot is moved as it plans; a real host would drive the wheels and report the
// measured pose (add_pose).
#include <host/robot_host.hpp>

#include <algorithm>
#include <iostream>

#include "picture.hpp"

int main() {
  const Eigen::Vector2d goal{4.0, 0.0};
  const Eigen::Vector2d box_low{-2.0, -1.0};
  const Eigen::Vector2d box_high{-1.0, 0.5};
  spf::OccupancyMap map{spf::GridFrame::covering({-6.0, -6.0}, {6.0, 6.0}, 0.1), 2.0};
  map.add_box(box_low, box_high);
  spf::host::HostParameters parameters;
  parameters.relies_on_scan = false;  // it has the map, and is told what moves
  spf::host::RobotHost robot{1, spf::defaults_for(spf::RobotParameters{}), parameters,
                             spf::host::Motion::as_planned};
  robot.planner().set_goal({goal, std::nullopt});
  robot.start(map, {{-4.0, 0.0}, 0.0}, 0.0);

  Picture picture{{-5.0, -2.0}, {5.5, 2.0}};
  picture.box(box_low, box_high, "wall");
  double least_clearance = 1e9;  // [m] between surfaces
  for (int tick = 0; tick < 3000 && robot.agent().status().reason != spf::StopCause::arrived; ++tick) {
    const double time = 0.01 * tick;
    const Eigen::Vector2d position = robot.agent().committed().position(time);
    const Eigen::Vector2d obstacle{5.0 - 0.6 * time, 0.1};
    if (tick % 10 == 0) robot.add_observation({{time, {{7, obstacle, {}, 0.4, 0.0}}, {}}, true}, time);
    robot.step(time);

    const double to_box = (box_low - position).cwiseMax(position - box_high).cwiseMax(0.0).norm();
    least_clearance = std::min({least_clearance, to_box - 0.3, (position - obstacle).norm() - 0.7});
    if (tick % 100 == 0) {
      picture.disc(position, 0.3, "robot-0", 0.15);
      picture.disc(obstacle, 0.4, "obstacle", 0.15);
      picture.text(obstacle - Eigen::Vector2d{0.1, 0.1}, spf::fixed(time, 0));
      picture.text(position - Eigen::Vector2d{0.1, 0.1}, spf::fixed(time, 0));
    }
  }
  const spf::StopCause cause = robot.agent().status().reason;
  picture.save("04_one_robot.svg");
  std::cout << to_string(cause) << ", least clearance " << spf::fixed(least_clearance, 2) << " m\n";
  return cause == spf::StopCause::arrived && least_clearance > 0.0 ? 0 : 1;
}
