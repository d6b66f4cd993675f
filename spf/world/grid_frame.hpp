// An axis-aligned grid of nodes. Frame: world.
#pragma once

#include <Eigen/Core>

#include <cstdint>

namespace spf {

/// Axis-aligned grid; node (i, j) lies at origin + resolution * (i, j).
struct GridFrame {
  Eigen::Vector2d origin_world = Eigen::Vector2d::Zero();  ///< [m] position of node (0, 0)
  double resolution = 0.1;                                 ///< [m]
  int width = 0;                                           ///< nodes along x
  int height = 0;                                          ///< nodes along y

  /// The smallest frame of this resolution that covers a rectangle. Throws std::invalid_argument when the
  /// rectangle is empty or not finite, the resolution not positive, or the frame would have more than 2^26
  /// nodes.
  [[nodiscard]] static GridFrame covering(const Eigen::Vector2d& low, const Eigen::Vector2d& high,
                                          double resolution);

  [[nodiscard]] bool contains(int i, int j) const { return 0 <= i && i < width && 0 <= j && j < height; }
  /// Number of a node, row by row.
  [[nodiscard]] std::int32_t index(int i, int j) const { return j * width + i; }
  /// Position of a node [m].
  [[nodiscard]] Eigen::Vector2d node_position(int i, int j) const {
    return {origin_world.x() + resolution * i, origin_world.y() + resolution * j};
  }
  /// Nearest node, clamped to the frame. NaN counts as the origin.
  [[nodiscard]] Eigen::Vector2i nearest_node(const Eigen::Vector2d& position_world) const;
};

/// Throws std::invalid_argument unless the frame has 1 to 2^26 nodes and finite, positive measures.
void check_frame(const GridFrame& frame);

}  // namespace spf
