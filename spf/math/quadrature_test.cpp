#include "spf/math/quadrature.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "spf/math/random_stream.hpp"

namespace spf {
namespace {

TEST(GaussLegendre, IsExactForPolynomialsOfDegree19) {
  RandomStream random{1};
  for (int degree = 0; degree <= 19; ++degree) {
    const double from = random.uniform(-1.0, 0.0);
    const double to = random.uniform(0.2, 1.2);
    const double value = gauss_legendre([&](double x) { return std::pow(x, degree); }, from, to);
    const double exact = (std::pow(to, degree + 1) - std::pow(from, degree + 1)) / (degree + 1);
    // Nodes and weights are rounded to 16 digits; the values are at most 1.2^19 = 32 over 2.2.
    EXPECT_NEAR(value, exact, 1e-13) << "degree " << degree;
  }
}

TEST(Quadrature, RefinesWhereTheFunctionBendsSharply) {
  // The speed of a path that misses a standstill by little: sqrt(x^2 + gap^2).
  for (const double gap : {0.1, 1e-2, 1e-3, 1e-4, 1e-6, 0.0}) {
    Quadrature quadrature{1e-10, 40, 1000};
    const double value = quadrature.integrate([&](double x) { return std::hypot(x, gap); }, 0.0, 1.0);
    const double logarithm = gap > 0.0 ? std::asinh(1.0 / gap) : 0.0;
    const double exact = 0.5 * (std::hypot(1.0, gap) + gap * gap * logarithm);
    // Each of some 15 levels may be wrong by the tolerance.
    EXPECT_NEAR(value, exact, 1.5e-9) << "gap " << gap;
  }
}

TEST(Quadrature, StaysWithinItsBudgetWhateverTheFunction) {
  constexpr int kMaxPanels = 50;
  constexpr int kCalls = 20;
  RandomStream random{7};
  const auto noise = [&](double) { return random.uniform(-1.0, 1.0); };
  const auto not_a_number = [](double) { return std::numeric_limits<double>::quiet_NaN(); };
  const auto jumps = [](double x) { return x < 1.0 / 3.0 ? 0.0 : 1.0; };
  const auto check = [&](auto&& function) {
    int evaluations = 0;
    Quadrature quadrature{0.0, 1000, kMaxPanels};
    const auto counted = [&](double x) {
      ++evaluations;
      return function(x);
    };
    for (int i = 0; i < kCalls; ++i) static_cast<void>(quadrature.integrate(counted, 0.0, 1.0));
    // A call that finds nothing left still evaluates its one panel.
    EXPECT_LE(evaluations, (kMaxPanels + kCalls) * Quadrature::kPanelEvaluations);
    EXPECT_GE(evaluations, kMaxPanels * Quadrature::kPanelEvaluations - 20);  // and makes use of it
  };
  check(noise);
  check(not_a_number);
  check(jumps);
}

TEST(Quadrature, HalvesNoDeeperThanItIsAllowed) {
  int evaluations = 0;
  Quadrature quadrature{0.0, 3, 1000};
  const double value = quadrature.integrate(
      [&](double x) {
        ++evaluations;
        return x < 1.0 / 3.0 ? 0.0 : 1.0;
      },
      0.0, 1.0);
  // 1 + 2 + 4 + 8 panels, were all of them halved; those away from the jump agree at once or by rounding.
  EXPECT_LE(evaluations, 15 * Quadrature::kPanelEvaluations);
  EXPECT_NEAR(value, 2.0 / 3.0, 1.0 / 8.0);  // wrong by no more than the panel with the jump
}

}  // namespace
}  // namespace spf
