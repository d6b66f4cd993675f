// spf check: checks scenario files and shows how the program reads them.
#include <iostream>
#include <memory>
#include <set>

#include "apps/command.hpp"
#include "config/input_problem.hpp"
#include "report/table.hpp"
#include "sim/scenario.hpp"

namespace spf {
namespace {

struct CheckOptions {
  std::vector<std::string> files;
  ScenarioOptions scenario;
  MethodTable methods;
};

std::string scene_text(const sim::Scenario& scenario) {
  std::string text = std::to_string(scenario.robots.size()) + " robots";
  const auto add = [&text](std::size_t count, const char* what) {
    if (count > 0) text += ", " + std::to_string(count) + " " + what;
  };
  add(scenario.boxes.size(), "boxes");
  add(scenario.discs.size(), "static discs");
  add(scenario.walls.size(), "walls");
  add(scenario.polygons.size(), "polygons");
  add(scenario.people.size(), "people with waypoints");
  add(scenario.moving.size(), "moving discs");
  std::set<int> people;
  for (const sim::CrowdSample& sample : scenario.crowd) people.insert(sample.id);
  add(people.size(), "recorded people");
  if (scenario.map) {
    const host::CellMap cells = scenario.map->cells();
    text += ", a map of " + std::to_string(cells.width) + " x " + std::to_string(cells.height) +
            " cells of " + fixed(cells.resolution, 3) + " m";
  }
  if (scenario.border) {
    const Eigen::Vector2d size = scenario.border->high - scenario.border->low;
    text += ", in " + fixed(size.x(), 1) + " x " + fixed(size.y(), 1) + " m";
  }
  return text;
}

void print_summary(const std::string& file, const RunConfiguration& config) {
  const sim::SimulationParameters& simulation = config.simulation;
  const std::size_t warnings = config.warnings.size();
  std::cout << file << ": good"
            << (warnings == 0
                    ? ""
                    : ", with " + std::to_string(warnings) + (warnings == 1 ? " warning" : " warnings"))
            << "\n  family " << enum_name(config.family) << ", method " << config.method.name() << ", seed "
            << config.seed << "\n  " << scene_text(make_trial(config, 0)) << "\n  noise "
            << enum_name(simulation.noise.model) << " at " << simulation.noise.level << " Sigma, map "
            << enum_name(simulation.sensing.map) << ", detections "
            << enum_name(simulation.sensing.detections) << ", tracking "
            << enum_name(simulation.trial.tracking) << "\n";
  std::cout.flush();
  print_warnings(config.warnings);
}

int check(const CheckOptions& options) {
  bool good = true;
  for (const std::string& file : options.files) {
    try {
      print_summary(file, read_run_configuration(file, options.scenario.to_settings(), options.methods));
    } catch (const InputError& error) {
      std::cout.flush();
      std::cerr << error.what() << "\n";
      good = false;
    }
  }
  return good ? kDone : kBadInput;
}

}  // namespace

Verb add_check(CLI::App& program, const MethodTable& methods) {
  CLI::App* app = program.add_subcommand("check", "Validate scenario files and say what they mean");
  const auto options = std::make_shared<CheckOptions>();
  options->methods = methods;
  app->add_option("scenario", options->files, "scenario files")->type_name("FILE")->required();
  options->scenario.add_to(*app);
  app->footer(
      "Examples:\n"
      "  spf check scenarios/t2.yaml\n"
      "  spf check my_scene.yaml --set robot.radius=0.5\n"
      "Exit status: 0 all files are good, 2 one is not; every problem is printed as file:line:column: ...\n"
      "Settings that contradict each other, but could be meant, are warned of and keep the status 0.");
  return {app, [options](const std::vector<std::string>&) { return check(*options); }};
}

}  // namespace spf
