#include "sim/crowd.hpp"

#include <algorithm>
#include <map>

namespace spf::sim {

Crowd::Crowd(const std::vector<CrowdSample>& samples) {
  std::map<int, std::size_t> index_of;
  for (const CrowdSample& sample : samples) index_of.emplace(sample.id, 0);
  for (auto& [id, index] : index_of) {
    index = people_.size();
    people_.push_back({id, 0, {}});
  }
  for (const CrowdSample& sample : samples) people_[index_of.at(sample.id)].samples.push_back(sample);
}

Eigen::Vector2d Crowd::position(const Person& person, double time) {
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
