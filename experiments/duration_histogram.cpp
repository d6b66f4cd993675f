#include "experiments/duration_histogram.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace spf {
namespace {

constexpr double kSmallest = 1e-9;  // [s] anything shorter counts as this
constexpr double kEmpty = std::numeric_limits<double>::quiet_NaN();
const double kLogWidth = std::log(1.02);

int bucket_of(double seconds) {
  return static_cast<int>(std::floor(std::log(std::max(seconds, kSmallest) / kSmallest) / kLogWidth));
}

/// Geometric middle of a bucket: within 1 % of everything in it.
double value_of(int bucket) {
  return kSmallest * std::exp((bucket + 0.5) * kLogWidth);
}

}  // namespace

void DurationHistogram::add(double seconds) {
  if (!std::isfinite(seconds)) return;
  minimum_ = count_ == 0 ? seconds : std::min(minimum_, seconds);
  maximum_ = count_ == 0 ? seconds : std::max(maximum_, seconds);
  ++buckets_[bucket_of(seconds)];
  ++count_;
}

void DurationHistogram::merge(const DurationHistogram& other) {
  if (other.count_ == 0) return;
  minimum_ = count_ == 0 ? other.minimum_ : std::min(minimum_, other.minimum_);
  maximum_ = count_ == 0 ? other.maximum_ : std::max(maximum_, other.maximum_);
  for (const auto& [bucket, count] : other.buckets_) buckets_[bucket] += count;
  count_ += other.count_;
}

double DurationHistogram::percentile(double share) const {
  if (count_ == 0) return kEmpty;
  const double wanted = std::max(1.0, std::ceil(share * static_cast<double>(count_)));
  std::int64_t seen = 0;
  for (const auto& [bucket, count] : buckets_) {
    seen += count;
    if (static_cast<double>(seen) >= wanted) return std::clamp(value_of(bucket), minimum_, maximum_);
  }
  return maximum_;
}

double DurationHistogram::minimum() const {
  return count_ == 0 ? kEmpty : minimum_;
}
double DurationHistogram::maximum() const {
  return count_ == 0 ? kEmpty : maximum_;
}

DurationHistogram DurationHistogram::from_buckets(std::map<int, std::int64_t> buckets, double minimum,
                                                  double maximum) {
  DurationHistogram made;
  made.buckets_ = std::move(buckets);
  for (const auto& [bucket, count] : made.buckets_) made.count_ += count;
  made.minimum_ = minimum;
  made.maximum_ = maximum;
  return made;
}

}  // namespace spf
