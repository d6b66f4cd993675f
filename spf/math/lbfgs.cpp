#include "spf/math/lbfgs.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace spf {
namespace {
constexpr double kRounding = std::numeric_limits<double>::epsilon();
}  // namespace

Lbfgs::Lbfgs(int max_dimension, const LbfgsParameters& parameters) : parameters_{validated(parameters)} {
  assert(max_dimension >= 0);
  for (Iterate* storage : {&current_, &trial_, &lower_}) {
    storage->point.setZero(max_dimension);
    storage->gradient.setZero(max_dimension);
  }
  direction_.setZero(max_dimension);
  steps_.setZero(max_dimension, parameters_.memory);
  gradient_changes_.setZero(max_dimension, parameters_.memory);
  inverse_products_.setZero(parameters_.memory);
  projections_.setZero(parameters_.memory);
  past_costs_.resize(static_cast<std::size_t>(std::max(1, parameters_.past)));
}

LbfgsResult Lbfgs::run(Eigen::Ref<Eigen::VectorXd> x, const Problem& problem) {
  assert(x.size() <= current_.point.size());
  dimension_ = static_cast<int>(x.size());
  pair_count_ = 0;
  newest_ = -1;
  iterations_ = 0;
  evaluations_ = 0;
  current_.point.head(dimension_) = x;

  const bool finite = evaluate(problem, current_);
  LbfgsResult result;
  result.outcome = signal_ == LbfgsSignal::cancel ? LbfgsOutcome::cancelled
                   : finite                       ? iterate(problem)
                                                  : LbfgsOutcome::not_finite;
  x = current_.point.head(dimension_);
  result.cost = current_.cost;
  result.iterations = iterations_;
  result.evaluations = evaluations_;
  return result;
}

LbfgsOutcome Lbfgs::iterate(const Problem& problem) {
  while (true) {
    if (gradient_is_small()) return LbfgsOutcome::converged;
    if (parameters_.past > 0) {
      double& past = past_costs_[static_cast<std::size_t>(iterations_ % parameters_.past)];
      const double fall = past - current_.cost;
      if (iterations_ >= parameters_.past && fall < parameters_.delta * std::fabs(current_.cost))
        return LbfgsOutcome::small_progress;
      past = current_.cost;
    }
    if (iterations_ >= parameters_.max_iterations) return LbfgsOutcome::iteration_limit;

    ++iterations_;
    const double slope = choose_direction();
    const bool steepest = pair_count_ == 0;
    switch (search_line(problem, slope)) {
      case SearchEnd::found:
        remember_step();
        accept(trial_);
        break;
      case SearchEnd::lower_only:  // no usable curvature: go on from the lower point with an empty memory
        accept(lower_);
        pair_count_ = 0;
        break;
      case SearchEnd::nothing:
        if (steepest) return LbfgsOutcome::line_search_failed;
        pair_count_ = 0;
        break;
      case SearchEnd::evaluation_limit:
        return LbfgsOutcome::evaluation_limit;
      case SearchEnd::cancelled:
        return LbfgsOutcome::cancelled;
    }
  }
}

/// False when cost or gradient is not finite. The hook's answer is in signal_.
bool Lbfgs::evaluate(const Problem& problem, Iterate& at) {
  const Point point = at.point.head(dimension_);
  at.cost = problem.cost(problem.callables, point, at.gradient.head(dimension_));
  ++evaluations_;
  signal_ = problem.hook(problem.callables, point, at.cost);
  return std::isfinite(at.cost) && at.gradient.head(dimension_).allFinite();
}

bool Lbfgs::gradient_is_small() const {
  return dimension_ == 0 ||
         current_.gradient.head(dimension_).lpNorm<Eigen::Infinity>() <= parameters_.gradient_tolerance;
}

