// Compares analytic gradients with central differences.
#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <cmath>

namespace spf {

struct GradientCheck {
  Eigen::VectorXd analytic;
  Eigen::VectorXd numeric;
  /// Largest deviation of a component, relative to the largest component of either gradient.
  double relative_error = 0.0;
  /// Index of that component.
  Eigen::Index worst = 0;
};

/// Central differences of `cost_and_gradient`, called as double(x, gradient) with an Eigen::VectorXd of x's
/// size. Each component moves by step * max(1, |x_i|). With the default step the truncation is about 1e-10
/// and rounding 1e-11, times the size of the third derivative and of the cost, relative to the gradient: a
/// tolerance of 1e-6 leaves room for costs a thousand times their gradient and still shows any wrong term.
template <class CostAndGradient>
[[nodiscard]] GradientCheck check_gradient(CostAndGradient&& cost_and_gradient, const Eigen::VectorXd& x,
                                           double step = 1e-5) {
  GradientCheck check;
  check.analytic = Eigen::VectorXd::Zero(x.size());
  check.numeric = Eigen::VectorXd::Zero(x.size());
  cost_and_gradient(x, check.analytic);

  Eigen::VectorXd unused = Eigen::VectorXd::Zero(x.size());
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    const double shift = step * std::max(1.0, std::fabs(x[i]));
    Eigen::VectorXd above = x;
    Eigen::VectorXd below = x;
    above[i] += shift;
    below[i] -= shift;
    const double rise = cost_and_gradient(above, unused) - cost_and_gradient(below, unused);
    check.numeric[i] = rise / (above[i] - below[i]);  // the shift that was really made
  }

  if (x.size() == 0) return check;
  const double scale =
      std::max(check.analytic.lpNorm<Eigen::Infinity>(), check.numeric.lpNorm<Eigen::Infinity>());
  const Eigen::VectorXd deviation = (check.analytic - check.numeric).cwiseAbs();
  const double largest = deviation.maxCoeff(&check.worst);
  check.relative_error = scale > 0.0 ? largest / scale : largest;
  return check;
}

}  // namespace spf
