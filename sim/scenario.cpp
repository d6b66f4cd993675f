#include "sim/scenario.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "sim/geometry.hpp"
#include "sim/outlines.hpp"
#include "sim/polygon_check.hpp"
#include "sim/uniform_grid.hpp"
#include "sim/walkers.hpp"
#include "spf/math/index.hpp"
#include "spf/math/polygon.hpp"
#include "spf/math/random_stream.hpp"

namespace spf::sim {
namespace {

std::string entry(const char* list, std::size_t index, const char* member = "") {
  return std::string{list} + "[" + std::to_string(index) + "]" + member;
}

/// Collects problems as sentences with the numbers in them.
class Report {
 public:
  template <class... Parts>
  ScenarioProblem& add(std::string where, const Parts&... parts) {
    std::ostringstream sentence;
    (sentence << ... << parts);
    return found_.emplace_back(ScenarioProblem{std::move(where), sentence.str(), "", ""});
  }
  template <class... Parts>
  void add_point(std::string where, const Eigen::Vector2d& point, const Parts&... parts) {
    std::ostringstream value;
    value << "(" << point.x() << ", " << point.y() << ")";
    add(std::move(where), parts...).value = value.str();
  }
  void require_finite(const std::string& where, const Eigen::Vector2d& value) {
    if (!value.allFinite()) add_point(where, value, "must be finite");
  }
  void require_radius(const std::string& where, double radius) {
    if (!(radius > 0.0 && radius <= 1000.0)) add(where, "radius ", radius, " m must lie in (0, 1000]");
  }
  [[nodiscard]] bool none() const { return found_.empty(); }
  [[nodiscard]] std::vector<ScenarioProblem> take() { return std::move(found_); }

 private:
  std::vector<ScenarioProblem> found_;
};

/// What overlaps one position: the first of them is reported, the others are counted, so that a scene has no
/// more problems than entries.
class FirstOfMany {
 public:
  void add(double distance, const char* list, std::size_t index) {
    if (count_++ > 0) return;
    distance_ = distance;
    list_ = list;
    index_ = index;
  }
  [[nodiscard]] bool any() const { return count_ > 0; }
  [[nodiscard]] double distance() const { return distance_; }
  [[nodiscard]] std::string name() const { return entry(list_, index_); }
  [[nodiscard]] std::string and_more() const {
    return count_ < 2 ? "" : " (and " + std::to_string(count_ - 1) + " more)";
  }

