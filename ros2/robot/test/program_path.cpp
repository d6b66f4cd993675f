#include "ros2/robot/program_test.hpp"

namespace spf_ros2 {

std::string fast_dds_program();

std::string program_path() {
  return SPF_ROS2_PROGRAM;
}

std::string fast_dds_program() {
  return SPF_FAST_DDS_PROGRAM;
}

}  // namespace spf_ros2
