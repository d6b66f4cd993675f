// The MPC's problem for Ipopt, an independent solver: multiple shooting, slacks for the soft bounds, exact
// derivatives by hand. For tests and benchmarks only, hence in a header: the library does not link Ipopt.
#pragma once

#include <IpIpoptApplication.hpp>
#include <IpTNLP.hpp>

#include <cmath>
#include <utility>
#include <vector>

#include "spf/tracking/mpc.hpp"

namespace spf {

/// Variables: z_1..z_H, u_0..u_{H-1}, slacks s_1..s_H (two each, for x and y). Constraints: the dynamics (3
/// H), then z - s <= upper and z + s >= lower (4 H).
class MpcIpoptProblem : public Ipopt::TNLP {
 public:
  using Index = Ipopt::Index;
  using Number = Ipopt::Number;

  MpcIpoptProblem(const MpcParameters& parameters, const Drive& drive)
      : parameters_{parameters}, drive_{drive}, steps_{parameters.horizon}, inputs_count_{drive.inputs()} {}

  void set_problem(const MpcProblem& problem) { problem_ = problem; }
  [[nodiscard]] double cost() const { return cost_; }
  [[nodiscard]] const DriveInputs& wheel_speeds() const { return inputs_; }

  bool get_nlp_info(Index& n, Index& m, Index& nnz_jac, Index& nnz_hessian, IndexStyleEnum& style) override {
    n = (5 + inputs_count_) * steps_;
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
      for (int i = 0; i < inputs_count_; ++i) {
        x_l[input(k, i)] = drive_.lower()[i];
        x_u[input(k, i)] = drive_.upper()[i];
      }
      for (int i = 0; i < 3; ++i) g_l[3 * k + i] = g_u[3 * k + i] = 0.0;
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
      for (int i = 0; i < 3; ++i)
        x[state(k + 1, i)] = problem_.reference.pose[static_cast<std::size_t>(k + 1)][i];
      for (int i = 0; i < inputs_count_; ++i)
        x[input(k, i)] = problem_.reference.wheel_speeds[static_cast<std::size_t>(k)][i];
      for (int i = 0; i < 2; ++i) x[slack(k, i)] = 0.0;
    }
    return true;
  }

  bool eval_f(Index, const Number* x, bool, Number& f) override {
    f = 0.0;
    for (int k = 0; k < steps_; ++k) {
      for (int i = 0; i < 3; ++i) f += weight(i) * square(state_error(x, k, i));
      for (int i = 0; i < inputs_count_; ++i) {
        f += parameters_.effort_weight * square(input_error(x, k, i)) +
             parameters_.rate_weight * square(change(x, k, i));
      }
      for (int i = 0; i < 2; ++i) f += parameters_.slack_weight * square(x[slack(k, i)]);
    }
    return true;
  }

