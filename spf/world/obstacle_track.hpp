// Belief about one moving obstacle: a state estimate and how its uncertainty grows. Frame: world.
#pragma once

#include "spf/world/obstacle_state.hpp"

namespace spf {

struct ObstacleTrack {
  int id = 0;
  double time = 0.0;  ///< [s] instant of `state`
  ObstacleState state;
  double position_variance = 0.0;   ///< [m^2] per axis
  double velocity_variance = 0.0;   ///< [(m/s)^2] per axis
  double cross_covariance = 0.0;    ///< [m^2/s] of position and velocity, per axis
  double position_diffusion = 0.0;  ///< [m^2/s] growth of the position variance: white velocity noise
  double velocity_diffusion = 0.0;  ///< [(m/s)^2/s] growth of the velocity variance: random-walk velocity
  double stood = 0.0;               ///< [s] for so long it has been seen to stand still

  /// Standard deviation per axis after `ahead` seconds [m]:
  /// sigma^2 = P + 2 C ahead + V ahead^2 + Dp ahead + Dv ahead^3 / 3; ahead < 0 counts as 0.
  [[nodiscard]] double position_sigma(double ahead) const;
};

}  // namespace spf
