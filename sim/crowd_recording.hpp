// A recording of people, as a whole: how long and how large it is, and the windows that trials cut out of it.
// Frame: world of the recording.
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
  /// Time between two samples of one person, the median [s]; 0 when nobody was seen twice.
  [[nodiscard]] double interval() const { return interval_; }
  /// Who is unseen for longer has been away meanwhile; nothing is filled in [s].
  [[nodiscard]] double longest_gap() const { return 1.5 * interval_; }

  /// Windows of `length` that begin every `spacing` [s] from the first sample on and end within the
  /// recording. A recording that is shorter than one window has one, in which nobody is left after its end.
  [[nodiscard]] int window_count(double length, double spacing) const;

  /// What happens from `begin` on for `length` [s], with times counted from `begin`; samples just outside are
  /// kept, so that who is on the way at either end moves there too.
  [[nodiscard]] std::vector<CrowdSample> window(double begin, double length) const;

 private:
  std::vector<CrowdSample> samples_;
  Box extent_;
  double interval_ = 0.0;  // [s]
};

}  // namespace spf::sim
