// The map that a fleet is given (nav_msgs/OccupancyGrid): cells of a scenario's static shapes. Frame: world.
#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <vector>

#include "sim/scenario.hpp"
#include "wire/pose.hpp"

namespace spf::simulator {

struct MapCells {
  Eigen::Vector2d low = Eigen::Vector2d::Zero();  ///< [m] lower left corner
  float resolution = 0.05F;                       ///< [m]
  std::uint32_t width = 0, height = 0;
  std::vector<std::int8_t> data;  ///< row by row from below: 0 free, 100 occupied
};

/// The border's inside (or all there is, where the scene is open), with the static shapes when the scenario
/// says that they are known. A cell is occupied when its centre is. `resolution` [m].
[[nodiscard]] MapCells map_cells(const sim::Scenario& scenario, double resolution);

template <class OccupancyGrid, class Time>
[[nodiscard]] OccupancyGrid map_message(const MapCells& cells, const std::string& frame, const Time& time) {
  OccupancyGrid grid;
  grid.header.frame_id = frame;
  grid.header.stamp = grid.info.map_load_time = time;
  grid.info.resolution = cells.resolution;
  grid.info.width = cells.width;
  grid.info.height = cells.height;
  wire::fill(Pose2{cells.low, 0.0}, grid.info.origin);
  grid.data = cells.data;
  return grid;
}

}  // namespace spf::simulator
