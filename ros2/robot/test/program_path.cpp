#include "ros2/robot/program_test.hpp"

namespace spf_ros2 {

std::string program_path() {
  return SPF_ROS2_PROGRAM;
}

}  // namespace spf_ros2
