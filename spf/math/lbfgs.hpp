// Limited-memory BFGS for costs with kinks and one-sided penalties: two-loop recursion, weak Wolfe conditions
// found by bracketing and bisection (Lewis and Overton 2013), cautious update (Li and Fukushima 2001). It
// always ends: every iteration counts, also one whose curvature is unusable, and evaluations are limited as
// well.
#pragma once

#include <Eigen/Core>

#include <array>
#include <type_traits>
#include <utility>
#include <vector>

#include "spf/math/parameters.hpp"

namespace spf {

struct LbfgsParameters {
  int memory = 16;                   ///< [1] pairs of steps and gradient changes kept
  double gradient_tolerance = 1e-5;  ///< [1] stops at |g|_inf <= tolerance, wherever the origin of x is
  int past = 3;                      ///< [1] iterations over which progress is judged; 0 = never
  double delta = 1e-2;       ///< [1] stops when the cost fell by less than this share over `past` iterations
  int max_iterations = 200;  ///< [1]
  int max_evaluations = 2000;         ///< [1] the deadline, in evaluations so that results repeat
  int max_line_search = 64;           ///< [1] evaluations in one line search
  double sufficient_decrease = 1e-4;  ///< [1] Armijo constant
  double curvature = 0.9;             ///< [1] weak Wolfe constant, above sufficient_decrease
  double cautious_factor = 1e-6;      ///< [1] keeps a pair if y.s > factor * |g| * |s|^2

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit("memory", self.memory, "1", Range{1, 100}, "pairs of steps and gradient changes kept (ES2: 16)");
    visit("gradient_tolerance", self.gradient_tolerance, "1", Range{0.0, 1.0},
          "stop when every component of the gradient is this small");
    visit("past", self.past, "1", Range{0, 16},
          "iterations over which progress is judged, 0 = never (ES2: 3)");
    visit("delta", self.delta, "1", Range{0.0, 1.0},
          "stop when the cost fell by less than this share (ES2: 0.01)");
    visit("max_iterations", self.max_iterations, "1", Range{1, 1000000}, "iterations of one run (ES2: 200)");
    visit("max_evaluations", self.max_evaluations, "1", Range{1, 100000000},
          "cost evaluations of one run, its deadline");
    visit("max_line_search", self.max_line_search, "1", Range{1, 1000},
          "cost evaluations of one line search");
    visit("sufficient_decrease", self.sufficient_decrease, "1", Range{1e-12, 0.49},
          "Armijo constant of the line search");
    visit("curvature", self.curvature, "1", Range{0.5, 0.999999}, "weak Wolfe constant of the line search");
    visit("cautious_factor", self.cautious_factor, "1", Range{0.0, 1.0},
          "least curvature of a pair that is kept");
  }
};

enum class LbfgsOutcome {
  converged,           ///< the gradient is small
  small_progress,      ///< the cost hardly fell over the last `past` iterations
  iteration_limit,     ///< max_iterations
  evaluation_limit,    ///< max_evaluations
  line_search_failed,  ///< no lower point along the steepest descent: a kink, rounding, or a wrong gradient
  not_finite,          ///< cost or gradient at the start is NaN or infinite; x is unchanged
  cancelled            ///< the hook asked to stop; x is the point before the line search it stopped
};

template <>
struct EnumNames<LbfgsOutcome> {
  static constexpr std::array<std::pair<LbfgsOutcome, const char*>, 7> values{
      {{LbfgsOutcome::converged, "converged"},
       {LbfgsOutcome::small_progress, "small_progress"},
       {LbfgsOutcome::iteration_limit, "iteration_limit"},
       {LbfgsOutcome::evaluation_limit, "evaluation_limit"},
       {LbfgsOutcome::line_search_failed, "line_search_failed"},
       {LbfgsOutcome::not_finite, "not_finite"},
       {LbfgsOutcome::cancelled, "cancelled"}}};
};

