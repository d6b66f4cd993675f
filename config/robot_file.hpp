// The parameter file of one robot: those keys of a scenario file that concern a robot (method, robot, agent),
// and those of its host. Read with the same checks and messages as scenario files.
#pragma once

#include <string>
#include <vector>

#include "config/hiding_visitor.hpp"
#include "config/input_problem.hpp"
#include "config/method_choice.hpp"
#include "host/host_parameters.hpp"
#include "spf/team/agent_parameters.hpp"

namespace spf {

/// A robot's file with all its defaults filled in.
struct RobotFile {
  MethodChoice method;
  RobotParameters robot;
  AgentParameters agent;  ///< without its robot: that is `robot`
  host::HostParameters host;
  std::vector<InputProblem> warnings;  ///< of settings that contradict each other; not among the fields

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit_head(self, visit);
    visit_parameters(self, visit);
  }
  /// The keys on which the defaults of the others depend.
  template <class Self, class Visitor>
  static void visit_head(Self& self, Visitor&& visit) {
    visit("method", self.method, "how the robot plans and tracks: a set of agent parameters");
    visit.group("robot", self.robot);
  }
  template <class Self, class Visitor>
  static void visit_parameters(Self& self, Visitor&& visit) {
    PartlyHidden<std::remove_reference_t<decltype((self.agent))>> agent{self.agent, {"robot"}};
    visit.group("agent", agent);
    visit.group("host", self.host);
  }
};

/// The defaults for a method and a robot: many follow the robot (ScaledUnit). Its scans tell of what moves.
[[nodiscard]] RobotFile default_robot_file(const MethodChoice& method, const RobotParameters& robot);

/// Throws InputError with every problem, contradictions that a robot could not drive with among them. An
/// empty path gives the defaults. `methods` are those that the file may name.
[[nodiscard]] RobotFile read_robot_file(const std::string& path, const MethodTable& methods = {});
/// The same from text; `name` stands for the file in messages.
[[nodiscard]] RobotFile robot_file_from_text(const std::string& text, const std::string& name,
                                             const MethodTable& methods = {});

/// The text of a file that gives `file`, with every key written out.
[[nodiscard]] std::string to_yaml_text(const RobotFile& file, bool explains = false);

/// The agent's parameters: `agent` with the file's robot. Where nobody reports moving obstacles
/// (`host.relies_on_obstacles: false`), perception tells of all that it finds, not of what has moved alone.
[[nodiscard]] AgentParameters agent_parameters(const RobotFile& file);

}  // namespace spf
