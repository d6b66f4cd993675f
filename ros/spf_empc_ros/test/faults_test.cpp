// The faults of robots on ROS 1: those of every ROS.
#include "wire/robot_faults_test.hpp"

#include "test/robot_world_test.hpp"

namespace spf::wire {

INSTANTIATE_TYPED_TEST_SUITE_P(OnRos1, RobotFaults, spf_empc_ros::Ros1);

}  // namespace spf::wire
