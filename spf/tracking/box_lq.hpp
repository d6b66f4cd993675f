// A finite-horizon linear-quadratic problem with hard bounds on the inputs and quadratically soft bounds on
// the states: one Gauss-Newton step of the MPC (eq. 19). Solved by a dual active set in range-space form: one
// Riccati factorisation without bounds, then one Riccati solve per bound that becomes active; a soft bound
// differs from a hard one by a term on the diagonal of the small Schur matrix. If that does not finish within
// its step limit, a projected Newton method takes over, each of whose iterates is feasible and no worse than
// the one before.
//
//   minimise   sum_{k=1..H} |z_k - reference_k|_Q^2 + slack_weight |violation of [lower, upper] by z_k|^2
//            + sum_{k=0..H-1} effort_weight |u_k - input_reference_k|^2 + rate_weight |u_k - u_{k-1}|^2
//   subject to z_{k+1} = A_k z_k + B_k u_k + c_k,  input_lower <= u_k <= input_upper, z_0 and u_{-1} given
//   (z_0 is never bounded).
//
// A_k is the identity but for the heading's column: z = (x, y, heading); u has N components, the inputs of
// the drive.
#pragma once

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <vector>

#include "spf/math/index.hpp"
#include "spf/tracking/reference_sampler.hpp"
#include "spf/tracking/small_cholesky.hpp"

namespace spf {

template <int N>
struct BoxLqStage {
  double x_by_heading = 0.0;  ///< A(0, 2)
  double y_by_heading = 0.0;  ///< A(1, 2)
  Eigen::Matrix<double, 3, N> input_matrix;
  Eigen::Vector3d offset;
  Eigen::Vector3d reference;                    ///< for z_{k+1}
  Eigen::Matrix<double, N, 1> input_reference;  ///< for u_k
};

template <int N>
struct BoxLqProblem {
  int steps = 0;  ///< H, 1..kMaxHorizon
  Eigen::Vector3d initial;
  Eigen::Matrix<double, N, 1> previous_input;
  Eigen::Vector3d state_weight;  ///< diagonal of Q, > 0
  double effort_weight = 0.0;
  double rate_weight = 0.0;
  double slack_weight = 0.0;
  Eigen::Matrix<double, N, 1> input_lower;
  Eigen::Matrix<double, N, 1> input_upper;
  Eigen::Vector3d lower;  ///< may be -infinity
  Eigen::Vector3d upper;  ///< may be +infinity
  std::array<BoxLqStage<N>, kMaxHorizon> stages;
};

template <int N>
using InputSequence = std::array<Eigen::Matrix<double, N, 1>, kMaxHorizon>;
using StateSequence = std::array<Eigen::Vector3d, kMaxHorizon + 1>;

/// Signed violation of the soft bounds, per component.
template <int N>
[[nodiscard]] Eigen::Vector3d bound_violation(const BoxLqProblem<N>& problem, const Eigen::Vector3d& state);

/// Cost of states and inputs, whatever model they obey.
template <int N>
[[nodiscard]] double box_lq_cost(const BoxLqProblem<N>& problem, const StateSequence& states,
                                 const InputSequence<N>& inputs);

struct BoxLqOutcome {
  bool solved = false;       ///< to rounding; else the inputs are feasible and the best found
  bool fell_back = false;    ///< the projected Newton method had to take over
  int active_set_steps = 0;  ///< bounds activated or dropped
};

/// Construct once, solve often: all memory is taken at once. Made for N = 2 to 6.
template <int N>
class BoxLqSolver {
 public:
  /// For problems of at most so many steps, 1..kMaxHorizon.
  explicit BoxLqSolver(int most_steps = kMaxHorizon);

  using Input = Eigen::Matrix<double, N, 1>;
  using Inputs = InputSequence<N>;
  using Problem = BoxLqProblem<N>;

  /// Replaces `inputs`, any initial guess, by the minimiser. The bounds that were active at the last minimum
  /// are tried first.
  BoxLqOutcome solve(const Problem& problem, Inputs& inputs, int max_steps);
  /// Drops the warm start (the last active bounds). It changes the work, not the minimum.
  void forget() { active_count_ = 0; }

  /// The projected Newton method alone: improves `inputs`, first clipped to the limit. True when at the
  /// minimum.
  bool refine(const Problem& problem, Inputs& inputs, int max_steps);

