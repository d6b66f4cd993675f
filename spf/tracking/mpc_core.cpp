#include "spf/tracking/mpc_core.hpp"

#include <algorithm>
#include <cmath>

#include "spf/math/index.hpp"

namespace spf {
namespace {

using Eigen::Vector3d;

bool usable(const MpcProblem& problem, int horizon, int inputs) {
  if (problem.reference.steps != horizon) return false;
  bool finite = problem.previous_wheel_speeds.size() == inputs && problem.initial_pose.allFinite() &&
                problem.disturbance.allFinite() && problem.previous_wheel_speeds.allFinite();
  for (int k = 0; k <= horizon; ++k) {
    finite = finite && problem.reference.pose[as_index(k)].allFinite();
    if (k < horizon)
      finite = finite && problem.reference.wheel_speeds[as_index(k)].size() == inputs &&
               problem.reference.wheel_speeds[as_index(k)].allFinite();
  }
  return finite;
}

}  // namespace

template <int N>
MpcCore<N>::MpcCore(const MpcParameters& parameters, const Drive& drive)
    : parameters_{parameters},
      drive_{drive},
      linear_{drive.type() != DriveType::car},
      body_from_input_{drive.jacobian(drive.standstill())},
      solver_{parameters.horizon} {
  constexpr double kUnbounded = 1e30;
  lq_.steps = parameters_.horizon;
  lq_.state_weight = {parameters_.position_weight, parameters_.position_weight, parameters_.heading_weight};
  lq_.effort_weight = parameters_.effort_weight;
  lq_.rate_weight = parameters_.rate_weight;
  lq_.slack_weight = parameters_.slack_weight;
  lq_.input_lower = drive_.lower();
  lq_.input_upper = drive_.upper();
  lq_.lower = {parameters_.x_lower, parameters_.y_lower, -kUnbounded};
  lq_.upper = {parameters_.x_upper, parameters_.y_upper, kUnbounded};
}

template <int N>
const MpcResult& MpcCore<N>::solve(const MpcProblem& problem) {
  if (!usable(problem, parameters_.horizon, N)) {
    result_ = MpcResult{};
    result_.wheel_speeds.fill(drive_.standstill());
    result_.pose.fill(problem.initial_pose);
    forget();
    return result_;
  }
  set_up(problem);

  // 1. About the reference. The heading of z_0 is the measured one, so that the first command has no
  //    linearisation error.
  for (int k = 0; k < lq_.steps; ++k) trial_inputs_[as_index(k)] = lq_.stages[as_index(k)].input_reference;
  inputs_ = trial_inputs_;
  trial_states_ = problem.reference.pose;
  trial_states_[0] = problem.initial_pose;
  linearise(problem, trial_states_, inputs_);
  BoxLqOutcome outcome = solver_.solve(lq_, trial_inputs_, parameters_.active_set_steps);
  bool settled = outcome.solved;
  result_.active_set_steps = outcome.active_set_steps;
  result_.fell_back = outcome.fell_back;
  result_.iterations = 1;
  inputs_ = trial_inputs_;
  double cost = roll_out(problem, inputs_, result_.pose);
  result_.status = MpcStatus::iteration_limit;

  // 2. About the last solution; the best one counts.
  best_inputs_ = inputs_;
  double best_cost = cost;
  while (result_.iterations < parameters_.iterations) {
    ++result_.iterations;
    linearise(problem, result_.pose, inputs_);
    trial_inputs_ = inputs_;
    outcome = solver_.solve(lq_, trial_inputs_, parameters_.active_set_steps);
    settled = settled && outcome.solved;
    result_.active_set_steps += outcome.active_set_steps;
    result_.fell_back = result_.fell_back || outcome.fell_back;
    cost = move_towards_trial(problem, cost);
    if (cost <= best_cost + 1e-12 * (1.0 + best_cost)) {  // of two equals, the later
      best_cost = cost;
      best_inputs_ = inputs_;
    }
    if (result_.last_change <= parameters_.tolerance) {
      result_.status = MpcStatus::converged;
      break;
    }
  }
  if (cost > best_cost + 1e-12 * (1.0 + best_cost)) {
    inputs_ = best_inputs_;
    cost = roll_out(problem, best_inputs_, result_.pose);
  }
  if (!settled) result_.status = MpcStatus::step_limit;
  return finish(problem, cost);
}

template <int N>
void MpcCore<N>::set_up(const MpcProblem& problem) {
  lq_.initial = problem.initial_pose;
  lq_.previous_input = problem.previous_wheel_speeds;
  for (int k = 0; k < lq_.steps; ++k) {
    lq_.stages[as_index(k)].reference = problem.reference.pose[as_index(k + 1)];
    lq_.stages[as_index(k)].input_reference = problem.reference.wheel_speeds[as_index(k)];
  }
}

// z' = z + dt (A(heading) b(u) + d), to first order about a heading and u. With wheels b is linear, so that
// only the heading enters the nonlinearity, and its own row is linear: the predicted headings are exact.
template <int N>
void MpcCore<N>::linearise(const MpcProblem& problem, const StateSequence& about,
                           const InputSequence<N>& inputs) {
  const double dt = parameters_.dt;
  for (int k = 0; k < lq_.steps; ++k) {
    BoxLqStage<N>& stage = lq_.stages[as_index(k)];
    const double heading = about[as_index(k)].z();
    const Eigen::Matrix3d rotation = world_from_body(heading);
    stage.input_matrix.noalias() = rotation * jacobian(inputs[as_index(k)]);
    stage.input_matrix *= dt;
    Vector3d moved = stage.input_matrix * inputs[as_index(k)];
    Vector3d beyond = Vector3d::Zero();  // the first order: of inputs that the motion is not linear in
    if (!linear_) {
      const Vector3d exact = dt * (rotation * twist_body(inputs[as_index(k)]));
      beyond = exact - moved;
      moved = exact;
    }
    stage.x_by_heading = -moved.y();
    stage.y_by_heading = moved.x();
    stage.offset = dt * problem.disturbance;
    if (!linear_) stage.offset += beyond;
    stage.offset.x() -= stage.x_by_heading * heading;
    stage.offset.y() -= stage.y_by_heading * heading;
  }
}

template <int N>
double MpcCore<N>::roll_out(const MpcProblem& problem, const InputSequence<N>& inputs,
                            StateSequence& states) const {
  states[0] = problem.initial_pose;
  for (int k = 0; k < lq_.steps; ++k) {
    const Vector3d& state = states[as_index(k)];
    states[as_index(k + 1)] =
        state +
        parameters_.dt * (twist_in_world(twist_body(inputs[as_index(k)]), state.z()) + problem.disturbance);
  }
  return box_lq_cost(lq_, states, inputs);
}

// Line search from the last solution towards the trial inputs on the nonlinear cost. Full steps converge fast
// while errors are moderate; far from the reference they oscillate, so the lowest point of the parabola
// through three costs is tried too. The input bounds are convex, hence every point between is feasible.
template <int N>
double MpcCore<N>::move_towards_trial(const MpcProblem& problem, double cost) {
  constexpr double kSmallChange = 1e-3;  // [m/s] below which full steps are safe
  constexpr int kHalvings = 3;
  double change = 0.0;
  for (int k = 0; k < lq_.steps; ++k) {
    input_steps_[as_index(k)] = trial_inputs_[as_index(k)] - inputs_[as_index(k)];
    change = std::max(change, input_steps_[as_index(k)].cwiseAbs().maxCoeff());
  }
  double fraction = 1.0;
  double trial_cost = try_fraction(problem, fraction);
  if (change > kSmallChange) {
    const double half_cost = try_fraction(problem, 0.5);
    // cost + slope t + curvature t^2
    const double curvature = 2.0 * (cost + trial_cost - 2.0 * half_cost);
    const double slope = trial_cost - cost - curvature;
    const double lowest = curvature > 0.0 ? std::clamp(-0.5 * slope / curvature, 0.1, 1.0) : 1.0;
    const double lowest_cost = lowest < 0.9 ? try_fraction(problem, lowest) : trial_cost;
    if (lowest_cost < trial_cost) fraction = lowest;
    trial_cost = try_fraction(problem, fraction);
  }
  // Near the optimum costs agree to rounding, and the full step is taken.
  const double acceptable = cost + 1e-12 * (1.0 + cost);
  for (int i = 0; i < kHalvings && trial_cost > acceptable; ++i) {
    fraction *= 0.5;
    trial_cost = try_fraction(problem, fraction);
  }
  // Along a stiff wall every shorter step may cost more as well, since the wall is curved for the linear
  // model. The full step makes progress; solve() remembers the best.
  if (trial_cost > acceptable) {
    fraction = 1.0;
    trial_cost = try_fraction(problem, fraction);
  }
  result_.last_change = fraction * change;
  std::swap(inputs_, trial_inputs_);
  std::swap(result_.pose, trial_states_);
  return trial_cost;
}

template <int N>
double MpcCore<N>::try_fraction(const MpcProblem& problem, double fraction) {
  for (int k = 0; k < lq_.steps; ++k) {
    const Input input = inputs_[as_index(k)] + fraction * input_steps_[as_index(k)];
    trial_inputs_[as_index(k)] =
        input.cwiseMax(lq_.input_lower).cwiseMin(lq_.input_upper);  // against rounding
  }
  return roll_out(problem, trial_inputs_, trial_states_);
}

template <int N>
const MpcResult& MpcCore<N>::finish(const MpcProblem& problem, double cost) {
  result_.cost = cost;
  linearise(problem, result_.pose, inputs_);
  result_.optimality_residual = solver_.optimality_residual(lq_, result_.pose, inputs_);
  result_.largest_violation = 0.0;
  for (int k = 1; k <= lq_.steps; ++k)
    result_.largest_violation = std::max(
        result_.largest_violation, bound_violation(lq_, result_.pose[as_index(k)]).cwiseAbs().maxCoeff());
  for (int k = 0; k < lq_.steps; ++k) result_.wheel_speeds[as_index(k)] = inputs_[as_index(k)];
  return result_;
}

template class MpcCore<2>;
template class MpcCore<3>;
template class MpcCore<4>;
template class MpcCore<5>;
template class MpcCore<6>;

}  // namespace spf