/// Two-loop recursion; falls back to steepest descent when the result does not descend. Returns the slope
/// along the direction.
double Lbfgs::choose_direction() {
  const int n = dimension_;
  const int memory = parameters_.memory;
  direction_.head(n) = -current_.gradient.head(n);
  if (pair_count_ > 0) {
    for (int i = 0, j = newest_; i < pair_count_; ++i, j = (j + memory - 1) % memory) {
      projections_[j] = inverse_products_[j] * steps_.col(j).head(n).dot(direction_.head(n));
      direction_.head(n) -= projections_[j] * gradient_changes_.col(j).head(n);
    }
    const double change = gradient_changes_.col(newest_).head(n).squaredNorm();
    direction_.head(n) *= 1.0 / (inverse_products_[newest_] * change);
    int j = (newest_ + memory - pair_count_ + 1) % memory;
    for (int i = 0; i < pair_count_; ++i, j = (j + 1) % memory) {
      const double backward = inverse_products_[j] * gradient_changes_.col(j).head(n).dot(direction_.head(n));
      direction_.head(n) += (projections_[j] - backward) * steps_.col(j).head(n);
    }
    const double slope = direction_.head(n).dot(current_.gradient.head(n));
    if (slope < 0.0 && std::isfinite(slope) && direction_.head(n).allFinite()) return slope;
    pair_count_ = 0;
    direction_.head(n) = -current_.gradient.head(n);
  }
  return -current_.gradient.head(n).squaredNorm();
}

/// Weak Wolfe: grow the step until it is bracketed, then bisect. `trial_` is the result when found; otherwise
/// `lower_` is the longest step seen that descends enough.
Lbfgs::SearchEnd Lbfgs::search_line(const Problem& problem, double slope) {
  const int n = dimension_;
  double low = 0.0;
  double high = std::numeric_limits<double>::infinity();
  double step = pair_count_ > 0 ? 1.0 : std::min(1.0, 1.0 / direction_.head(n).norm());
  const double shortest =
      kRounding * current_.point.head(n).lpNorm<Eigen::Infinity>() /
      direction_.head(n).lpNorm<Eigen::Infinity>();  // shorter steps leave the point unchanged
  for (int i = 0; i < parameters_.max_line_search; ++i) {
    if (evaluations_ >= parameters_.max_evaluations) {
      if (low > 0.0) accept(lower_);
      return SearchEnd::evaluation_limit;
    }
    trial_.point.head(n) = current_.point.head(n) + step * direction_.head(n);
    const bool finite = evaluate(problem, trial_);
    if (signal_ == LbfgsSignal::cancel) return SearchEnd::cancelled;

    if (!finite || !(trial_.cost <= current_.cost + parameters_.sufficient_decrease * step * slope)) {
      high = step;
    } else if (trial_.gradient.head(n).dot(direction_.head(n)) < parameters_.curvature * slope) {
      low = step;
      std::swap(trial_, lower_);
    } else {
      return SearchEnd::found;
    }
    step = std::isinf(high) ? 2.0 * low : 0.5 * (low + high);
    const bool divisible = step - low > kRounding * low && step > shortest && std::isfinite(step);
    if (!divisible) break;  // a kink lies between the bracket's ends, or only rounding does
  }
  return low > 0.0 ? SearchEnd::lower_only : SearchEnd::nothing;
}

/// Keeps the pair of the step from `current_` to `trial_` if its curvature is trustworthy.
void Lbfgs::remember_step() {
  const int n = dimension_;
  const int slot = (newest_ + 1) % parameters_.memory;
  steps_.col(slot).head(n) = trial_.point.head(n) - current_.point.head(n);
  gradient_changes_.col(slot).head(n) = trial_.gradient.head(n) - current_.gradient.head(n);
  const double product = steps_.col(slot).head(n).dot(gradient_changes_.col(slot).head(n));
  const double least =
      parameters_.cautious_factor * current_.gradient.head(n).norm() * steps_.col(slot).head(n).squaredNorm();
  constexpr double kSmallest = 1e-300;  // below, 1 / product overflows
  if (!(product > std::max(least, kSmallest)) || !std::isfinite(product)) {
    pair_count_ =
        std::min(pair_count_, parameters_.memory - 1);  // the slot held the oldest pair of a full memory
    return;
  }
  inverse_products_[slot] = 1.0 / product;
  newest_ = slot;
  pair_count_ = std::min(pair_count_ + 1, parameters_.memory);
}

void Lbfgs::accept(Iterate& next) {
  std::swap(current_, next);
}

}  // namespace spf