  /// Largest component of P(u - gradient) - u with P the projection on the input bounds: zero exactly at a
  /// minimiser. Where the stages linearise a nonlinear model at these states and inputs, it is that problem's
  /// residual too.
  double optimality_residual(const Problem& problem, const StateSequence& states, const Inputs& inputs);

 private:
  struct Feedback {
    Input step;
    Eigen::Matrix<double, N, 3> by_state;
    Eigen::Matrix<double, N, N> by_previous_input;
  };
  /// One side of one bound, as sign * value >= sign * bound. Inputs are those of step `stage`, states
  /// z_{stage + 1}.
  struct Bound {
    int stage = 0;
    int component = 0;
    bool on_input = true;
    double sign = 1.0;
    bool operator==(const Bound& other) const {
      return stage == other.stage && component == other.component && on_input == other.on_input &&
             sign == other.sign;
    }
  };
  /// Change of inputs and states by a unit multiplier of a bound.
  struct Response {
    std::vector<Input> inputs;
    std::vector<Eigen::Vector3d> states;
  };
  static constexpr int kMaxActive = 40;
  using ActiveVector = std::array<double, kMaxActive>;
  /// Rows of a symmetric or triangular matrix up to the diagonal.
  class LowerTriangle {
   public:
    double* operator[](std::size_t row) { return values_.data() + row * (row + 1) / 2; }
    const double* operator[](std::size_t row) const { return values_.data() + row * (row + 1) / 2; }

   private:
    std::array<double, static_cast<std::size_t>(kMaxActive*(kMaxActive + 1) / 2)> values_;
  };

  void roll_out(const Problem& problem, const Inputs& inputs);
  void compute_gradient(const Problem& problem, const StateSequence& states, const Inputs& inputs,
                        double slack_weight);
  [[nodiscard]] double residual(const Problem& problem, const Inputs& inputs) const;
  void hold_inputs_at_bounds(const Problem& problem, const Inputs& inputs);
  template <bool kRate>
  void riccati_sweep(const Problem& problem, const Inputs& inputs);
  double candidate(const Problem& problem, const Inputs& inputs, double scale, bool clip_first);
  bool improves(const Problem& problem, const Inputs& inputs, double cost, double slope);

  // The dual active set, in box_lq_dual.cpp.
  bool solve_dual(const Problem& problem, Inputs& inputs, int max_steps, int& steps);
  void minimise_without_bounds(const Problem& problem, Inputs& inputs);
  bool start_from_last_active_set(const Problem& problem, Inputs& inputs);
  bool take_up(const Problem& problem, Inputs& inputs, const Bound& bound, double violation, int max_steps,
               int& steps);
  [[nodiscard]] double most_violated(const Problem& problem, const Inputs& inputs, Bound& worst) const;
  void respond(const Problem& problem, const Bound& bound, Response& response);
  [[nodiscard]] double shortfall(const Problem& problem, const Inputs& inputs, const Bound& bound) const;
  void move_along(const Problem& problem, Inputs& inputs, const Response& response, double amount);
  [[nodiscard]] bool is_active(const Bound& bound) const;
  void append_active(const Problem& problem, const Bound& bound, double multiplier);
  void drop_active(int position);
  bool factor_schur(int from);
  void solve_schur(ActiveVector& vector) const;

  StateSequence states_;
  StateSequence state_steps_;
  Inputs input_steps_;
  Inputs gradient_;
  double gradient_scale_ = 0.0;
  std::array<Eigen::Vector3d, kMaxHorizon + 1> state_gradient_;   // of the cost of z_k alone
  std::array<Eigen::Vector3d, kMaxHorizon + 1> state_curvature_;  // its diagonal Hessian
  std::array<Feedback, kMaxHorizon> feedback_;
  std::array<SmallCholesky<N>, kMaxHorizon> factors_;  // of the curvature by each input
  std::array<std::array<bool, static_cast<std::size_t>(N)>, kMaxHorizon> held_;

  Inputs trial_inputs_;
  StateSequence trial_states_;
  Inputs dual_inputs_;
  int active_count_ = 0;
  std::array<Bound, kMaxActive> active_;
  ActiveVector multipliers_;
  // Responses are kept where they were computed; order_ says which belongs to which active bound.
  std::vector<Response> responses_;
  std::array<int, kMaxActive + 1> order_;
  LowerTriangle schur_;         // by active position
  LowerTriangle schur_factor_;  // its Cholesky factor
};

}  // namespace spf