struct LbfgsResult {
  LbfgsOutcome outcome = LbfgsOutcome::not_finite;
  double cost = 0.0;    ///< at the returned x; never above the start's
  int iterations = 0;   ///< line searches begun
  int evaluations = 0;  ///< of cost and gradient together
};

/// What the hook asks for after an evaluation.
enum class LbfgsSignal { proceed, cancel };

/// Owns the memory of the method. Nothing allocates after construction (unless the cost does).
class Lbfgs {
 public:
  using Point = Eigen::Ref<const Eigen::VectorXd>;
  using Gradient = Eigen::Ref<Eigen::VectorXd>;

  /// Throws std::invalid_argument for parameters out of range.
  explicit Lbfgs(int max_dimension, const LbfgsParameters& parameters = {});

  /// Minimises `cost`, called as double(const Lbfgs::Point& x, Lbfgs::Gradient gradient); it fills the whole
  /// gradient. A cost or gradient that is not finite counts as "step too long". x holds the start, then the
  /// result; its size is at most max_dimension. Deterministic: the same calls give the same bits.
  template <class CostFunction>
  LbfgsResult minimize(Eigen::Ref<Eigen::VectorXd> x, CostFunction&& cost) {
    return minimize(x, cost, [](const Point&, double) { return LbfgsSignal::proceed; });
  }

  /// The same with a hook, called after each evaluation as LbfgsSignal(const Lbfgs::Point& x, double cost).
  template <class CostFunction, class Hook>
  LbfgsResult minimize(Eigen::Ref<Eigen::VectorXd> x, CostFunction&& cost, Hook&& hook) {
    using Cost = std::remove_reference_t<CostFunction>;
    using Watch = std::remove_reference_t<Hook>;
    std::pair<Cost*, Watch*> callables{&cost, &hook};
    const Problem problem{&callables,
                          [](void* both, const Point& at, Gradient gradient) -> double {
                            return (*static_cast<std::pair<Cost*, Watch*>*>(both)->first)(at, gradient);
                          },
                          [](void* both, const Point& at, double value) -> LbfgsSignal {
                            return (*static_cast<std::pair<Cost*, Watch*>*>(both)->second)(at, value);
                          }};
    return run(x, problem);
  }

  [[nodiscard]] const LbfgsParameters& parameters() const { return parameters_; }

 private:
  /// The caller's two callables, seen without their types and without owning them.
  struct Problem {
    void* callables;
    double (*cost)(void*, const Point&, Gradient);
    LbfgsSignal (*hook)(void*, const Point&, double);
  };
  struct Iterate {
    Eigen::VectorXd point;
    Eigen::VectorXd gradient;
    double cost = 0.0;
  };
  enum class SearchEnd { found, lower_only, nothing, evaluation_limit, cancelled };

  LbfgsResult run(Eigen::Ref<Eigen::VectorXd> x, const Problem& problem);
  LbfgsOutcome iterate(const Problem& problem);
  bool evaluate(const Problem& problem, Iterate& at);
  [[nodiscard]] bool gradient_is_small() const;
  double choose_direction();
  SearchEnd search_line(const Problem& problem, double slope);
  void remember_step();
  void accept(Iterate& next);

  LbfgsParameters parameters_;
  int dimension_ = 0;
  Iterate current_;
  Iterate trial_;
  Iterate lower_;  // best trial that descends enough but is still too steep
  Eigen::VectorXd direction_;
  Eigen::MatrixXd steps_;             // columns: s
  Eigen::MatrixXd gradient_changes_;  // columns: y
  Eigen::VectorXd inverse_products_;  // 1 / (y.s)
  Eigen::VectorXd projections_;
  std::vector<double> past_costs_;
  int newest_ = -1;
  int pair_count_ = 0;
  int iterations_ = 0;
  int evaluations_ = 0;
  LbfgsSignal signal_ = LbfgsSignal::proceed;
};

}  // namespace spf
