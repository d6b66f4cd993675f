// spf-ros2: nodes of a robot on ROS 2.
#include "ros2/robot/program.hpp"

int main(int argc, char** argv) {
  return spf_ros2::run_program({argv, argv + argc});
}
