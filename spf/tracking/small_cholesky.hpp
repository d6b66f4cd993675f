// Cholesky factorisation of a small matrix of fixed size, unrolled by the compiler.
#pragma once

#include <Eigen/Core>

#include <cmath>

namespace spf {

/// Cholesky factor of a positive definite N x N matrix, with the inverses of its diagonal.
template <int N>
class SmallCholesky {
 public:
  using Vector = Eigen::Matrix<double, N, 1>;

  SmallCholesky() = default;
  explicit SmallCholesky(const Eigen::Matrix<double, N, N>& m) {
    for (int j = 0; j < N; ++j) {
      double pivot = m(j, j);
      for (int l = 0; l < j; ++l) pivot -= lower_(j, l) * lower_(j, l);
      inverse_diagonal_[j] = 1.0 / std::sqrt(pivot);
      for (int i = j + 1; i < N; ++i) {
        double sum = m(i, j);
        for (int l = 0; l < j; ++l) sum -= lower_(i, l) * lower_(j, l);
        lower_(i, j) = sum * inverse_diagonal_[j];
      }
    }
  }
  [[nodiscard]] Vector solve(const Vector& b) const {
    Vector x = b;
    for (int i = 0; i < N; ++i) {
      for (int j = 0; j < i; ++j) x[i] -= lower_(i, j) * x[j];
      x[i] *= inverse_diagonal_[i];
    }
    for (int i = N - 1; i >= 0; --i) {
      for (int j = i + 1; j < N; ++j) x[i] -= lower_(j, i) * x[j];
      x[i] *= inverse_diagonal_[i];
    }
    return x;
  }
  template <int Columns>
  [[nodiscard]] Eigen::Matrix<double, N, Columns> solve_columns(
      const Eigen::Matrix<double, N, Columns>& b) const {
    Eigen::Matrix<double, N, Columns> x;
    for (int column = 0; column < Columns; ++column) x.col(column) = solve(b.col(column));
    return x;
  }

 private:
  Vector inverse_diagonal_;
  Eigen::Matrix<double, N, N> lower_;  // below the diagonal
};

}  // namespace spf
