// Scenario files: a family of the experiment protocol (docs/protocol.md) or an explicit scene, and everything
// that differs from the defaults. Reading one gives a RunConfiguration, which determines every trial's ground
// truth and every robot's parameters. Frame: world, SI.
#pragma once

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "config/hiding_visitor.hpp"
#include "config/input_problem.hpp"
#include "config/method_choice.hpp"
#include "sim/families.hpp"
#include "sim/scenario.hpp"
#include "study/crowd_file.hpp"
#include "study/fleet_entries.hpp"
#include "study/map_file.hpp"

namespace spf {

/// Source of the scene: drawn by a family of the simulator, or (none) written out in the file.
struct SceneFamily {
  std::optional<sim::Family> drawn;

  friend constexpr bool operator==(const SceneFamily& a, const SceneFamily& b) { return a.drawn == b.drawn; }
  friend constexpr bool operator!=(const SceneFamily& a, const SceneFamily& b) { return !(a == b); }
};
inline constexpr SceneFamily kExplicitScene{};

template <std::size_t... i>
[[nodiscard]] constexpr auto scene_family_names(std::index_sequence<i...>) {
  constexpr auto& drawn = EnumNames<sim::Family>::values;
  return std::array<std::pair<SceneFamily, const char*>, sizeof...(i) + 1>{
      {{SceneFamily{drawn[i].first}, drawn[i].second}..., {kExplicitScene, "explicit"}}};
}
template <>
struct EnumNames<SceneFamily> {
  static constexpr auto values =
      scene_family_names(std::make_index_sequence<EnumNames<sim::Family>::values.size()>{});
};

/// Kind of a robot that takes the next of the fleet's.
inline constexpr int kInTurn = -1;

/// One kind of robots in a fleet whose robots are not all alike. What an entry does not set is as the rest of
/// the file says for all robots; defaults that follow the robot follow this one.
struct RobotKind {
  MethodChoice method;
  RobotParameters robot;
  AgentParameters agent;  ///< without its robot: that is `robot`

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit_robot(self, visit);
    PartlyHidden<std::remove_reference_t<decltype((self.agent))>> agent{self.agent, {"robot"}};
    visit.group("agent", agent);
  }
  /// What the defaults of the rest depend on.
  template <class Self, class Visitor>
  static void visit_robot(Self& self, Visitor&& visit) {
    visit("method", self.method, "how robots of this kind plan and track");
    visit.group("robot", self.robot);
  }
};

struct RobotEntry {
  int kind = kInTurn;
  Eigen::Vector2d start = kUnsetPoint;
  std::optional<double> heading;
  Eigen::Vector2d goal = kUnsetPoint;
  std::optional<double> goal_heading;
  std::vector<Eigen::Vector2d> next_goals;

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit.required("start");
    visit.required("goal");
    visit("kind", self.kind, "1", Range{kInTurn, 9999},
          "which entry of fleet the robot is of; -1: they are taken in turn");
    visit("start", self.start, "m", kCoordinate, "where the robot's centre is at the beginning");
    visit("heading", self.heading, "rad", Range{-6.3, 6.3},
          "of its x axis at the beginning; none: towards the goal");
    visit("goal", self.goal, "m", kCoordinate, "where it is to go");
    visit("goal_heading", self.goal_heading, "rad", Range{-6.3, 6.3}, "of its x axis at the goal; none: any");
    visit.values("next_goals", self.next_goals, "m", kCoordinate,
                 "where it is to go then, one after the other, as [[4, 0], [0, 0]] (trial.goals)");
  }
};

struct BoxEntry {
  Eigen::Vector2d low = kUnsetPoint;
  Eigen::Vector2d high = kUnsetPoint;

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit.required("low");
    visit.required("high");
    visit("low", self.low, "m", kCoordinate, "lower left corner");
    visit("high", self.high, "m", kCoordinate, "upper right corner");
  }
};

struct DiscEntry {
  Eigen::Vector2d center = kUnsetPoint;
  double radius = 0.5;

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit.required("center");
    visit("center", self.center, "m", kCoordinate, "middle of the disc");
    visit("radius", self.radius, "m", Range{0.001, 1000.0}, "radius of the disc");
  }
};

struct WallEntry {
  Eigen::Vector2d from = kUnsetPoint;
  Eigen::Vector2d to = kUnsetPoint;

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit.required("from");
    visit.required("to");
    visit("from", self.from, "m", kCoordinate, "one end");
    visit("to", self.to, "m", kCoordinate, "the other end");
  }
};

struct PolygonEntry {
  std::vector<Eigen::Vector2d> corners;

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit.required("corners");
    visit.values("corners", self.corners, "m", kCoordinate,
                 "its corners one after the other, as [[0, 0], [1, 0], [1, 2]]; the last joins the first");
  }
};

