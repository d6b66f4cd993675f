// The area that a disc sweeps while its centre moves along an arc, or straight ahead. Frame: any, with the
// centre at the origin when it sets out.
#pragma once

#include <Eigen/Core>

namespace spf::host {

/// Immutable. Queries never throw or allocate.
class SweptArc {
 public:
  /// `direction` is a unit vector, `curvature` [1/m] positive to the left, `radius` [m] the disc's.
  SweptArc(const Eigen::Vector2d& direction, double curvature, double radius);

  /// How far [m] the centre gets until the disc touches a point [m]: 0 when it does already and comes nearer
  /// still, infinite when it never does within one turn, or leaves a point that it touches.
  [[nodiscard]] double distance_to(const Eigen::Vector2d& point) const;

  [[nodiscard]] double curvature() const { return 1.0 / turn_; }  ///< [1/m] to whatever side

 private:
  [[nodiscard]] double straight_distance_to(double along, double aside) const;

  Eigen::Vector2d direction_;
  double side_;    // +1: turns left, -1: right
  double turn_;    // [m] radius of the arc; infinite when it is straight
  double radius_;  // [m]
};

}  // namespace spf::host
