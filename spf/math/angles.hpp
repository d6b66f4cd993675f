// Angles in radians, wrapped to (-pi, pi].
#pragma once

#include <cmath>

namespace spf {

inline constexpr double kPi = 3.14159265358979323846;

/// The same direction in (-pi, pi].
[[nodiscard]] inline double wrap_angle(double angle) {
  const double wrapped = std::remainder(angle, 2.0 * kPi);  // in [-pi, pi]
  return wrapped <= -kPi ? wrapped + 2.0 * kPi : wrapped;
}

/// The shortest turn from `from` to `to`, in (-pi, pi].
[[nodiscard]] inline double angle_difference(double to, double from) {
  return wrap_angle(to - from);
}

}  // namespace spf