 private:
  std::size_t count_ = 0;
  double distance_ = 0.0;  // [m]
  const char* list_ = "";
  std::size_t index_ = 0;
};

void check_box(Report& report, const std::string& where, const Box& box) {
  report.require_finite(where, box.low);
  report.require_finite(where, box.high);
  if ((box.low.array() >= box.high.array()).any())
    report.add(where, "low corner (", box.low.x(), ", ", box.low.y(), ") must lie below the high corner (",
               box.high.x(), ", ", box.high.y(), ")");
}

void check_shapes(Report& report, const Scenario& scenario) {
  if (scenario.border) check_box(report, "border", *scenario.border);
  for (std::size_t i = 0; i < scenario.boxes.size(); ++i)
    check_box(report, entry("boxes", i), scenario.boxes[i]);
  for (std::size_t i = 0; i < scenario.discs.size(); ++i) {
    report.require_finite(entry("discs", i), scenario.discs[i].center);
    report.require_radius(entry("discs", i), scenario.discs[i].radius);
  }
  for (std::size_t i = 0; i < scenario.walls.size(); ++i) {
    report.require_finite(entry("walls", i), scenario.walls[i].from);
    report.require_finite(entry("walls", i), scenario.walls[i].to);
  }
  PolygonCheck polygons;
  for (std::size_t i = 0; i < scenario.polygons.size(); ++i) {
    const std::string problem = polygons.problem_of(scenario.polygons[i]);
    if (!problem.empty()) report.add(entry("polygons", i, ".corners"), problem);
  }
  for (std::size_t i = 0; i < scenario.moving.size(); ++i) {
    report.require_finite(entry("moving", i, ".position"), scenario.moving[i].position_world);
    report.require_finite(entry("moving", i, ".velocity"), scenario.moving[i].velocity_world);
    report.require_radius(entry("moving", i), scenario.moving[i].radius);
  }
  if (!scenario.crowd.empty()) report.require_radius("crowd", scenario.crowd_radius);
  for (std::size_t i = 0; i < scenario.crowd.size(); ++i) {
    report.require_finite(entry("crowd", i), scenario.crowd[i].position_world);
    if (!std::isfinite(scenario.crowd[i].time)) report.add(entry("crowd", i), "time must be finite");
    if (i > 0 && scenario.crowd[i].time < scenario.crowd[i - 1].time)
      report.add(entry("crowd", i), "samples must be sorted by time");
  }
}

/// What positions are held against, looked through once for all of them.
struct Ground {
  explicit Ground(const Scenario& scenario) : outlines{scenario} {
    for (const Polygon& polygon : scenario.polygons) {
      Box& bound = bounds.emplace_back();
      if (polygon.corners.empty()) continue;
      bound = {polygon.corners.front(), polygon.corners.front()};
      for (const Eigen::Vector2d& corner : polygon.corners) {
        bound.low = bound.low.cwiseMin(corner);
        bound.high = bound.high.cwiseMax(corner);
      }
    }
  }
  Outlines outlines;
  std::vector<Box> bounds;  // of the polygons
};

void require_free_cells(Report& report, const std::string& where, const Eigen::Vector2d& position,
                        double radius, const Scenario& scenario, const Ground& ground) {
  if (!scenario.map) return;
  std::ostringstream problem;
  if (scenario.map->occupied(position)) {
    problem << "is in an occupied cell of the map, or beyond its edges";
  } else {
    double nearest = radius;
    ground.outlines.visit(position, radius, [&](const Outlines::Piece& piece) {
      if (piece.polygon < 0) nearest = std::min(nearest, distance_to_segment(position, piece.segment));
    });
    if (nearest < radius)
      problem << "is " << nearest << " m from a wall of the map, less than the radius " << radius << " m";
  }
  if (!problem.str().empty()) report.add(where, problem.str()).other = "map";
}

/// A robot's centre must stay its radius away from everything static.
void check_position(Report& report, const std::string& where, const Eigen::Vector2d& position, double radius,
                    const Scenario& scenario, const Ground& ground) {
  report.require_finite(where, position);
  if (!position.allFinite()) return;
  if (scenario.border && depth_inside(position, *scenario.border) < radius)
    report.add_point(where, position, "must lie inside the border by the radius ", radius, " m");
  FirstOfMany inside;
  const auto require_gap = [&](const char* list, std::size_t index, double distance) {
    if (distance < radius) inside.add(distance, list, index);
  };
  for (std::size_t i = 0; i < scenario.boxes.size(); ++i)
    require_gap("boxes", i, distance_to_box(position, scenario.boxes[i]));
  for (std::size_t i = 0; i < scenario.discs.size(); ++i)
    require_gap("discs", i, (position - scenario.discs[i].center).norm() - scenario.discs[i].radius);
  for (std::size_t i = 0; i < scenario.walls.size(); ++i)
    require_gap("walls", i, distance_to_segment(position, scenario.walls[i]));
  for (std::size_t i = 0; i < scenario.polygons.size(); ++i)
    if (distance_to_box(position, ground.bounds[i]) < radius)
      require_gap("polygons", i,
                  std::max(signed_distance_to_polygon(position, scenario.polygons[i].corners), 0.0));
  if (inside.any())
    report
        .add(where, "is ", inside.distance(), " m from ", inside.name(), ", less than the radius ", radius,
             " m", inside.and_more())
        .other = inside.name();
  require_free_cells(report, where, position, radius, scenario, ground);
}

constexpr std::size_t kMostPeople = 1000;       // who react to each other
constexpr std::size_t kMostWaypoints = 10'000;  // of all people together

void check_people(Report& report, const Scenario& scenario) {
  if (scenario.people.empty()) return;
  if (scenario.people.size() > kMostPeople)
    return static_cast<void>(
        report.add("people", "must be at most ", kMostPeople, ", and are ", scenario.people.size()));
  const StaticShapes shapes{scenario};
  std::size_t waypoints = 0;
  for (std::size_t i = 0; i < scenario.people.size(); ++i) {
    const PersonTask& person = scenario.people[i];
    const std::string where = entry("people", i, ".waypoints");
    report.require_radius(entry("people", i), person.radius);
    waypoints += person.waypoints.size();
    if (person.waypoints.empty() || waypoints > kMostWaypoints) {
      report.add(where, "must be at least 1, and at most ", kMostWaypoints, " of all people together");
      continue;
    }
    const auto finite = [](const Eigen::Vector2d& point) { return point.allFinite(); };
    if (!std::all_of(person.waypoints.begin(), person.waypoints.end(), finite)) {
      report.add(where, "must be finite");
      continue;
    }
    const Eigen::Vector2d& start = person.waypoints.front();
    const bool inside = std::any_of(
        scenario.polygons.begin(), scenario.polygons.end(),
        [&](const Polygon& shape) { return signed_distance_to_polygon(start, shape.corners) < 0.0; });
    if (inside || (scenario.map && scenario.map->occupied(start)))
      report.add(where, "must not begin inside a polygon or an occupied cell of the map");
    else if (const std::string problem = blocked_path(person, shapes); !problem.empty())
      report.add(where, problem);
  }
}

void report_overlap(Report& report, std::size_t robot, const FirstOfMany& inside) {
  if (inside.any())
    report
        .add(entry("robots", robot, ".start"), "is inside ", inside.name(), ": centres ", inside.distance(),
             " m apart", inside.and_more())
        .other = inside.name();
}

void check_robots(Report& report, const Scenario& scenario) {
  if (scenario.robots.empty()) report.add("robots", "at least one robot is needed");
  std::vector<Eigen::Vector2d> starts;
  const Ground ground{scenario};
  for (std::size_t i = 0; i < scenario.robots.size(); ++i) {
    const RobotTask& task = scenario.robots[i];
    const double radius = scenario.robot_of(i).radius;
    check_position(report, entry("robots", i, ".start"), task.start.position_world, radius, scenario, ground);
    check_position(report, entry("robots", i, ".goal"), task.goal_world, radius, scenario, ground);
    for (std::size_t k = 0; k < task.next_goals.size(); ++k)
      check_position(report, entry("robots", i, entry(".next_goals", k).c_str()),
                     task.next_goals[k].position_world, radius, scenario, ground);
    if (!std::isfinite(task.start.heading))
      report.add(entry("robots", i, ".start"), "heading must be finite");
    if (task.goal_heading && !std::isfinite(*task.goal_heading))
      report.add(entry("robots", i, ".goal"), "heading must be finite");
    if (!task.start.position_world.allFinite()) continue;
    FirstOfMany inside;
    for (std::size_t d = 0; d < scenario.moving.size(); ++d) {
      const double gap = (task.start.position_world - scenario.moving[d].position_world).norm();
      if (gap < radius + scenario.moving[d].radius) inside.add(gap, "moving", d);
    }
    for (std::size_t p = 0; p < scenario.people.size(); ++p) {
      const PersonTask& person = scenario.people[p];
      const auto elsewhere = [&](const Eigen::Vector2d& point) { return point != person.waypoints.front(); };
      const bool draws =
          person.anywhere && std::any_of(person.waypoints.begin(), person.waypoints.end(), elsewhere);
      if (person.waypoints.empty() || draws) continue;
      const double gap = (task.start.position_world - person.waypoints.front()).norm();
      if (gap < radius + person.radius) inside.add(gap, "people", p);
    }
    report_overlap(report, i, inside);
    starts.push_back(task.start.position_world);
  }
  if (starts.size() != scenario.robots.size()) return;  // not finite: indices below would not fit
  const double largest_sum = 2.0 * scenario.largest_radius();
  UniformGrid grid{std::max(largest_sum, 1e-3)};
  grid.assign(starts);
  for (std::size_t i = 0; i < starts.size(); ++i) {
    FirstOfMany inside;
    grid.visit(starts[i], largest_sum, [&](int other) {
      const std::size_t j = static_cast<std::size_t>(other);
      const double gap = (starts[i] - starts[j]).norm();
      const bool both = !joins_later(scenario, i) && !joins_later(scenario, j);
      if (both && j < i && gap < scenario.robot_of(i).radius + scenario.robot_of(j).radius)
        inside.add(gap, "robots", j);
    });
    report_overlap(report, i, inside);
  }
}

void check_events(Report& report, const Scenario& scenario) {
  const int robots = static_cast<int>(scenario.robots.size());
  const Ground ground{scenario};
  for (std::size_t i = 0; i < scenario.events.size(); ++i) {
    const FleetEvent& event = scenario.events[i];
    const int robot = event.order.robot;
    if (!(event.time >= 0.0 && std::isfinite(event.time)))
      report.add(entry("events", i, ".at"), "must be a time of 0 s or more");
    if (event.after_robot >= robots)
      report.add(entry("events", i, ".after.robot"), "must be below ", robots, ", the number of robots");
    if (robot < 0 || robot >= robots) {
      report.add(entry("events", i, ".robot"), "must be below ", robots, ", the number of robots");
      continue;
    }
    if (event.order.act != FleetAct::goal) continue;
    const Eigen::Vector2d& goal = event.order.goal.position_world;
    if (!goal.allFinite())
      report.add(entry("events", i, ".goal"), "must say where to");
    else
      check_position(report, entry("events", i, ".goal"), goal, scenario.robot_of(as_index(robot)).radius,
                     scenario, ground);
    if (!std::isfinite(event.order.goal.heading.value_or(0.0)))
      report.add(entry("events", i, ".goal_heading"), "must be finite");
  }
}

}  // namespace

std::string to_text(const ScenarioProblem& problem) {
  return problem.where + " " + (problem.value.empty() ? "" : problem.value + " ") + problem.what;
}

std::vector<ScenarioProblem> problems_of(const Scenario& scenario) {
  Report report;
  for (const std::string& problem : problems(scenario.robot)) report.add("robot", problem);
  for (std::size_t i = 0; i < scenario.fleet.size(); ++i)
    for (const std::string& problem : problems(scenario.fleet[i])) report.add(entry("fleet", i), problem);
  const std::size_t kinds = std::max<std::size_t>(1, scenario.fleet.size());
  bool known = true;
  for (std::size_t i = 0; i < scenario.robots.size(); ++i)
    if (scenario.robots[i].kind >= kinds) {
      known = false;
      report.add(entry("robots", i, ".kind"), "must be below ", kinds, ", the number of kinds of robots");
    }
  if (!known) return report.take();
  for (const std::string& problem : problems(scenario.simulation)) report.add("simulation", problem);
  if (std::remainder(scenario.simulation.trial.plant_rate, 10.0) != 0.0)
    report.add("simulation", "trial.plant_rate = ", scenario.simulation.trial.plant_rate,
               " [Hz] must be a multiple of 10 Hz");
  check_shapes(report, scenario);
  if (report.none()) check_people(report, scenario);
  check_robots(report, scenario);
  check_events(report, scenario);
  return report.take();
}

double Scenario::largest_radius() const {
  return sim::largest_radius(robot, fleet);
}

double largest_radius(const RobotParameters& robot, const std::vector<RobotParameters>& fleet) {
  double largest = fleet.empty() ? robot.radius : 0.0;
  for (const RobotParameters& kind : fleet) largest = std::max(largest, kind.radius);
  return largest;
}

double rest_to_rest_time(double distance, double max_speed, double max_acceleration) {
  if (distance >= max_speed * max_speed / max_acceleration)
    return distance / max_speed + max_speed / max_acceleration;
  return 2.0 * std::sqrt(std::max(distance, 0.0) / max_acceleration);
}

double slowest_time_of(const Scenario& scenario) {
  double slowest = 0.0;
  for (std::size_t i = 0; i < scenario.robots.size(); ++i) {
    const RobotTask& task = scenario.robots[i];
    const RobotParameters& robot = scenario.robot_of(i);
    slowest = std::max(slowest, rest_to_rest_time((task.goal_world - task.start.position_world).norm(),
                                                  robot.max_speed, robot.max_acceleration));
  }
  return slowest;
}

bool has_life(const Scenario& scenario) {
  return scenario.simulation.trial.goals != GoalSupply::listed || !scenario.events.empty() ||
         std::any_of(scenario.robots.begin(), scenario.robots.end(),
                     [](const RobotTask& task) { return !task.next_goals.empty(); });
}

bool joins_later(const Scenario& scenario, std::size_t robot) {
  for (const FleetEvent& event : scenario.events) {
    if (event.order.robot != static_cast<int>(robot)) continue;
    if (event.order.act == FleetAct::join) return true;
    if (event.order.act == FleetAct::leave) return false;
  }
  return false;
}

double time_limit_of(const Scenario& scenario) {
  if (scenario.simulation.trial.time_limit > 0.0) return scenario.simulation.trial.time_limit;
  return std::max(120.0, 4.0 * slowest_time_of(scenario));
}

void give_kinds_in_turn(Scenario& scenario) {
  if (scenario.fleet.empty()) return;
  for (std::size_t i = 0; i < scenario.robots.size(); ++i)
    scenario.robots[i].kind = i % scenario.fleet.size();
}

std::uint64_t stream_seed(const Scenario& scenario, StreamRole role, std::uint64_t index) {
  const std::uint64_t trial = mix(scenario.seed, static_cast<std::uint64_t>(scenario.trial));
  return mix(mix(trial, static_cast<std::uint64_t>(role)), index);
}

}  // namespace spf::sim
