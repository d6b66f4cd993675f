#include "sim/crowd_recording.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <unordered_map>

namespace spf::sim {
namespace {

constexpr double kRounding = 1e-6;  // [s] of times in files

double median_interval(const std::vector<CrowdSample>& samples) {
  std::unordered_map<int, double> last_seen;
  std::vector<double> intervals;
  for (const CrowdSample& sample : samples) {
    const auto [last, is_new] = last_seen.try_emplace(sample.id, sample.time);
    if (!is_new) intervals.push_back(sample.time - last->second);
    last->second = sample.time;
  }
  if (intervals.empty()) return 0.0;
  const auto middle = intervals.begin() + static_cast<std::ptrdiff_t>(intervals.size() / 2);
  std::nth_element(intervals.begin(), middle, intervals.end());
  return *middle;
}

}  // namespace

CrowdRecording::CrowdRecording(std::vector<CrowdSample> samples) : samples_{std::move(samples)} {
  if (samples_.empty()) throw std::invalid_argument{"a recording of people needs at least one sample"};
  const auto earlier = [](const CrowdSample& a, const CrowdSample& b) { return a.time < b.time; };
  if (!std::is_sorted(samples_.begin(), samples_.end(), earlier))
    throw std::invalid_argument{"the samples of a recording must be sorted by time"};
  extent_ = {samples_.front().position_world, samples_.front().position_world};
  for (const CrowdSample& sample : samples_) {
    extent_.low = extent_.low.cwiseMin(sample.position_world);
    extent_.high = extent_.high.cwiseMax(sample.position_world);
  }
  interval_ = median_interval(samples_);
}

int CrowdRecording::window_count(double length, double spacing) const {
  const double room = end() - begin() - length;
  return room <= 0.0 ? 1 : static_cast<int>(std::floor((room + kRounding) / spacing)) + 1;
}

std::vector<CrowdSample> CrowdRecording::window(double begin, double length) const {
  std::vector<CrowdSample> part;
  const double slack = longest_gap() + kRounding;
  for (const CrowdSample& sample : samples_) {
    const double time = sample.time - begin;
    if (time < -slack || time > length + slack) continue;
    part.push_back({time, sample.id, sample.position_world});
  }
  return part;
}

}  // namespace spf::sim
