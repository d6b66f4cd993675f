#include "experiments/statistics.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "spf/math/random_stream.hpp"

namespace spf {
namespace {

struct PublishedInterval {
  int successes, trials;
  double low, high;
};

// Newcombe, Statistics in Medicine 17 (1998) 857-872, Table I, method 3 (score, no correction); four printed
// digits.
TEST(WilsonInterval, MatchesPublishedValues) {
  for (const PublishedInterval& published : {PublishedInterval{81, 263, 0.2553, 0.3662},
                                             {15, 148, 0.0624, 0.1605},
                                             {0, 20, 0.0, 0.1611},
                                             {1, 29, 0.0061, 0.1718}}) {
    SCOPED_TRACE(published.trials);
    const Interval interval = wilson_interval(published.successes, published.trials);
    EXPECT_NEAR(interval.low, published.low, 0.5e-4);  // half of the last printed digit
    EXPECT_NEAR(interval.high, published.high, 0.5e-4);
  }
}

// The limits are the rates whose score test just fails to reject: |rate - p| = z sqrt(p (1 - p) / n).
TEST(WilsonInterval, LimitsSolveTheScoreEquation) {
  for (int trials = 1; trials <= 60; ++trials)
    for (int successes = 0; successes <= trials; ++successes) {
      const double rate = static_cast<double>(successes) / trials;
      const Interval interval = wilson_interval(successes, trials);
      for (const double limit : {interval.low, interval.high}) {
        if (limit == 0.0 || limit == 1.0) continue;
        const double spread = 1.959963984540054 * std::sqrt(limit * (1.0 - limit) / trials);
        EXPECT_NEAR(std::abs(rate - limit), spread, 1e-12) << successes << " of " << trials;  // rounding
      }
      EXPECT_LE(interval.low, rate);
      EXPECT_GE(interval.high, rate);
    }
}

TEST(WilsonInterval, KnowsNothingWithoutTrials) {
  EXPECT_EQ(wilson_interval(0, 0).low, 0.0);
  EXPECT_EQ(wilson_interval(0, 0).high, 1.0);
}

// By hand: 2 * (sum of binomials) / 2^n.
TEST(McnemarExact, MatchesHandComputedValues) {
  EXPECT_NEAR(mcnemar_exact(0, 5), 2.0 * 1.0 / 32.0, 1e-14);
  EXPECT_NEAR(mcnemar_exact(1, 9), 2.0 * 11.0 / 1024.0, 1e-14);
  EXPECT_NEAR(mcnemar_exact(2, 8), 2.0 * 56.0 / 1024.0, 1e-14);
  EXPECT_EQ(mcnemar_exact(0, 0), 1.0);
  EXPECT_EQ(mcnemar_exact(4, 4), 1.0);  // both tails overlap: capped
}

// Agresti, Categorical Data Analysis (approval of the prime minister): 150 and 86 changed sides; z = 4.17,
// whose two-sided normal tail is 3.1e-5. The exact p lies within a fifth of it at this n.
TEST(McnemarExact, AgreesWithTheNormalApproximationForManyPairs) {
  EXPECT_NEAR(mcnemar_exact(86, 150), 3.4e-5, 0.6e-5);
}

// Fagerland, Lydersen, Laake, "The McNemar test for binary matched-pairs data" (2013), on Bentur et al.'s
// airway responsiveness: 1 and 7 discordant pairs, exact conditional p = 0.070. The approval data above by
// R's exact2x2: p = 3.716e-05.
TEST(McnemarExact, MatchesPublishedValues) {
  EXPECT_NEAR(mcnemar_exact(1, 7), 0.0703, 5e-5);
  EXPECT_NEAR(mcnemar_exact(86, 150), 3.716e-05, 5e-9);
}

TEST(McnemarExact, DoesNotCareWhichMethodIsFirst) {
  for (int a = 0; a < 30; ++a)
    for (int b = 0; b < 30; ++b) EXPECT_EQ(mcnemar_exact(a, b), mcnemar_exact(b, a));
}

TEST(McnemarExact, SurvivesThousandsOfPairs) {
  EXPECT_EQ(mcnemar_exact(5000, 5000), 1.0);
  EXPECT_GT(mcnemar_exact(4900, 5100), 0.04);  // z = 2: 0.0455 by the normal tail
  EXPECT_LT(mcnemar_exact(4900, 5100), 0.05);
  EXPECT_GE(mcnemar_exact(0, 10000), 0.0);
}

TEST(Moments, AreThoseOfTextbooks) {
  const std::vector<double> values{2.0, 4.0, 4.0, 4.0, 5.0, 5.0, 7.0, 9.0};
  EXPECT_EQ(mean(values), 5.0);
  EXPECT_NEAR(standard_deviation(values), std::sqrt(32.0 / 7.0), 1e-15);
  EXPECT_EQ(minimum(values), 2.0);
  EXPECT_EQ(maximum(values), 9.0);
}

TEST(Moments, AreUnknownWithoutValues) {
  EXPECT_TRUE(std::isnan(mean({})));
  EXPECT_TRUE(std::isnan(standard_deviation({1.0})));
  EXPECT_TRUE(std::isnan(minimum({})));
  EXPECT_TRUE(std::isnan(maximum({})));
}

// Type 7 of Hyndman and Fan, as R's quantile(c(1, 2, 4, 8, 16), c(0, .1, .25, .5, .9, 1)).
TEST(Percentile, InterpolatesBetweenOrderStatistics) {
  const std::vector<double> values{16.0, 1.0, 8.0, 2.0, 4.0};
  EXPECT_EQ(percentile(values, 0.0), 1.0);
  EXPECT_NEAR(percentile(values, 0.1), 1.4, 1e-15);
  EXPECT_EQ(percentile(values, 0.25), 2.0);
  EXPECT_EQ(percentile(values, 0.5), 4.0);
  EXPECT_NEAR(percentile(values, 0.9), 12.8, 1e-14);
  EXPECT_EQ(percentile(values, 1.0), 16.0);
}

TEST(Percentile, LeavesTheRightShareBelow) {
  RandomStream random{11};
  std::vector<double> values;
  for (int i = 0; i < 1001; ++i) values.push_back(random.normal());
  for (const double share : {0.01, 0.37, 0.99}) {
    const double value = percentile(values, share);
    int below = 0;
    for (const double other : values) below += other < value ? 1 : 0;
    EXPECT_NEAR(below, share * 1000.0, 1.0);
  }
}

}  // namespace
}  // namespace spf
