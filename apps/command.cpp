#include "apps/command.hpp"

#include <iostream>
#include <set>

#include "config/contradiction_report.hpp"

namespace spf {

void ScenarioOptions::add_to(CLI::App& app) {
  app.add_option("--seed", seed, "seed of everything random (key seed)")->type_name("N");
  app.add_option("--method", method, "how robots plan and track (key method)")->type_name("NAME");
  app.add_option("--noise", noise, "how moving obstacles vary: white or walk (key noise.model)")
      ->type_name("MODEL");
  app.add_option("--level", level, "multiple of Sigma of that noise (key noise.level)")->type_name("S");
  app.add_option("--tracking", tracking, "ideal or full (key trial.tracking)")->type_name("MODE");
  app.add_option("--set", settings, "any key of the scenario file, as in noise.level=1; may be repeated")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false)
      ->take_all();
}

std::vector<Setting> ScenarioOptions::to_settings() const {
  std::vector<Setting> all;
  const auto add = [&all](const std::optional<std::string>& value, const char* key, const char* option) {
    if (value) all.push_back({std::string{key} + "=" + *value, option});
  };
  add(seed, "seed", "--seed");
  add(method, "method", "--method");
  add(noise, "noise.model", "--noise");
  add(level, "noise.level", "--level");
  add(tracking, "trial.tracking", "--tracking");
  for (const std::string& setting : settings) all.push_back({setting});
  return all;
}

void print_warnings(const std::vector<InputProblem>& warnings) {
  std::set<std::string> told;
  for (const InputProblem& warning : warnings) {
    const std::string text = warning_text(warning);
    if (told.insert(text).second) std::cerr << text << "\n";
  }
}

}  // namespace spf
