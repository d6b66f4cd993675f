#include "spf/world/obstacle_track.hpp"

#include <algorithm>
#include <cmath>

namespace spf {

double ObstacleTrack::position_sigma(double ahead) const {
  const double t = std::max(ahead, 0.0);
  const double variance = position_variance + t * (2.0 * cross_covariance + position_diffusion +
                                                   t * (velocity_variance + t * velocity_diffusion / 3.0));
  return std::sqrt(std::max(variance, 0.0));
}

}  // namespace spf
