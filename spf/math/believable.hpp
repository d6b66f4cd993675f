// Largest size of a number from outside (sensors, peers, messages) that is accepted: its squares, products
// and sums over a trajectory are still finite. In SI units nothing on the ground comes near it.
#pragma once

#include <Eigen/Core>

#include <cmath>

namespace spf {

inline constexpr double kLargestBelieved = 1e9;

/// Finite, and small enough to compute with.
[[nodiscard]] inline bool believable(double number) {
  return std::abs(number) <= kLargestBelieved;  // false for NaN
}
template <class Derived>
[[nodiscard]] bool believable(const Eigen::DenseBase<Derived>& numbers) {
  return numbers.unaryExpr([](double number) { return believable(number); }).all();
}

}  // namespace spf
