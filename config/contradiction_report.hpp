// Contradictions among the settings of a file, told at the place where one of them stands.
#pragma once

#include <string>
#include <vector>

#include "config/input_problem.hpp"
#include "config/yaml_tree.hpp"
#include "host/contradictions.hpp"

namespace spf {

/// Adds those that are errors to `problems`, the others to `warnings`.
void report_contradictions(const YamlNode& root, const std::vector<host::Contradiction>& found,
                           InputProblems& problems, std::vector<InputProblem>& warnings);

/// "file.yaml:3:7: warning: robot.max_speed = 2 m/s is more than ..."
[[nodiscard]] std::string warning_text(const InputProblem& warning);

}  // namespace spf
