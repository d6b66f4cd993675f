// The MPC's problem for Ipopt, an independent solver: multiple shooting, slacks for the soft bounds, exact
// derivatives by hand. For tests and benchmarks only, hence in a header: the library does not link Ipopt.
#pragma once

#include <IpIpoptApplication.hpp>
#include <IpTNLP.hpp>

#include <cmath>
#include <vector>

#include "spf/tracking/mpc.hpp"

namespace spf {

/// Variables: z_1..z_H, u_0..u_{H-1}, slacks s_1..s_H (two each, for x and y). Constraints: the dynamics (3
/// H), then z - s <= upper and z + s >= lower (4 H).
class MpcIpoptProblem : public Ipopt::TNLP {
 public:
  using Index = Ipopt::Index;
  using Number = Ipopt::Number;

  MpcIpoptProblem(const MpcParameters& parameters, const OmniKinematics& kinematics)
      : parameters_{parameters}, kinematics_{kinematics}, steps_{parameters.horizon} {}

  void set_problem(const MpcProblem& problem) { problem_ = problem; }
  [[nodiscard]] double cost() const { return cost_; }
  [[nodiscard]] const InputSequence<3>& wheel_speeds() const { return inputs_; }

  bool get_nlp_info(Index& n, Index& m, Index& nnz_jac, Index& nnz_hessian, IndexStyleEnum& style) override {
    n = 8 * steps_;
    m = 7 * steps_;
    nnz_jac = 0;
    each_jacobian([&](Index, Index, double) { ++nnz_jac; }, nullptr);
    nnz_hessian = 0;
    each_hessian([&](Index, Index, double) { ++nnz_hessian; }, nullptr, 1.0, nullptr);
    style = TNLP::C_STYLE;
    return true;
  }

  bool get_bounds_info(Index n, Number* x_l, Number* x_u, Index, Number* g_l, Number* g_u) override {
    for (Index i = 0; i < n; ++i) {
      x_l[i] = -2e19;
      x_u[i] = 2e19;
    }
    for (int k = 0; k < steps_; ++k) {
      for (int i = 0; i < 3; ++i) {
        x_l[input(k, i)] = -kinematics_.max_wheel_speed();
        x_u[input(k, i)] = kinematics_.max_wheel_speed();
        g_l[3 * k + i] = g_u[3 * k + i] = 0.0;
      }
      const double lower[2] = {parameters_.x_lower, parameters_.y_lower};
      const double upper[2] = {parameters_.x_upper, parameters_.y_upper};
      for (int i = 0; i < 2; ++i) {
        x_l[slack(k, i)] = 0.0;
        g_l[bound_row(k, i)] = -2e19;
        g_u[bound_row(k, i)] = upper[i];
        g_l[bound_row(k, i) + 1] = lower[i];
        g_u[bound_row(k, i) + 1] = 2e19;
      }
    }
    return true;
  }

  bool get_starting_point(Index, bool, Number* x, bool, Number*, Number*, Index, bool, Number*) override {
    for (int k = 0; k < steps_; ++k) {
      for (int i = 0; i < 3; ++i) {
        x[state(k + 1, i)] = problem_.reference.pose[static_cast<std::size_t>(k + 1)][i];
        x[input(k, i)] = problem_.reference.wheel_speeds[static_cast<std::size_t>(k)][i];
      }
      for (int i = 0; i < 2; ++i) x[slack(k, i)] = 0.0;
    }
    return true;
  }

  bool eval_f(Index, const Number* x, bool, Number& f) override {
    f = 0.0;
    for (int k = 0; k < steps_; ++k) {
      for (int i = 0; i < 3; ++i) {
        f += weight(i) * square(state_error(x, k, i)) +
             parameters_.effort_weight * square(input_error(x, k, i)) +
             parameters_.rate_weight * square(change(x, k, i));
      }
      for (int i = 0; i < 2; ++i) f += parameters_.slack_weight * square(x[slack(k, i)]);
    }
    return true;
  }

  bool eval_grad_f(Index n, const Number* x, bool, Number* gradient) override {
    for (Index i = 0; i < n; ++i) gradient[i] = 0.0;
    for (int k = 0; k < steps_; ++k) {
      for (int i = 0; i < 3; ++i) {
        gradient[state(k + 1, i)] += 2.0 * weight(i) * state_error(x, k, i);
        gradient[input(k, i)] += 2.0 * parameters_.effort_weight * input_error(x, k, i);
        gradient[input(k, i)] += 2.0 * parameters_.rate_weight * change(x, k, i);
        if (k > 0) gradient[input(k - 1, i)] -= 2.0 * parameters_.rate_weight * change(x, k, i);
      }
      for (int i = 0; i < 2; ++i) gradient[slack(k, i)] = 2.0 * parameters_.slack_weight * x[slack(k, i)];
    }
    return true;
  }

