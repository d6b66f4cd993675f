#include "host/cell_map.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "host/robot_map.hpp"

namespace spf::host {
namespace {

constexpr double kNotTurned = 1e-6;  // [rad]

bool is_turned(const CellMap& cells) {
  return std::abs(cells.origin_world.heading) > kNotTurned;
}

/// Position of a corner between cells in the map's own frame [m].
Eigen::Vector2d corner_at(const CellMap& cells, std::size_t column, std::size_t row) {
  return cells.resolution * Eigen::Vector2d{static_cast<double>(column), static_cast<double>(row)};
}

/// Calls visit(first, end) for every run of occupied cells of a row.
template <class Visit>
void for_occupied_runs(const CellMap& cells, std::size_t row, const Visit& visit) {
  const auto occupied = [&](std::size_t i) { return is_occupied((*cells.values)[row * cells.width + i]); };
  for (std::size_t i = 0; i < cells.width; ++i) {
    if (!occupied(i)) continue;
    const std::size_t first = i;
    while (i < cells.width && occupied(i)) ++i;
    visit(first, i);
  }
}

}  // namespace

void check_cells(const CellMap& cells) {
  const double count = static_cast<double>(cells.width) * static_cast<double>(cells.height);
  if (!(count > 0.0 && count <= static_cast<double>(kMostCells)))
    throw std::invalid_argument("it has no cells, or too many");
  const std::size_t values = cells.values != nullptr ? cells.values->size() : 0;
  if (values != cells.width * cells.height)
    throw std::invalid_argument("data has " + std::to_string(values) + " entries, not " +
                                std::to_string(cells.width * cells.height));
  if (!(std::isfinite(cells.resolution) && cells.resolution > 0.0))
    throw std::invalid_argument("resolution is not above 0");
  if (!cells.origin_world.position_world.allFinite() || !std::isfinite(cells.origin_world.heading))
    throw std::invalid_argument("its origin is not finite");
  const double size = cells.resolution * static_cast<double>(std::max(cells.width, cells.height));
  if (cells.origin_world.position_world.lpNorm<Eigen::Infinity>() > kFarthest || size > kFarthest)
    throw std::invalid_argument("it reaches farther than any robot goes");
}

std::vector<CellBlock> occupied_blocks(const CellMap& cells) {
  std::vector<CellBlock> blocks;
  std::vector<std::size_t> open, still_open;  // blocks that end at the row, by column
  for (std::size_t row = 0; row < cells.height; ++row) {
    still_open.clear();
    std::size_t above = 0;
    for_occupied_runs(cells, row, [&](std::size_t first, std::size_t end) {
      while (above < open.size() && blocks[open[above]].first_column < first) ++above;
      const bool goes_on = above < open.size() && blocks[open[above]].first_column == first &&
                           blocks[open[above]].end_column == end;
      if (goes_on) {
        blocks[open[above]].end_row = row + 1;
        still_open.push_back(open[above]);
      } else {
        still_open.push_back(blocks.size());
        blocks.push_back({first, end, row, row + 1});
      }
    });
    std::swap(open, still_open);
  }
  return blocks;
}

CellExtent extent_of(const CellMap& cells) {
  const Eigen::Vector2d extent = corner_at(cells, cells.width, cells.height);
  const Pose2& origin = cells.origin_world;
  if (!is_turned(cells)) return {origin.position_world, origin.position_world + extent};
  const Eigen::Matrix2d turn = Eigen::Rotation2Dd{origin.heading}.toRotationMatrix();
  const Eigen::Vector2d centre = origin.position_world + turn * (0.5 * extent);
  const Eigen::Vector2d half = turn.cwiseAbs() * (0.5 * extent);
  return {centre - half, centre + half};
}

void add_edges(OccupancyMap& map, const CellMap& cells) {
  const Eigen::Vector2d extent = corner_at(cells, cells.width, cells.height);
  const Eigen::Vector2d& low = cells.origin_world.position_world;
  if (is_turned(cells))
    map.add_border(Eigen::Vector2d::Zero(), extent, cells.origin_world);
  else
    map.add_border(low, low + extent);
}

void add_cells(OccupancyMap& map, const CellMap& cells) {
  const Eigen::Vector2d& low = cells.origin_world.position_world;
  const bool turned = is_turned(cells);
  for (const CellBlock& block : occupied_blocks(cells)) {
    const Eigen::Vector2d corner = corner_at(cells, block.first_column, block.first_row);
    const Eigen::Vector2d other = corner_at(cells, block.end_column, block.end_row);
    if (turned)
      map.add_box(corner, other, cells.origin_world);
    else
      map.add_box(low + corner, low + other);
  }
}

OccupancyMap map_of_cells(const CellMap& cells, const HostParameters& host) {
  check_cells(cells);
  const CellExtent extent = extent_of(cells);
  // Shapes between nodes keep their exact distance, so nodes may be farther apart than cells.
  OccupancyMap map = empty_map(extent.low_world, extent.high_world, host.map_grain, cells.resolution);
  add_edges(map, cells);
  add_cells(map, cells);
  return map;
}

}  // namespace spf::host
