// The scene that a scenario file with `family: explicit` writes out. Frame: world.
#pragma once

#include <string>
#include <vector>

#include "study/scenario_file.hpp"

namespace spf {

/// Parameters of each kind of robot.
[[nodiscard]] std::vector<RobotParameters> robots_of(const std::vector<RobotKind>& fleet);

/// Ground truth, but for recorded people.
[[nodiscard]] sim::Scenario explicit_scenario(const RunConfiguration& config);

/// Checks the scene of a file. A refused value has been replaced by a default, about which nothing more is
/// reported.
void check_explicit(const YamlNode& root, const RunConfiguration& config, InputProblems& problems);

/// Reports a rule that the scene breaks at the entry that does.
void report(const sim::ScenarioProblem& problem, const YamlNode& root, InputProblems& problems);

/// "robots[3].start"
[[nodiscard]] std::string entry_name(const char* list, std::size_t index, const char* member);

}  // namespace spf
