// Cholesky factorisation of a 3x3 matrix, unrolled.
#pragma once

#include <Eigen/Core>

#include <cmath>

namespace spf {

/// Cholesky factor of a positive definite 3x3 matrix, with the inverses of its diagonal.
class Cholesky3 {
 public:
  Cholesky3() = default;
  explicit Cholesky3(const Eigen::Matrix3d& m) {
    inverse_diagonal_[0] = 1.0 / std::sqrt(m(0, 0));
    l10_ = m(1, 0) * inverse_diagonal_[0];
    l20_ = m(2, 0) * inverse_diagonal_[0];
    inverse_diagonal_[1] = 1.0 / std::sqrt(m(1, 1) - l10_ * l10_);
    l21_ = (m(2, 1) - l20_ * l10_) * inverse_diagonal_[1];
    inverse_diagonal_[2] = 1.0 / std::sqrt(m(2, 2) - l20_ * l20_ - l21_ * l21_);
  }
  [[nodiscard]] Eigen::Vector3d solve(const Eigen::Vector3d& b) const {
    const double y0 = b[0] * inverse_diagonal_[0];
    const double y1 = (b[1] - l10_ * y0) * inverse_diagonal_[1];
    const double y2 = (b[2] - l20_ * y0 - l21_ * y1) * inverse_diagonal_[2];
    const double x2 = y2 * inverse_diagonal_[2];
    const double x1 = (y1 - l21_ * x2) * inverse_diagonal_[1];
    return {(y0 - l10_ * x1 - l20_ * x2) * inverse_diagonal_[0], x1, x2};
  }
  [[nodiscard]] Eigen::Matrix3d solve(const Eigen::Matrix3d& b) const {
    Eigen::Matrix3d x;
    for (int column = 0; column < 3; ++column) x.col(column) = solve(Eigen::Vector3d{b.col(column)});
    return x;
  }

 private:
  Eigen::Vector3d inverse_diagonal_;
  double l10_, l20_, l21_;
};

}  // namespace spf
