// What the hosts of a real robot must know beyond its agent: which data the robot relies on, and what no
// honest sensor, clock or peer would say.
#pragma once

#include <array>
#include <utility>

#include "host/guard_parameters.hpp"
#include "host/map_grain.hpp"
#include "spf/math/parameters.hpp"

namespace spf {

namespace host {
/// Which readings of a range sensor say that nothing is there. Infinity and readings beyond its range always
/// do; what is none of these and no range is no reading: covered, broken, or too near.
enum class NoReturn { infinite, zero, nan, any };
}  // namespace host

template <>
struct EnumNames<host::NoReturn> {
  static constexpr std::array<std::pair<host::NoReturn, const char*>, 4> values{
      {{host::NoReturn::infinite, "infinite"},
       {host::NoReturn::zero, "zero"},
       {host::NoReturn::nan, "nan"},
       {host::NoReturn::any, "any"}}};
};

}  // namespace spf

namespace spf::host {

struct HostParameters {
  bool relies_on_scan = true;               ///< stands without fresh scans
  bool relies_on_obstacles = true;          ///< stands without fresh reports of moving obstacles
  NoReturn no_return = NoReturn::infinite;  ///< how the scanner says that nothing is there
  double least_plan_interval = 0.02;        ///< [s] between two plans that observations bring forward
  double plan_silence = 0.5;                ///< [s] without a word of the planner until the tracker brakes
  double command_silence = 0.5;             ///< [s] without a word of what the wheels are told: they stand
  double largest_plan_error = 0.6;  ///< [m] farther from its plan the tracker stands and waits for a new one
  double jump_distance = 0.5;       ///< [m] beyond what the robot can drive: the pose has jumped
  double jump_heading = 0.5;        ///< [rad] likewise
  double jump_persistence = 0.5;    ///< [s] a jump that lasts is believed: the robot was relocalised
  double clock_error = 0.1;         ///< [s] by which a stamp may be ahead of the clock
  double clock_jump = 1.0;          ///< [s] between two steps: beyond, the clock has jumped
  double goal_heading_tolerance = 0.1;  ///< [rad] within which the heading of the goal is reached
  double goal_patience = 10.0;          ///< [s] without a path to the goal until it is given up
  double goal_memory = 10.0;            ///< [s] of absence after which a goal is not taken up again
  bool trusts_peers = false;            ///< peers are taken at their word, unchecked
  double peer_clock_error = 0.05;       ///< [s] beyond, a peer's clock is off and the peer a stranger
  double largest_peer_radius = 2.0;     ///< [m] messages of larger peers are malformed
  double largest_peer_sigma = 1.0;      ///< [m] likewise of those who do not know where they are
  double largest_peer_speed = 10.0;     ///< [m/s] likewise of faster ones
  double grid_size = 40.0;  ///< [m] side of the sensed map, around the start, where no map is given
  MapGrain map_grain;
  GuardParameters guard;

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit("relies_on_scan", self.relies_on_scan, "the robot stands without fresh scans");
    visit("relies_on_obstacles", self.relies_on_obstacles,
          "the robot stands without fresh reports of moving obstacles, empty ones included");
    visit("no_return", self.no_return,
          "readings of the scanner that mean \"nothing there\" beside infinite ones and those beyond its "
          "range");
    visit("least_plan_interval", self.least_plan_interval, "s", Range{0.005, 10.0},
          "an observation is planned with at once, but not within this time of the plan with the last one; "
          "with agent.team.plan_period or more plans keep to that period");
    visit("plan_silence", self.plan_silence, "s", Range{0.05, 10.0},
          "without a word of the planner for this long the tracker brakes");
    visit("command_silence", self.command_silence, "s", Range{0.05, 10.0},
          "without a word of what the wheels are told for this long they are taken to stand");
    visit("largest_plan_error", self.largest_plan_error, kMetresByStopping, Range{0.05, 100.0},
          "farther from its plan the tracker stands and waits for a new one");
    visit("jump_distance", self.jump_distance, kMetresBySize, Range{0.01, 1000.0},
          "a pose farther from where the robot can be is a jump");
    visit("jump_heading", self.jump_heading, "rad", Range{0.01, 6.3}, "likewise its heading");
    visit("jump_persistence", self.jump_persistence, "s", Range{0.0, 60.0},
          "a jump that lasts for so long is believed: the robot was relocalised");
    visit("clock_error", self.clock_error, "s", Range{0.0, 10.0},
          "stamps may be ahead of the clock by so much");
    visit("clock_jump", self.clock_jump, "s", Range{0.1, 60.0},
          "a longer step of the clock, or one backwards, is a jump");
    visit("goal_heading_tolerance", self.goal_heading_tolerance, "rad", Range{0.01, 3.2},
          "the goal's heading counts as reached within this");
    visit("goal_patience", self.goal_patience, "s", Range{0.0, 3600.0},
          "a goal of the action is given up when no path has led to it for so long");
    visit("goal_memory", self.goal_memory, "s", Range{0.0, 3600.0},
          "a robot that was away for longer does not take up its goal again");
    visit(
        "trusts_peers", self.trusts_peers,
        "peers are taken at their word: neither their messages nor that they are where they say is checked");
    visit("peer_clock_error", self.peer_clock_error, "s", Range{0.001, 10.0},
          "a peer whose clock differs by more is kept away from as from a stranger");
    visit("largest_peer_radius", self.largest_peer_radius, "m", Range{0.01, 100.0},
          "messages of larger peers are malformed");
    visit("largest_peer_sigma", self.largest_peer_sigma, "m", Range{0.0, 100.0},
          "messages of peers that are less sure of their position are malformed");
    visit("largest_peer_speed", self.largest_peer_speed, "m/s", Range{0.1, 100.0},
          "messages of faster peers are malformed");
    visit("grid_size", self.grid_size, kMetresByStopping, Range{1.0, 1000.0},
          "side of the sensed map, around the start, where no map is given");
    MapGrain::visit_fields_as("map_resolution", "map_reach", self.map_grain, visit);
    visit.group("guard", self.guard);
  }
};

/// No robot is farther from the origin of its frame [m].
inline constexpr double kFarthest = 1e6;

}  // namespace spf::host
