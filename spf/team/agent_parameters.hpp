// Everything that can be set about one robot: the nested parameters of its parts, and which planner it gets.
// Methods are sets of them (spf/team/method_table.hpp).
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <utility>

#include "spf/field/field_parameters.hpp"
#include "spf/math/parameters.hpp"
#include "spf/perception/perception_parameters.hpp"
#include "spf/planning/cost_to_go_parameters.hpp"
#include "spf/planning/orca/orca_parameters.hpp"
#include "spf/planning/planner.hpp"
#include "spf/planning/planner_parameters.hpp"
#include "spf/planning/space_time/space_time_parameters.hpp"
#include "spf/robot/robot_parameters.hpp"
#include "spf/team/sight_parameters.hpp"
#include "spf/team/team_parameters.hpp"
#include "spf/tracking/tracker_parameters.hpp"
#include "spf/world/obstacle_tracker.hpp"
#include "spf/world/peer_table.hpp"

namespace spf {

struct AgentParameters;
/// Makes the planner that an agent is given.
using PlannerFactory = std::function<std::unique_ptr<Planner>(const AgentParameters&)>;
/// That of the default method.
[[nodiscard]] std::unique_ptr<Planner> make_space_time_planner(const AgentParameters& agent);

/// Where the body's x axis points while the robot moves. `look`: it is kept where the robot sees all round;
/// one that knows of what moves by a scanner with a blind side alone turns to and fro, so that it sees all in
/// turn.
enum class HeadingMode { look, keep, goal, motion };
template <>
struct EnumNames<HeadingMode> {
  static constexpr std::array<std::pair<HeadingMode, const char*>, 4> values{
      {{HeadingMode::look, "look"},
       {HeadingMode::keep, "keep"},
       {HeadingMode::goal, "goal"},
       {HeadingMode::motion, "motion"}}};
};

struct AgentParameters {
  HeadingMode heading_mode = HeadingMode::look;
  RobotParameters robot;
  TeamParameters team;
  FieldParameters field;
  PlannerParameters planner;
  CostToGoParameters guide;
  SpaceTimeParameters space_time;
  OrcaParameters orca;
  TrackerParameters tracker;
  SightParameters sight;
  PerceptionParameters perception;
  ObstacleTrackerParameters obstacles;
  PeerTableParameters peers;
  PlannerFactory make_planner = make_space_time_planner;  ///< not among the fields: a method sets it

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit("heading_mode", self.heading_mode, "where the body's x axis points while the robot moves");
    visit.group("robot", self.robot);
    visit.group("team", self.team);
    visit.group("field", self.field);
    visit.group("planner", self.planner);
    visit.group("guide", self.guide);
    visit.group("space_time", self.space_time);
    visit.group("orca", self.orca);
    visit.group("tracker", self.tracker);
    visit.group("sight", self.sight);
    visit.group("perception", self.perception);
    visit.group("obstacles", self.obstacles);
    visit.group("peers", self.peers);
  }
};

/// The defaults for a robot: what follows the robot (ScaledUnit) is scaled from the standard one. This is
/// where to start; what is set afterwards counts as it is written.
[[nodiscard]] AgentParameters defaults_for(const RobotParameters& robot);

/// The parameters with what follows from others: the radius of a robot with corners.
[[nodiscard]] AgentParameters settled(AgentParameters agent);

/// The parameters with a temporary speed limit of `max_speed` [m/s]. The lookahead distances of the paper's
/// planner shrink in proportion, so that its planning time horizon stays the same.
[[nodiscard]] AgentParameters slowed_to(AgentParameters agent, double max_speed);

}  // namespace spf
