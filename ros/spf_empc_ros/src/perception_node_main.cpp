// perception_node: one robot's perception half, in the robot's namespace.
#include <ros/ros.h>

#include "spf_empc_ros/perception_node.hpp"

int main(int argc, char** argv) {
  return spf_empc_ros::run_node(argc, argv, "perception", [](const spf_empc_ros::RobotConfig& config) {
    const ros::Time start = spf_empc_ros::first_time();
    if (!ros::ok()) return;
    const spf_empc_ros::PerceptionNode node{ros::NodeHandle{}, config, start};
    ros::spin();
  });
}
