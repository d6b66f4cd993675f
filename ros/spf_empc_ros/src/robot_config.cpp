#include "spf_empc_ros/robot_config.hpp"

#include <ros/init.h>
#include <ros/master.h>
#include <ros/network.h>
#include <ros/ros.h>
#include <ros/this_node.h>
#include <xmlrpcpp/XmlRpcClient.h>
#include <xmlrpcpp/XmlRpcValue.h>

#include <stdexcept>

#include "config/contradiction_report.hpp"
#include "spf_empc_ros/conversions.hpp"

namespace spf_empc_ros {

RobotConfig read_config(const ros::NodeHandle& own) {
  RobotConfig config;
  own.param("robot_id", config.robot_id, config.robot_id);
  own.param("frame", config.frame, config.frame);
  config.frame = plain_frame(config.frame);
  config.base_frame =
      own.param<std::string>("base_frame", "robot" + std::to_string(config.robot_id) + "/base_link");
  config.base_frame = plain_frame(config.base_frame);
  const std::string path = own.param<std::string>("config", "");
  const std::string map = own.param<std::string>("map", "wait");
  std::string problems;
  if (config.robot_id < 0)
    problems += "\nrobot_id = " + std::to_string(config.robot_id) + " must be at least 0";
  if (config.frame.empty()) problems += "\nframe must not be empty";
  if (config.base_frame.empty()) problems += "\nbase_frame must not be empty";
  if (map != "wait" && map != "none") problems += "\nmap = " + map + " must be one of wait, none";
  config.waits_for_map = map == "wait";
  try {
    config.file = spf::read_robot_file(path);
  } catch (const spf::InputError& error) {
    problems += std::string{"\n"} + error.what();
  }
  if (!problems.empty()) throw std::invalid_argument{problems.substr(1)};
  config.agent = spf::agent_parameters(config.file);
  return config;
}

ros::Time first_time() {
  ros::Time now = ros::Time::now();
  while (ros::ok() && now.isZero()) {
    ROS_INFO_THROTTLE(5.0, "waiting for /clock");
    ros::WallDuration{0.01}.sleep();
    ros::spinOnce();
    now = ros::Time::now();
  }
  return now;
}

namespace {

/// The address of a living node that has this node's name already; empty without one. The master would end
/// it in favour of this one, and two robots of one number would end each other for ever.
std::string namesake() {
  XmlRpc::XmlRpcValue request, response, uri;
  request[0] = request[1] = ros::this_node::getName();
  if (!ros::master::execute("lookupNode", request, response, uri, false)) return {};
  std::string host;
  std::uint32_t port = 0;
  const std::string address = uri;
  if (!ros::network::splitURI(address, host, port)) return {};
  XmlRpc::XmlRpcClient client{host.c_str(), static_cast<int>(port), "/"};
  XmlRpc::XmlRpcValue caller, pid;
  caller[0] = ros::this_node::getName();
  return client.execute("getPid", caller, pid) ? address : std::string{};
}

}  // namespace

int run_node(int argc, char** argv, const char* name, void (*body)(const RobotConfig& config)) {
  ros::init(argc, argv, name);
  if (const std::string address = namesake(); !address.empty()) {
    ROS_FATAL("%s runs already, at %s: has another robot this number?", ros::this_node::getName().c_str(),
              address.c_str());
    return 1;
  }
  const ros::NodeHandle own{"~"};
  try {
    const RobotConfig config = read_config(own);
    for (const spf::InputProblem& warning : config.file.warnings)
      ROS_WARN("%s", spf::warning_text(warning).c_str());
    body(config);
  } catch (const std::exception& error) {
    ROS_FATAL("%s", error.what());
    return 1;
  }
  return 0;
}

}  // namespace spf_empc_ros
