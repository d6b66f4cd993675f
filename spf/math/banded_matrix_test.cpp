#include "spf/math/banded_matrix.hpp"

#include <gtest/gtest.h>

#include "spf/math/random_stream.hpp"
#include "spf/testing/allocation_guard.hpp"
#include "spf/testing/dense_oracle.hpp"

namespace spf {
namespace {

/// Fills band and dense matrix alike, with a dominant diagonal: safe without pivoting, condition below 10.
template <int Lower, int Upper>
Eigen::MatrixXd fill_at_random(BandedMatrix<Lower, Upper>& banded, int size, RandomStream& random) {
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(size, size);
  banded.reset(size);
  for (int i = 0; i < size; ++i)
    for (int j = std::max(0, i - Lower); j <= std::min(size - 1, i + Upper); ++j) {
      dense(i, j) = random.uniform(-1.0, 1.0) + (i == j ? 1.5 * (Lower + Upper) : 0.0);
      banded(i, j) = dense(i, j);
    }
  return dense;
}

template <int Lower, int Upper>
void expect_like_dense(std::uint64_t seed) {
  RandomStream random{seed};
  BandedMatrix<Lower, Upper> banded{40};
  for (const int size :
       {1, 2, 3, 7, 12, 13, 39, 40, 5}) {  // also down again: nothing of a larger one may remain
    SCOPED_TRACE(size);
    const Eigen::MatrixXd dense = fill_at_random(banded, size, random);
    Eigen::MatrixXd right(size, 2);
    for (int i = 0; i < size; ++i) right.row(i) = random.normal2().transpose();
    banded.factorize();
    EXPECT_TRUE(banded.regular());
    Eigen::MatrixXd solution = right;
    banded.solve_in_place(solution);
    EXPECT_LT((solution - solve_densely(dense, right)).norm(), 1e-13);
    Eigen::MatrixXd transposed = right;
    banded.solve_transposed_in_place(transposed);
    EXPECT_LT((transposed - solve_densely(dense.transpose(), right)).norm(), 1e-13);
  }
}

TEST(BandedMatrix, SolvesLikeADenseFactorisation) {
  expect_like_dense<6, 6>(1);
  expect_like_dense<1, 1>(2);
  expect_like_dense<3, 1>(3);
  expect_like_dense<2, 5>(4);
}

TEST(BandedMatrix, SaysWhenAPivotVanishes) {
  BandedMatrix<1, 1> banded{2};
  banded.reset(2);
  banded(0, 1) = 1.0;
  banded(1, 0) = 1.0;  // regular, but not without pivoting
  banded.factorize();
  EXPECT_FALSE(banded.regular());
  banded.reset(2);
  banded(0, 0) = 2.0;
  banded(1, 1) = 3.0;
  banded.factorize();
  EXPECT_TRUE(banded.regular());
}

TEST(BandedMatrix, AcceptsTheEmptySystem) {
  BandedMatrix<6, 6> banded{6};
  banded.reset(0);
  banded.factorize();
  Eigen::MatrixXd nothing(0, 2);
  banded.solve_in_place(nothing);
  EXPECT_TRUE(banded.regular());
}

TEST(BandedMatrix, DoesNotAllocateAfterConstruction) {
  RandomStream random{5};
  BandedMatrix<6, 6> banded{96};
  Eigen::MatrixXd right = Eigen::MatrixXd::Ones(96, 2);
  const AllocationGuard guard;
  banded.reset(96);
  for (int i = 0; i < 96; ++i) banded(i, i) = random.uniform(1.0, 2.0);
  banded.factorize();
  banded.solve_in_place(right);
  banded.solve_transposed_in_place(right);
  EXPECT_EQ(guard.allocations(), 0);
}

}  // namespace
}  // namespace spf
