// A compact store of many durations: counts in logarithmic buckets, 2 % wide, so that percentiles over any
// number of trials (and over merged shards) are known to 1 %. The smallest and the largest value are exact.
#pragma once

#include <cstdint>
#include <map>

namespace spf {

class DurationHistogram {
 public:
  void add(double seconds);
  void merge(const DurationHistogram& other);

  [[nodiscard]] std::int64_t count() const { return count_; }
  /// Smallest value v such that at least `share` of all values are <= v, to 1 %; NaN without values. [s]
  [[nodiscard]] double percentile(double share) const;
  [[nodiscard]] double minimum() const;  ///< [s] exact; NaN without values
  [[nodiscard]] double maximum() const;  ///< [s] exact; NaN without values

  /// Bucket -> count, and a histogram made of them: for files.
  [[nodiscard]] const std::map<int, std::int64_t>& buckets() const { return buckets_; }
  static DurationHistogram from_buckets(std::map<int, std::int64_t> buckets, double minimum, double maximum);

 private:
  std::map<int, std::int64_t> buckets_;
  std::int64_t count_ = 0;
  double minimum_ = 0.0;
  double maximum_ = 0.0;
};

}  // namespace spf
