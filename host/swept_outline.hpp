// The area that a convex polygon sweeps while it moves along an arc and turns with it, straight ahead, or
// turns on the spot. Frame: any, with the polygon's centre at the origin when it sets out.
#pragma once

#include <Eigen/Core>

#include "spf/robot/footprint.hpp"

namespace spf::host {

/// Immutable. Queries never throw or allocate.
class SweptOutline {
 public:
  /// An outline with corners at a heading [rad]. `direction` is the unit vector in which the centre sets out,
  /// `curvature` [1/m] positive to the left.
  SweptOutline(const Footprint& outline, double heading, const Eigen::Vector2d& direction, double curvature);

  /// How far [m] the centre gets until the outline meets a point [m]: 0 when it holds it and it lies ahead,
  /// infinite when it never does within one turn, or leaves a point that it holds.
  [[nodiscard]] double distance_to(const Eigen::Vector2d& point) const;
  /// How far [rad] it may turn on the spot until it meets a point; infinite when it never does, or holds it.
  [[nodiscard]] double turn_to(const Eigen::Vector2d& point, bool left) const;

 private:
  [[nodiscard]] double straight_distance_to(const Eigen::Vector2d& point) const;
  [[nodiscard]] double turn_around(const Eigen::Vector2d& middle, double side,
                                   const Eigen::Vector2d& point) const;

  ConvexPolygon polygon_;
  Eigen::Vector2d direction_;
  double curvature_;  // [1/m]
};

}  // namespace spf::host
