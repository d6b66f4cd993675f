#pragma once

#include <Eigen/Core>
#include <cmath>

namespace spf::host {

/// Where the centre stands [m] after a distance [m] from the origin, along an arc that begins in a direction
/// [rad] and bends with a signed curvature [1/m]: what the closed forms of swept shapes are compared with.
inline Eigen::Vector2d centre_after(double distance, double direction, double curvature) {
  if (curvature == 0.0) return distance * Eigen::Vector2d{std::cos(direction), std::sin(direction)};
  const double turned = direction + curvature * distance;
  return Eigen::Vector2d{std::sin(turned) - std::sin(direction), std::cos(direction) - std::cos(turned)} /
         curvature;
}

}  // namespace spf::host
