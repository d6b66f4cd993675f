// robot_file SCENARIO [--robot NUMBER] [KEY=VALUE...] > robot.yaml
// Prints the parameter file of a scenario's robots: what `config` of planner, tracker and perception is to be
// when simulator_node runs that scenario and its robots are not the default ones. Where robots are of several
// kinds (`fleet`), that of the robot NUMBER (default: 0).
#include "simulator/robot_file.hpp"

int main(int argc, char** argv) {
  return spf::simulator::print_robot_file("robot_file", {argv + 1, argv + argc});
}
