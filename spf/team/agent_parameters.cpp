#include "spf/team/agent_parameters.hpp"

#include "spf/robot/robot_scale.hpp"

namespace spf {

AgentParameters defaults_for(const RobotParameters& robot) {
  AgentParameters parameters = scaled(AgentParameters{}, RobotScale{robot});
  parameters.robot = robot;
  return parameters;
}

}  // namespace spf
