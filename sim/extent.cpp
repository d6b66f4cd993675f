#include "sim/extent.hpp"

#include "host/cell_map.hpp"

namespace spf::sim {
namespace {

constexpr double kOpenMargin = 8.0;  // [m] around everything, where there is no border

}  // namespace

Box extent_of(const Scenario& scenario) {
  if (scenario.border) return *scenario.border;
  if (scenario.map) {  // the world ends at its edges
    const host::CellExtent extent = host::extent_of(scenario.map->cells());
    return {extent.low_world, extent.high_world};
  }
  Box extent{scenario.robots.front().start.position_world, scenario.robots.front().start.position_world};
  const auto include = [&extent](const Eigen::Vector2d& point) {
    extent.low = extent.low.cwiseMin(point);
    extent.high = extent.high.cwiseMax(point);
  };
  for (const RobotTask& task : scenario.robots) {
    include(task.start.position_world);
    include(task.goal_world);
    for (const host::Goal& goal : task.next_goals) include(goal.position_world);
  }
  for (const FleetEvent& event : scenario.events)
    if (event.order.act == FleetAct::goal) include(event.order.goal.position_world);
  for (const Box& box : scenario.boxes) {
    include(box.low);
    include(box.high);
  }
  for (const Disc& disc : scenario.discs) include(disc.center);
  for (const Segment& wall : scenario.walls) {
    include(wall.from);
    include(wall.to);
  }
  for (const Polygon& polygon : scenario.polygons)
    for (const Eigen::Vector2d& corner : polygon.corners) include(corner);
  extent.low -= Eigen::Vector2d::Constant(kOpenMargin);
  extent.high += Eigen::Vector2d::Constant(kOpenMargin);
  return extent;
}

}  // namespace spf::sim
