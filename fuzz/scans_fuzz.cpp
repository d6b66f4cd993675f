// Scans, and reports of obstacles beside them: to the map, through the hosts' gates, and to the agent.
#include <cmath>

#include "fuzz/robot_world.hpp"
#include "host/scan_check.hpp"

namespace {

using namespace spf;

RangeScan scan_of(fuzz::Bytes& bytes) {
  RangeScan scan;
  const int count = bytes.up_to(3) > 0 ? bytes.up_to(40) : bytes.whole<std::uint16_t>() % 3000;
  scan.angle_min = bytes.up_to(3) > 0 ? -3.14 : bytes.number();
  scan.angle_increment = bytes.up_to(3) > 0 ? 6.28 / (count + 1) : bytes.number();
  scan.max_range = bytes.up_to(1) > 0 ? 8.0 : bytes.number();
  for (int i = 0; i < count; ++i) scan.ranges.push_back(bytes.empty() ? 2.5 : bytes.number());
  return scan;
}

Pose2 pose_of(fuzz::Bytes& bytes) {
  if (bytes.up_to(3) > 0) return {};
  const Eigen::Vector2d position = bytes.pair();
  return {position, bytes.number()};
}

Observation observation_of(fuzz::Bytes& bytes, double now) {
  Observation observation;
  observation.time = bytes.up_to(7) > 0 ? now : bytes.number();
  const int count = bytes.up_to(3);
  for (int i = 0; i < count; ++i) {
    Detection detection;
    detection.id = bytes.byte();
    detection.position_world = bytes.pair();
    if (bytes.up_to(1) > 0) detection.velocity_world = bytes.pair();
    detection.radius = bytes.number();
    detection.position_sigma = bytes.number();
    observation.detections.push_back(detection);
  }
  observation.scan = scan_of(bytes);
  return observation;
}

void tell_map(fuzz::Bytes bytes) {
  OccupancyMap map = fuzz::small_map();
  for (int sweep = 0; sweep < 4; ++sweep) {
    const RangeScan scan = scan_of(bytes);
    const Pose2 pose = pose_of(bytes);
    const MaskedDisc disc{bytes.pair(), bytes.number()};
    map.integrate(scan, pose, {disc});
    const double distance = map.distance(pose.position_world);
    fuzz::require(std::isfinite(distance) && distance <= map.max_distance(), "a map gives distances");
  }
  for (const Eigen::Vector2d& point : map.occupied_points())
    fuzz::require(point.allFinite(), "surfaces are somewhere");
}

void tell_hosts(fuzz::Bytes bytes) {
  const host::HostParameters parameters;
  host::PerceptionHost perception{AgentParameters{}, parameters};
  host::PlannerProcess planner{0, fuzz::agent_of(bytes), parameters};
  planner.planner().set_map(fuzz::small_map());
  planner.planner().set_goal({{3.0, 0.0}, std::nullopt});
  for (int i = 0; i < 50; ++i) {
    const double now = 10.0 + 0.02 * i;
    planner.add_pose({now, Pose2{}}, now);
    if (i >= 30 && i % 5 == 0) {
      const Observation observation = observation_of(bytes, now);
      const host::DriverScan driver{*observation.scan, 0.0, 0.1, {pose_of(bytes), i % 2 == 0}};
      perception.applied(now, Eigen::Vector3d{1.0, -0.5, 0.2});
      if (auto sensed = perception.add_scan(observation.time, driver, now))
        planner.add_observation(*sensed, now);
      if (auto sensed = perception.add_detections(observation.time, observation.detections, now))
        planner.add_observation(*sensed, now);
      planner.add_observation({observation, true}, now);  // past the first gate
    }
    planner.step(now);
  }
  if (planner.planner().agent() != nullptr) fuzz::require_sound(*planner.planner().agent());
}

void tell_agent(fuzz::Bytes bytes) {
  host::RobotHost robot = fuzz::trusting_robot(fuzz::agent_of(bytes));
  for (int i = 0; i < 5; ++i) {
    const double now = 0.1 * i;
    robot.add_pose({now, pose_of(bytes)}, now);
    robot.add_observation({observation_of(bytes, now), true}, now);
    fuzz::step(robot, now);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::give({data, size}, tell_agent, tell_hosts, tell_map);
  return 0;
}
