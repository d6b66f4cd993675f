// How people avoid each other: away from the predicted point of closest approach, the sooner and nearer the
// stronger; to the right when an encounter is head-on; bodies that touch push each other apart. Frame: world,
// SI.
#pragma once

#include <Eigen/Core>

namespace spf::sim {

/// Somebody or something with a round body that moves.
struct Body {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  ///< [m]
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();  ///< [m/s]
};

inline constexpr double kWalkerRelaxation = 0.5;  ///< [s] in which people take up their preferred velocity
inline constexpr double kWalkerHurry = 1.3;       ///< [1] fastest, in wanted speeds
inline constexpr double kWalkerStrongest = 4.0;   ///< [m/s^2] largest acceleration

/// Acceleration [m/s^2] by which a person avoids another body. `touching` [m] is the distance of centres at
/// which they touch; somebody who stands on purpose only yields to pushing.
[[nodiscard]] Eigen::Vector2d avoidance(const Body& self, const Body& other, double touching, bool standing);

/// The acceleration, shortened to what people are capable of.
[[nodiscard]] Eigen::Vector2d within_strength(const Eigen::Vector2d& acceleration);

/// One step of a person with this acceleration.
void advance(Body& body, const Eigen::Vector2d& acceleration, double wanted_speed, double step);

}  // namespace spf::sim
