// How a robot's software obeys. Frame: world.
#pragma once

#include "host/robot_host.hpp"
#include "sim/world.hpp"

namespace spf::sim {

/// Passes an order of this tick (World::orders()) on to the robot that it is for. One that joins, or has been
/// repaired, starts afresh where it is, with `map` (robot_map()).
void obey(const FleetOrder& order, const World& world, const OccupancyMap& map, host::RobotHost& robot);

}  // namespace spf::sim
