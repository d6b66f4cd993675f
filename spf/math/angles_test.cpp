#include "spf/math/angles.hpp"

#include <gtest/gtest.h>

#include "spf/math/random_stream.hpp"

namespace spf {
namespace {

TEST(Angles, WrapsIntoTheHalfOpenCircle) {
  EXPECT_EQ(wrap_angle(0.0), 0.0);
  EXPECT_EQ(wrap_angle(kPi), kPi);
  EXPECT_EQ(wrap_angle(-kPi), kPi);
  EXPECT_DOUBLE_EQ(wrap_angle(3.0 * kPi), kPi);
  EXPECT_DOUBLE_EQ(wrap_angle(-kPi - 0.25), kPi - 0.25);
  EXPECT_DOUBLE_EQ(wrap_angle(kPi + 0.25), -kPi + 0.25);
}

TEST(Angles, KeepsTheDirection) {
  RandomStream random{1};
  for (int i = 0; i < 10000; ++i) {
    SCOPED_TRACE(i);
    const double angle = random.uniform(-1000.0, 1000.0);
    const double wrapped = wrap_angle(angle);
    EXPECT_GT(wrapped, -kPi);
    EXPECT_LE(wrapped, kPi);
    // 160 turns of a circle known to 1e-16 of itself.
    EXPECT_NEAR(std::cos(wrapped), std::cos(angle), 1e-12);
    EXPECT_NEAR(std::sin(wrapped), std::sin(angle), 1e-12);
  }
}

TEST(Angles, DifferenceIsTheShortestTurn) {
  EXPECT_DOUBLE_EQ(angle_difference(0.1, -0.2), 0.1 + 0.2);
  EXPECT_NEAR(angle_difference(-3.0, 3.0), 2.0 * kPi - 6.0, 1e-15);
  EXPECT_NEAR(angle_difference(3.0, -3.0), 6.0 - 2.0 * kPi, 1e-15);
  RandomStream random{2};
  for (int i = 0; i < 1000; ++i) {
    const double from = random.uniform(-10.0, 10.0);
    const double to = random.uniform(-10.0, 10.0);
    const double turn = angle_difference(to, from);
    EXPECT_LE(std::fabs(turn), kPi);
    EXPECT_NEAR(wrap_angle(from + turn - to), 0.0, 1e-14);
  }
}

}  // namespace
}  // namespace spf
