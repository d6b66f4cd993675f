// Fits a disc to range returns: maximum a posteriori estimate of centre and radius. Frame: world.
#pragma once

#include <Eigen/Core>

#include <array>

#include "spf/perception/sensor_sweep.hpp"

namespace spf {

/// A ray tangent to the disc: half a step beside the last beam that hits it.
struct TangentRay {
  BeamRay ray;
  double side = 0.0;   ///< +1: the disc is to the left of the ray; -1: to the right; 0: there is none
  double sigma = 0.1;  ///< [m] of the gap between disc and ray
};

struct DiscFitProblem {
  const ScanReturn* returns = nullptr;
  int count = 0;
  std::array<TangentRay, 2> tangents;                      ///< where the outline was seen
  Eigen::Vector2d sensor_world = Eigen::Vector2d::Zero();  ///< [m] the centre lies behind the returns
  double range_sigma = 0.02;                               ///< [m]
  double prior_radius = 0.3;                               ///< [m]
  double prior_radius_sigma = 0.15;                        ///< [m]
};

struct DiscFit {
  Eigen::Vector2d centre_world = Eigen::Vector2d::Zero();  ///< [m]
  double radius = 0.0;                                     ///< [m]
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();    ///< of (centre, radius), from the Hessian
  double rms = 0.0;                                        ///< [m] of |return - centre| - radius
};

/// Minimises sum (|p - c| - r)^2 / sigma^2 + ((r - r0) / sigma_r)^2 + sum over tangents of
/// (gap - r)^2 / sigma_t^2 + (beside / r0)^2 by damped Gauss-Newton steps: gap is the distance from centre to
/// ray, and beside that of the centre from the line through sensor and mean return, a weak prior for what
/// is seen through a slit. The centre stays behind the mean return. Needs at least one return. All numbers
/// finite.
[[nodiscard]] DiscFit fit_disc(const DiscFitProblem& problem);

}  // namespace spf
