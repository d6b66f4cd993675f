// Probabilities of the standard normal distribution.
#pragma once

#include <cmath>

namespace spf {

inline constexpr double kSqrtHalf = 0.70710678118654752440;

/// P(X > z) for X of mean 0 and standard deviation 1.
[[nodiscard]] inline double normal_tail(double z) {
  return 0.5 * std::erfc(z * kSqrtHalf);
}

/// P(-z < X < z), z >= 0.
[[nodiscard]] inline double normal_within(double z) {
  return std::erf(z * kSqrtHalf);
}

}  // namespace spf
