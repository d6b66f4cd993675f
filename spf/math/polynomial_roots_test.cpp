#include "spf/math/polynomial_roots.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "spf/math/random_stream.hpp"

namespace spf {
namespace {

/// Ascending coefficients of the product of (x - root).
template <std::size_t Degree>
std::array<double, Degree + 1> from_roots(const std::array<double, Degree>& roots) {
  std::array<double, Degree + 1> coefficients{};
  coefficients[0] = 1.0;
  std::size_t degree = 0;
  for (const double root : roots) {
    ++degree;
    for (std::size_t k = degree; k > 0; --k) coefficients[k] = coefficients[k - 1] - root * coefficients[k];
    coefficients[0] *= -root;
  }
  return coefficients;
}

TEST(PolynomialRoots, EvaluatesValueAndSlope) {
  const ValueAndSlope at = evaluate_polynomial(std::array<double, 4>{1.0, -2.0, 0.0, 3.0}, 2.0);
  EXPECT_EQ(at.value, 21.0);
  EXPECT_EQ(at.slope, 34.0);
}

TEST(PolynomialRoots, FindsAllRootsInsideAndNoneOutside) {
  RandomStream random{1};
  for (int i = 0; i < 500; ++i) {
    SCOPED_TRACE(i);
    std::array<double, 6> planted{};  // spread out, else they are ill-conditioned: 0.3 apart at least
    double at = -1.5;
    for (double& root : planted) root = (at += random.uniform(0.3, 0.8));
    const std::array<double, 7> coefficients = from_roots(planted);
    std::vector<double> expected;
    for (const double root : planted)
      if (-0.5 <= root && root <= 1.2) expected.push_back(root);
    const RootList<7> found = polynomial_roots(coefficients, -0.5, 1.2);
    ASSERT_EQ(found.size(), expected.size());
    // Coefficients up to 1e2 rounded to 1e-14, over slopes of at least 0.3^5 = 2e-3.
    for (std::size_t k = 0; k < expected.size(); ++k) EXPECT_NEAR(found[k], expected[k], 1e-11);
  }
}

TEST(PolynomialRoots, FindsEverySignChangeOfRandomPolynomials) {
  RandomStream random{2};
  constexpr int kSamples = 20000;
  for (int i = 0; i < 200; ++i) {
    SCOPED_TRACE(i);
    std::array<double, 8> coefficients{};
    for (double& coefficient : coefficients) coefficient = random.normal();
    const RootList<8> found = polynomial_roots(coefficients, -1.0, 1.0);
    EXPECT_TRUE(std::is_sorted(found.begin(), found.end()));
    std::size_t changes = 0;
    double last = evaluate_polynomial(coefficients, -1.0).value;
    for (int s = 1; s <= kSamples; ++s) {
      const double x = -1.0 + 2.0 * s / kSamples;
      const double value = evaluate_polynomial(coefficients, x).value;
      if ((value < 0.0) != (last < 0.0)) {
        ++changes;
        const bool listed = std::any_of(found.begin(), found.end(), [&](double root) {
          return x - 2.0 / kSamples - 1e-12 <= root && root <= x + 1e-12;
        });
        EXPECT_TRUE(listed) << "sign change before " << x;
      }
      last = value;
    }
    EXPECT_GE(found.size(), changes);
    for (const double root : found) EXPECT_NEAR(evaluate_polynomial(coefficients, root).value, 0.0, 1e-13);
  }
}

TEST(PolynomialRoots, HandlesConstantsAndZero) {
  EXPECT_EQ(polynomial_roots(std::array<double, 1>{3.0}, 0.0, 1.0).size(), 0U);
  EXPECT_EQ(polynomial_roots(std::array<double, 4>{3.0, 0.0, 0.0, 0.0}, 0.0, 1.0).size(), 0U);
  const RootList<8> of_zero = polynomial_roots(std::array<double, 8>{}, 0.0, 1.0);
  for (const double root : of_zero) EXPECT_TRUE(0.0 <= root && root <= 1.0);
}

TEST(PolynomialRoots, FindsTripleRootsAndRootsAtTheEnds) {
  const RootList<4> triple = polynomial_roots(std::array<double, 4>{0.0, 0.0, 0.0, 1.0}, -1.0, 2.0);
  ASSERT_EQ(triple.size(), 1U);
  EXPECT_NEAR(triple[0], 0.0, 1e-15);
  const RootList<3> ends = polynomial_roots(std::array<double, 3>{0.0, -1.0, 1.0}, 0.0, 1.0);
  ASSERT_EQ(ends.size(), 2U);
  EXPECT_EQ(ends[0], 0.0);
  EXPECT_EQ(ends[1], 1.0);
}

}  // namespace
}  // namespace spf