struct MovingEntry {
  Eigen::Vector2d position = kUnsetPoint;
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();
  double radius = 0.4;

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit.required("position");
    visit("position", self.position, "m", kCoordinate, "where its centre is at the beginning");
    visit("velocity", self.velocity, "m/s", Range{-100.0, 100.0}, "its velocity at the beginning");
    visit("radius", self.radius, "m", Range{0.001, 1000.0}, "its radius");
  }
};

struct PersonEntry {
  sim::PersonTask task;

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit.required("waypoints");
    visit.values("waypoints", self.task.waypoints, "m", kCoordinate,
                 "where the person walks, as [[0, 0], [4, 0]]; the first is the start");
    visit("speed", self.task.speed, "m/s", Range{0.05, 5.0}, "how fast he or she likes to walk");
    visit("radius", self.task.radius, "m", Range{0.01, 10.0}, "radius of the body");
    visit("behaviour", self.task.behaviour,
          "fixed: straight on, whatever is in the way; reacting: avoids robots, people and what stands");
    visit("at_last", self.task.at_last,
          "at the last waypoint: back along the path, on to the first, or stay");
    visit("anywhere", self.task.anywhere, "every trial draws where on the path the person starts");
  }
};

/// Where and when recorded people are in an explicit scene.
struct CrowdPlacement {
  Eigen::Vector2d origin = Eigen::Vector2d::Zero();
  double heading = 0.0;
  double begin = 0.0;
  double spacing = 5.0;

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit("origin", self.origin, "m", kCoordinate, "where the origin of the recording lies in the scene");
    visit("heading", self.heading, "rad", Range{-6.3, 6.3}, "where its x axis points");
    visit("begin", self.begin, "s", Range{0.0, 1e7}, "trial 0 begins so long after the first sample");
    visit("spacing", self.spacing, "s", Range{0.0, 1e6},
          "and trial k so many times later; after the recording's end from its beginning on");
  }
};

/// The scene of a file with `family: explicit`.
struct ExplicitScene {
  std::vector<RobotEntry> robots;
  std::optional<BoxEntry> border;
  std::vector<BoxEntry> boxes;
  std::vector<DiscEntry> discs;
  std::vector<WallEntry> walls;
  std::vector<PolygonEntry> polygons;
  std::string map;  ///< path of the map, absolute once read; empty = none
  MapSettings map_settings;
  std::vector<WallEntry> seams;
  std::vector<MovingEntry> moving;
  std::vector<PersonEntry> people;
  CrowdPlacement crowd_placement;  ///< of RunConfiguration::crowd

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit.required("robots");
    visit.list("robots", self.robots, "the robots; robot 0 has the highest priority");
    visit.optional_group("border", self.border, "the box that robots and moving discs stay inside");
    visit.list("boxes", self.boxes, "static axis-parallel boxes");
    visit.list("discs", self.discs, "static discs");
    visit.list("walls", self.walls, "thin walls");
    visit.list("polygons", self.polygons, "static filled polygons, whose sides do not cross");
    visit("map", self.map,
          "static map: the YAML file of a ROS map server, or a picture (PGM, PNG), beside the scenario file, "
          "or with --set in the working directory; nothing is beyond its edges");
    visit.group("map_settings", self.map_settings);
    visit.list("seams", self.seams, "lines at which an observed pose jumps (pose_noise.seam_sigma)");
    visit.list("moving", self.moving, "moving discs; they bounce off the border and static shapes");
    visit.list("people", self.people, "people who walk from waypoint to waypoint");
    visit.group("crowd_placement", self.crowd_placement);
  }
};

/// A scenario file with all its defaults filled in.
struct RunConfiguration {
  SceneFamily family;
  std::uint64_t seed = sim::kDefaultSeed;
  MethodChoice method;
  sim::LayoutParameters layout;  ///< of a drawn family
  std::string crowd;             ///< of ped and of explicit scenes: path of the recording, absolute once read
  CrowdSettings crowd_settings;
  std::shared_ptr<const sim::CrowdRecording> recording;  ///< the recording itself; not among the fields
  ExplicitScene scene;                                   ///< of an explicit one
  std::shared_ptr<const sim::StaticMap> map;             ///< its map, null = none; not among the fields
  std::vector<EventEntry> events;
  RobotParameters robot;
  std::vector<RobotKind> fleet;  ///< the kinds of robots; empty: all are alike
  sim::SimulationParameters simulation;
  AgentParameters agent;               ///< without its robot: that is `robot`
  std::vector<InputProblem> warnings;  ///< of settings that contradict each other; not among the fields

  /// All keys, in the order in which they are written.
  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit_head(self, visit);
    visit_fleet(self, visit);
    visit_scene(self, visit);
    visit.group("robot", self.robot);
    visit_parameters(self, visit);
  }
  /// Reading follows another order, since defaults depend on other keys of the file: the head names family
  /// and method, these determine the default robot, and all three the defaults of the rest.
  template <class Self, class Visitor>
  static void visit_head(Self& self, Visitor&& visit);
  template <class Self, class Visitor>
  static void visit_scene(Self& self, Visitor&& visit);
  template <class Self, class Visitor>
  static void visit_fleet(Self& self, Visitor&& visit);
  template <class Self, class Visitor>
  static void visit_parameters(Self& self, Visitor&& visit);
};

