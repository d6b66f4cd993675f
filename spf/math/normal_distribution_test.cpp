#include "spf/math/normal_distribution.hpp"

#include <gtest/gtest.h>

namespace spf {
namespace {

// Tabulated to the digits given.
TEST(NormalDistribution, AgreesWithItsTable) {
  EXPECT_EQ(normal_tail(0.0), 0.5);
  EXPECT_NEAR(normal_tail(1.0), 0.15865525393145705, 1e-15);
  EXPECT_NEAR(normal_tail(1.959963984540054), 0.025, 1e-15);
  EXPECT_NEAR(normal_tail(-1.0), 0.84134474606854295, 1e-15);
  EXPECT_EQ(normal_within(0.0), 0.0);
  EXPECT_NEAR(normal_within(1.0), 0.68268949213708590, 1e-15);
  EXPECT_NEAR(normal_within(2.0), 0.95449973610364160, 1e-15);
}

// Where 1 - P would have lost every digit.
TEST(NormalDistribution, KeepsSmallTails) {
  EXPECT_NEAR(normal_tail(10.0) / 7.6198530241605261e-24, 1.0, 1e-12);
}

}  // namespace
}  // namespace spf
