#include "test/robot_world_test.hpp"

namespace spf_empc_ros {

std::string node_program(const std::string& name) {
  return SPF_ROS_PROGRAMS "/" + name;
}

}  // namespace spf_empc_ros
