// A recorded crowd as moving discs: a person moves linearly between the samples of the recording, is present
// from the first to the last of them, and does not react. Frame: world.
#pragma once

#include <limits>
#include <vector>

#include "sim/scenario.hpp"

namespace spf::sim {

class Crowd {
 public:
  /// A person without a sample for longer than `longest_gap` [s] is absent meanwhile.
  explicit Crowd(const std::vector<CrowdSample>& samples,
                 double longest_gap = std::numeric_limits<double>::infinity());

  /// Calls visit(id, from, to) for everyone present both at `time` and at `time + step` [s], by ascending id,
  /// with the positions at both. Times must not decrease.
  template <class Visit>
  void visit(double time, double step, Visit&& visit) {
    for (Presence& person : presences_) {
      if (person.samples.front().time > time + kRounding) continue;
      if (person.samples.back().time < time + step - kRounding) continue;
      while (person.cursor + 2 < person.samples.size() && person.samples[person.cursor + 1].time <= time)
        ++person.cursor;
      visit(person.id, position(person, time), position(person, time + step));
    }
  }

 private:
  static constexpr double kRounding = 1e-9;  // [s] of times that were shifted

  /// A person from entering to leaving.
  struct Presence {
    int id = 0;
    std::size_t cursor = 0;  // the sample at or before the time last asked for
    std::vector<CrowdSample> samples;
  };
  [[nodiscard]] static Eigen::Vector2d position(const Presence& person, double time);

  std::vector<Presence> presences_;  // by id, then by time
};

}  // namespace spf::sim
