#include "experiments/duration_histogram.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "spf/math/random_stream.hpp"

namespace spf {
namespace {

// Durations from nanoseconds to seconds; the oracle sorts them.
TEST(DurationHistogram, KnowsPercentilesToOnePercent) {
  RandomStream random{3};
  DurationHistogram histogram;
  std::vector<double> values;
  for (int i = 0; i < 5000; ++i) {
    values.push_back(std::exp(random.uniform(std::log(2e-9), std::log(5.0))));
    histogram.add(values.back());
  }
  std::sort(values.begin(), values.end());
  for (const double share : {0.001, 0.25, 0.5, 0.99, 1.0}) {
    const double expected = values[static_cast<std::size_t>(std::ceil(share * 5000.0)) - 1];
    EXPECT_NEAR(histogram.percentile(share) / expected, 1.0, 0.0101)
        << share;  // half a bucket: sqrt(1.02) - 1
  }
  EXPECT_EQ(histogram.minimum(), values.front());
  EXPECT_EQ(histogram.maximum(), values.back());
}

TEST(DurationHistogram, MergesAsIfAllHadBeenAdded) {
  RandomStream random{4};
  DurationHistogram all, left, right;
  for (int i = 0; i < 1000; ++i) {
    const double value = random.uniform(1e-6, 1e-3);
    all.add(value);
    (i % 3 == 0 ? left : right).add(value);
  }
  left.merge(DurationHistogram{});
  left.merge(right);
  EXPECT_EQ(left.count(), 1000);
  EXPECT_EQ(left.buckets(), all.buckets());
  EXPECT_EQ(left.minimum(), all.minimum());
  EXPECT_EQ(left.maximum(), all.maximum());
}

TEST(DurationHistogram, IsUnknownWhenEmptyAndIgnoresWhatIsNoNumber) {
  DurationHistogram histogram;
  histogram.add(std::nan(""));
  EXPECT_EQ(histogram.count(), 0);
  EXPECT_TRUE(std::isnan(histogram.percentile(0.5)));
  EXPECT_TRUE(std::isnan(histogram.maximum()));
  histogram.add(0.0);  // a clock that did not tick
  EXPECT_EQ(histogram.percentile(0.5), 0.0);
}

}  // namespace
}  // namespace spf
