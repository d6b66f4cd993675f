// Finds points near a position without testing all of them: cells of equal size, hashed, so that the extent
// of the scene does not matter. Rebuilt whenever the points have moved; keeps its memory.
#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace spf::sim {

class UniformGrid {
 public:
  /// cell_size [m] > 0: about the radius of the queries.
  explicit UniformGrid(double cell_size) : inverse_size_{1.0 / cell_size} {}

  /// Replaces the points; their indices are what visit() reports.
  void assign(const std::vector<Eigen::Vector2d>& points);

  /// Calls visit(index) once for every point within `radius` of `position` (and for some a little farther),
  /// in an order that depends on the points alone.
  template <class Visit>
  void visit(const Eigen::Vector2d& position, double radius, Visit&& visit) const {
    if (cells_.empty()) return;
    const Cell low = cell_of(position - Eigen::Vector2d::Constant(radius));
    const Cell high = cell_of(position + Eigen::Vector2d::Constant(radius));
    const double span = static_cast<double>(high.x - low.x + 1) * static_cast<double>(high.y - low.y + 1);
    if (span > static_cast<double>(cells_.size())) {  // fewer points than cells: test them all
      for (std::size_t i = 0; i < cells_.size(); ++i)
        if (low.x <= cells_[i].x && cells_[i].x <= high.x && low.y <= cells_[i].y && cells_[i].y <= high.y)
          visit(static_cast<int>(i));
      return;
    }
    for (std::int64_t y = low.y; y <= high.y; ++y)
      for (std::int64_t x = low.x; x <= high.x; ++x) visit_cell({x, y}, visit);
  }

 private:
  struct Cell {
    std::int64_t x;
    std::int64_t y;
  };
  [[nodiscard]] Cell cell_of(const Eigen::Vector2d& point) const;
  [[nodiscard]] std::size_t bucket_of(const Cell& cell) const;
  template <class Visit>
  void visit_cell(const Cell& cell, Visit&& visit) const {
    const std::size_t bucket = bucket_of(cell);
    for (std::size_t slot = bucket_begin_[bucket]; slot < bucket_begin_[bucket + 1]; ++slot) {
      const std::size_t index = order_[slot];
      if (cells_[index].x == cell.x && cells_[index].y == cell.y) visit(static_cast<int>(index));
    }
  }

  double inverse_size_;  // [1/m]
  std::size_t bucket_mask_ = 0;
  std::vector<Cell> cells_;                // of each point
  std::vector<std::size_t> bucket_begin_;  // into order_, one more than there are buckets
  std::vector<std::size_t> order_;         // points by bucket, ascending within each
};

}  // namespace spf::sim
