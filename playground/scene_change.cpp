#include "playground/scene_change.hpp"

#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

#include <nlohmann/json.hpp>

#include "sim/contact.hpp"
#include "sim/walkers.hpp"
#include "spf/math/random_stream.hpp"

namespace spf::playground {
namespace {

using nlohmann::json;
using Kind = SceneChange::Kind;

constexpr double kFarthest = 1000.0;      // [m] of a coordinate
constexpr int kMostPeople = 60;           // in a scene, so that it stays lively
constexpr std::size_t kMostShapes = 500;  // likewise walls, and pillars

constexpr std::array<std::pair<const char*, Kind>, 8> kKinds{{{"goal", Kind::goal},
                                                              {"robot", Kind::robot},
                                                              {"moving", Kind::moving},
                                                              {"person", Kind::person},
                                                              {"crowd", Kind::crowd},
                                                              {"wall", Kind::wall},
                                                              {"pillar", Kind::pillar},
                                                              {"risk", Kind::risk}}};

[[noreturn]] void refuse(const std::string& key, const json& value, const std::string& limit) {
  throw std::invalid_argument{"change: " + key + " = " + value.dump().substr(0, 60) + " must be " + limit};
}

const json& value_of(const json& change, const char* key) {
  const auto found = change.find(key);
  if (found == change.end()) throw std::invalid_argument{std::string{"change: "} + key + " is missing"};
  return *found;
}

double number_of(const json& change, const char* key, double low, double high, const char* unit) {
  const json& value = value_of(change, key);
  const auto limit = [&] {
    return "a number in [" + json(low).dump() + ", " + json(high).dump() + "] " + unit;
  };
  if (!value.is_number()) refuse(key, value, limit());
  const double number = value.get<double>();
  if (!(number >= low && number <= high)) refuse(key, value, limit());
  return number;
}

int index_of(const json& change, const char* key, int high) {
  const json& value = value_of(change, key);
  const std::string limit = "a whole number in [0, " + std::to_string(high) + "]";
  if (!value.is_number_integer()) refuse(key, value, limit);
  const auto number = value.get<std::int64_t>();
  if (number < 0 || number > high) refuse(key, value, limit);
  return static_cast<int>(number);
}

Eigen::Vector2d point_of(const json& change, const char* key) {
  const json& value = value_of(change, key);
  const auto good = [](const json& number) {
    return number.is_number() && std::abs(number.get<double>()) <= kFarthest;
  };
  if (!value.is_array() || value.size() != 2 || !good(value[0]) || !good(value[1]))
    refuse(key, value, "[x, y] in [-1000, 1000] m");
  return {value[0].get<double>(), value[1].get<double>()};
}

SceneChange change_of(Kind kind, const json& change) {
  SceneChange read;
  read.kind = kind;
  switch (kind) {
    case Kind::goal:
    case Kind::robot:
      read.index = index_of(change, "robot", 9999);
      read.at = point_of(change, "at");
      break;
    case Kind::moving:
      read.index = index_of(change, "id", 9999);
      read.at = point_of(change, "at");
      break;
    case Kind::person:
      read.at = point_of(change, "at");
      read.to = point_of(change, "to");
      break;
    case Kind::crowd:
      read.index = index_of(change, "people", kMostPeople);
      break;
    case Kind::wall:
      read.at = point_of(change, "from");
      read.to = point_of(change, "to");
      break;
    case Kind::pillar:
      read.at = point_of(change, "at");
      read.number = number_of(change, "radius", 0.05, 5.0, "m");
      break;
    case Kind::risk:
      read.number = number_of(change, "seconds", 0.0, 1e6, "s");
      break;
  }
  return read;
}

sim::PersonTask walk(const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  sim::PersonTask task;
  task.waypoints.push_back(from);
  if ((to - from).norm() > 0.1) task.waypoints.push_back(to);
  return task;
}

/// People on straight ways through the free space between the robots' starts and goals, none of whom begins
/// beside a robot.
void add_crowd(int people, sim::Scenario& scenario) {
  constexpr double kGap = 1.5;       // [m] to where a robot begins or another person does
  constexpr double kShortest = 4.0;  // [m] way
  constexpr int kMostDraws = 20'000;
  Eigen::Vector2d low = scenario.robots.front().start.position_world;
  Eigen::Vector2d high = low;
  for (const sim::RobotTask& robot : scenario.robots) {
    low = low.cwiseMin(robot.start.position_world).cwiseMin(robot.goal_world);
    high = high.cwiseMax(robot.start.position_world).cwiseMax(robot.goal_world);
  }
  const sim::StaticShapes shapes{scenario};
  RandomStream random{sim::stream_seed(scenario, sim::StreamRole::people, 1'000'000)};
  const auto draw = [&] {
    return Eigen::Vector2d{low +
                           (high - low).cwiseProduct(Eigen::Vector2d{random.uniform(), random.uniform()})};
  };
  const std::size_t wanted = scenario.people.size() + static_cast<std::size_t>(people);
  for (int i = 0; i < kMostDraws && scenario.people.size() < wanted; ++i) {
    const Eigen::Vector2d from = draw();
    const Eigen::Vector2d to = draw();
    bool good = (to - from).norm() >= kShortest && !shapes.first_contact({from, to}, 0.4);
    for (const sim::RobotTask& robot : scenario.robots)
      good = good && (robot.start.position_world - from).norm() > kGap;
    for (const sim::PersonTask& person : scenario.people)
      good = good && (person.waypoints.front() - from).norm() > kGap;
    if (good) scenario.people.push_back(walk(from, to));
  }
}

void require_index(int index, std::size_t count, const char* what) {
  if (static_cast<std::size_t>(index) >= count)
    throw std::invalid_argument{std::string{"change: "} + what + " = " + std::to_string(index) +
                                ", of which there are " + std::to_string(count)};
}

/// Whoever walks there and back turns before what is in the way now.
void shorten_ways(sim::Scenario& scenario) {
  const sim::StaticShapes shapes{scenario};
  for (sim::PersonTask& person : scenario.people) {
    if (person.waypoints.size() != 2 || sim::blocked_path(person, shapes).empty()) continue;
    const Eigen::Vector2d from = person.waypoints.front();
    const Eigen::Vector2d way = person.waypoints.back() - from;
    double free = 0.0;
    for (double share = 0.5; share > 1e-3; share *= 0.5) {
      person.waypoints.back() = from + (free + share) * way;
      if (sim::blocked_path(person, shapes).empty()) free += share;
    }
    person.waypoints.back() = from + free * way;
  }
}

void apply_unchecked(const SceneChange& change, sim::Scenario& scenario) {
  const auto index = static_cast<std::size_t>(change.index);
  switch (change.kind) {
    case Kind::goal:
      require_index(change.index, scenario.robots.size(), "robot");
      scenario.robots[index].goal_world = change.at;
      break;
    case Kind::robot:
      require_index(change.index, scenario.robots.size(), "robot");
      scenario.robots[index].start.position_world = change.at;
      break;
    case Kind::moving:
      require_index(change.index, scenario.moving.size(), "id");
      scenario.moving[index].position_world = change.at;
      break;
    case Kind::person:
      scenario.people.push_back(walk(change.at, change.to));
      break;
    case Kind::crowd:
      add_crowd(change.index, scenario);
      break;
    case Kind::wall:
      scenario.walls.push_back({change.at, change.to});
      shorten_ways(scenario);
      break;
    case Kind::pillar:
      scenario.discs.push_back({change.at, change.number});
      shorten_ways(scenario);
      break;
    case Kind::risk:
      break;
  }
  if (scenario.people.size() > kMostPeople) throw std::invalid_argument{"there are 60 people already"};
  if (scenario.walls.size() > kMostShapes || scenario.discs.size() > kMostShapes)
    throw std::invalid_argument{"there are 500 walls or pillars already"};
}

}  // namespace

SceneChange scene_change(const std::string& text) {
  const json change = json::parse(text, nullptr, false);
  if (!change.is_object()) throw std::invalid_argument{"change: is not a JSON object"};
  const json& kind = value_of(change, "do");
  std::string all;
  for (const auto& [name, one] : kKinds) {
    if (kind == name) return change_of(one, change);
    all += (all.empty() ? "" : ", ") + std::string{name};
  }
  refuse("do", kind, "one of " + all);
}

void apply(const SceneChange& change, sim::Scenario& scenario) {
  sim::Scenario changed = scenario;
  apply_unchecked(change, changed);
  std::string reasons;
  for (const sim::ScenarioProblem& problem : sim::problems_of(changed))
    reasons += (reasons.empty() ? "" : "; ") + sim::to_text(problem);
  if (!reasons.empty()) throw std::invalid_argument{reasons};
  scenario = std::move(changed);
}

}  // namespace spf::playground
