#include <algorithm>
#include <cmath>
#include <utility>

#include "host/cell_map.hpp"
#include "host/robot_map.hpp"
#include "sim/extent.hpp"
#include "sim/simulation.hpp"
#include "spf/robot/robot_scale.hpp"

namespace spf::sim {
namespace {

constexpr double kMaxNodes = 0x1p24;  // of a map; larger scenes get a coarser one

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

host::OperatingConditions operating_conditions(const Scenario& scenario) {
  const SimulationParameters& simulation = scenario.simulation;
  const SensingParameters& sensing = simulation.sensing;
  host::OperatingConditions conditions;
  conditions.by_wheels = simulation.trial.tracking == TrackingMode::full;
  conditions.sensing_range = sensing.range;
  conditions.sensing_rate = sensing.rate;
  if (conditions.by_wheels) conditions.pose_rate = simulation.pose_noise.rate;
  conditions.computing_delay = simulation.trial.computing_delay;
  conditions.others_report = sensing.detections != DetectionQuality::scan;
  conditions.has_peers = scenario.robots.size() > 1;
  conditions.peer_sight = sensing.peer_detection_range;
  const bool scans = sensing.map == MapKnowledge::sensed || sensing.detections == DetectionQuality::scan;
  if (scans && sensing.peers_block_beams)
    conditions.peer_sight = std::max(conditions.peer_sight, sensing.range);
  conditions.message_range = simulation.radio.range;
  conditions.message_loss = simulation.radio.loss;
  conditions.message_delay = simulation.radio.delay;
  return conditions;
}

}  // namespace

OccupancyMap robot_map(const Scenario& scenario) {
  const SensingParameters& sensing = scenario.simulation.sensing;
  const Box extent = extent_of(scenario);
  const Eigen::Vector2d size = extent.high - extent.low;
  OccupancyMap map =
      host::empty_map(extent.low, extent.high, sensing.map_grain, std::sqrt(size.x() * size.y() / kMaxNodes));
  if (scenario.border) map.add_border(scenario.border->low, scenario.border->high);
  if (scenario.map) host::add_edges(map, scenario.map->cells());
  if (sensing.map == MapKnowledge::sensed) {
    map.mark_unexplored();
    return map;
  }
  for (const Box& box : scenario.boxes) map.add_box(box.low, box.high);
  for (const Disc& disc : scenario.discs) map.add_disc(disc.center, disc.radius);
  for (const Segment& wall : scenario.walls) add_wall(map, wall);
  for (const Polygon& polygon : scenario.polygons) map.add_polygon(polygon.corners);
  if (scenario.map) host::add_cells(map, scenario.map->cells());
  return map;
}

AgentParameters agent_parameters_for(const Scenario& scenario, AgentParameters agent) {
  if (scenario.fleet.empty()) agent.robot = scenario.robot;
  agent.team.goal_tolerance =
      std::min(agent.team.goal_tolerance, 0.5 * scenario.simulation.trial.arrival_distance);
  // What a robot knows of its own sensors.
  const SensingParameters& sensing = scenario.simulation.sensing;
  agent.sight.range = std::min(agent.sight.range, sensing.range);
  const bool scans_alone = sensing.detections == DetectionQuality::scan;
  const bool sensed = sensing.map == MapKnowledge::sensed;
  agent.perception.enabled = agent.perception.enabled || scans_alone || sensed;
  agent.perception.map_scans = sensed;
  agent.perception.moving_alone = !scans_alone;
  agent.perception.range_sigma = std::max(0.5 * agent.perception.range_sigma, sensing.range_sigma);
  agent.perception.pose_sigma =
      std::max(agent.perception.pose_sigma, scenario.simulation.pose_noise.seam_sigma);
  return agent;
}

host::HostParameters host_parameters_for(const Scenario& scenario, const AgentParameters& agent) {
  constexpr double kSigmas = 10.0;  // of the difference of two poses: never in a trial's 10^5 poses
  constexpr double kPeriods = 3.0;  // that a watchdog bears
  const SimulationParameters& simulation = scenario.simulation;
  const PoseNoiseParameters& noise = simulation.pose_noise;
  host::HostParameters host = scaled(host::HostParameters{}, RobotScale{agent.robot});
  const double spread = kSigmas * std::hypot(noise.position_sigma, noise.seam_sigma);
  host.jump_distance = std::min(host.jump_distance + spread, 1000.0);
  host.jump_heading = std::min(host.jump_heading + kSigmas * noise.heading_sigma, 6.3);
  host.largest_plan_error = std::min(host.largest_plan_error + spread, 100.0);
  // A scenario may let robots fall far behind their plans, and must not be stopped before.
  if (agent.team.reanchor_distance > host.largest_plan_error)
    host.largest_plan_error = 2.0 * agent.team.reanchor_distance;
  // Robots of a trial plan by their period alone, and think when a pose arrives.
  host.least_plan_interval = agent.team.plan_period;
  const double tick = 1.0 / noise.rate;
  const auto bear = [](double& silence, double period) { silence = std::max(silence, kPeriods * period); };
  bear(host.plan_silence, std::max(agent.team.plan_period, tick));
  bear(host.command_silence, std::max(agent.tracker.control_period, tick));
  bear(host.clock_jump, tick);
  host.map_grain = simulation.sensing.map_grain;
  const bool scans_alone = simulation.sensing.detections == DetectionQuality::scan;
  host.relies_on_scan = scans_alone && simulation.trial.tracking == TrackingMode::full;
  host.relies_on_obstacles = !scans_alone && simulation.trial.tracking == TrackingMode::full;
  host.trusts_peers = true;
  host.guard.enabled = simulation.sensing.guard && simulation.trial.tracking == TrackingMode::full;
  return host;
}

std::vector<host::Contradiction> contradictions(const Scenario& scenario, const AgentParameters& agent) {
  const AgentParameters parameters = agent_parameters_for(scenario, agent);
  std::vector<host::Contradiction> kept;
  for (host::Contradiction& found : host::contradictions(
           parameters, host_parameters_for(scenario, parameters), operating_conditions(scenario))) {
    if (found.key == "host.map_reach") found.key = "sensing.map_max_distance";
    if (found.key == "host.map_resolution") found.key = "sensing.map_resolution";
    // The rest of the host is derived, and nothing that a scenario sets.
    if (found.key.rfind("host.", 0) != 0) kept.push_back(std::move(found));
  }
  return kept;
}

}  // namespace spf::sim
