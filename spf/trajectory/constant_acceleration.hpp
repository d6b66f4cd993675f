// The simplest piece of a trajectory. Frame: that of its arguments.
#pragma once

#include "spf/trajectory/trajectory.hpp"

namespace spf {

/// From a position [m] at one velocity to another [m/s] in a duration [s] > 0.
[[nodiscard]] inline QuinticPiece constant_acceleration(const Eigen::Vector2d& position,
                                                        const Eigen::Vector2d& from,
                                                        const Eigen::Vector2d& to, double duration) {
  QuinticPiece piece;
  piece.duration = duration;
  piece.coefficients.row(0) = position.transpose();
  piece.coefficients.row(1) = from.transpose();
  piece.coefficients.row(2) = (to - from).transpose() / (2.0 * duration);
  return piece;
}

}  // namespace spf
