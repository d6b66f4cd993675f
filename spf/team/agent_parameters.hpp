// Everything that can be set about one robot: the nested parameters of its parts, and the methods as sets of
// them.
#pragma once

#include <array>
#include <utility>

#include "spf/field/field_parameters.hpp"
#include "spf/math/parameters.hpp"
#include "spf/planning/guide_path.hpp"
#include "spf/planning/planner_parameters.hpp"
#include "spf/planning/space_time_parameters.hpp"
#include "spf/robot/robot_parameters.hpp"
#include "spf/tracking/tracker_parameters.hpp"
#include "spf/world/obstacle_tracker.hpp"
#include "spf/world/occupancy_parameters.hpp"
#include "spf/world/peer_table.hpp"

namespace spf {

/// The paper's method, its baselines and ablations, and ours. Each is a set of parameters of one code path.
enum class Method {
  es2,                             ///< moving obstacles taken as standing where they are (baseline ES2)
  es2_constant_velocity,           ///< moving obstacles taken at constant velocity (baseline ES2*)
  spf_empc,                        ///< the paper
  spf_empc_without_field,          ///< its field does not see velocity (Table 3, "w/o SPF")
  spf_empc_without_self_sampling,  ///< its controller follows discrete points (Table 3, "w/o SS")
  spf_empc_without_observer,       ///< its controller takes raw measurements (Table 3, "w/o ESO")
  space_time,                      ///< ours (docs/space_time.md), the default
};
template <>
struct EnumNames<Method> {
  static constexpr std::array<std::pair<Method, const char*>, 7> values{
      {{Method::es2, "es2"},
       {Method::es2_constant_velocity, "es2_constant_velocity"},
       {Method::spf_empc, "spf_empc"},
       {Method::spf_empc_without_field, "spf_empc_without_field"},
       {Method::spf_empc_without_self_sampling, "spf_empc_without_self_sampling"},
       {Method::spf_empc_without_observer, "spf_empc_without_observer"},
       {Method::space_time, "space_time"}}};
};

/// Which generator makes the plans.
enum class Generator { field, space_time };
template <>
struct EnumNames<Generator> {
  static constexpr std::array<std::pair<Generator, const char*>, 2> values{
      {{Generator::field, "field"}, {Generator::space_time, "space_time"}}};
};

/// Where the body's x axis points while the robot moves.
enum class HeadingMode { keep, goal, motion };
template <>
struct EnumNames<HeadingMode> {
  static constexpr std::array<std::pair<HeadingMode, const char*>, 3> values{
      {{HeadingMode::keep, "keep"}, {HeadingMode::goal, "goal"}, {HeadingMode::motion, "motion"}}};
};

/// Rates, time-outs and rules of the agent itself.
struct TeamParameters {
  double plan_period = 0.1;        ///< [s] between planning checks
  double replan_period = 1.0;      ///< [s] a plan of the field generator is renewed at least this often
  double message_period = 0.2;     ///< [s] the committed plan is told again at least this often
  double message_lifetime = 1.5;   ///< [s] after which a peer may no longer rely on it
  double stale_time = 0.3;         ///< [s] without pose or observation until the robot brakes
  double goal_tolerance = 0.05;    ///< [m] within which the robot counts itself arrived
  double reanchor_distance = 0.3;  ///< [m] from the plan beyond which the plan starts anew at the robot
  double emergency_time = 1.0;     ///< [s] predicted contact sooner than this (or than braking takes): brake
  double retry_first = 0.2;        ///< [s] back-off after a failed plan
  double retry_longest = 1.6;      ///< [s] longest back-off
  double guide_period = 0.5;       ///< [s] the guide path follows a changing map at most this often
  bool keep_candidates = false;    ///< keep every candidate of a plan, for display (allocates)

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit("plan_period", self.plan_period, "s", Range{0.01, 2.0}, "time between planning checks");
    visit("replan_period", self.replan_period, "s", Range{0.05, 10.0},
          "a plan of the field generator is renewed at least this often");
    visit("message_period", self.message_period, "s", Range{0.01, 10.0},
          "the committed plan is broadcast again at least this often");
    visit("message_lifetime", self.message_lifetime, "s", Range{0.1, 60.0},
          "time after which peers no longer rely on a broadcast");
    visit("stale_time", self.stale_time, "s", Range{0.02, 10.0},
          "time without pose or observation until the robot brakes");
    visit("goal_tolerance", self.goal_tolerance, "m", Range{0.001, 1.0},
          "distance within which the robot counts itself arrived");
    visit("reanchor_distance", self.reanchor_distance, "m", Range{0.02, 10.0},
          "distance from the plan beyond which it starts anew at the robot");
    visit("emergency_time", self.emergency_time, "s", Range{0.0, 10.0},
          "a predicted contact sooner than this makes the robot brake when it finds no plan");
    visit("retry_first", self.retry_first, "s", Range{0.0, 10.0}, "first wait after a failed plan");
    visit("retry_longest", self.retry_longest, "s", Range{0.0, 60.0},
          "longest wait after failed plans (it doubles each time)");
    visit("guide_period", self.guide_period, "s", Range{0.0, 60.0},
          "the guide path follows a changing map at most this often");
    visit("keep_candidates", self.keep_candidates, "keep every candidate of a plan, for display");
  }
};

struct AgentParameters {
  Generator generator = Generator::space_time;
  HeadingMode heading_mode = HeadingMode::keep;
  bool ideal_tracking =
      false;  ///< the robot is where its plan says (set by the simulator's `tracking: ideal`)
  RobotParameters robot;
  TeamParameters team;
  FieldParameters field;
  PlannerParameters planner;
  GuidePathParameters guide{0.15, 0.2, 10.0, 3.0};  ///< its clearance counts beyond the robot's radius here
  SpaceTimeParameters space_time;
  TrackerParameters tracker;
  ObstacleTrackerParameters obstacles;
  PeerTableParameters peers;
  OccupancyParameters occupancy;

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit("generator", self.generator, "what makes the plans; set by `method`");
    visit("heading_mode", self.heading_mode, "where the body's x axis points while the robot moves");
    visit("ideal_tracking", self.ideal_tracking,
          "the robot is where its plan says; set by `tracking: ideal`");
    visit.group("robot", self.robot);
    visit.group("team", self.team);
    visit.group("field", self.field);
    visit.group("planner", self.planner);
    visit.group("guide", self.guide);
    visit.group("space_time", self.space_time);
    visit.group("tracker", self.tracker);
    visit.group("obstacles", self.obstacles);
    visit.group("peers", self.peers);
    visit.group("occupancy", self.occupancy);
  }
};

/// The same robot with another method: changes only what the method names.
[[nodiscard]] AgentParameters with_method(AgentParameters parameters, Method method);

}  // namespace spf
