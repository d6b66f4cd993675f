// Real roots of a small polynomial in an interval: between two neighbouring roots of the derivative the
// polynomial is monotone, so one safeguarded Newton search settles each stretch; the derivative's roots are
// found likewise. Never allocates. Coefficients are in ascending powers.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace spf {

/// Value and slope by Horner's rule.
struct ValueAndSlope {
  double value;
  double slope;
};

template <std::size_t Count>
[[nodiscard]] ValueAndSlope evaluate_polynomial(const std::array<double, Count>& coefficients, double x) {
  ValueAndSlope result{0.0, 0.0};
  for (std::size_t k = Count; k-- > 0;) {
    result.slope = result.slope * x + result.value;
    result.value = result.value * x + coefficients[k];
  }
  return result;
}

/// Roots in ascending order. A polynomial of degree d has d of them; more than Capacity can only come from
/// rounding noise of a polynomial that is zero all over, and is dropped.
template <std::size_t Capacity>
class RootList {
 public:
  void push(double root) {
    if (size_ < Capacity) roots_[size_++] = root;
  }
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] double operator[](std::size_t index) const { return roots_[index]; }
  [[nodiscard]] const double* begin() const { return roots_.data(); }
  [[nodiscard]] const double* end() const { return roots_.data() + size_; }

 private:
  std::array<double, Capacity> roots_{};
  std::size_t size_ = 0;
};

/// The root in [low, high] of a polynomial that is monotone there and has opposite signs at the ends. Newton,
/// with bisection whenever a step would leave the bracket or shrinks too slowly. Precise to rounding of the
/// polynomial.
template <std::size_t Count>
[[nodiscard]] double monotone_root(const std::array<double, Count>& coefficients, double low, double high) {
  constexpr double kResolution = 1e-15;  // a few rounding units of the bracket's ends
  constexpr int kMaxSteps = 200;         // bisection alone would need about 60
  const bool rising = evaluate_polynomial(coefficients, low).value < 0.0;
  const double tolerance = kResolution * std::fmax(std::fabs(low), std::fabs(high));
  double x = 0.5 * (low + high);
  double step = high - low;
  for (int i = 0; i < kMaxSteps; ++i) {
    const ValueAndSlope here = evaluate_polynomial(coefficients, x);
    if (here.value == 0.0) return x;
    ((here.value < 0.0) == rising ? low : high) = x;
    const double previous_step = step;
    double next = x - here.value / here.slope;
    const bool good = next > low && next < high && std::fabs(next - x) < 0.5 * std::fabs(previous_step);
    if (!good) next = 0.5 * (low + high);
    step = next - x;
    x = next;
    if (std::fabs(step) <= tolerance || high - low <= tolerance) return x;
  }
  return x;
}

/// Every point in [low, high] where the polynomial changes sign, and the zeros that a search meets exactly. A
/// root that only touches zero may be missing: at such a point the antiderivative has no extremum, which is
/// what the callers want to know. Needs low <= high.
template <std::size_t Count>
[[nodiscard]] RootList<Count> polynomial_roots(const std::array<double, Count>& coefficients, double low,
                                               double high) {
  RootList<Count> roots;
  if constexpr (Count >= 2) {
    std::array<double, Count - 1> derivative{};
    for (std::size_t k = 1; k < Count; ++k) derivative[k - 1] = static_cast<double>(k) * coefficients[k];
    const RootList<Count - 1> turns = polynomial_roots(derivative, low, high);

    double left = low;
    double left_value = evaluate_polynomial(coefficients, low).value;
    const auto visit_stretch = [&](double right) {
      if (!(right > left)) return;
      const double right_value = evaluate_polynomial(coefficients, right).value;
      const bool crosses = (left_value < 0.0 && right_value > 0.0) || (left_value > 0.0 && right_value < 0.0);
      if (crosses) roots.push(monotone_root(coefficients, left, right));
      if (right_value == 0.0) roots.push(right);
      left = right;
      left_value = right_value;
    };
    if (left_value == 0.0) roots.push(low);
    for (const double turn : turns) visit_stretch(turn);
    visit_stretch(high);
  }
  return roots;
}

}  // namespace spf
