#include "spf_empc_ros/simulator_config.hpp"

#include <XmlRpcException.h>
#include <ros/console.h>

#include <stdexcept>
#include <string>
#include <vector>

namespace spf_empc_ros {
namespace {

using spf::simulator::Fault;
using spf::simulator::Settings;

/// A number of a parameter, whether written with a point or not.
double number(XmlRpc::XmlRpcValue& value) {
  return value.getType() == XmlRpc::XmlRpcValue::TypeInt ? static_cast<int>(value)
                                                         : static_cast<double>(value);
}

void read_faults(const ros::NodeHandle& own, Settings& settings, std::string& problems) {
  XmlRpc::XmlRpcValue list;
  if (!own.getParam("faults", list)) return;
  const int robots = static_cast<int>(settings.scenario.robots.size());
  try {
    for (int i = 0; i < list.size(); ++i) {
      XmlRpc::XmlRpcValue& entry = list[i];
      settings.faults.push_back(spf::simulator::make_fault(entry["topic"], static_cast<int>(entry["robot"]),
                                                           number(entry["from"]), number(entry["to"]),
                                                           robots));
    }
  } catch (const XmlRpc::XmlRpcException& error) {
    problems += "\nfaults must be a list of {topic, robot, from, to}: " + error.getMessage();
  } catch (const std::exception& error) {
    problems += std::string{"\nfaults: "} + error.what();
  }
}

}  // namespace

Settings read_simulator_config(const ros::NodeHandle& own) {
  Settings settings;
  std::string problems;
  std::vector<std::string> warnings;
  spf::simulator::TrialChoice choice;
  own.param<std::string>("scenario", choice.path, "");
  own.param("trial", choice.trial, choice.trial);
  own.getParam("overrides", choice.overrides);
  read_trial(choice, settings, problems, warnings);
  read_faults(own, settings, problems);
  own.param("frame", settings.frame, settings.frame);
  own.param("speed", settings.speed, settings.speed);
  own.param("wait_for_robots", settings.waits_for_robots, settings.waits_for_robots);
  own.param("publish_goals", settings.publishes_goals, settings.publishes_goals);
  own.param("quit_when_done", settings.quits_when_done, settings.quits_when_done);
  own.param("map_resolution", settings.map_resolution, settings.map_resolution);
  read_command(own.param<std::string>("command", "cmd_vel"), settings, problems);
  check(settings, problems, warnings);
  for (const std::string& warning : warnings) ROS_WARN("%s", warning.c_str());
  return settings;
}

}  // namespace spf_empc_ros
