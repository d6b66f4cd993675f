// A static map given as cells, as ground truth: occupied cells are walls, and so is everything beyond the
// map's edges. Its origin may be turned. Frame: world, SI.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "host/cell_map.hpp"
#include "sim/segment.hpp"

namespace spf::sim {

class StaticMap {
 public:
  /// Faces of walls; a map with more is noise, and nothing that robots drive in.
  static constexpr std::size_t kMostFaces = std::size_t{1} << 19;
  static constexpr double kLongestFace = 4.0;  ///< [m] longer ones are given in pieces

  /// `values` row by row from the origin on: 50 or more is occupied. Throws std::invalid_argument as
  /// host::map_of_cells does, and on more than kMostFaces.
  StaticMap(const Pose2& origin_world, double resolution, std::size_t width, std::size_t height,
            std::vector<std::int8_t> values);

  [[nodiscard]] host::CellMap cells() const { return {origin_, resolution_, width_, height_, &values_}; }
  /// Where free cells end, in pieces.
  [[nodiscard]] const std::vector<Segment>& faces() const { return faces_; }
  /// Whether a position lies in an occupied cell or beyond the edges.
  [[nodiscard]] bool occupied(const Eigen::Vector2d& position_world) const;
  /// Counterclockwise, from the origin on.
  [[nodiscard]] std::array<Eigen::Vector2d, 4> corners() const;

 private:
  [[nodiscard]] Eigen::Vector2d to_world(double column, double row) const;
  [[nodiscard]] bool wall_at(std::ptrdiff_t column, std::ptrdiff_t row) const;
  void add_faces(bool along_rows);

  Pose2 origin_;       // of the corner of the first cell; rows point along its x axis
  double resolution_;  // [m]
  std::size_t width_;
  std::size_t height_;
  std::vector<std::int8_t> values_;
  std::vector<Segment> faces_;
};

}  // namespace spf::sim
