// Robots with corners, as they really are: convex polygons that move and turn over a step. Frame: world [m].
#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <optional>

#include "sim/contact.hpp"
#include "spf/robot/footprint.hpp"

namespace spf::sim {

/// A box as a polygon.
[[nodiscard]] ConvexPolygon polygon_of(const Box& box);
/// The least depth of a polygon inside a border; negative where it is beyond.
[[nodiscard]] double depth_inside(const ConvexPolygon& polygon, const Box& border);

/// A robot with corners over one step: its centre moves along a line while it turns evenly.
struct BodyMotion {
  const Footprint* outline;
  Motion centre;
  double heading;  ///< [rad] at the beginning
  double turn;     ///< [rad] over the step

  [[nodiscard]] ConvexPolygon at(double share) const {
    return outline->placed(centre.at(share), heading + share * turn);
  }
  /// No point of it moves farther over the step [m].
  [[nodiscard]] double reach() const {
    return (centre.to - centre.from).norm() + outline->circumscribed_radius() * std::abs(turn);
  }
};

/// The share of a step at which a distance first comes to nothing: `distance(share)` falls by no more than
/// `fastest` [m] times the share. Exact to a micrometre.
template <class Distance>
[[nodiscard]] std::optional<double> first_touch(double fastest, const Distance& distance) {
  constexpr double kTouch = 1e-6;  // [m]
  double share = 0.0;
  while (true) {
    const double left = distance(share);
    if (left <= kTouch) return share;
    if (share >= 1.0 || !(fastest > 0.0)) return std::nullopt;
    share = std::min(1.0, share + left / fastest);
  }
}

}  // namespace spf::sim
