// Convex polygons of few corners, and their distances. Units and frame: those of the coordinates, for all
// arguments the same.
#pragma once

#include <Eigen/Core>

#include <array>
#include <cassert>
#include <cstddef>

#include "spf/math/segment.hpp"

namespace spf {

/// A value; never allocates. Distances are 0 where the polygon and the other touch or overlap. Three corners
/// at least before any of its questions.
class ConvexPolygon {
 public:
  static constexpr std::size_t kMostCorners = 16;

  /// Corners come counterclockwise, at most kMostCorners of them.
  void add(const Eigen::Vector2d& corner) {
    assert(size_ < kMostCorners);
    corners_[size_++] = corner;
  }

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] const Eigen::Vector2d& corner(std::size_t i) const { return corners_[i]; }
  /// From corner i to the next.
  [[nodiscard]] LineSegment edge(std::size_t i) const {
    return {corners_[i], corners_[i + 1 < size_ ? i + 1 : 0]};
  }
  [[nodiscard]] bool contains(const Eigen::Vector2d& point) const;
  [[nodiscard]] double distance_to(const Eigen::Vector2d& point) const;
  [[nodiscard]] double distance_to(const LineSegment& segment) const;
  [[nodiscard]] double distance_to(const ConvexPolygon& other) const;

 private:
  std::array<Eigen::Vector2d, kMostCorners> corners_;
  std::size_t size_ = 0;
};

}  // namespace spf
