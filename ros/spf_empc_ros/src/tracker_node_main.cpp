// tracker_node: one robot's tracker half, in the robot's namespace.
#include <ros/ros.h>

#include "spf_empc_ros/tracker_node.hpp"

int main(int argc, char** argv) {
  return spf_empc_ros::run_node(argc, argv, "tracker", [](const spf_empc_ros::RobotConfig& config) {
    const ros::Time start = spf_empc_ros::first_time();
    if (!ros::ok()) return;
    const spf_empc_ros::TrackerNode node{ros::NodeHandle{}, config, start};
    ros::spin();
  });
}
