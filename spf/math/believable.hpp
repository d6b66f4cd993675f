// Numbers from outside - sensors, peers, messages - are believed up to a size of which squares, products and
// sums over a trajectory are still numbers. In SI units nothing on the ground comes near it.
#pragma once

#include <Eigen/Core>

#include <cmath>

namespace spf {

inline constexpr double kLargestBelieved = 1e9;

/// Finite, and of a size that can be reckoned with.
[[nodiscard]] inline bool believable(double number) {
  return std::abs(number) <= kLargestBelieved;  // false for NaN
}
template <class Derived>
[[nodiscard]] bool believable(const Eigen::DenseBase<Derived>& numbers) {
  return numbers.unaryExpr([](double number) { return believable(number); }).all();
}

}  // namespace spf
