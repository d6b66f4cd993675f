// Everything that can be set about one robot: the nested parameters of its parts, and the methods as sets of
// them.
#pragma once

#include <array>
#include <utility>

#include "spf/field/field_parameters.hpp"
#include "spf/math/parameters.hpp"
#include "spf/planning/guide_path.hpp"
#include "spf/planning/orca/orca_parameters.hpp"
#include "spf/planning/planner_parameters.hpp"
#include "spf/planning/space_time/space_time_parameters.hpp"
#include "spf/robot/robot_parameters.hpp"
#include "spf/team/team_parameters.hpp"
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
  orca,                            ///< a reactive rule as the yardstick (docs/add_a_method.md)
  space_time,                      ///< ours (docs/space_time.md), the default
};
template <>
struct EnumNames<Method> {
  static constexpr std::array<std::pair<Method, const char*>, 8> values{
      {{Method::es2, "es2"},
       {Method::es2_constant_velocity, "es2_constant_velocity"},
       {Method::spf_empc, "spf_empc"},
       {Method::spf_empc_without_field, "spf_empc_without_field"},
       {Method::spf_empc_without_self_sampling, "spf_empc_without_self_sampling"},
       {Method::spf_empc_without_observer, "spf_empc_without_observer"},
       {Method::orca, "orca"},
       {Method::space_time, "space_time"}}};
};

/// Which generator makes the plans.
enum class Generator {
  field,       ///< the paper's: MINCO, L-BFGS, safety probability field (and the baselines)
  space_time,  ///< ours
  orca,        ///< a reactive rule
};
template <>
struct EnumNames<Generator> {
  static constexpr std::array<std::pair<Generator, const char*>, 3> values{
      {{Generator::field, "field"}, {Generator::space_time, "space_time"}, {Generator::orca, "orca"}}};
};

/// Where the body's x axis points while the robot moves.
enum class HeadingMode { keep, goal, motion };
template <>
struct EnumNames<HeadingMode> {
  static constexpr std::array<std::pair<HeadingMode, const char*>, 3> values{
      {{HeadingMode::keep, "keep"}, {HeadingMode::goal, "goal"}, {HeadingMode::motion, "motion"}}};
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
  OrcaParameters orca;
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
    visit.group("orca", self.orca);
    visit.group("tracker", self.tracker);
    visit.group("obstacles", self.obstacles);
    visit.group("peers", self.peers);
    visit.group("occupancy", self.occupancy);
  }
};

/// The defaults for a robot: what follows the robot (ScaledUnit) is scaled from the standard one. This is
/// where to start; what is set afterwards counts as it is written.
[[nodiscard]] AgentParameters defaults_for(const RobotParameters& robot);

/// The same robot with another method: changes only what the method names.
[[nodiscard]] AgentParameters with_method(AgentParameters parameters, Method method);

}  // namespace spf
