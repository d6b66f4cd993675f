#include "spf/team/agent_parameters.hpp"

#include <algorithm>
#include <utility>

#include "spf/robot/footprint.hpp"
#include "spf/robot/robot_scale.hpp"

namespace spf {

AgentParameters defaults_for(const RobotParameters& robot) {
  const RobotParameters settled = with_radius_of_footprint(robot);
  AgentParameters parameters = scaled(AgentParameters{}, RobotScale{settled});
  parameters.robot = settled;
  return parameters;
}

AgentParameters settled(AgentParameters agent) {
  agent.robot = with_radius_of_footprint(std::move(agent.robot));
  return agent;
}

AgentParameters slowed_to(AgentParameters agent, double max_speed) {
  constexpr double kShortestHorizon = 0.05;  // [m] the ranges of PlannerParameters
  constexpr double kShortestPiece = 0.01;    // [m]
  const double ratio = max_speed / agent.robot.max_speed;
  agent.robot.max_speed = max_speed;
  agent.planner.horizon = std::max(ratio * agent.planner.horizon, kShortestHorizon);
  agent.planner.piece_length = std::max(ratio * agent.planner.piece_length, kShortestPiece);
  return agent;
}

}  // namespace spf
