#include "spf/testing/dense_oracle.hpp"

#include <Eigen/LU>
#include <Eigen/QR>

namespace spf {

Eigen::MatrixXd solve_densely(const Eigen::MatrixXd& matrix, const Eigen::MatrixXd& right) {
  return matrix.fullPivLu().solve(right);
}

Eigen::MatrixXd orthogonal_basis(const Eigen::MatrixXd& columns) {
  return Eigen::HouseholderQR<Eigen::MatrixXd>{columns}.householderQ();
}

}  // namespace spf
