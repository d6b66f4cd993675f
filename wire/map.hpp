// Maps (nav_msgs/OccupancyGrid): cells of 50 or more are occupied, unknown ones are free, and the world ends
// at the edges.
#pragma once

#include <cstdint>
#include <exception>
#include <string>

#include "host/cell_map.hpp"
#include "host/host_parameters.hpp"
#include "spf/world/occupancy_map.hpp"
#include "wire/pose.hpp"

namespace spf::wire {

template <class OccupancyGrid>
[[nodiscard]] Converted<OccupancyMap> read_map(const OccupancyGrid& grid, const std::string& frame,
                                               const host::HostParameters& host) {
  using Result = Converted<OccupancyMap>;
  std::string refusal;
  if (frames_differ(grid.header.frame_id, frame, refusal)) return Result::refused(refusal);
  const Converted<Pose2> origin = read_pose(grid.info.origin);
  if (!origin) return Result::refused("its origin: " + origin.refusal);
  const host::CellMap cells{*origin, grid.info.resolution, grid.info.width, grid.info.height, &grid.data};
  try {
    return {host::map_of_cells(cells, host), {}};
  } catch (const std::exception& error) {
    return Result::refused(error.what());
  }
}

template <class OccupancyGrid>
void fill(const OccupancyMap& map, OccupancyGrid& grid) {
  const GridFrame& nodes = map.frame();
  grid.info.resolution = static_cast<float>(nodes.resolution);
  grid.info.width = static_cast<std::uint32_t>(nodes.width);
  grid.info.height = static_cast<std::uint32_t>(nodes.height);
  // A cell surrounds its node.
  fill(Pose2{nodes.origin_world - Eigen::Vector2d::Constant(0.5 * nodes.resolution), 0.0}, grid.info.origin);
  grid.data.reserve(static_cast<std::size_t>(nodes.width) * static_cast<std::size_t>(nodes.height));
  for (int j = 0; j < nodes.height; ++j)
    for (int i = 0; i < nodes.width; ++i)
      grid.data.push_back(map.node_distance(i, j) <= 0.5 * nodes.resolution ? 100 : 0);
}

/// The same cells in the same place, whatever the stamp.
template <class OccupancyGrid>
[[nodiscard]] bool same_cells(const OccupancyGrid& one, const OccupancyGrid& other) {
  const auto& a = one.info;
  const auto& b = other.info;
  const auto& p = a.origin;
  const auto& q = b.origin;
  return one.header.frame_id == other.header.frame_id && a.resolution == b.resolution && a.width == b.width &&
         a.height == b.height && p.position.x == q.position.x && p.position.y == q.position.y &&
         p.orientation.x == q.orientation.x && p.orientation.y == q.orientation.y &&
         p.orientation.z == q.orientation.z && p.orientation.w == q.orientation.w && one.data == other.data;
}

}  // namespace spf::wire
