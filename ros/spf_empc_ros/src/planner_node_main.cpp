// planner_node: one robot's planner half, in the robot's namespace.
#include <ros/ros.h>

#include "spf_empc_ros/planner_node.hpp"

int main(int argc, char** argv) {
  return spf_empc_ros::run_node(argc, argv, "planner", [](const spf_empc_ros::RobotConfig& config) {
    const ros::Time start = spf_empc_ros::first_time();
    if (!ros::ok()) return;
    const spf_empc_ros::PlannerNode node{ros::NodeHandle{}, config, start};
    ros::spin();
  });
}
