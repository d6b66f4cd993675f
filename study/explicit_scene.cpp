#include "study/explicit_scene.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "config/parameter_text.hpp"

namespace spf {
namespace {

double heading_of(const RobotEntry& entry) {
  if (entry.heading) return *entry.heading;
  const Eigen::Vector2d to_goal = entry.goal - entry.start;
  if (!to_goal.allFinite()) return 0.0;
  return std::atan2(to_goal.y(), to_goal.x());
}

/// Where the robot stays.
const Eigen::Vector2d& last_goal(const sim::RobotTask& task) {
  return task.next_goals.empty() ? task.goal_world : task.next_goals.back().position_world;
}

/// Rules of a file besides those of the simulator: goals apart, where robots stay at theirs; discs inside the
/// border.
std::vector<sim::ScenarioProblem> more_problems_of(const sim::Scenario& scenario) {
  std::vector<sim::ScenarioProblem> found;
  const bool stay = scenario.simulation.trial.goals == sim::GoalSupply::listed;
  for (std::size_t i = 0; i < scenario.robots.size() && stay; ++i) {
    std::string first, nearest;  // of the goals that are too near; further ones are counted
    std::size_t others = 0;
    for (std::size_t j = 0; j < i; ++j) {
      const double gap = (last_goal(scenario.robots[i]) - last_goal(scenario.robots[j])).norm();
      const double sum = scenario.robot_of(i).radius + scenario.robot_of(j).radius;
      if (!(gap < sum)) continue;
      if (first.empty()) {
        nearest = entry_name("robots", j, ".goal");
        first = "is " + to_text(gap) + " m from " + entry_name("robots", j, ".goal") +
                ", less than their radii, " + to_text(sum) + " m";
      } else {
        ++others;
      }
    }
    if (others > 0) first += " (and " + std::to_string(others) + " more)";
    if (!first.empty())
      found.push_back({entry_name("robots", i, ".goal"), std::move(first), "", std::move(nearest)});
  }
  for (std::size_t i = 0; i < scenario.moving.size() && scenario.border; ++i) {
    const ObstacleState& disc = scenario.moving[i];
    const double depth = std::min((disc.position_world - scenario.border->low).minCoeff(),
                                  (scenario.border->high - disc.position_world).minCoeff());
    if (depth < disc.radius)
      found.push_back({entry_name("moving", i, ".position"),
                       "must lie inside the border by its radius, " + to_text(disc.radius) + " m", "",
                       "border"});
  }
  return found;
}

}  // namespace

std::string entry_name(const char* list, std::size_t index, const char* member) {
  return std::string{list} + "[" + std::to_string(index) + "]" + member;
}

std::vector<RobotParameters> robots_of(const std::vector<RobotKind>& fleet) {
  std::vector<RobotParameters> robots;
  for (const RobotKind& kind : fleet) robots.push_back(kind.robot);
  return robots;
}

sim::Scenario explicit_scenario(const RunConfiguration& config) {
  sim::Scenario scenario;
  scenario.family = enum_name(kExplicitScene);
  scenario.seed = config.seed;
  scenario.robot = config.robot;
  scenario.fleet = robots_of(config.fleet);
  scenario.simulation = config.simulation;
  if (config.scene.border) scenario.border = sim::Box{config.scene.border->low, config.scene.border->high};
  for (const BoxEntry& box : config.scene.boxes) scenario.boxes.push_back({box.low, box.high});
  for (const DiscEntry& disc : config.scene.discs) scenario.discs.push_back({disc.center, disc.radius});
  for (const WallEntry& wall : config.scene.walls) scenario.walls.push_back({wall.from, wall.to});
  for (const PolygonEntry& polygon : config.scene.polygons) scenario.polygons.push_back({polygon.corners});
  scenario.map = config.map;
  for (const WallEntry& seam : config.scene.seams) scenario.seams.push_back({seam.from, seam.to});
  for (const MovingEntry& disc : config.scene.moving)
    scenario.moving.push_back({disc.position, disc.velocity, disc.radius});
  for (const PersonEntry& person : config.scene.people) scenario.people.push_back(person.task);
  for (const RobotEntry& robot : config.scene.robots) {
    sim::RobotTask& task = scenario.robots.emplace_back();
    task.start = {robot.start, heading_of(robot)};
    task.goal_world = robot.goal;
    task.goal_heading = robot.goal_heading;
    for (const Eigen::Vector2d& goal : robot.next_goals) task.next_goals.push_back({goal, std::nullopt});
  }
  for (const EventEntry& event : config.events) scenario.events.push_back(event_of(event));
  give_kinds_in_turn(scenario);
  for (std::size_t i = 0; i < scenario.robots.size(); ++i)
    if (config.scene.robots[i].kind != kInTurn)
      scenario.robots[i].kind = static_cast<std::size_t>(config.scene.robots[i].kind);
  return scenario;
}

void report(const sim::ScenarioProblem& problem, const YamlNode& root, InputProblems& problems) {
  const YamlNode& node = nearest_node(root, problem.where);
  const bool has_value = node.kind == YamlKind::scalar || node.kind == YamlKind::list;
  problems.add(node.location, problem.where + (has_value ? " = " + shown(node) : "") + " " + problem.what,
               problem.where);
}

void check_explicit(const YamlNode& root, const RunConfiguration& config, InputProblems& problems) {
  const InputProblems refused = problems;
  const sim::Scenario scenario = explicit_scenario(config);
  std::vector<sim::ScenarioProblem> found = sim::problems_of(scenario);
  const bool kinds_exist =
      std::all_of(scenario.robots.begin(), scenario.robots.end(), [&](const sim::RobotTask& task) {
        return scenario.fleet.empty() || task.kind < scenario.fleet.size();
      });
  if (kinds_exist)
    for (sim::ScenarioProblem& problem : more_problems_of(scenario)) found.push_back(std::move(problem));
  for (const sim::ScenarioProblem& problem : found) {
    if (refused.refuses(problem.where) || (!problem.other.empty() && refused.refuses(problem.other)))
      continue;
    report(problem, root, problems);
  }
}

}  // namespace spf
