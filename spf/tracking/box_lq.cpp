#include "spf/tracking/box_lq.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "spf/tracking/box_lq_stage.hpp"

namespace spf {
namespace {

using namespace box_lq;  // NOLINT: the arithmetic of the stages, of this solver alone

// Residual relative to the size of the gradient's parts, which are rounded to some 1e-14.
constexpr double kRelativeTolerance = 1e-11;
constexpr double kAbsoluteTolerance = 1e-10;
constexpr int kFallbackSteps = 40;

/// Makes an input step 0 that is held at its bound.
template <int N>
void take_out(int input, Eigen::Matrix<double, N, N>& curvature, Input<N>& gradient,
              Eigen::Matrix<double, N, 3>& by_state, Eigen::Matrix<double, N, N>& by_previous) {
  curvature.row(input).setZero();
  curvature.col(input).setZero();
  curvature(input, input) = 1.0;
  gradient[input] = 0.0;
  by_state.row(input).setZero();
  by_previous.row(input).setZero();
}

}  // namespace

template <int N>
Vector3d bound_violation(const BoxLqProblem<N>& problem, const Vector3d& state) {
  return (state - problem.upper).cwiseMax(0.0) - (problem.lower - state).cwiseMax(0.0);
}

template <int N>
double box_lq_cost(const BoxLqProblem<N>& problem, const StateSequence& states,
                   const InputSequence<N>& inputs) {
  double cost = 0.0;
  for (int k = 0; k < problem.steps; ++k) {
    const BoxLqStage<N>& stage = problem.stages[as_index(k)];
    const Vector3d& state = states[as_index(k + 1)];
    const Vector3d error = state - stage.reference;
    cost += error.dot(problem.state_weight.cwiseProduct(error));
    cost += problem.slack_weight * bound_violation(problem, state).squaredNorm();
    cost += problem.effort_weight * (inputs[as_index(k)] - stage.input_reference).squaredNorm();
    if (problem.rate_weight > 0.0) {
      const Input<N>& before = k > 0 ? inputs[as_index(k - 1)] : problem.previous_input;
      cost += problem.rate_weight * (inputs[as_index(k)] - before).squaredNorm();
    }
  }
  return cost;
}

template <int N>
double BoxLqSolver<N>::optimality_residual(const BoxLqProblem<N>& problem, const StateSequence& states,
                                           const InputSequence<N>& inputs) {
  compute_gradient(problem, states, inputs, problem.slack_weight);
  return residual(problem, inputs);
}

// The adjoint: gradient of the cost by every input, the states following from the inputs.
template <int N>
void BoxLqSolver<N>::compute_gradient(const BoxLqProblem<N>& problem, const StateSequence& states,
                                      const InputSequence<N>& inputs, double slack_weight) {
  gradient_scale_ = 0.0;
  Vector3d adjoint = Vector3d::Zero();
  for (int k = problem.steps - 1; k >= 0; --k) {
    const BoxLqStage<N>& stage = problem.stages[as_index(k)];
    const Vector3d& state = states[as_index(k + 1)];
    const Vector3d violation = bound_violation(problem, state);
    Vector3d& by_state = state_gradient_[as_index(k + 1)];
    by_state =
        2.0 * problem.state_weight.cwiseProduct(state - stage.reference) + 2.0 * slack_weight * violation;
    state_curvature_[as_index(k + 1)] = 2.0 * problem.state_weight;
    for (int i = 0; i < 3; ++i)
      if (violation[i] != 0.0) state_curvature_[as_index(k + 1)][i] += 2.0 * slack_weight;
    adjoint += by_state;  // now the derivative by z_{k+1}

    Input& gradient = gradient_[as_index(k)];
    gradient = stage.input_matrix.transpose() * adjoint;
    gradient_scale_ = std::max(gradient_scale_, adjoint.cwiseAbs().maxCoeff());
    gradient += 2.0 * problem.effort_weight * (inputs[as_index(k)] - stage.input_reference);
    if (problem.rate_weight > 0.0) {
      const Input& before = k > 0 ? inputs[as_index(k - 1)] : problem.previous_input;
      gradient += 2.0 * problem.rate_weight * (inputs[as_index(k)] - before);
      if (k + 1 < problem.steps)
        gradient -= 2.0 * problem.rate_weight * (inputs[as_index(k + 1)] - inputs[as_index(k)]);
    }
    adjoint = transposed(stage, adjoint);
  }
}

template <int N>
double BoxLqSolver<N>::residual(const BoxLqProblem<N>& problem, const InputSequence<N>& inputs) const {
  double largest = 0.0;
  for (int k = 0; k < problem.steps; ++k) {
    const Input moved =
        clipped<N>(inputs[as_index(k)] - gradient_[as_index(k)], problem) - inputs[as_index(k)];
    largest = std::max(largest, moved.cwiseAbs().maxCoeff());
  }
  return largest;
}

template <int N>
void BoxLqSolver<N>::hold_inputs_at_bounds(const BoxLqProblem<N>& problem, const InputSequence<N>& inputs) {
  constexpr double kInside = 1.0 - 1e-13;  // a step that ends on the limit may round to just inside
  for (int k = 0; k < problem.steps; ++k)
    for (int i = 0; i < N; ++i) {
      const double input = inputs[as_index(k)][i];
      const double gradient = gradient_[as_index(k)][i];
      held_[as_index(k)][static_cast<std::size_t>(i)] =
          (input >= kInside * problem.input_upper[i] && gradient < 0.0) ||
          (input <= kInside * problem.input_lower[i] && gradient > 0.0);
    }
}

// Of every input and every component of a state one bound at most is active.
template <int N>
BoxLqSolver<N>::BoxLqSolver(int most_steps)
    : responses_(as_index(std::min(kMaxActive, (N + 3) * most_steps) + 1)) {
  for (Response& response : responses_) {
    response.inputs.resize(as_index(most_steps));
    response.states.resize(as_index(most_steps + 1));
  }
}

// Newton step of the free inputs as a feedback law. The value function of the steps from the current iterate
// is a quadratic in the state's step and, with a rate weight, the previous input's step.
template <int N>
template <bool kRate>
void BoxLqSolver<N>::riccati_sweep(const BoxLqProblem<N>& problem, const InputSequence<N>& inputs) {
  using Square = Eigen::Matrix<double, N, N>;
  const double rate = problem.rate_weight;
  const double own_curvature = 2.0 * (problem.effort_weight + (kRate ? rate : 0.0));
  Matrix3d value_zz = state_curvature_[as_index(problem.steps)].asDiagonal();
  Vector3d value_z = state_gradient_[as_index(problem.steps)];
  Eigen::Matrix<double, 3, N> value_zv = Eigen::Matrix<double, 3, N>::Zero();
  Square value_vv = Square::Zero();
  Input value_v = Input::Zero();

  for (int k = problem.steps - 1; k >= 0; --k) {
    const BoxLqStage<N>& stage = problem.stages[as_index(k)];
    const Eigen::Matrix<double, 3, N>& b = stage.input_matrix;
    Feedback& feedback = feedback_[as_index(k)];
    Input change = Input::Zero();
    if constexpr (kRate)
      change = inputs[as_index(k)] - (k > 0 ? inputs[as_index(k - 1)] : problem.previous_input);

    Eigen::Matrix<double, N, 3> cross = b.transpose() * value_zz;  // d2 / du dz', z' the next state
    Square curvature = cross * b;
    curvature.diagonal().array() += own_curvature;
    Input gradient = 2.0 * problem.effort_weight * (inputs[as_index(k)] - stage.input_reference);
    gradient.noalias() += b.transpose() * value_z;
    if constexpr (kRate) {
      const Square mixed = b.transpose() * value_zv;
      curvature += mixed + mixed.transpose() + value_vv;
      cross += value_zv.transpose();
      gradient += 2.0 * rate * change + value_v;
    }
    Eigen::Matrix<double, N, 3> by_state = times_transition(cross, stage);
    Square by_previous = Square::Zero();
    if constexpr (kRate) by_previous.diagonal().setConstant(-2.0 * rate);

    for (int i = 0; i < N; ++i)
      if (held_[as_index(k)][static_cast<std::size_t>(i)])
        take_out<N>(i, curvature, gradient, by_state, by_previous);
    SmallCholesky<N>& factor = factors_[as_index(k)] = SmallCholesky<N>{curvature};
    feedback.step = -factor.solve(gradient);
    feedback.by_state.setZero();
    if (k > 0 || kRate) feedback.by_state = -factor.solve_columns(by_state);
    if constexpr (kRate) feedback.by_previous_input = -factor.solve_columns(by_previous);
    if (k == 0) return;

    value_zz = transition_times(stage, times_transition(value_zz, stage));
    value_zz.noalias() += by_state.transpose() * feedback.by_state;
    value_zz = (0.5 * (value_zz + value_zz.transpose())).eval();
    value_zz.diagonal() += state_curvature_[as_index(k)];
    value_z =
        (transposed(stage, value_z) + by_state.transpose() * feedback.step + state_gradient_[as_index(k)])
            .eval();
    if constexpr (kRate) {
      value_zv.noalias() = by_state.transpose() * feedback.by_previous_input;
      value_vv.noalias() = by_previous.transpose() * feedback.by_previous_input;
      value_vv.diagonal().array() += 2.0 * rate;
      value_v = -2.0 * rate * change + by_previous.transpose() * feedback.step;
    }
  }
}

// Fills the steps of inputs and states and returns the slope of the cost along them. clip_first: later inputs
// react to the clipping of earlier ones, which is the better guess. Otherwise the scaled Newton direction is
// projected on the box, which is a descent direction for a small enough scale (Bertsekas' projected Newton
// method).
template <int N>
double BoxLqSolver<N>::candidate(const BoxLqProblem<N>& problem, const InputSequence<N>& inputs, double scale,
                                 bool clip_first) {
  double slope = 0.0;
  Vector3d answered = Vector3d::Zero();  // the state step to which the feedback responds
  Input answered_input = Input::Zero();
  state_steps_[0].setZero();
  for (int k = 0; k < problem.steps; ++k) {
    const BoxLqStage<N>& stage = problem.stages[as_index(k)];
    const Feedback& feedback = feedback_[as_index(k)];
    const Input& input = inputs[as_index(k)];
    Input newton = feedback.step;
    newton.noalias() += feedback.by_state * answered;
    if (problem.rate_weight > 0.0) newton.noalias() += feedback.by_previous_input * answered_input;
    Input& step = input_steps_[as_index(k)];
    step = clipped<N>(input + scale * newton, problem) - input;
    state_steps_[as_index(k + 1)] = advance<N>(stage, state_steps_[as_index(k)], step);
    answered = clip_first ? state_steps_[as_index(k + 1)] : advance<N>(stage, answered, newton);
    answered_input = clip_first ? step : newton;
    slope += gradient_[as_index(k)].dot(step);
  }
  return slope;
}

// Leaves the result of the candidate steps in the trial sequences; true when the cost falls as its slope
// predicts.
template <int N>
bool BoxLqSolver<N>::improves(const BoxLqProblem<N>& problem, const InputSequence<N>& inputs, double cost,
                              double slope) {
  if (!(slope < 0.0)) return false;
  trial_states_[0] = states_[0];
  for (int k = 0; k < problem.steps; ++k) {
    trial_inputs_[as_index(k)] = clipped<N>(inputs[as_index(k)] + input_steps_[as_index(k)], problem);
    trial_states_[as_index(k + 1)] = states_[as_index(k + 1)] + state_steps_[as_index(k + 1)];
  }
  constexpr double kShare = 1e-3;  // of the predicted decrease; rounding of the cost is tolerated
  return box_lq_cost(problem, trial_states_, trial_inputs_) <= cost + kShare * slope + 1e-15 * cost;
}

template <int N>
BoxLqOutcome BoxLqSolver<N>::solve(const BoxLqProblem<N>& problem, InputSequence<N>& inputs, int max_steps) {
  assert(1 <= problem.steps && problem.steps <= kMaxHorizon);
  BoxLqOutcome outcome;
  dual_inputs_ = inputs;
  outcome.solved = solve_dual(problem, dual_inputs_, max_steps, outcome.active_set_steps);
  if (outcome.solved) {
    for (int k = 0; k < problem.steps; ++k)  // a bound is met to rounding
      inputs[as_index(k)] = clipped<N>(dual_inputs_[as_index(k)], problem);
    return outcome;
  }
  forget();
  outcome.fell_back = true;
  outcome.solved = refine(problem, inputs, kFallbackSteps);
  return outcome;
}

template <int N>
void BoxLqSolver<N>::roll_out(const BoxLqProblem<N>& problem, const InputSequence<N>& inputs) {
  states_[0] = problem.initial;
  for (int k = 0; k < problem.steps; ++k) {
    const BoxLqStage<N>& stage = problem.stages[as_index(k)];
    states_[as_index(k + 1)] = advance<N>(stage, states_[as_index(k)], inputs[as_index(k)]) + stage.offset;
  }
}

template <int N>
bool BoxLqSolver<N>::refine(const BoxLqProblem<N>& problem, InputSequence<N>& inputs, int max_steps) {
  for (int k = 0; k < problem.steps; ++k) inputs[as_index(k)] = clipped<N>(inputs[as_index(k)], problem);
  roll_out(problem, inputs);
  for (int steps = 0;; ++steps) {
    compute_gradient(problem, states_, inputs, problem.slack_weight);
    const double tolerance = kAbsoluteTolerance + kRelativeTolerance * gradient_scale_;
    if (residual(problem, inputs) <= tolerance) return true;
    if (steps == max_steps) return false;

    hold_inputs_at_bounds(problem, inputs);
    if (problem.rate_weight > 0.0)
      riccati_sweep<true>(problem, inputs);
    else
      riccati_sweep<false>(problem, inputs);

    const double cost = box_lq_cost(problem, states_, inputs);
    bool better = improves(problem, inputs, cost, candidate(problem, inputs, 1.0, true));
    for (double scale = 1.0; !better && scale > 1e-12; scale *= 0.5)
      better = improves(problem, inputs, cost, candidate(problem, inputs, scale, false));
    // No descent beyond rounding is left.
    if (!better) return residual(problem, inputs) <= 1e3 * tolerance;
    inputs = trial_inputs_;
    states_ = trial_states_;
  }
}

#define SPF_BOX_LQ(N)                                                                                    \
  template Vector3d bound_violation<N>(const BoxLqProblem<N>&, const Vector3d&);                         \
  template double box_lq_cost<N>(const BoxLqProblem<N>&, const StateSequence&, const InputSequence<N>&); \
  template class BoxLqSolver<N>;
SPF_BOX_LQ(2)
SPF_BOX_LQ(3)
SPF_BOX_LQ(4)
SPF_BOX_LQ(5)
SPF_BOX_LQ(6)
#undef SPF_BOX_LQ

}  // namespace spf
