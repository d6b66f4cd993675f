#include "experiments/statistics.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace spf {
namespace {
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
}

Interval wilson_interval(int successes, int trials) {
  assert(0 <= successes && successes <= trials);
  if (trials == 0) return {};
  constexpr double z = 1.959963984540054;
  const double n = trials;
  const double rate = successes / n;
  const double center = rate + z * z / (2.0 * n);
  const double half_width = z * std::sqrt(rate * (1.0 - rate) / n + z * z / (4.0 * n * n));
  const double scale = 1.0 + z * z / n;
  // At the ends the limits are exactly 0 and 1; rounding must not move them.
  return {successes == 0 ? 0.0 : std::max(0.0, (center - half_width) / scale),
          successes == trials ? 1.0 : std::min(1.0, (center + half_width) / scale)};
}

double mcnemar_exact(int only_a, int only_b) {
  assert(only_a >= 0 && only_b >= 0);
  const int n = only_a + only_b;
  const int fewer = std::min(only_a, only_b);
  // Twice the lower tail of Binomial(n, 1/2). The terms go through logarithms, since 2^-n underflows for
  // large n.
  double tail = 0.0;
  for (int k = 0; k <= fewer; ++k)
    tail +=
        std::exp(std::lgamma(n + 1.0) - std::lgamma(k + 1.0) - std::lgamma(n - k + 1.0) - n * std::log(2.0));
  return std::min(1.0, 2.0 * tail);
}

double mean(const std::vector<double>& values) {
  if (values.empty()) return kNone;
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double standard_deviation(const std::vector<double>& values) {
  if (values.size() < 2) return kNone;
  const double center = mean(values);
  double sum = 0.0;
  for (const double value : values) sum += (value - center) * (value - center);
  return std::sqrt(sum / static_cast<double>(values.size() - 1));
}

double minimum(const std::vector<double>& values) {
  return values.empty() ? kNone : *std::min_element(values.begin(), values.end());
}

double maximum(const std::vector<double>& values) {
  return values.empty() ? kNone : *std::max_element(values.begin(), values.end());
}

double percentile(std::vector<double> values, double share) {
  assert(0.0 <= share && share <= 1.0);
  if (values.empty()) return kNone;
  const double position = share * static_cast<double>(values.size() - 1);
  const std::size_t below = static_cast<std::size_t>(position);
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(below);
  std::nth_element(values.begin(), at, values.end());
  const double low = *at;
  const double fraction = position - static_cast<double>(below);
  if (fraction == 0.0) return low;
  return low + fraction * (*std::min_element(at + 1, values.end()) - low);
}

}  // namespace spf
