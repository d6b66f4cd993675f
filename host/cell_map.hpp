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

/// How many cells a map may have.
inline constexpr std::size_t kMostCells = std::size_t{1} << 26;

/// What the value of a cell says.
[[nodiscard]] constexpr bool is_occupied(std::int8_t value) {
  return value >= 50;
}

/// Throws std::invalid_argument on a map without cells, of more than kMostCells, with numbers that are none,
/// or with another number of values than of cells.
void check_cells(const CellMap& cells);

/// Occupied cells [first_column, end_column) of the rows [first_row, end_row).
struct CellBlock {
  std::size_t first_column, end_column, first_row, end_row;
};
/// Blocks that cover every occupied cell once, and nothing else.
[[nodiscard]] std::vector<CellBlock> occupied_blocks(const CellMap& cells);

/// The smallest axis-parallel rectangle around the map.
struct CellExtent {
  Eigen::Vector2d low_world;   ///< [m]
  Eigen::Vector2d high_world;  ///< [m]
};
[[nodiscard]] CellExtent extent_of(const CellMap& cells);

/// The world ends at the edges of these cells.
void add_edges(OccupancyMap& map, const CellMap& cells);
/// Occupied cells are known shapes, unknown ones are free.
void add_cells(OccupancyMap& map, const CellMap& cells);

/// Both, in a map that covers the cells. Throws as check_cells does.
[[nodiscard]] OccupancyMap map_of_cells(const CellMap& cells, const HostParameters& host);

}  // namespace spf::host
