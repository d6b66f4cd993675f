#include <ros/ros.h>

#include <exception>

#include "spf_empc_ros/simulator_node.hpp"

int main(int argc, char** argv) {
  ros::init(argc, argv, "simulator");
  const ros::NodeHandle own{"~"};
  try {
    bool simulated = false;
    if (!ros::param::get("/use_sim_time", simulated) || !simulated) {
      ROS_FATAL("set /use_sim_time to true before any node starts: the simulator is the clock");
      return 1;
    }
    const ros::WallTime now = ros::WallTime::now();
    spf_empc_ros::SimulatorNode simulator{ros::NodeHandle{}, spf_empc_ros::read_simulator_config(own),
                                          ros::Time{now.sec, 0}};
    return simulator.run();
  } catch (const std::exception& error) {
    ROS_FATAL("%s", error.what());
    return 1;
  }
}
