// Smoothness: the jerk integral, relative to a reference jerk of the robot.
#pragma once

#include "spf/trajectory/minco.hpp"

namespace spf {

struct SmoothnessCost {
  double weight = 1.0;  ///< [1/s]
  double reference_jerk =
      1.0;  ///< [m/s^3] max_acceleration^2 / max_speed: full acceleration in the time to full speed

  /// C = weight * integral of |jerk|^2 / reference_jerk^2 over the motion.
  [[nodiscard]] double add(const Minco& minco, Minco::Coefficients& wrt_coefficients,
                           Minco::Durations& wrt_durations) const {
    const double scaled = weight / (reference_jerk * reference_jerk);
    minco.add_smoothness_gradient(scaled, wrt_coefficients, wrt_durations);
    return scaled * minco.smoothness();
  }
};

}  // namespace spf
