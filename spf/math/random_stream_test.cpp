#include "spf/math/random_stream.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace spf {
namespace {

TEST(RandomStream, DrawsThePublishedSplitmixSequence) {
  RandomStream random{1234567};
  EXPECT_EQ(random.bits(), 6457827717110365317ULL);
  EXPECT_EQ(random.bits(), 3203168211198807973ULL);
  EXPECT_EQ(random.bits(), 9817491932198370423ULL);
}

TEST(RandomStream, UniformIsTheTop53Bits) {
  RandomStream bits{42};
  RandomStream random{42};
  for (int i = 0; i < 1000; ++i) {
    const double expected = std::ldexp(static_cast<double>(bits.bits() >> 11U), -53);
    const double drawn = random.uniform();
    EXPECT_EQ(drawn, expected);
    EXPECT_GE(drawn, 0.0);
    EXPECT_LT(drawn, 1.0);
  }
}

TEST(RandomStream, UniformFillsItsInterval) {
  RandomStream random{3};
  constexpr int kDraws = 100000;
  double sum = 0.0;
  double squares = 0.0;
  for (int i = 0; i < kDraws; ++i) {
    const double drawn = random.uniform(-2.0, 4.0);
    EXPECT_TRUE(-2.0 <= drawn && drawn < 4.0);
    sum += drawn;
    squares += (drawn - 1.0) * (drawn - 1.0);
  }
  EXPECT_NEAR(sum / kDraws, 1.0, 4.0 * std::sqrt(3.0 / kDraws));      // 4 standard errors, variance 6^2 / 12
  EXPECT_NEAR(squares / kDraws, 3.0, 4.0 * std::sqrt(7.2 / kDraws));  // variance of the square: 6^4 / 180
}

TEST(RandomStream, NormalHasTheMomentsAndTailsOfANormal) {
  RandomStream random{4};
  constexpr int kDraws = 200000;
  double sum = 0.0;
  double squares = 0.0;
  int beyond_two = 0;
  for (int i = 0; i < kDraws; ++i) {
    const double drawn = random.normal();
    ASSERT_TRUE(std::isfinite(drawn));
    sum += drawn;
    squares += drawn * drawn;
    if (std::fabs(drawn) > 2.0) ++beyond_two;
  }
  // 4 standard errors each; 4.55 % of a normal lie beyond two standard deviations.
  EXPECT_NEAR(sum / kDraws, 0.0, 4.0 / std::sqrt(kDraws));
  EXPECT_NEAR(squares / kDraws, 1.0, 4.0 * std::sqrt(2.0 / kDraws));
  EXPECT_NEAR(static_cast<double>(beyond_two) / kDraws, 0.0455003, 4.0 * std::sqrt(0.0455 * 0.9545 / kDraws));
}

TEST(RandomStream, NormalFollowsItsFormulaAndDrawsXFirst) {
  RandomStream uniforms{9};
  RandomStream random{9};
  const double u1 = uniforms.uniform();
  const double u2 = uniforms.uniform();
  const double first = std::sqrt(-2.0 * std::log(1.0 - u1)) * std::cos(2.0 * 3.14159265358979323846 * u2);
  EXPECT_DOUBLE_EQ(random.normal(), first);

  RandomStream pair{9};
  RandomStream single{9};
  const Eigen::Vector2d drawn = pair.normal2();
  EXPECT_EQ(drawn.x(), single.normal());
  EXPECT_EQ(drawn.y(), single.normal());
}

TEST(RandomStream, MixIsTheSecondOutputOfTheCombinedSeed) {
  RandomStream expected{7ULL * 0x9E3779B97F4A7C15ULL + 11ULL};
  expected.bits();
  EXPECT_EQ(mix(7, 11), expected.bits());
}

TEST(RandomStream, MixSeparatesRolesAndIndices) {
  std::set<std::uint64_t> seeds;
  for (std::uint64_t seed = 0; seed < 20; ++seed)
    for (std::uint64_t role = 0; role < 20; ++role)
      for (std::uint64_t index = 0; index < 20; ++index) seeds.insert(mix(mix(seed, role), index));
  EXPECT_EQ(seeds.size(), 8000U);
  EXPECT_NE(mix(1, 2), mix(2, 1));
}

}  // namespace
}  // namespace spf
