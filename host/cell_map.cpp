#include "host/cell_map.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "host/robot_map.hpp"

namespace spf::host {
namespace {

constexpr double kMostCells = 1 << 26;
constexpr int kOccupiedValue = 50;
constexpr double kNotTurned = 1e-6;  // [rad]

void check_cells(const CellMap& cells) {
  const double count = static_cast<double>(cells.width) * static_cast<double>(cells.height);
  if (!(count > 0.0 && count <= kMostCells)) throw std::invalid_argument("it has no cells, or too many");
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

/// Calls visit(first, end, row) for every run of occupied cells.
template <class Visit>
void for_occupied_runs(const CellMap& cells, const Visit& visit) {
  for (std::size_t j = 0; j < cells.height; ++j) {
    const auto occupied = [&](std::size_t i) {
      return (*cells.values)[j * cells.width + i] >= kOccupiedValue;
    };
    for (std::size_t i = 0; i < cells.width; ++i) {
      if (!occupied(i)) continue;
      const std::size_t first = i;
      while (i < cells.width && occupied(i)) ++i;
      visit(first, i, j);
    }
  }
}

}  // namespace

OccupancyMap map_of_cells(const CellMap& cells, const HostParameters& host) {
  check_cells(cells);
  const double cell = cells.resolution;
  const Pose2& origin = cells.origin_world;
  const bool turned = std::abs(origin.heading) > kNotTurned;
  const Eigen::Vector2d extent =
      cell * Eigen::Vector2d{static_cast<double>(cells.width), static_cast<double>(cells.height)};
  Eigen::Vector2d low = origin.position_world;
  Eigen::Vector2d high = low + extent;
  if (turned) {
    const Eigen::Matrix2d turn = Eigen::Rotation2Dd{origin.heading}.toRotationMatrix();
    const Eigen::Vector2d centre = origin.position_world + turn * (0.5 * extent);
    const Eigen::Vector2d half = turn.cwiseAbs() * (0.5 * extent);
    low = centre - half;
    high = centre + half;
  }
  // Shapes between nodes keep their exact distance, so nodes may be farther apart than cells.
  OccupancyMap map = empty_map(low, high, host.map_grain, cell);
  if (turned)
    map.add_border(Eigen::Vector2d::Zero(), extent, origin);
  else
    map.add_border(low, high);
  for_occupied_runs(cells, [&](std::size_t first, std::size_t end, std::size_t row) {
    const Eigen::Vector2d corner =
        cell * Eigen::Vector2d{static_cast<double>(first), static_cast<double>(row)};
    const Eigen::Vector2d other =
        cell * Eigen::Vector2d{static_cast<double>(end), static_cast<double>(row + 1)};
    if (turned)
      map.add_box(corner, other, origin);
    else
      map.add_box(low + corner, low + other);
  });
  return map;
}

}  // namespace spf::host
