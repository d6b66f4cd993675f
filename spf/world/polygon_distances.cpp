#include "spf/world/polygon_distances.hpp"

#include <algorithm>
#include <cmath>

#include "spf/math/segment.hpp"

namespace spf {

PolygonDistances::PolygonDistances(const GridFrame& frame, const std::vector<Eigen::Vector2d>& corners,
                                   double reach)
    : frame_{frame}, reach_{reach} {
  Eigen::Vector2d low = corners.front();
  Eigen::Vector2d high = corners.front();
  for (const Eigen::Vector2d& corner : corners) {
    low = low.cwiseMin(corner);
    high = high.cwiseMax(corner);
  }
  const Eigen::Vector2d margin = Eigen::Vector2d::Constant(reach + frame.resolution);
  low_ = frame.nearest_node(low - margin);
  high_ = frame.nearest_node(high + margin);
  distances_.assign(slot(high_.x(), high_.y()) + 1, static_cast<float>(reach));
  for (std::size_t i = 0, last = corners.size() - 1; i < corners.size(); last = i++)
    enter_side(corners[last], corners[i]);
  turn_inside(corners);
}

/// Piece by piece, since the box around a long slanting side holds mostly nodes that are far from it.
void PolygonDistances::enter_side(const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  const Eigen::Vector2d along = to - from;
  const double longest = reach_ + frame_.resolution;
  // Only what lies near the grid matters, however far a side goes.
  const double most = 4.0 * (frame_.width + frame_.height);
  const double pieces = std::clamp(std::ceil(along.norm() / longest), 1.0, std::max(most, 1.0));
  const Eigen::Vector2d margin = Eigen::Vector2d::Constant(longest);
  for (int piece = 0; piece < static_cast<int>(pieces); ++piece) {
    const Eigen::Vector2d a = from + along * (piece / pieces);
    const Eigen::Vector2d b = from + along * ((piece + 1) / pieces);
    const Eigen::Vector2d first_corner = a.cwiseMin(b) - margin;
    const Eigen::Vector2d last_corner = a.cwiseMax(b) + margin;
    const Eigen::Vector2d grid_end = frame_.node_position(frame_.width - 1, frame_.height - 1);
    if ((last_corner.array() < frame_.origin_world.array()).any() ||
        (first_corner.array() > grid_end.array()).any())
      continue;
    const Eigen::Vector2i first = frame_.nearest_node(first_corner).cwiseMax(low_);
    const Eigen::Vector2i last = frame_.nearest_node(last_corner).cwiseMin(high_);
    for (int j = first.y(); j <= last.y(); ++j)
      for (int i = first.x(); i <= last.x(); ++i) {
        float& distance = distances_[slot(i, j)];
        distance = std::min(distance,
                            static_cast<float>(distance_to_segment(frame_.node_position(i, j), {from, to})));
      }
  }
}

/// Row by row: between the first and the second crossing of the outline, the third and the fourth, ...
void PolygonDistances::turn_inside(const std::vector<Eigen::Vector2d>& corners) {
  std::vector<double> crossings;
  for (int j = low_.y(); j <= high_.y(); ++j) {
    const double height = frame_.node_position(0, j).y();
    crossings.clear();
    for (std::size_t k = 0, last = corners.size() - 1; k < corners.size(); last = k++) {
      const Eigen::Vector2d& a = corners[last];
      const Eigen::Vector2d& b = corners[k];
      if ((a.y() > height) != (b.y() > height))
        crossings.push_back(a.x() + (height - a.y()) / (b.y() - a.y()) * (b.x() - a.x()));
    }
    std::sort(crossings.begin(), crossings.end());
    std::size_t passed = 0;
    for (int i = low_.x(); i <= high_.x(); ++i) {
      const double x = frame_.node_position(i, j).x();
      while (passed < crossings.size() && crossings[passed] <= x) ++passed;
      if (passed % 2 == 1) distances_[slot(i, j)] *= -1.0F;
    }
  }
}

}  // namespace spf
