// A half plane in which a node should lie: the form in which static surfaces (es2 guide pairs) and the safety
// probability field (eq. 10-13) enter the optimiser. Both are constant within one run. Frame: world.
#pragma once

#include <Eigen/Core>

namespace spf {

struct GuidePair {
  int node = 0;  ///< index in the NodeSet
  Eigen::Vector2d base =
      Eigen::Vector2d::Zero();  ///< [m] point on the border of the half plane: b, or the guide point g
  Eigen::Vector2d normal = Eigen::Vector2d::Zero();  ///< unit vector towards the safe side
  int source = -1;                                   ///< id of the obstacle, -1 = static
};

/// Signed distance of a point from the border [m], positive on the safe side.
[[nodiscard]] inline double signed_distance(const GuidePair& pair, const Eigen::Vector2d& position) {
  return (position - pair.base).dot(pair.normal);
}

}  // namespace spf
