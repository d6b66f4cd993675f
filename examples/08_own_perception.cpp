// A detector of your own: a few lines make detections of range scans. The robot is told where something is,
// never how fast; it learns that from the detections.
#include <host/robot_host.hpp>
#include <iostream>

#include "picture.hpp"

namespace {

constexpr double kRadius = 0.3;  // [m] of the person, and of the robot
/// Where 360 beams meet the disc of a person.
std::vector<Eigen::Vector2d> returns_of(const Eigen::Vector2d& sensor, const Eigen::Vector2d& person) {
  std::vector<Eigen::Vector2d> returns;
  for (int degree = 0; degree < 360; ++degree) {
    const Eigen::Vector2d beam{std::cos(0.01745329 * degree), std::sin(0.01745329 * degree)};
    const Eigen::Vector2d to_person = person - sensor;
    const double along = beam.dot(to_person), beside = (to_person - along * beam).norm();
    if (along > 0.0 && beside < kRadius)
      returns.emplace_back(sensor + (along - std::sqrt(kRadius * kRadius - beside * beside)) * beam);
  }
  return returns;
}

/// Returns are of the near side alone: their middle lies pi/4 of the radius before the person's.
spf::Detection detect(const Eigen::Vector2d& sensor, const std::vector<Eigen::Vector2d>& returns) {
  Eigen::Vector2d middle{0.0, 0.0};
  for (const auto& hit : returns) middle += hit / static_cast<double>(returns.size());
  return {1, middle + 0.785 * kRadius * (middle - sensor).normalized(), {}, kRadius, 0.03};
}

}  // namespace

int main() {
  spf::host::HostParameters host;
  host.relies_on_scan = false;  // scans go to the detector alone
  spf::host::RobotHost robot{1, spf::defaults_for({}), host, spf::host::Motion::as_planned};
  robot.planner().set_goal({{4.0, 0.0}, std::nullopt});
  robot.start({spf::GridFrame::covering({-6.0, -4.0}, {6.0, 4.0}, 0.1), 2.0}, {{-4.0, 0.0}, 0.0}, 0.0);

  Picture picture{{-5.0, -2.5}, {5.0, 2.5}};
  double worst = 0.0, clearance = 1e9;  // [m]
  for (int tick = 0; tick < 3000 && robot.agent().status().reason != spf::StopCause::arrived; ++tick) {
    const double time = 0.01 * tick;
    const Eigen::Vector2d here = robot.agent().committed().position(time), person{2.0 - 0.5 * time, 0.1};
    if (const auto returns = returns_of(here, person); tick % 10 == 0 && !returns.empty()) {
      const spf::Detection seen = detect(here, returns);
      robot.add_observation({{time, {seen}, {}}, true}, time);
      worst = std::max(worst, (seen.position_world - person).norm());
      if (tick % 100 == 0) picture.line(returns, "obstacle", 3.0);
      if (tick % 100 == 0) picture.disc(here, kRadius, "robot-0", 0.1);
    }
    robot.step(time);
    clearance = std::min(clearance, (here - person).norm() - 2.0 * kRadius);
  }
  picture.text({-4.9, 2.25}, "every second: the robot, and what its scan shows of the person it meets");
  picture.save("08_own_perception.svg");
  std::cout << "detector wrong by at most " << worst << " m; clearance at least " << clearance << " m\n";
  return clearance > 0.0 ? 0 : 1;
}
