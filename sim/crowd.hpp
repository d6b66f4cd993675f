// A recorded crowd as moving discs: a person moves linearly between the samples of the recording, is there
// from the first to the last of them, and does not react. Frame: world.
#pragma once

#include <vector>

#include "sim/scenario.hpp"

namespace spf::sim {

class Crowd {
 public:
  explicit Crowd(const std::vector<CrowdSample>& samples);

  /// Calls visit(id, from, to) for everybody who is there at `time` and still there at `time + step` [s], by
  /// ascending id, with the positions at both. Times must not go back.
  template <class Visit>
  void visit(double time, double step, Visit&& visit) {
    for (Person& person : people_) {
      if (person.samples.front().time > time || person.samples.back().time < time + step) continue;
      while (person.cursor + 2 < person.samples.size() && person.samples[person.cursor + 1].time <= time)
        ++person.cursor;
      visit(person.id, position(person, time), position(person, time + step));
    }
  }

 private:
  struct Person {
    int id = 0;
    std::size_t cursor = 0;  // the sample at or before the time last asked for
    std::vector<CrowdSample> samples;
  };
  [[nodiscard]] static Eigen::Vector2d position(const Person& person, double time);

  std::vector<Person> people_;  // by id
};

}  // namespace spf::sim
