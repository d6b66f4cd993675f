// The smallest host of a robot outside the project: find_package(spf), one target, one door
// (RobotAgent::step). The robot is moved as it plans; a real host would drive the wheels and measure the pose
// instead.
#include <spf/team/robot_agent.hpp>

#include <algorithm>
#include <iomanip>
#include <iostream>

int main() {
  const Eigen::Vector2d goal{4.0, 0.0};
  const Eigen::Vector2d box_low{-2.0, -1.0};
  const Eigen::Vector2d box_high{-1.0, 0.5};
  spf::OccupancyMap map{spf::GridFrame::covering({-6.0, -6.0}, {6.0, 6.0}, 0.1), 2.0};
  map.add_box(box_low, box_high);
  spf::RobotAgent robot{1, spf::defaults_for(spf::RobotParameters{}), map, {{-4.0, 0.0}, 0.0}, 0.0};
  robot.set_goal(goal);

  double least_clearance = 1e9;  // [m] between surfaces
  for (int tick = 0; tick < 3000 && robot.status().reason != spf::StandReason::arrived; ++tick) {
    const double time = 0.01 * tick;
    const Eigen::Vector2d place = robot.committed().position(time);
    const Eigen::Vector2d obstacle{5.0 - 0.6 * time, 0.1};
    spf::AgentInput input;
    input.poses.push_back({time, {place, 0.0}});
    if (tick % 10 == 0) input.observation = {time, {{7, obstacle, {}, 0.4, 0.0}}, {}};
    robot.step(time, input);

    const double to_box = (box_low - place).cwiseMax(place - box_high).cwiseMax(0.0).norm();
    least_clearance = std::min({least_clearance, to_box - 0.3, (place - obstacle).norm() - 0.7});
    if (tick % 50 == 0)
      std::cout << std::fixed << std::setprecision(2) << time << " s  " << place.transpose() << " m\n";
  }
  const bool arrived = robot.status().reason == spf::StandReason::arrived;
  std::cout << to_string(robot.status().reason) << ", least clearance " << least_clearance << " m\n";
  return arrived && least_clearance > 0.0 ? 0 : 1;
}