  bool eval_g(Index, const Number* x, bool, Index, Number* g) override {
    for (int k = 0; k < steps_; ++k) {
      const double theta = value(x, k, 2);
      const Eigen::Vector3d v = body_twist(x, k);
      const double c = std::cos(theta);
      const double s = std::sin(theta);
      const double twist[3] = {c * v[0] - s * v[1], s * v[0] + c * v[1], v[2]};
      for (int i = 0; i < 3; ++i)
        g[3 * k + i] =
            x[state(k + 1, i)] - value(x, k, i) - parameters_.dt * (twist[i] + problem_.disturbance[i]);
      for (int i = 0; i < 2; ++i) {
        g[bound_row(k, i)] = x[state(k + 1, i)] - x[slack(k, i)];
        g[bound_row(k, i) + 1] = x[state(k + 1, i)] + x[slack(k, i)];
      }
    }
    return true;
  }

  bool eval_jac_g(Index, const Number* x, bool, Index, Index, Index* rows, Index* columns,
                  Number* values) override {
    Index entry = 0;
    each_jacobian(
        [&](Index row, Index column, double derivative) {
          if (values == nullptr) {
            rows[entry] = row;
            columns[entry] = column;
          } else {
            values[entry] = derivative;
          }
          ++entry;
        },
        values == nullptr ? nullptr : x);
    return true;
  }

  bool eval_h(Index, const Number* x, bool, Number factor, Index, const Number* multipliers, bool, Index,
              Index* rows, Index* columns, Number* values) override {
    Index entry = 0;
    each_hessian(
        [&](Index row, Index column, double derivative) {
          if (values == nullptr) {
            rows[entry] = row;
            columns[entry] = column;
          } else {
            values[entry] = derivative;
          }
          ++entry;
        },
        values == nullptr ? nullptr : x, factor, multipliers);
    return true;
  }

  void finalize_solution(Ipopt::SolverReturn, Index, const Number* x, const Number*, const Number*, Index,
                         const Number*, const Number*, Number f, const Ipopt::IpoptData*,
                         Ipopt::IpoptCalculatedQuantities*) override {
    cost_ = f;
    for (int k = 0; k < steps_; ++k)
      for (int i = 0; i < 3; ++i) inputs_[static_cast<std::size_t>(k)][i] = x[input(k, i)];
  }

 private:
  static double square(double value) { return value * value; }
  static Index state(int k, int i) { return 3 * (k - 1) + i; }  // k >= 1
  [[nodiscard]] Index input(int k, int i) const { return 3 * steps_ + 3 * k + i; }
  [[nodiscard]] Index slack(int k, int i) const { return 6 * steps_ + 2 * k + i; }
  [[nodiscard]] Index bound_row(int k, int i) const { return 3 * steps_ + 4 * k + 2 * i; }
  [[nodiscard]] double weight(int i) const {
    return i < 2 ? parameters_.position_weight : parameters_.heading_weight;
  }
  [[nodiscard]] double value(const Number* x, int k, int i) const {
    return k == 0 ? problem_.initial_pose[i] : x[state(k, i)];
  }
  [[nodiscard]] double state_error(const Number* x, int k, int i) const {
    return x[state(k + 1, i)] - problem_.reference.pose[static_cast<std::size_t>(k + 1)][i];
  }
  [[nodiscard]] double input_error(const Number* x, int k, int i) const {
    return x[input(k, i)] - problem_.reference.wheel_speeds[static_cast<std::size_t>(k)][i];
  }
  [[nodiscard]] double change(const Number* x, int k, int i) const {
    return x[input(k, i)] - (k > 0 ? x[input(k - 1, i)] : problem_.previous_wheel_speeds[i]);
  }
  [[nodiscard]] Eigen::Vector3d body_twist(const Number* x, int k) const {
    return kinematics_.twist_body({x[input(k, 0)], x[input(k, 1)], x[input(k, 2)]});
  }