  bool eval_grad_f(Index n, const Number* x, bool, Number* gradient) override {
    for (Index i = 0; i < n; ++i) gradient[i] = 0.0;
    for (int k = 0; k < steps_; ++k) {
      for (int i = 0; i < 3; ++i) gradient[state(k + 1, i)] += 2.0 * weight(i) * state_error(x, k, i);
      for (int i = 0; i < inputs_count_; ++i) {
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
    for (int k = 0; k < steps_; ++k) {
      DriveInput& inputs = inputs_[static_cast<std::size_t>(k)];
      inputs.resize(inputs_count_);
      for (int i = 0; i < inputs_count_; ++i) inputs[i] = x[input(k, i)];
    }
  }

 private:
  static double square(double value) { return value * value; }
  static Index state(int k, int i) { return 3 * (k - 1) + i; }  // k >= 1
  [[nodiscard]] Index input(int k, int i) const { return 3 * steps_ + inputs_count_ * k + i; }
  [[nodiscard]] Index slack(int k, int i) const { return (3 + inputs_count_) * steps_ + 2 * k + i; }
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
  [[nodiscard]] DriveInput inputs_of(const Number* x, int k) const {
    return x != nullptr ? DriveInput{Eigen::Map<const DriveInput>(x + input(k, 0), inputs_count_)}
                        : drive_.standstill();
  }
  [[nodiscard]] Eigen::Vector3d body_twist(const Number* x, int k) const {
    return drive_.twist_body(inputs_of(x, k));
  }
  /// Second derivatives of a car's yaw rate, v tan(angle) / wheel base, by speed and angle, and by angle
  /// twice.
  [[nodiscard]] std::pair<double, double> bending(const DriveInput& input) const {
    const double by_angle = drive_.jacobian(input)(2, 1);
    const double by_both = drive_.jacobian(Eigen::Vector2d{1.0, input[1]})(2, 1);
    return {by_both, 2.0 * std::tan(input[1]) * by_angle};
  }

  /// Calls entry(row, column, derivative); x may be null when only the structure is wanted.
  template <class Entry>
  void each_jacobian(Entry&& entry, const Number* x) const {
    const double dt = parameters_.dt;
    for (int k = 0; k < steps_; ++k) {
      const DriveJacobian by_input = drive_.jacobian(inputs_of(x, k));
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
      for (int j = 0; j < inputs_count_; ++j) {
        entry(3 * k, input(k, j), -dt * (c * by_input(0, j) - s * by_input(1, j)));
        entry(3 * k + 1, input(k, j), -dt * (s * by_input(0, j) + c * by_input(1, j)));
        entry(3 * k + 2, input(k, j), -dt * by_input(2, j));
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
    for (int k = 0; k < steps_; ++k) {
      for (int i = 0; i < 3; ++i) entry(state(k + 1, i), state(k + 1, i), 2.0 * factor * weight(i));
      for (int i = 0; i < inputs_count_; ++i) {
        const double ends = k + 1 < steps_ ? 2.0 : 1.0;
        entry(input(k, i), input(k, i), 2.0 * factor * (parameters_.effort_weight + ends * rate));
        if (k > 0) entry(input(k, i), input(k - 1, i), -2.0 * factor * rate);
      }
      for (int i = 0; i < 2; ++i) entry(slack(k, i), slack(k, i), 2.0 * factor * parameters_.slack_weight);
      if (drive_.type() == DriveType::car) {
        const auto [by_both, by_angle_twice] = bending(inputs_of(x, k));
        const double m2 = multipliers != nullptr ? multipliers[3 * k + 2] : 0.0;
        entry(input(k, 1), input(k, 0), -dt * m2 * by_both);
        entry(input(k, 1), input(k, 1), -dt * m2 * by_angle_twice);
      }
      if (k == 0) continue;
      const DriveJacobian by_input = drive_.jacobian(inputs_of(x, k));
      const double theta = x != nullptr ? value(x, k, 2) : 0.0;
      const Eigen::Vector3d v = x != nullptr ? body_twist(x, k) : Eigen::Vector3d{0.0, 0.0, 0.0};
      const double c = std::cos(theta);
      const double s = std::sin(theta);
      const double m0 = multipliers != nullptr ? multipliers[3 * k] : 0.0;
      const double m1 = multipliers != nullptr ? multipliers[3 * k + 1] : 0.0;
      entry(state(k, 2), state(k, 2), dt * (m0 * (c * v[0] - s * v[1]) + m1 * (s * v[0] + c * v[1])));
      for (int j = 0; j < inputs_count_; ++j)
        entry(input(k, j), state(k, 2),
              dt * (m0 * (s * by_input(0, j) + c * by_input(1, j)) -
                    m1 * (c * by_input(0, j) - s * by_input(1, j))));
    }
  }

  MpcParameters parameters_;
  Drive drive_;
  int steps_;
  int inputs_count_;
  MpcProblem problem_;
  double cost_ = 0.0;
  DriveInputs inputs_;
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
