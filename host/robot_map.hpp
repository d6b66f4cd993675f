// Maps of robots: how fine, and how far their distances reach, by one rule for those that are given, sensed
// or simulated. Frame: world.
#pragma once

#include <algorithm>

#include "host/host_parameters.hpp"
#include "spf/world/occupancy_map.hpp"

namespace spf::host {

/// Distances reach over so many nodes at least [1].
inline constexpr double kLeastReach = 4.0;

/// Nothing is known of this rectangle yet. Nodes are no nearer than `finest` [m] to each other, whatever the
/// grain wants.
[[nodiscard]] inline OccupancyMap empty_map(const Eigen::Vector2d& low, const Eigen::Vector2d& high,
                                            const MapGrain& grain, double finest = 0.0) {
  const double resolution = std::max(grain.resolution, finest);
  return {GridFrame::covering(low, high, resolution), std::max(grain.reach, kLeastReach * resolution)};
}

/// The map of a robot that was given none: a square of `grid_size` around a position [m].
[[nodiscard]] inline OccupancyMap sensed_map(const Eigen::Vector2d& centre_world,
                                             const HostParameters& host) {
  const Eigen::Vector2d half = Eigen::Vector2d::Constant(0.5 * host.grid_size);
  OccupancyMap map = empty_map(centre_world - half, centre_world + half, host.map_grain);
  map.mark_unexplored();
  return map;
}

}  // namespace spf::host
