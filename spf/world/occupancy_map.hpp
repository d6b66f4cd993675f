// Static surroundings: a grid of occupied cells with a truncated distance field over it. Known shapes enter with
// their exact distance, sensed cells with their hit point. One clearance model for search, optimiser and checker:
// everybody asks distance(). Frame: world.
#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <vector>

#include "spf/math/pose2.hpp"
#include "spf/world/observation.hpp"

namespace spf {

/// Axis-aligned grid; node (i, j) stands at origin + resolution * (i, j).
struct GridFrame {
  Eigen::Vector2d origin_world = Eigen::Vector2d::Zero();  ///< [m] position of node (0, 0)
  double resolution = 0.1;                                 ///< [m]
  int width = 0;                                           ///< nodes along x
  int height = 0;                                          ///< nodes along y

  /// The smallest frame of this resolution that covers a rectangle.
  [[nodiscard]] static GridFrame covering(const Eigen::Vector2d& low, const Eigen::Vector2d& high, double resolution);
};

/// A disc whose scan returns are explained by something else (a tracked obstacle, a peer) and are not static.
struct IgnoredDisc {
  Eigen::Vector2d position_world = Eigen::Vector2d::Zero();
  double radius = 0.0;
};

class OccupancyMap {
 public:
  /// Distances are exact up to max_distance [m] and read max_distance beyond. Throws std::invalid_argument on an
  /// empty frame or one of more than 2^26 nodes.
  OccupancyMap(const GridFrame& frame, double max_distance);

  // Known shapes (exact distance, negative inside).
  void add_box(const Eigen::Vector2d& low, const Eigen::Vector2d& high);
  void add_disc(const Eigen::Vector2d& centre, double radius);
  /// The robot's world ends at these lines: outside counts as inside a wall.
  void add_border(const Eigen::Vector2d& low, const Eigen::Vector2d& high);

  /// Enters one sweep of the range sensor taken at `sensor_pose_world`: cells crossed by beams become free, cells with
  /// returns occupied (log odds), unless the return lies in an ignored disc. Non-finite and non-positive ranges other
  /// than +infinity are skipped.
  void integrate(const RangeScan& scan, const Pose2& sensor_pose_world, const std::vector<IgnoredDisc>& ignored);

  /// Distance from a point to the nearest static surface [m], bilinear between nodes, negative inside known shapes,
  /// at most max_distance(). Outside the grid: the value at the nearest node.
  [[nodiscard]] double distance(const Eigen::Vector2d& position_world) const;
  /// Gradient of that interpolation: points away from the surface; zero where truncated.
  [[nodiscard]] Eigen::Vector2d distance_gradient(const Eigen::Vector2d& position_world) const;
  /// Distance at a node without interpolation; (i, j) inside the frame.
  [[nodiscard]] double node_distance(int i, int j) const;
  /// Position of a node [m].
  [[nodiscard]] Eigen::Vector2d node_position(int i, int j) const;
  /// Nearest node, clamped to the frame.
  [[nodiscard]] Eigen::Vector2i nearest_node(const Eigen::Vector2d& position_world) const;

  [[nodiscard]] const GridFrame& frame() const { return frame_; }
  [[nodiscard]] double max_distance() const { return max_distance_; }
  /// Grows whenever any distance changes: cached paths compare it.
  [[nodiscard]] std::uint64_t revision() const { return revision_; }
  /// Sensed occupied cells (hit points) that became occupied after a revision: for display.
  [[nodiscard]] std::vector<Eigen::Vector2d> occupied_points() const;

 private:
  GridFrame frame_;
  double max_distance_;
  std::uint64_t revision_ = 0;
  std::vector<float> shape_distance_;   // [m] of known shapes
  std::vector<float> distance_;         // [m] of shapes and sensed cells together
  std::vector<float> log_odds_;         // sensed
  std::vector<Eigen::Vector2f> hits_;   // [m] point behind an occupied sensed cell
};

}  // namespace spf
