// A map of cells, as map servers and mapping give it, as the map that a robot plans with.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "host/host_parameters.hpp"
#include "spf/math/pose2.hpp"
#include "spf/world/occupancy_map.hpp"

namespace spf::host {

struct CellMap {
  Pose2 origin_world;                                ///< the corner of the first cell, and where rows point
  double resolution = 0.0;                           ///< [m] side of a cell
  std::size_t width = 0;                             ///< cells of a row
  std::size_t height = 0;                            ///< rows
  const std::vector<std::int8_t>* values = nullptr;  ///< row by row: 50 or more is occupied, -1 unknown
};

/// Occupied cells are known shapes, unknown ones are free, and the world ends at the edges. Throws
/// std::invalid_argument on a map without cells, of more than 2^26, with numbers that are none, or with
/// another number of values than of cells.
[[nodiscard]] OccupancyMap map_of_cells(const CellMap& cells, const HostParameters& host);

}  // namespace spf::host