/// The defaults of a family and a method.
[[nodiscard]] RunConfiguration default_run_configuration(SceneFamily family, const MethodChoice& method);
/// The same for another robot than the family's: defaults that follow the robot (ScaledUnit) follow this one.
[[nodiscard]] RunConfiguration default_run_configuration(SceneFamily family, const MethodChoice& method,
                                                         const RobotParameters& robot);

/// One value written over the file's.
struct Setting {
  std::string assignment;        ///< key.path=value
  std::string source = "--set";  ///< where it comes from, for messages
};

/// Reads a file and applies settings over it. Throws InputError with every problem: of form, of single
/// values, of those that contradict each other, and of the scene (robots inside obstacles, ...). `methods`
/// are those that it may name.
[[nodiscard]] RunConfiguration read_run_configuration(const std::string& path,
                                                      const std::vector<Setting>& settings = {},
                                                      const MethodTable& methods = {});
/// The same from text; `name` stands for the file in messages.
[[nodiscard]] RunConfiguration run_configuration_from_text(const std::string& text, const std::string& name,
                                                           const std::vector<Setting>& settings = {},
                                                           const MethodTable& methods = {});

/// The text of a file that gives this configuration, with every key written out. With `explains`, each has a
/// comment.
[[nodiscard]] std::string to_yaml_text(const RunConfiguration& config, bool explains = false);

/// Ground truth of trial k. Throws std::runtime_error when a family finds no scene for its layout, or the
/// recording has no such window.
[[nodiscard]] sim::Scenario make_trial(const RunConfiguration& config, int trial);

/// Number of trials: the windows of a recording; empty (unlimited) otherwise.
[[nodiscard]] std::optional<int> trial_count(const RunConfiguration& config);
/// Why trials `first` to `first + trials - 1` cannot all be run; empty when they can.
[[nodiscard]] std::string trials_problem(const RunConfiguration& config, int first, int trials);
/// Text that is equal for two configurations when all their trials are, wherever their recordings are stored.
[[nodiscard]] std::string identity_text(const RunConfiguration& config);

/// Parameters of the robots: `agent` with the configuration's robot, or those of each kind where there are
/// kinds. An observer whose pose_sigma or heading_sigma is 0 (the default, "as exact as the scenario says")
/// is set to the scenario's pose_noise; any other value is used as written, so that an observer can be
/// misinformed on purpose.
[[nodiscard]] std::vector<AgentParameters> agents_of(const RunConfiguration& config);
/// The same where all robots are alike, or of the first kind.
[[nodiscard]] AgentParameters agent_parameters(const RunConfiguration& config);

// ---- implementation of the field list

template <class Self, class Visitor>
void RunConfiguration::visit_head(Self& self, Visitor&& visit) {
  visit.required("family");
  visit("family", self.family, "family of scenes (docs/protocol.md), or explicit: the scene is in the file");
  visit("seed", self.seed, "1", Range{0.0, 18446744073709551615.0}, "seed of everything random");
  visit("method", self.method, "how robots plan and track: a set of agent parameters");
}

template <class Self, class Visitor>
void RunConfiguration::visit_scene(Self& self, Visitor&& visit) {
  if (self.family.drawn)
    visit("robots", self.layout.robots, "1", Range{1, 10000}, "number of robots");
  else
    ExplicitScene::visit_fields(self.scene, visit);
  if (!self.family.drawn || self.family.drawn == sim::Family::ped) {
    visit("crowd", self.crowd,
          "recorded people: a file (docs/scenarios.md says of which formats), beside the scenario file, or "
          "with --set in the working directory (family: ped, explicit)");
    visit.group("crowd_settings", self.crowd_settings);
  }
  if (self.family.drawn) {
    PartlyHidden<std::remove_reference_t<decltype((self.layout))>> layout{self.layout, {"robots"}};
    visit.group("layout", layout);
  }
  visit.list("events", self.events,
             "what happens to robots while a trial runs, as {at: 5, robot: 0, do: pause}");
}

template <class Self, class Visitor>
void RunConfiguration::visit_fleet(Self& self, Visitor&& visit) {
  visit.list(
      "fleet", self.fleet,
      "kinds of robots, taken in turn: a list of maps with method, robot and agent, as far as they differ "
      "from those of the file; none: all are alike");
}

template <class Self, class Visitor>
void RunConfiguration::visit_parameters(Self& self, Visitor&& visit) {
  sim::SimulationParameters::visit_fields(self.simulation, visit);
  PartlyHidden<std::remove_reference_t<decltype((self.agent))>> agent{self.agent, {"robot"}};
  visit.group("agent", agent);
}

}  // namespace spf
