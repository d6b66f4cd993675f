// The statistics of the tables: intervals of rates, paired comparison, moments and percentiles.
#pragma once

#include <vector>

namespace spf {

struct Interval {
  double low = 0.0;
  double high = 1.0;
};

/// Wilson's score interval of a rate, 95 % (z = 1.959963984540054), without continuity correction.
/// [0, 1] without trials. Requires 0 <= successes <= trials.
[[nodiscard]] Interval wilson_interval(int successes, int trials);

/// McNemar's exact test, two-sided: p of a split at least this uneven of the pairs in which only one
/// succeeded, when both are equally likely. 1 without such pairs.
[[nodiscard]] double mcnemar_exact(int only_a, int only_b);

/// Mean of the values; NaN when there are none.
[[nodiscard]] double mean(const std::vector<double>& values);
/// Sample standard deviation (n - 1); NaN below two values.
[[nodiscard]] double standard_deviation(const std::vector<double>& values);
/// Smallest value; NaN when there are none.
[[nodiscard]] double minimum(const std::vector<double>& values);
/// Largest value; NaN when there are none.
[[nodiscard]] double maximum(const std::vector<double>& values);

/// Percentile with linear interpolation between order statistics (position share * (n - 1); type 7 of Hyndman
/// and Fan), share in [0, 1]; NaN when there are no values.
[[nodiscard]] double percentile(std::vector<double> values, double share);

}  // namespace spf
