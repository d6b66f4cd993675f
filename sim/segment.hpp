// A line segment. Frame: world [m].
#pragma once

#include <Eigen/Core>

namespace spf::sim {

/// A thin wall, a face of something solid, or a seam between two fields of view.
struct Segment {
  Eigen::Vector2d from = Eigen::Vector2d::Zero();  ///< [m]
  Eigen::Vector2d to = Eigen::Vector2d::Zero();    ///< [m]
};

}  // namespace spf::sim
