// The dual active set of BoxLqSolver (Goldfarb and Idnani 1983, in range-space form). Every bound reads
// n^T x >= b - slack with multiplier >= 0; the Schur matrix over the active bounds is n_i^T G^-1 n_j, plus
// 1 / (2 slack_weight) on the diagonal of soft ones, for which slack = multiplier / (2 slack_weight). G^-1 n
// is one Riccati solve ("response"). The problem is always feasible, because only states have bounds that can
// conflict and those are soft; so the method ends at the minimum after finitely many steps.
#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "spf/tracking/box_lq_stage.hpp"

namespace spf {
namespace {
using namespace box_lq;  // NOLINT: the arithmetic of the stages, of this solver alone

// A bound counts as violated beyond this [m/s], [m]; inputs are clipped afterwards.
constexpr double kViolation = 1e-11;

template <int N>
double softness(const BoxLqProblem<N>& problem, bool on_input) {
  return on_input ? 0.0 : 0.5 / problem.slack_weight;
}

}  // namespace

template <int N>
bool BoxLqSolver<N>::solve_dual(const BoxLqProblem<N>& problem, InputSequence<N>& inputs, int max_steps,
                                int& steps) {
  minimise_without_bounds(problem, inputs);
  if (!start_from_last_active_set(problem, inputs)) return false;
  while (true) {
    Bound worst;
    const double violation = most_violated(problem, inputs, worst);
    if (violation <= 0.0) return true;
    if (!take_up(problem, inputs, worst, violation, max_steps, steps)) return false;
  }
}

template <int N>
void BoxLqSolver<N>::minimise_without_bounds(const BoxLqProblem<N>& problem, InputSequence<N>& inputs) {
  roll_out(problem, inputs);
  compute_gradient(problem, states_, inputs, 0.0);
  for (int k = 0; k < problem.steps; ++k) held_[as_index(k)].fill(false);
  const bool rate = problem.rate_weight > 0.0;
  if (rate)
    riccati_sweep<true>(problem, inputs);
  else
    riccati_sweep<false>(problem, inputs);
  Vector3d state_step = Vector3d::Zero();
  Input step = Input::Zero();
  for (int k = 0; k < problem.steps; ++k) {
    const Feedback& feedback = feedback_[as_index(k)];
    Input next = feedback.step;
    if (k > 0) next.noalias() += feedback.by_state * state_step;
    if (k > 0 && rate) next.noalias() += feedback.by_previous_input * step;
    step = next;
    state_step = advance<N>(problem.stages[as_index(k)], state_step, step);
    inputs[as_index(k)] += step;
    states_[as_index(k + 1)] += state_step;
  }
}

// G^-1 n for the bound's normal n: the linear-quadratic problem with the single linear term -n.
template <int N>
void BoxLqSolver<N>::respond(const BoxLqProblem<N>& problem, const Bound& bound, Response& response) {
  const bool rate = problem.rate_weight > 0.0;
  Vector3d by_state = Vector3d::Zero();
  Input by_previous = Input::Zero();
  if (!bound.on_input) by_state[bound.component] = -bound.sign;
  for (int k = bound.stage; k >= 0; --k) {
    const Feedback& feedback = feedback_[as_index(k)];
    Input gradient = problem.stages[as_index(k)].input_matrix.transpose() * by_state;
    if (rate) gradient += by_previous;
    if (bound.on_input && k == bound.stage) gradient[bound.component] -= bound.sign;
    response.inputs[as_index(k)] = -factors_[as_index(k)].solve(gradient);
    if (k == 0) break;
    by_state = transposed(problem.stages[as_index(k)], by_state);
    by_state.noalias() += feedback.by_state.transpose() * gradient;
    if (rate) by_previous.noalias() = feedback.by_previous_input.transpose() * gradient;
  }
  response.states[0].setZero();
  for (int k = 0; k < problem.steps; ++k) {
    Input& input = response.inputs[as_index(k)];
    if (k > bound.stage) input.setZero();
    if (k > 0) {
      input.noalias() += feedback_[as_index(k)].by_state * response.states[as_index(k)];
      if (rate)
        input.noalias() += feedback_[as_index(k)].by_previous_input * response.inputs[as_index(k - 1)];
    }
    response.states[as_index(k + 1)] =
        advance<N>(problem.stages[as_index(k)], response.states[as_index(k)], input);
  }
}

template <int N>
double BoxLqSolver<N>::shortfall(const BoxLqProblem<N>& problem, const InputSequence<N>& inputs,
                                 const Bound& bound) const {
  if (bound.on_input) {
    const double value = inputs[as_index(bound.stage)][bound.component];
    return bound.sign > 0.0 ? problem.input_lower[bound.component] - value
                            : value - problem.input_upper[bound.component];
  }
  const double value = states_[as_index(bound.stage + 1)][bound.component];
  return bound.sign > 0.0 ? problem.lower[bound.component] - value : value - problem.upper[bound.component];
}

template <int N>
double BoxLqSolver<N>::most_violated(const BoxLqProblem<N>& problem, const InputSequence<N>& inputs,
                                     Bound& worst) const {
  double most = kViolation;
  bool found = false;
  const bool soft = problem.slack_weight > 0.0;
  for (int k = 0; k < problem.steps; ++k) {
    for (int i = 0; i < std::max(N, 3); ++i) {
      for (const bool on_input : {true, false}) {
        if (on_input ? i >= N : (i >= 3 || !soft)) continue;
        const double value = on_input ? inputs[as_index(k)][i] : states_[as_index(k + 1)][i];
        const double below = (on_input ? problem.input_lower[i] : problem.lower[i]) - value;
        const double above = value - (on_input ? problem.input_upper[i] : problem.upper[i]);
        if (std::max(below, above) <= most) continue;
        const Bound candidate_bound{k, i, on_input, below > above ? 1.0 : -1.0};
        if (is_active(candidate_bound)) continue;
        most = std::max(below, above);
        worst = candidate_bound;
        found = true;
      }
    }
  }
  return found ? most : 0.0;
}

template <int N>
bool BoxLqSolver<N>::is_active(const Bound& bound) const {
  return std::find(active_.begin(), active_.begin() + active_count_, bound) !=
         active_.begin() + active_count_;
}

template <int N>
void BoxLqSolver<N>::move_along(const BoxLqProblem<N>& problem, InputSequence<N>& inputs,
                                const Response& response, double amount) {
  for (int k = 0; k < problem.steps; ++k) {
    inputs[as_index(k)] += amount * response.inputs[as_index(k)];
    states_[as_index(k + 1)] += amount * response.states[as_index(k + 1)];
  }
}

// Activates a bound whose response lies in the first free slot, and adds its row of the Schur matrix.
template <int N>
void BoxLqSolver<N>::append_active(const BoxLqProblem<N>& problem, const Bound& bound, double multiplier) {
  const std::size_t last = as_index(active_count_);
  active_[last] = bound;
  multipliers_[last] = multiplier;
  ++active_count_;
  const Response& response = responses_[as_index(order_[last])];
  for (std::size_t j = 0; j <= last; ++j) {
    const Bound& other = active_[j];
    const double value = other.on_input ? response.inputs[as_index(other.stage)][other.component]
                                        : response.states[as_index(other.stage + 1)][other.component];
    schur_[last][j] = other.sign * value;
  }
  schur_[last][last] += softness(problem, bound.on_input);
}

template <int N>
void BoxLqSolver<N>::drop_active(int position) {
  const int freed = order_[as_index(position)];
  for (int i = position; i + 1 < active_count_; ++i) {
    active_[as_index(i)] = active_[as_index(i + 1)];
    multipliers_[as_index(i)] = multipliers_[as_index(i + 1)];
    order_[as_index(i)] = order_[as_index(i + 1)];
    for (int j = 0; j <= i; ++j)
      schur_[as_index(i)][as_index(j)] = schur_[as_index(i + 1)][as_index(j < position ? j : j + 1)];
  }
  --active_count_;
  // The slot of the bound being activated, if any, follows the active ones.
  order_[as_index(active_count_)] = order_[as_index(active_count_ + 1)];
  order_[as_index(active_count_ + 1)] = freed;
}

// Cholesky factor of the Schur matrix, rows from `from` on. False when the matrix is not positive definite:
// active bounds that depend on each other to rounding.
template <int N>
bool BoxLqSolver<N>::factor_schur(int from) {
  for (int i = from; i < active_count_; ++i) {
    double* const row = schur_factor_[as_index(i)];
    for (int j = 0; j <= i; ++j) {
      double sum = schur_[as_index(i)][as_index(j)];
      for (int l = 0; l < j; ++l) sum -= row[as_index(l)] * schur_factor_[as_index(j)][as_index(l)];
      if (j < i) {
        row[as_index(j)] = sum / schur_factor_[as_index(j)][as_index(j)];
      } else {
        if (!(sum > 1e-13 * schur_[as_index(i)][as_index(i)])) return false;
        row[as_index(i)] = std::sqrt(sum);
      }
    }
  }
  return true;
}

template <int N>
void BoxLqSolver<N>::solve_schur(ActiveVector& vector) const {
  for (int i = 0; i < active_count_; ++i) {
    for (int j = 0; j < i; ++j)
      vector[as_index(i)] -= schur_factor_[as_index(i)][as_index(j)] * vector[as_index(j)];
    vector[as_index(i)] /= schur_factor_[as_index(i)][as_index(i)];
  }
  for (int i = active_count_ - 1; i >= 0; --i) {
    for (int j = i + 1; j < active_count_; ++j)
      vector[as_index(i)] -= schur_factor_[as_index(j)][as_index(i)] * vector[as_index(j)];
    vector[as_index(i)] /= schur_factor_[as_index(i)][as_index(i)];
  }
}

// Multipliers for the remembered bounds, those with the wrong sign dropped until none is left: a valid start
// of the dual method, whatever was remembered.
template <int N>
bool BoxLqSolver<N>::start_from_last_active_set(const BoxLqProblem<N>& problem, InputSequence<N>& inputs) {
  const int remembered = active_count_;
  active_count_ = 0;
  for (std::size_t i = 0; i < responses_.size(); ++i) order_[i] = static_cast<int>(i);
  for (int i = 0; i < remembered; ++i) {
    const Bound bound = active_[as_index(i)];
    if (bound.stage >= problem.steps || (!bound.on_input && !(problem.slack_weight > 0.0))) continue;
    respond(problem, bound, responses_[as_index(order_[as_index(active_count_)])]);
    append_active(problem, bound, 0.0);
    if (!factor_schur(active_count_ - 1)) --active_count_;
  }
  while (active_count_ > 0) {
    for (int i = 0; i < active_count_; ++i)
      multipliers_[as_index(i)] = shortfall(problem, inputs, active_[as_index(i)]);
    solve_schur(multipliers_);
    const auto least = std::min_element(multipliers_.begin(), multipliers_.begin() + active_count_);
    if (*least >= 0.0) break;
    const int position = static_cast<int>(least - multipliers_.begin());
    drop_active(position);
    if (!factor_schur(position)) return false;
  }
  for (int i = 0; i < active_count_; ++i)
    move_along(problem, inputs, responses_[as_index(order_[as_index(i)])], multipliers_[as_index(i)]);
  return true;
}

// Raises the multiplier of a violated bound until the bound holds, dropping active bounds whose multiplier
// would turn negative meanwhile.
template <int N>
bool BoxLqSolver<N>::take_up(const BoxLqProblem<N>& problem, InputSequence<N>& inputs, const Bound& bound,
                             double violation, int max_steps, int& steps) {
  if (as_index(active_count_ + 1) == responses_.size()) return false;
  respond(problem, bound, responses_[as_index(order_[as_index(active_count_)])]);
  const auto along = [&bound](const Response& response) {
    return bound.sign * (bound.on_input ? response.inputs[as_index(bound.stage)][bound.component]
                                        : response.states[as_index(bound.stage + 1)][bound.component]);
  };
  double multiplier = 0.0;
  while (true) {
    if (steps++ >= max_steps) return false;
    const Response& own = responses_[as_index(order_[as_index(active_count_)])];
    ActiveVector trade;  // what the active multipliers lose per unit of the new one
    double curvature = along(own) + softness(problem, bound.on_input);
    const double full_curvature = curvature;
    for (int i = 0; i < active_count_; ++i)
      trade[as_index(i)] = along(responses_[as_index(order_[as_index(i)])]);
    const ActiveVector coupling = trade;
    solve_schur(trade);
    for (int i = 0; i < active_count_; ++i) curvature -= coupling[as_index(i)] * trade[as_index(i)];

    double step =
        curvature > 1e-13 * full_curvature ? violation / curvature : std::numeric_limits<double>::infinity();
    int blocking = -1;
    for (int i = 0; i < active_count_; ++i) {
      if (trade[as_index(i)] <= 0.0 || multipliers_[as_index(i)] >= step * trade[as_index(i)]) continue;
      step = multipliers_[as_index(i)] / trade[as_index(i)];
      blocking = i;
    }
    if (!std::isfinite(step)) return false;

    multiplier += step;
    violation -= step * curvature;
    move_along(problem, inputs, own, step);
    for (int i = 0; i < active_count_; ++i) {
      multipliers_[as_index(i)] -= step * trade[as_index(i)];
      move_along(problem, inputs, responses_[as_index(order_[as_index(i)])], -step * trade[as_index(i)]);
    }
    if (blocking < 0) {
      append_active(problem, bound, multiplier);
      return factor_schur(active_count_ - 1);
    }
    drop_active(blocking);
    if (!factor_schur(blocking)) return false;
  }
}

template class BoxLqSolver<2>;
template class BoxLqSolver<3>;
template class BoxLqSolver<4>;
template class BoxLqSolver<5>;
template class BoxLqSolver<6>;

}  // namespace spf
