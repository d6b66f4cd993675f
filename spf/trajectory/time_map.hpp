// Smooth one-to-one map between an unconstrained number tau and a positive duration, so that durations can be
// optimised without bounds: T(0) = 1 s, twice continuously differentiable, quadratic for long durations and
// inverse quadratic for short ones.
#pragma once

#include <cassert>
#include <cmath>

namespace spf {

/// T(tau) [s] > 0.
[[nodiscard]] inline double duration_from_tau(double tau) {
  if (tau > 0.0) return (0.5 * tau + 1.0) * tau + 1.0;
  return 1.0 / ((0.5 * tau - 1.0) * tau + 1.0);
}

/// dT/dtau [s] > 0.
[[nodiscard]] inline double duration_slope(double tau) {
  if (tau > 0.0) return tau + 1.0;
  const double inverse = (0.5 * tau - 1.0) * tau + 1.0;
  return (1.0 - tau) / (inverse * inverse);
}

/// The tau of a duration > 0 [s].
[[nodiscard]] inline double tau_from_duration(double duration) {
  assert(duration > 0.0);
  return duration > 1.0 ? std::sqrt(2.0 * duration - 1.0) - 1.0 : 1.0 - std::sqrt(2.0 / duration - 1.0);
}

}  // namespace spf
