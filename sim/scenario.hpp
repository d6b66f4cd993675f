// Ground truth of one trial: static shapes, dynamic obstacles, robots and their tasks. Frame: world, SI.
#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sim/fleet_event.hpp"
#include "sim/person_task.hpp"
#include "sim/segment.hpp"
#include "sim/simulation_parameters.hpp"
#include "sim/static_map.hpp"
#include "spf/math/pose2.hpp"
#include "spf/robot/robot_parameters.hpp"
#include "spf/world/obstacle_state.hpp"

namespace spf::sim {

/// Axis-aligned rectangle.
struct Box {
  Eigen::Vector2d low = Eigen::Vector2d::Zero();   ///< [m] lower left corner
  Eigen::Vector2d high = Eigen::Vector2d::Zero();  ///< [m] upper right corner
};

/// Static disc.
struct Disc {
  Eigen::Vector2d center = Eigen::Vector2d::Zero();  ///< [m]
  double radius = 0.5;                               ///< [m]
};

/// Static filled polygon: three corners or more, in either sense, whose sides do not cross.
struct Polygon {
  std::vector<Eigen::Vector2d> corners;  ///< [m]
};

struct RobotTask {
  Pose2 start;
  Eigen::Vector2d goal_world = Eigen::Vector2d::Zero();  ///< [m]
  std::optional<double> goal_heading;                    ///< [rad], free when absent
  std::size_t kind = 0;                                  ///< of Scenario::fleet, where that names kinds
  std::vector<host::Goal> next_goals = {};               ///< after the first, one after the other
};

/// One sample of a recorded crowd: a person is a disc that moves linearly between its samples, present from
/// its first to its last, and does not react.
struct CrowdSample {
  double time = 0.0;  ///< [s]
  int id = 0;
  Eigen::Vector2d position_world = Eigen::Vector2d::Zero();  ///< [m]
};

inline constexpr std::uint64_t kDefaultSeed = 20240501;

struct Scenario {
  std::string family = "custom";
  int trial = 0;  ///< k of docs/protocol.md
  std::uint64_t seed = kDefaultSeed;

  /// Bounds moving discs and robots: a centre stays inside by its radius; a robot that crosses it has hit the
  /// border.
  std::optional<Box> border;
  std::vector<Box> boxes;
  std::vector<Disc> discs;
  std::vector<Segment> walls;
  std::vector<Polygon> polygons;
  std::shared_ptr<const StaticMap> map;  ///< of cells; null = none. Trials share it
  std::vector<Segment> seams;            ///< crossing one makes the observed pose jump (PoseNoiseParameters)
  std::vector<ObstacleState> moving;     ///< moving discs at t = 0, ids 0, 1, 2, ...
  std::vector<CrowdSample> crowd;        ///< recorded people, sorted by time
  double crowd_radius = 0.25;            ///< [m] of each person
  double crowd_gap = kUnlimited;         ///< [s] a person without a sample for longer is absent meanwhile
  std::vector<PersonTask> people;        ///< who walk from waypoint to waypoint
  std::vector<RobotTask> robots;
  RobotParameters robot;               ///< of all robots, unless there are kinds of them
  std::vector<RobotParameters> fleet;  ///< the kinds of robots; empty: all are alike
  std::vector<FleetEvent> events;      ///< what happens to robots while the trial runs
  SimulationParameters simulation;

  /// Parameters of the robot `number`.
  [[nodiscard]] const RobotParameters& robot_of(std::size_t number) const {
    return fleet.empty() ? robot : fleet[robots[number].kind];
  }
  /// [m] of the largest robot.
  [[nodiscard]] double largest_radius() const;
};

/// [m] of the largest robot of a fleet, which where it is empty is that of `robot`.
[[nodiscard]] double largest_radius(const RobotParameters& robot, const std::vector<RobotParameters>& fleet);

/// A rule that a scenario breaks. Entries are named as in scenario files.
struct ScenarioProblem {
  std::string where;  ///< the entry that breaks it: "robots[3].start"
  std::string what;   ///< "must be finite"
  std::string value;  ///< of the entry, where it is a point: "(1, 2)"
  std::string other;  ///< the other entry involved: "discs[2]", empty = none
};
/// "robots[3].start (1, 2) must be finite"
[[nodiscard]] std::string to_text(const ScenarioProblem& problem);

/// Everything that makes the scenario unusable: numbers out of range or not finite, boxes inside out, robots
/// or goals inside an obstacle, each other or beyond the border. Of all that overlaps one position the first
/// is reported and the others are counted. Empty when it can run.
[[nodiscard]] std::vector<ScenarioProblem> problems_of(const Scenario& scenario);

/// Time of the fastest rest-to-rest motion over a straight distance [s]: a trapezoid of speed.
[[nodiscard]] double rest_to_rest_time(double distance, double max_speed, double max_acceleration);

/// Time of the fastest motion to the goal [s] of the robot that needs the longest, were there no obstacles.
[[nodiscard]] double slowest_time_of(const Scenario& scenario);

/// Whether robots do more than go to one goal each.
[[nodiscard]] bool has_life(const Scenario& scenario);
/// Whether the robot is not there at first, since it joins later.
[[nodiscard]] bool joins_later(const Scenario& scenario, std::size_t robot);

/// Gives the robots the kinds of the fleet one after the other, from the first again after the last.
void give_kinds_in_turn(Scenario& scenario);

/// The trial's time limit [s]: as set, or max(120 s, 4 times the slowest robot's obstacle-free time)
/// (docs/protocol.md).
[[nodiscard]] double time_limit_of(const Scenario& scenario);

/// What a random stream is for. Streams of different roles or indices are independent, and none is the
/// scene's or the obstacles' (docs/protocol.md).
enum class StreamRole : std::uint64_t {
  pose = 0x504F5345'00000000ULL,
  seam = 0x5345414D'00000000ULL,
  detection = 0x44455445'00000000ULL,
  scan = 0x5343414E'00000000ULL,
  radio = 0x52414449'00000000ULL,
  people = 0x50454F50'00000000ULL,
  goal = 0x474F414C'00000000ULL,
};
/// Seed of the stream of one role and index in a trial.
[[nodiscard]] std::uint64_t stream_seed(const Scenario& scenario, StreamRole role, std::uint64_t index);

}  // namespace spf::sim
