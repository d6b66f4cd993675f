#include "simulator/settings.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "config/contradiction_report.hpp"
#include "study/scenario_file.hpp"
#include "wire/converted.hpp"

namespace spf::simulator {

void read_trial(const TrialChoice& choice, Settings& settings, std::string& problems,
                std::vector<std::string>& warnings) {
  if (choice.path.empty()) {
    problems += "\nscenario must name a scenario file";
    return;
  }
  std::vector<Setting> overrides;
  for (const std::string& assignment : choice.overrides) overrides.push_back({assignment, "overrides"});
  try {
    const RunConfiguration run = read_run_configuration(choice.path, overrides);
    for (const InputProblem& warning : run.warnings) warnings.push_back(warning_text(warning));
    settings.scenario = make_trial(run, choice.trial);
    settings.control_period = run.agent.tracker.control_period;
    settings.map_resolution = 0.5 * run.simulation.sensing.map_grain.resolution;
  } catch (const std::exception& error) {
    problems += std::string{"\n"} + error.what();
  }
}

void read_command(const std::string& command, Settings& settings, std::string& problems) {
  if (command != "cmd_vel" && command != "wheel_speeds")
    problems += "\ncommand = " + command + " must be one of cmd_vel, wheel_speeds";
  settings.takes_wheel_speeds = command == "wheel_speeds";
}

Fault make_fault(const std::string& topic, int robot, double from, double to, int robots) {
  constexpr std::array<std::pair<const char*, FaultyTopic>, 3> kTopics{
      {{"odom", FaultyTopic::odom}, {"scan", FaultyTopic::scan}, {"obstacles", FaultyTopic::obstacles}}};
  const auto* known =
      std::find_if(kTopics.begin(), kTopics.end(), [&](const auto& entry) { return topic == entry.first; });
  if (known == kTopics.end())
    throw std::invalid_argument{"topic = " + topic + " must be one of odom, scan, obstacles"};
  if (robot < 0 || robot >= robots)
    throw std::invalid_argument{"robot = " + std::to_string(robot) + " must lie in [0, " +
                                std::to_string(robots - 1) + "]"};
  return {known->second, robot, from, to};
}

void check(Settings& settings, std::string problems, std::vector<std::string>& warnings) {
  settings.frame = wire::plain_frame(settings.frame);
  if (settings.frame.empty()) problems += "\nframe must not be empty";
  if (!(settings.speed >= 0.01 && settings.speed <= 100.0))
    problems += "\nspeed = " + std::to_string(settings.speed) + " must lie in [0.01, 100]";
  if (!(settings.map_resolution >= 0.005 && settings.map_resolution <= 1.0))
    problems += "\nmap_resolution = " + std::to_string(settings.map_resolution) + " must lie in [0.005, 1]";
  if (!problems.empty()) throw std::invalid_argument{problems.substr(1)};
  sim::SimulationParameters& simulation = settings.scenario.simulation;
  if (simulation.trial.tracking == sim::TrackingMode::ideal) {
    warnings.emplace_back("trial.tracking = ideal: robots on ROS are tracked in full");
    simulation.trial.tracking = sim::TrackingMode::full;
  }
  if (simulation.radio.loss > 0.0 || std::isfinite(simulation.radio.range))
    warnings.emplace_back(
        "radio: robots on ROS talk over the network, without the scenario's loss and range");
}

}  // namespace spf::simulator
