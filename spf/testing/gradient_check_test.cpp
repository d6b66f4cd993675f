#include "spf/testing/gradient_check.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace spf {
namespace {

/// x^4 + exp(x y) + sin(y), with an error put into the second component on demand.
struct Smooth {
  double error = 0.0;
  double operator()(const Eigen::VectorXd& x, Eigen::VectorXd& gradient) const {
    const double e = std::exp(x[0] * x[1]);
    gradient[0] = 4.0 * x[0] * x[0] * x[0] + x[1] * e;
    gradient[1] = x[0] * e + std::cos(x[1]) + error;
    return x[0] * x[0] * x[0] * x[0] + e + std::sin(x[1]);
  }
};

TEST(GradientCheck, AcceptsARightGradient) {
  const GradientCheck check = check_gradient(Smooth{}, Eigen::Vector2d{0.7, -1.3});
  EXPECT_LT(check.relative_error, 1e-9);
}

TEST(GradientCheck, NamesTheWrongComponent) {
  const GradientCheck check = check_gradient(Smooth{1e-3}, Eigen::Vector2d{0.7, -1.3});
  EXPECT_GT(check.relative_error, 1e-4);
  EXPECT_EQ(check.worst, 1);
}

TEST(GradientCheck, AcceptsAnExactZero) {
  const auto zero = [](const Eigen::VectorXd&, Eigen::VectorXd& gradient) {
    gradient.setZero();
    return 5.0;
  };
  EXPECT_EQ(check_gradient(zero, Eigen::Vector3d{1.0, 2.0, 3.0}).relative_error, 0.0);
}

TEST(GradientCheck, SeesAMissingGradientOfALargeArgument) {
  const auto forgotten = [](const Eigen::VectorXd& x, Eigen::VectorXd& gradient) {
    gradient.setZero();
    return 1e-4 * x[0];
  };
  EXPECT_NEAR(check_gradient(forgotten, Eigen::VectorXd::Constant(1, 1e6)).relative_error, 1.0, 1e-6);
}

}  // namespace
}  // namespace spf
