#include "simulator/robot_file.hpp"

#include <charconv>
#include <iostream>
#include <stdexcept>
#include <system_error>

#include "sim/simulation.hpp"

namespace spf::simulator {
namespace {

int number_of(const std::string& text) {
  int number = -1;
  const char* end = text.data() + text.size();
  const auto [read, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc{} || read != end)
    throw std::invalid_argument("--robot " + text + " must be the number of a robot");
  return number;
}

RobotFile file_by(const std::vector<std::string>& arguments) {
  std::vector<Setting> settings;
  int robot = 0;
  for (std::size_t i = 1; i < arguments.size(); ++i) {
    if (arguments[i] == "--robot")
      robot = number_of(i + 1 < arguments.size() ? arguments[++i] : "");
    else
      settings.push_back({arguments[i], "argument " + std::to_string(i + 1)});
  }
  return robot_file_of(read_run_configuration(arguments[0], settings), robot);
}

}  // namespace

RobotFile robot_file_of(const RunConfiguration& run, int number) {
  const sim::Scenario trial = make_trial(run, 0);
  if (number < 0 || number >= static_cast<int>(trial.robots.size()))
    throw std::invalid_argument("--robot " + std::to_string(number) + " must lie in [0, " +
                                std::to_string(trial.robots.size() - 1) + "]");
  const std::size_t kind = run.fleet.empty() ? 0 : trial.robots[static_cast<std::size_t>(number)].kind;
  const AgentParameters agent = agents_of(run)[kind];
  RobotFile file = default_robot_file(run.fleet.empty() ? run.method : run.fleet[kind].method, agent.robot);
  file.agent = sim::agent_parameters_for(trial, agent);
  const host::HostParameters derived = sim::host_parameters_for(trial, file.agent);
  const sim::DetectionQuality detections = trial.simulation.sensing.detections;
  file.host.relies_on_obstacles = detections != sim::DetectionQuality::scan;
  file.host.map_grain = derived.map_grain;
  file.host.plan_silence = derived.plan_silence;
  file.host.command_silence = derived.command_silence;
  file.host.clock_jump = derived.clock_jump;
  return file;
}

int print_robot_file(const std::string& name, const std::vector<std::string>& arguments) {
  if (arguments.empty() || arguments[0] == "--help") {
    std::cerr << name
              << " SCENARIO [--robot NUMBER] [KEY=VALUE...] > robot.yaml\n"
                 "Prints the parameter file of a scenario's robots (of a mixed fleet: of robot NUMBER), for "
                 "the nodes' parameter `config`.\n";
    return arguments.empty() ? 2 : 0;
  }
  try {
    std::cout << to_yaml_text(file_by(arguments), true);
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 2;
  }
  return 0;
}

}  // namespace spf::simulator
