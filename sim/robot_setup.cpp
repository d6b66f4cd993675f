#include <algorithm>
#include <cmath>

#include "host/robot_map.hpp"
#include "sim/simulation.hpp"
#include "spf/robot/robot_scale.hpp"

namespace spf::sim {
namespace {

constexpr double kOpenMargin = 8.0;   // [m] around everything, where there is no border
constexpr double kMaxNodes = 0x1p24;  // of a map; larger places get a coarser one

/// A thin wall as points so close that the distance between two of them cannot be told from the wall's: at a
/// distance d they read at most (resolution / 8)^2 / (2 d) too much.
void add_wall(OccupancyMap& map, const Segment& wall) {
  const double spacing = 0.25 * map.frame().resolution;
  const int steps = std::max(1, static_cast<int>(std::ceil((wall.to - wall.from).norm() / spacing)));
  for (int i = 0; i <= steps; ++i) {
    const double share = static_cast<double>(i) / steps;
    map.add_disc(wall.from + share * (wall.to - wall.from), 0.0);
  }
}

Box extent_of(const Scenario& scenario) {
  if (scenario.border) return *scenario.border;
  Box extent{scenario.robots.front().start.position_world, scenario.robots.front().start.position_world};
  const auto include = [&extent](const Eigen::Vector2d& point) {
    extent.low = extent.low.cwiseMin(point);
    extent.high = extent.high.cwiseMax(point);
  };
  for (const RobotTask& task : scenario.robots) {
    include(task.start.position_world);
    include(task.goal_world);
  }
  for (const Box& box : scenario.boxes) {
    include(box.low);
    include(box.high);
  }
  for (const Disc& disc : scenario.discs) include(disc.center);
  for (const Segment& wall : scenario.walls) {
    include(wall.from);
    include(wall.to);
  }
  extent.low -= Eigen::Vector2d::Constant(kOpenMargin);
  extent.high += Eigen::Vector2d::Constant(kOpenMargin);
  return extent;
}

}  // namespace

OccupancyMap robot_map(const Scenario& scenario, const OccupancyParameters& parameters) {
  const SensingParameters& sensing = scenario.simulation.sensing;
  const Box extent = extent_of(scenario);
  const Eigen::Vector2d size = extent.high - extent.low;
  const host::MapGrain grain{sensing.map_resolution, sensing.map_max_distance};
  OccupancyMap map =
      host::empty_map(extent.low, extent.high, grain, parameters, std::sqrt(size.x() * size.y() / kMaxNodes));
  if (scenario.border) map.add_border(scenario.border->low, scenario.border->high);
  if (sensing.map == MapKnowledge::sensed) return map;
  for (const Box& box : scenario.boxes) map.add_box(box.low, box.high);
  for (const Disc& disc : scenario.discs) map.add_disc(disc.center, disc.radius);
  for (const Segment& wall : scenario.walls) add_wall(map, wall);
  return map;
}

AgentParameters agent_parameters_for(const Scenario& scenario, AgentParameters agent) {
  agent.robot = scenario.robot;
  agent.team.goal_tolerance =
      std::min(agent.team.goal_tolerance, 0.5 * scenario.simulation.trial.arrival_distance);
  return agent;
}

host::HostParameters host_parameters_for(const Scenario& scenario) {
  constexpr double kSigmas = 10.0;  // of the difference of two poses: never in a trial's 10^5 poses
  const SimulationParameters& simulation = scenario.simulation;
  const PoseNoiseParameters& noise = simulation.pose_noise;
  host::HostParameters host = scaled(host::HostParameters{}, RobotScale{scenario.robot});
  const double spread = kSigmas * std::hypot(noise.position_sigma, noise.seam_sigma);
  host.jump_distance = std::min(host.jump_distance + spread, 1000.0);
  host.jump_heading = std::min(host.jump_heading + kSigmas * noise.heading_sigma, 6.3);
  host.largest_plan_error = std::min(host.largest_plan_error + spread, 100.0);
  host.map_resolution = simulation.sensing.map_resolution;
  host.map_reach = simulation.sensing.map_max_distance;
  host.relies_on_scan = false;
  host.relies_on_obstacles = simulation.trial.tracking == TrackingMode::full;
  host.trusts_peers = true;
  host.guard.enabled = simulation.sensing.guard && simulation.trial.tracking == TrackingMode::full;
  return host;
}

}  // namespace spf::sim
