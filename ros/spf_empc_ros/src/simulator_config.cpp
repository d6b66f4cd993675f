#include "spf_empc_ros/simulator_config.hpp"

#include <XmlRpcException.h>
#include <ros/console.h>

#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "config/contradiction_report.hpp"
#include "spf_empc_ros/conversions.hpp"
#include "study/scenario_file.hpp"

namespace spf_empc_ros {
namespace {

/// A number of a parameter, whether written with a point or not.
double number(XmlRpc::XmlRpcValue& value) {
  return value.getType() == XmlRpc::XmlRpcValue::TypeInt ? static_cast<int>(value)
                                                         : static_cast<double>(value);
}

std::vector<spf::Setting> overrides(const ros::NodeHandle& own) {
  std::vector<std::string> assignments;
  own.getParam("overrides", assignments);
  std::vector<spf::Setting> settings;
  for (const std::string& assignment : assignments) settings.push_back({assignment, "overrides"});
  return settings;
}

Fault read_fault(XmlRpc::XmlRpcValue& entry, int robots) {
  constexpr std::array<std::pair<const char*, FaultyTopic>, 3> kTopics{
      {{"odom", FaultyTopic::odom}, {"scan", FaultyTopic::scan}, {"obstacles", FaultyTopic::obstacles}}};
  Fault fault;
  const std::string topic = entry["topic"];
  bool known = false;
  for (const auto& [name, value] : kTopics) {
    if (topic != name) continue;
    fault.topic = value;
    known = true;
  }
  if (!known) throw std::invalid_argument{"topic = " + topic + " must be one of odom, scan, obstacles"};
  fault.robot = static_cast<int>(entry["robot"]);
  if (fault.robot < 0 || fault.robot >= robots)
    throw std::invalid_argument{"robot = " + std::to_string(fault.robot) + " must lie in [0, " +
                                std::to_string(robots - 1) + "]"};
  fault.from = number(entry["from"]);
  fault.to = number(entry["to"]);
  return fault;
}

void read_faults(const ros::NodeHandle& own, SimulatorConfig& config, std::string& problems) {
  XmlRpc::XmlRpcValue list;
  if (!own.getParam("faults", list)) return;
  try {
    for (int i = 0; i < list.size(); ++i)
      config.faults.push_back(read_fault(list[i], static_cast<int>(config.scenario.robots.size())));
  } catch (const XmlRpc::XmlRpcException& error) {
    problems += "\nfaults must be a list of {topic, robot, from, to}: " + error.getMessage();
  } catch (const std::exception& error) {
    problems += std::string{"\nfaults: "} + error.what();
  }
}

void read_scenario(const ros::NodeHandle& own, SimulatorConfig& config, std::string& problems) {
  const std::string path = own.param<std::string>("scenario", "");
  if (path.empty()) {
    problems += "\nscenario must name a scenario file";
    return;
  }
  try {
    const spf::RunConfiguration run = spf::read_run_configuration(path, overrides(own));
    for (const spf::InputProblem& warning : run.warnings) ROS_WARN("%s", spf::warning_text(warning).c_str());
    config.scenario = spf::make_trial(run, own.param("trial", 0));
    config.control_period = run.agent.tracker.control_period;
    config.map_resolution = 0.5 * run.simulation.sensing.map_grain.resolution;
  } catch (const std::exception& error) {
    problems += std::string{"\n"} + error.what();
  }
}

/// What a scenario says and the network, the drive and the computers of a ROS fleet decide themselves.
void warn_of_what_is_real(spf::sim::Scenario& scenario) {
  spf::sim::SimulationParameters& simulation = scenario.simulation;
  if (simulation.trial.tracking == spf::sim::TrackingMode::ideal) {
    ROS_WARN("trial.tracking = ideal: robots on ROS are tracked in full");
    simulation.trial.tracking = spf::sim::TrackingMode::full;
  }
  if (simulation.radio.loss > 0.0 || std::isfinite(simulation.radio.range))
    ROS_WARN("radio: robots on ROS talk over the network, without the scenario's loss and range");
}

}  // namespace

SimulatorConfig read_simulator_config(const ros::NodeHandle& own) {
  SimulatorConfig config;
  std::string problems;
  read_scenario(own, config, problems);
  read_faults(own, config, problems);
  own.param("frame", config.frame, config.frame);
  config.frame = plain_frame(config.frame);
  own.param("speed", config.speed, config.speed);
  own.param("wait_for_robots", config.waits_for_robots, config.waits_for_robots);
  own.param("publish_goals", config.publishes_goals, config.publishes_goals);
  own.param("quit_when_done", config.quits_when_done, config.quits_when_done);
  own.param("map_resolution", config.map_resolution, config.map_resolution);
  const std::string command = own.param<std::string>("command", "cmd_vel");
  if (command != "cmd_vel" && command != "wheel_speeds")
    problems += "\ncommand = " + command + " must be one of cmd_vel, wheel_speeds";
  config.takes_wheel_speeds = command == "wheel_speeds";
  if (config.frame.empty()) problems += "\nframe must not be empty";
  if (!(config.speed >= 0.01 && config.speed <= 100.0))
    problems += "\nspeed = " + std::to_string(config.speed) + " must lie in [0.01, 100]";
  if (!(config.map_resolution >= 0.005 && config.map_resolution <= 1.0))
    problems += "\nmap_resolution = " + std::to_string(config.map_resolution) + " must lie in [0.005, 1]";
  if (!problems.empty()) throw std::invalid_argument{problems.substr(1)};
  warn_of_what_is_real(config.scenario);
  return config;
}

}  // namespace spf_empc_ros
