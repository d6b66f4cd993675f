#include "simulator/map_cells.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/extent.hpp"
#include "sim/geometry.hpp"
#include "spf/math/polygon.hpp"
#include "spf/math/segment.hpp"

namespace spf::simulator {
namespace {

using sim::Box;
using sim::Disc;
using sim::Scenario;
using sim::Segment;

constexpr std::int8_t kOccupied = 100;

template <class Points>
Box bounds_of(const Points& points) {
  Box bounds{points[0], points[0]};
  for (const Eigen::Vector2d& point : points) {
    bounds.low = bounds.low.cwiseMin(point);
    bounds.high = bounds.high.cwiseMax(point);
  }
  return bounds;
}

/// Cells being filled: marks those whose centre a shape covers.
class CellPainter {
 public:
  explicit CellPainter(MapCells& cells) : cells_{cells}, size_{cells.resolution} {}

  /// `distance` from a centre to the shape must not be above `reach`.
  template <class Distance>
  void paint(const Eigen::Vector2d& low, const Eigen::Vector2d& high, double reach,
             const Distance& distance) {
    const auto [i0, j0] = cell_of(low - Eigen::Vector2d::Constant(reach));
    const auto [i1, j1] = cell_of(high + Eigen::Vector2d::Constant(reach));
    for (long j = j0; j <= j1; ++j)
      for (long i = i0; i <= i1; ++i) {
        const Eigen::Vector2d centre =
            cells_.low + size_ * Eigen::Vector2d{static_cast<double>(i) + 0.5, static_cast<double>(j) + 0.5};
        if (distance(centre) <= reach)
          cells_.data[static_cast<std::size_t>(j) * cells_.width + static_cast<std::size_t>(i)] = kOccupied;
      }
  }

 private:
  [[nodiscard]] std::pair<long, long> cell_of(const Eigen::Vector2d& position) const {
    const Eigen::Vector2d steps = (position - cells_.low) / size_;
    return {std::clamp(std::lround(std::floor(steps.x())), 0L, static_cast<long>(cells_.width) - 1),
            std::clamp(std::lround(std::floor(steps.y())), 0L, static_cast<long>(cells_.height) - 1)};
  }
  MapCells& cells_;
  double size_;  // [m] of a cell
};

void paint_shapes(const Scenario& scenario, CellPainter& painter, double resolution) {
  for (const Box& box : scenario.boxes)
    painter.paint(box.low, box.high, 0.0,
                  [&](const Eigen::Vector2d& position) { return sim::distance_to_box(position, box); });
  for (const Disc& disc : scenario.discs)
    painter.paint(disc.center, disc.center, disc.radius,
                  [&](const Eigen::Vector2d& position) { return (position - disc.center).norm(); });
  // A thin wall covers no centre: its cells are those that it may cross.
  for (const Segment& wall : scenario.walls)
    painter.paint(wall.from.cwiseMin(wall.to), wall.from.cwiseMax(wall.to), resolution * std::sqrt(0.5),
                  [&](const Eigen::Vector2d& position) { return distance_to_segment(position, wall); });
  for (const sim::Polygon& polygon : scenario.polygons) {
    const Box bounds = bounds_of(polygon.corners);
    painter.paint(bounds.low, bounds.high, 0.0, [&](const Eigen::Vector2d& position) {
      return signed_distance_to_polygon(position, polygon.corners);
    });
  }
  if (!scenario.map) return;
  const Box bounds = bounds_of(scenario.map->corners());
  painter.paint(bounds.low, bounds.high, 0.0, [&](const Eigen::Vector2d& position) {
    return scenario.map->occupied(position) ? 0.0 : resolution;
  });
}

}  // namespace

MapCells map_cells(const Scenario& scenario, double resolution) {
  const Box extent = extent_of(scenario);
  MapCells cells;
  cells.low = extent.low;
  cells.resolution = static_cast<float>(resolution);
  const Eigen::Vector2d size = (extent.high - extent.low) / static_cast<double>(cells.resolution);
  constexpr double kRounding = 1e-3;  // of a cell
  cells.width = static_cast<std::uint32_t>(std::ceil(size.x() - kRounding));
  cells.height = static_cast<std::uint32_t>(std::ceil(size.y() - kRounding));
  cells.data.assign(static_cast<std::size_t>(cells.width) * cells.height, 0);
  if (scenario.simulation.sensing.map == sim::MapKnowledge::sensed) return cells;
  CellPainter painter{cells};
  paint_shapes(scenario, painter, resolution);
  return cells;
}

}  // namespace spf::simulator
