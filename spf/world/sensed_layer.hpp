// What a range sensor has seen, on a grid: log odds per cell, where in each cell beams have ended, and the
// distance from every node to the nearest such point. Part of OccupancyMap. Frame: world.
#pragma once

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <vector>

#include "spf/world/grid_frame.hpp"

namespace spf {

/// One beam of a sweep: free up to its end, where there is a surface or nothing.
struct SensedBeam {
  Eigen::Vector2d direction_world = Eigen::Vector2d::UnitX();  ///< unit vector
  double length = 0.0;                                         ///< [m] free up to here
  bool returned = false;  ///< there is a surface at the end: the cell of the end is not crossed
  bool marks = false;     ///< and it is a static one, to be entered
};

/// Memory grows with the area seen, in tiles of 32 x 32 nodes (12 KB each): of a map of a square kilometre a
/// robot stores only what lies along its route.
class SensedLayer {
 public:
  SensedLayer(const GridFrame& frame, double max_distance);

  /// Enters a sweep; every cell is updated at most once, returns before crossings, so that a beam never
  /// clears what another beam of the same sweep has hit. True when any distance changed.
  bool integrate(const Eigen::Vector2d& sensor_world, const std::vector<SensedBeam>& beams);
  /// Enters surfaces at these points [m], as sure as sweeps make them that just suffice.
  void enter_surfaces(const std::vector<Eigen::Vector2d>& points_world);

  /// A surface is at most this much nearer than distance() says [m]: half a part of a cell.
  [[nodiscard]] double error() const { return 0.5 * frame_.resolution / kParts; }
  /// Distance from node (i, j) to the nearest hit point of an occupied cell [m], at most max_distance.
  [[nodiscard]] float distance(int i, int j) const {
    const int tile = tile_of_[tile_slot(i, j)];
    return tile < 0 ? max_distance_ : tiles_[static_cast<std::size_t>(tile)].distance[cell_slot(i, j)];
  }
  /// Lowers each of four values to the distance from its node, (i, j) to (i + 3, j); all inside the frame.
  void lower(int i, int j, float (&values)[4]) const {
    const bool in_one_tile = (i & (kTileSide - 1)) <= kTileSide - 4;
    const int tile = tile_of_[tile_slot(i, j)];
    if (in_one_tile && tile < 0) return;
    const float* row =
        in_one_tile ? &tiles_[static_cast<std::size_t>(tile)].distance[cell_slot(i, j)] : nullptr;
    for (int k = 0; k < 4; ++k) {
      const float sensed = row != nullptr ? row[k] : distance(i + k, j);
      values[k] = sensed < values[k] ? sensed : values[k];
    }
  }
  /// Whether beams have crossed cell (i, j) and its eight neighbours, each more than once.
  [[nodiscard]] bool free_around(int i, int j) const;
  /// Whether a cell at most `reach` rows and columns from (i, j) speaks for "free", and none for "occupied".
  [[nodiscard]] bool crossed_near(int i, int j, int reach) const;
  [[nodiscard]] std::vector<Eigen::Vector2d> occupied_points() const;

 private:
  static constexpr int kTileBits = 5;
  static constexpr int kTileSide = 1 << kTileBits;
  static constexpr std::size_t kTileCells = std::size_t{1} << (2 * kTileBits);
  static constexpr int kParts = 4;  // of a cell, along each axis

  struct Tile {
    int first_i = 0;
    int first_j = 0;
    int occupied_cells = 0;
    std::array<float, kTileCells> distance;
    std::array<std::int16_t, kTileCells> log_odds;  // in units of 1 / kLogOddsUnit
    std::array<std::uint16_t, kTileCells> hits;     // a bit for each of the 4 x 4 parts of the cell in which
                                                    // a beam has ended; valid while log_odds > 0
    std::array<std::uint16_t, kTileCells> sweep;    // last sweep that updated the cell
  };
  /// The middle of a part of a cell in which beams have ended.
  struct Hit {
    int i;
    int j;
    Eigen::Vector2f offset;  // [m] from node (i, j)
  };
  struct NodeWindow {
    int low_i, high_i, low_j, high_j;  // inclusive
  };

  [[nodiscard]] std::size_t tile_slot(int i, int j) const {
    return static_cast<std::size_t>(j >> kTileBits) * static_cast<std::size_t>(tiles_across_) +
           static_cast<std::size_t>(i >> kTileBits);
  }
  [[nodiscard]] static std::size_t cell_slot(int i, int j) {
    return static_cast<std::size_t>(((j & (kTileSide - 1)) << kTileBits) | (i & (kTileSide - 1)));
  }
  Tile& tile_at(int i, int j);
  [[nodiscard]] NodeWindow window_around(int i, int j, int reach) const;
  [[nodiscard]] Hit hit_at(int i, int j, int part) const;
  template <class Visit>
  void for_hits(const Tile& tile, std::size_t slot, std::uint16_t parts, const Visit& visit) const;
  void enter_return(const Eigen::Vector2d& end_world);
  void cross_cells(const Eigen::Vector2d& sensor_world, const std::vector<SensedBeam>& beams,
                   std::size_t index);
  void enter_crossing(Tile& tile, const Eigen::Vector2i& cell, const Eigen::Vector2d& sensor_world,
                      const std::vector<SensedBeam>& beams, std::size_t index);
  void stamp(const Hit& hit);
  void forget(const std::vector<Hit>& vanished);
  void restore(const Hit& vanished, std::size_t first_node, std::size_t last_node);
  void begin_sweep();

  GridFrame frame_;
  float max_distance_;  // [m]
  int reach_;           // [nodes] of max_distance
  std::int16_t hit_step_, miss_step_, lowest_, highest_, occupied_from_;
  int tiles_across_;
  std::vector<std::int32_t> tile_of_;  // index into tiles_, -1 = nothing seen there
  std::vector<Tile> tiles_;
  std::uint16_t sweep_ = 0;
  std::vector<Hit> appeared_, vanished_, nearby_;  // of the current sweep, kept for their capacity
  std::vector<Eigen::Vector2i> orphans_;           // nodes whose nearest hit has vanished
};

}  // namespace spf
