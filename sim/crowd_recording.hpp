// A recording of people: its duration and extent, and the windows that trials take from it. Frame: world of
// the recording.
#pragma once

#include <vector>

#include "sim/scenario.hpp"

namespace spf::sim {

class CrowdRecording {
 public:
  /// At least one sample, sorted by time. Throws std::invalid_argument otherwise.
  explicit CrowdRecording(std::vector<CrowdSample> samples);

  [[nodiscard]] const std::vector<CrowdSample>& samples() const { return samples_; }
  [[nodiscard]] double begin() const { return samples_.front().time; }  ///< [s] of the first sample
  [[nodiscard]] double end() const { return samples_.back().time; }     ///< [s] of the last
  [[nodiscard]] const Box& extent() const { return extent_; }           ///< of all positions
  /// Time between two samples of one person, the median [s]; 0 when no person has two samples.
  [[nodiscard]] double interval() const { return interval_; }
  /// A person without a sample for longer is absent meanwhile; nothing is interpolated [s].
  [[nodiscard]] double longest_gap() const { return 1.5 * interval_; }

  /// Windows of `length` that begin every `spacing` [s] from the first sample on and end within the
  /// recording. A recording shorter than one window has one, which is empty after the recording's end.
  [[nodiscard]] int window_count(double length, double spacing) const;

  /// What happens from `begin` on for `length` [s], with times counted from `begin`; samples just outside are
  /// kept, so that people move at both ends of the window, too.
  [[nodiscard]] std::vector<CrowdSample> window(double begin, double length) const;

 private:
  std::vector<CrowdSample> samples_;
  Box extent_;
  double interval_ = 0.0;  // [s]
};

}  // namespace spf::sim
