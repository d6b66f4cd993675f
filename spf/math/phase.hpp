// When each of many does what all do once a period.
#pragma once

#include <cmath>

namespace spf {

/// A share of the period, in [0, 1), for each number: multiples of the golden ratio, an additive recurrence
/// that leaves numbers in a row far apart, however many there are.
[[nodiscard]] inline double phase_of(int number) {
  constexpr double kGoldenRatio = 0.6180339887498949;  // less one
  const double turns = kGoldenRatio * number;
  return turns - std::floor(turns);
}

}  // namespace spf
