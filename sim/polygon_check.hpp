// Whether hand-drawn polygons can be used, within bounded work for all of a scene together.
#pragma once

#include <string>

#include "sim/scenario.hpp"

namespace spf::sim {

class PolygonCheck {
 public:
  static constexpr std::size_t kMostCorners = 1000;          ///< of one polygon
  static constexpr std::size_t kMostCornersOfAll = 100'000;  ///< of a scene

  /// "" or what must be mended: "must be at least 3, and are 2", of its corners. Call it once for each
  /// polygon of a scene.
  [[nodiscard]] std::string problem_of(const Polygon& polygon);

 private:
  std::size_t corners_ = 0;  // so far
};

}  // namespace spf::sim
