// Robots on ROS 1: what holds on every ROS.
#include "wire/robot_faults_test.hpp"
#include "wire/robot_scanner_test.hpp"

#include "test/robot_world_test.hpp"

namespace spf::wire {

INSTANTIATE_TYPED_TEST_SUITE_P(OnRos1, RobotFaults, spf_empc_ros::Ros1);
INSTANTIATE_TYPED_TEST_SUITE_P(OnRos1, RobotScanner, spf_empc_ros::Ros1);
INSTANTIATE_TYPED_TEST_SUITE_P(OnRos1, RobotArrivals, spf_empc_ros::Ros1);

}  // namespace spf::wire
