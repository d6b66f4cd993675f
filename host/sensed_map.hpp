// The map of a robot that was given none. Frame: world.
#pragma once

#include "host/host_parameters.hpp"
#include "spf/world/occupancy_map.hpp"

namespace spf::host {

/// Nothing is known of it yet: a square of `grid_size` around a place [m].
[[nodiscard]] inline OccupancyMap sensed_map(const Eigen::Vector2d& centre_world, const HostParameters& host,
                                             const OccupancyParameters& occupancy) {
  const Eigen::Vector2d half = Eigen::Vector2d::Constant(0.5 * host.grid_size);
  return {GridFrame::covering(centre_world - half, centre_world + half, host.map_resolution), host.map_reach,
          occupancy};
}

}  // namespace spf::host
