#include "sim/crowd.hpp"

#include <algorithm>

namespace spf::sim {

Crowd::Crowd(const std::vector<CrowdSample>& samples, double longest_gap) {
  std::vector<CrowdSample> sorted = samples;
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const CrowdSample& a, const CrowdSample& b) { return a.id < b.id; });
  for (const CrowdSample& sample : sorted) {
    const bool goes_on = !presences_.empty() && presences_.back().id == sample.id &&
                         sample.time - presences_.back().samples.back().time <= longest_gap;
    if (!goes_on) presences_.push_back({sample.id, 0, {}});
    presences_.back().samples.push_back(sample);
  }
}

Eigen::Vector2d Crowd::position(const Presence& person, double time) {
  const std::vector<CrowdSample>& samples = person.samples;
  std::size_t next = person.cursor;
  while (next < samples.size() && samples[next].time <= time) ++next;
  if (next == 0) return samples.front().position_world;
  if (next == samples.size()) return samples.back().position_world;
  const CrowdSample& before = samples[next - 1];
  const CrowdSample& after = samples[next];
  const double share = (time - before.time) / (after.time - before.time);
  return before.position_world + share * (after.position_world - before.position_world);
}

}  // namespace spf::sim
