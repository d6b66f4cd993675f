// Signed distances from the nodes of a grid to a simple polygon. The work grows with the length of its sides
// and the area that it covers, not with their product. Frame: world.
#pragma once

#include <Eigen/Core>

#include <vector>

#include "spf/world/grid_frame.hpp"

namespace spf {

class PolygonDistances {
 public:
  /// Of the nodes that are not farther than `reach` [m] from the polygon, which has three finite corners or
  /// more.
  PolygonDistances(const GridFrame& frame, const std::vector<Eigen::Vector2d>& corners, double reach);

  [[nodiscard]] const Eigen::Vector2i& low() const { return low_; }    ///< node
  [[nodiscard]] const Eigen::Vector2i& high() const { return high_; }  ///< node, inclusive
  /// Distance from node (i, j) to the outline [m], negative inside; in either case at most `reach` large.
  [[nodiscard]] float at(int i, int j) const { return distances_[slot(i, j)]; }

 private:
  [[nodiscard]] std::size_t slot(int i, int j) const {
    const auto width = static_cast<std::size_t>(high_.x() - low_.x() + 1);
    return static_cast<std::size_t>(j - low_.y()) * width + static_cast<std::size_t>(i - low_.x());
  }
  void enter_side(const Eigen::Vector2d& from, const Eigen::Vector2d& to);
  void turn_inside(const std::vector<Eigen::Vector2d>& corners);

  GridFrame frame_;
  double reach_;  // [m]
  Eigen::Vector2i low_, high_;
  std::vector<float> distances_;  // by node of the window
};

}  // namespace spf
