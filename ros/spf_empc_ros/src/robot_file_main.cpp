// robot_file SCENARIO [--robot NUMBER] [KEY=VALUE...] > robot.yaml
// Prints the parameter file of a scenario's robots: what `config` of planner, tracker and perception is to be
// when simulator_node runs that scenario and its robots are not the default ones. Where robots are of several
// kinds (`fleet`), that of the robot NUMBER (default: 0).
#include <charconv>
#include <iostream>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

#include "config/robot_file.hpp"
#include "sim/simulation.hpp"
#include "study/scenario_file.hpp"

namespace {

constexpr const char* kUsage =
    "robot_file SCENARIO [--robot NUMBER] [KEY=VALUE...] > robot.yaml\n"
    "Prints the parameter file of a scenario's robots (of a mixed fleet: of robot NUMBER), for the nodes' "
    "parameter `config`.\n";

spf::RobotFile file_of(const spf::RunConfiguration& config, int robot) {
  const spf::sim::Scenario trial = spf::make_trial(config, 0);
  if (robot < 0 || robot >= static_cast<int>(trial.robots.size()))
    throw std::invalid_argument("--robot " + std::to_string(robot) + " must lie in [0, " +
                                std::to_string(trial.robots.size() - 1) + "]");
  const std::size_t kind = config.fleet.empty() ? 0 : trial.robots[static_cast<std::size_t>(robot)].kind;
  const spf::AgentParameters agent = spf::agents_of(config)[kind];
  spf::RobotFile file =
      spf::default_robot_file(config.fleet.empty() ? config.method : config.fleet[kind].method, agent.robot);
  file.agent = spf::sim::agent_parameters_for(trial, agent);
  const spf::host::HostParameters derived = spf::sim::host_parameters_for(trial, file.agent);
  const spf::sim::DetectionQuality detections = trial.simulation.sensing.detections;
  file.host.relies_on_obstacles = detections != spf::sim::DetectionQuality::scan;
  file.host.map_grain = derived.map_grain;
  file.host.plan_silence = derived.plan_silence;
  file.host.command_silence = derived.command_silence;
  file.host.clock_jump = derived.clock_jump;
  return file;
}

int number_of(const std::string& text) {
  int number = -1;
  const char* end = text.data() + text.size();
  const auto [read, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc{} || read != end)
    throw std::invalid_argument("--robot " + text + " must be the number of a robot");
  return number;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2 || std::string{argv[1]} == "--help") {
    std::cerr << kUsage;
    return argc < 2 ? 2 : 0;
  }
  try {
    std::vector<spf::Setting> settings;
    int robot = 0;
    for (int i = 2; i < argc; ++i) {
      if (std::string{argv[i]} == "--robot")
        robot = number_of(i + 1 < argc ? argv[++i] : "");
      else
        settings.push_back({argv[i], "argument " + std::to_string(i)});
    }
    std::cout << spf::to_yaml_text(file_of(spf::read_run_configuration(argv[1], settings), robot), true);
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 2;
  }
  return 0;
}
