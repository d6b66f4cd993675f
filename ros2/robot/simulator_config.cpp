#include "ros2/robot/simulator_config.hpp"

#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>

namespace spf_ros2 {
namespace {

using spf::simulator::Settings;
using Texts = std::vector<std::string>;

/// "odom 0 5.0 7.0": topic, robot, from, to.
spf::simulator::Fault fault_of(const std::string& words, int robots) {
  std::istringstream stream{words};
  std::string topic, rest;
  int robot = -1;
  double from = 0.0, to = 0.0;
  if (!(stream >> topic >> robot >> from >> to) || stream >> rest)
    throw std::invalid_argument{"'" + words + "' must be topic, robot, from and to, as 'odom 0 5.0 7.0'"};
  return spf::simulator::make_fault(topic, robot, from, to, robots);
}

}  // namespace

Settings read_simulator_config(ros2::Node& node) {
  ros2::Parameters& parameters = node.parameters();
  const auto declare = [&](const char* name, auto value, const char* what) {
    return parameters.declare_as(name, value, {what, true, {}, {}});
  };
  Settings settings;
  std::string problems;
  std::vector<std::string> warnings;
  spf::simulator::TrialChoice choice;
  choice.path = declare("scenario", std::string{}, "path of a scenario file");
  choice.trial = static_cast<int>(
      parameters.declare_as("trial", std::int64_t{0},
                            {"which of the scenes that a family draws",
                             true,
                             ros2::ParameterRange{0.0, static_cast<double>(std::numeric_limits<int>::max())},
                             {}}));
  choice.overrides = declare("overrides", Texts{}, "keys of the scenario file, each as key=value");
  read_trial(choice, settings, problems, warnings);
  settings.frame = declare("frame", settings.frame, "the fleet's frame");
  settings.speed = declare("speed", settings.speed, "simulated seconds per second");
  settings.waits_for_robots =
      declare("wait_for_robots", settings.waits_for_robots, "the clock stands until all robots are there");
  settings.publishes_goals =
      declare("publish_goals", settings.publishes_goals, "send the robots to the scenario's goals");
  settings.quits_when_done =
      declare("quit_when_done", settings.quits_when_done, "end when the trial has ended");
  settings.map_resolution =
      declare("map_resolution", settings.map_resolution, "cells of /map [m]; default: half the scenario's");
  read_command(declare("command", std::string{"cmd_vel"}, "cmd_vel or wheel_speeds"), settings, problems);
  const Texts faults =
      declare("faults", Texts{}, "messages to lose, each as 'topic robot from to', times in simulated s");
  try {
    for (const std::string& fault : faults)
      settings.faults.push_back(fault_of(fault, static_cast<int>(settings.scenario.robots.size())));
  } catch (const std::invalid_argument& error) {
    problems += std::string{"\nfaults: "} + error.what();
  }
  check(settings, problems, warnings);
  for (const std::string& warning : warnings) node.log().warn(warning);
  return settings;
}

}  // namespace spf_ros2
