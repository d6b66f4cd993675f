#include "sim/fleet_order.hpp"

namespace spf::sim {

void obey(const FleetOrder& order, const World& world, const OccupancyMap& map, host::RobotHost& robot) {
  const RobotTruth& truth = world.robots()[as_index(order.robot)];
  robot.set_switches({truth.stopped, truth.paused});
  if (order.act == FleetAct::goal) robot.planner().set_goal(order.goal);
  if (order.act == FleetAct::cancel) robot.planner().cancel();
  if (order.act == FleetAct::join || order.act == FleetAct::repair)
    robot.start(map, truth.pose, world.time());
  if (order.act != FleetAct::priority) return;
  AgentParameters parameters = robot.planner().parameters();
  parameters.team.priority = order.priority;
  robot.planner().reconfigure(parameters);
}

}  // namespace spf::sim
