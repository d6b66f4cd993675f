#include "spf/testing/dense_oracle.hpp"

#include <gtest/gtest.h>

namespace spf {
namespace {

TEST(DenseOracle, SolvesWhatNeedsPivoting) {
  Eigen::MatrixXd matrix(3, 3);
  matrix << 0.0, 2.0, 1.0, 1.0, 0.0, 0.0, 3.0, 0.0, 4.0;
  Eigen::MatrixXd expected(3, 2);
  expected << 1.0, -2.0, 0.5, 3.0, -1.0, 0.25;
  EXPECT_LT((solve_densely(matrix, matrix * expected) - expected).norm(), 1e-14);  // a few roundings of 1e-16
}

TEST(DenseOracle, GivesAnOrthogonalBasisOfTheSameColumns) {
  Eigen::MatrixXd columns(3, 3);
  columns << 1.0, 2.0, 0.0, 0.0, 1.0, -1.0, 2.0, 0.0, 1.0;
  const Eigen::MatrixXd basis = orthogonal_basis(columns);
  EXPECT_LT((basis.transpose() * basis - Eigen::MatrixXd::Identity(3, 3)).norm(), 1e-14);
  // The first k columns span the same space: what is left over below the diagonal vanishes.
  const Eigen::MatrixXd triangle = basis.transpose() * columns;
  EXPECT_LT(Eigen::MatrixXd{triangle.triangularView<Eigen::StrictlyLower>()}.norm(), 1e-14);
}

}  // namespace
}  // namespace spf