  /// Calls entry(row, column, derivative); x may be null when only the structure is wanted.
  template <class Entry>
  void each_jacobian(Entry&& entry, const Number* x) const {
    const double dt = parameters_.dt;
    const Eigen::Matrix3d& inverse = kinematics_.body_from_wheel();
    for (int k = 0; k < steps_; ++k) {
      const double theta = x != nullptr ? value(x, k, 2) : 0.0;
      const Eigen::Vector3d v = x != nullptr ? body_twist(x, k) : Eigen::Vector3d{0.0, 0.0, 0.0};
      const double c = std::cos(theta);
      const double s = std::sin(theta);
      for (int i = 0; i < 3; ++i) {
        entry(3 * k + i, state(k + 1, i), 1.0);
        if (k > 0) entry(3 * k + i, state(k, i), -1.0);
      }
      if (k > 0) {
        entry(3 * k, state(k, 2), dt * (s * v[0] + c * v[1]));
        entry(3 * k + 1, state(k, 2), -dt * (c * v[0] - s * v[1]));
      }
      for (int j = 0; j < 3; ++j) {
        entry(3 * k, input(k, j), -dt * (c * inverse(0, j) - s * inverse(1, j)));
        entry(3 * k + 1, input(k, j), -dt * (s * inverse(0, j) + c * inverse(1, j)));
        entry(3 * k + 2, input(k, j), -dt * inverse(2, j));
      }
      for (int i = 0; i < 2; ++i) {
        entry(bound_row(k, i), state(k + 1, i), 1.0);
        entry(bound_row(k, i), slack(k, i), -1.0);
        entry(bound_row(k, i) + 1, state(k + 1, i), 1.0);
        entry(bound_row(k, i) + 1, slack(k, i), 1.0);
      }
    }
  }

  /// Lower triangle of the Lagrangian's Hessian.
  template <class Entry>
  void each_hessian(Entry&& entry, const Number* x, double factor, const Number* multipliers) const {
    const double dt = parameters_.dt;
    const double rate = parameters_.rate_weight;
    const Eigen::Matrix3d& inverse = kinematics_.body_from_wheel();
    for (int k = 0; k < steps_; ++k) {
      for (int i = 0; i < 3; ++i) {
        entry(state(k + 1, i), state(k + 1, i), 2.0 * factor * weight(i));
        const double ends = k + 1 < steps_ ? 2.0 : 1.0;
        entry(input(k, i), input(k, i), 2.0 * factor * (parameters_.effort_weight + ends * rate));
        if (k > 0) entry(input(k, i), input(k - 1, i), -2.0 * factor * rate);
      }
      for (int i = 0; i < 2; ++i) entry(slack(k, i), slack(k, i), 2.0 * factor * parameters_.slack_weight);
      if (k == 0) continue;
      const double theta = x != nullptr ? value(x, k, 2) : 0.0;
      const Eigen::Vector3d v = x != nullptr ? body_twist(x, k) : Eigen::Vector3d{0.0, 0.0, 0.0};
      const double c = std::cos(theta);
      const double s = std::sin(theta);
      const double m0 = multipliers != nullptr ? multipliers[3 * k] : 0.0;
      const double m1 = multipliers != nullptr ? multipliers[3 * k + 1] : 0.0;
      entry(state(k, 2), state(k, 2), dt * (m0 * (c * v[0] - s * v[1]) + m1 * (s * v[0] + c * v[1])));
      for (int j = 0; j < 3; ++j)
        entry(input(k, j), state(k, 2),
              dt * (m0 * (s * inverse(0, j) + c * inverse(1, j)) -
                    m1 * (c * inverse(0, j) - s * inverse(1, j))));
    }
  }

  MpcParameters parameters_;
  OmniKinematics kinematics_;
  int steps_;
  MpcProblem problem_;
  double cost_ = 0.0;
  InputSequence<3> inputs_;
};

/// An application with tight tolerances and without output; null when it cannot be initialised.
inline Ipopt::SmartPtr<Ipopt::IpoptApplication> make_ipopt(double tolerance, bool check_derivatives = false) {
  Ipopt::SmartPtr<Ipopt::IpoptApplication> application = new Ipopt::IpoptApplication(false);
  application->Options()->SetNumericValue("tol", tolerance);
  application->Options()->SetNumericValue("bound_relax_factor", 0.0);
  application->Options()->SetIntegerValue("print_level", check_derivatives ? 1 : 0);
  application->Options()->SetStringValue("sb", "yes");
  if (check_derivatives) application->Options()->SetStringValue("derivative_test", "second-order");
  if (application->Initialize() != Ipopt::Solve_Succeeded) return nullptr;
  return application;
}

}  // namespace spf
