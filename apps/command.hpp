// Common parts of the program's verbs.
#pragma once

#include <CLI/CLI.hpp>

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "study/scenario_file.hpp"

namespace spf {

inline constexpr int kDone = 0;
inline constexpr int kFailedCheck = 1;  ///< ran, but failed what it checks
inline constexpr int kBadInput = 2;     ///< bad usage, input, or a path that cannot be written

/// A verb registers itself and returns the function that runs it: given the words of the command line, it
/// returns the exit status.
struct Verb {
  CLI::App* app = nullptr;
  std::function<int(const std::vector<std::string>& command)> run;
};

/// The options by which every verb changes a scenario.
struct ScenarioOptions {
  std::optional<std::string> seed, method, noise, level, tracking;
  std::vector<std::string> settings;

  void add_to(CLI::App& app);
  /// As settings in ascending precedence: named options first, then --set.
  [[nodiscard]] std::vector<Setting> to_settings() const;
};

/// On stderr, one a line; the same text once.
void print_warnings(const std::vector<InputProblem>& warnings);

Verb add_run(CLI::App& program, const MethodTable& methods);
Verb add_experiment(CLI::App& program, const MethodTable& methods);
Verb add_report(CLI::App& program, const MethodTable& methods);
Verb add_check(CLI::App& program, const MethodTable& methods);
Verb add_parameters(CLI::App& program, const MethodTable& methods);
Verb add_crowd(CLI::App& program);

}  // namespace spf
