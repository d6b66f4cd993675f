// Integrals of scalar functions by Gauss-Legendre panels, halved until they agree with their halves. The
// number of evaluations is bounded whatever the function is. Never allocates.
#pragma once

#include <array>
#include <cmath>

namespace spf {

/// One panel of 10 nodes: exact but for rounding for polynomials up to degree 19.
template <class Function>
[[nodiscard]] double gauss_legendre(Function&& function, double from, double to) {
  // Half of the nodes on [-1, 1], which lie symmetrically, and their weights.
  constexpr std::array<std::array<double, 2>, 5> kRule{{{0.1488743389816312, 0.2955242247147529},
                                                        {0.4333953941292472, 0.2692667193099963},
                                                        {0.6794095682990244, 0.2190863625159820},
                                                        {0.8650633666889845, 0.1494513491505806},
                                                        {0.9739065285171717, 0.0666713443086881}}};
  const double middle = 0.5 * (from + to);
  const double half = 0.5 * (to - from);
  double sum = 0.0;
  for (const auto& [node, weight] : kRule)
    sum += weight * (function(middle - half * node) + function(middle + half * node));
  return half * sum;
}

/// Adaptive integration within a budget.
class Quadrature {
 public:
  static constexpr int kPanelEvaluations = 10;

  /// A panel is halved until its two halves together differ from it by no more than `tolerance` (absolute, in
  /// the integral's unit), at most max_depth times and within a budget of max_panels panels. Panels left
  /// unrefined then count as they are, so there is always a value.
  Quadrature(double tolerance, int max_depth, int max_panels)
      : tolerance_{tolerance}, max_depth_{max_depth}, panels_left_{max_panels} {}

  /// The integral of function(x) over [from, to]. Several calls share the budget; each costs one panel at
  /// least, even when the budget is spent.
  template <class Function>
  [[nodiscard]] double integrate(Function&& function, double from, double to) {
    --panels_left_;
    return refined(function, from, to, gauss_legendre(function, from, to), max_depth_);
  }

 private:
  template <class Function>
  double refined(Function& function, double from, double to, double whole, int depth) {
    if (depth == 0 || panels_left_ < 2) return whole;
    panels_left_ -= 2;
    const double middle = 0.5 * (from + to);
    const double left = gauss_legendre(function, from, middle);
    const double right = gauss_legendre(function, middle, to);
    if (std::fabs(left + right - whole) <= tolerance_) return left + right;
    return refined(function, from, middle, left, depth - 1) + refined(function, middle, to, right, depth - 1);
  }

  double tolerance_;
  int max_depth_;
  int panels_left_;
};

}  // namespace spf
