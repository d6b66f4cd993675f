// robot_file SCENARIO [KEY=VALUE...] > robot.yaml
// Prints the parameter file of a scenario's robots: what `config` of planner, tracker and perception is to be
// when simulator_node runs that scenario and its robots are not the default ones.
#include <iostream>
#include <string>
#include <vector>

#include "config/robot_file.hpp"
#include "sim/simulation.hpp"
#include "study/scenario_file.hpp"

int main(int argc, char** argv) {
  if (argc < 2 || std::string{argv[1]} == "--help") {
    std::cerr << "robot_file SCENARIO [KEY=VALUE...] > robot.yaml\n"
                 "Prints the parameter file of a scenario's robots, for the nodes' parameter `config`.\n";
    return argc < 2 ? 2 : 0;
  }
  try {
    std::vector<spf::Setting> settings;
    for (int i = 2; i < argc; ++i) settings.push_back({argv[i], "argument " + std::to_string(i)});
    const spf::RunConfiguration config = spf::read_run_configuration(argv[1], settings);
    spf::RobotFile file = spf::default_robot_file(config.method, config.robot);
    const spf::sim::Scenario trial = spf::make_trial(config, 0);
    file.agent = spf::sim::agent_parameters_for(trial, spf::agent_parameters(config));
    const spf::host::HostParameters derived = spf::sim::host_parameters_for(trial, file.agent);
    const spf::sim::DetectionQuality detections = trial.simulation.sensing.detections;
    file.host.relies_on_obstacles = detections != spf::sim::DetectionQuality::scan;
    file.host.map_grain = derived.map_grain;
    file.host.plan_silence = derived.plan_silence;
    file.host.command_silence = derived.command_silence;
    file.host.clock_jump = derived.clock_jump;
    std::cout << spf::to_yaml_text(file, true);
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 2;
  }
  return 0;
}
