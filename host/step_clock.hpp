// The clock as a host sees it, step by step: a step backwards, or a very long one, is a jump after which
// nothing that was known before can be dated.
#pragma once

#include <cstdint>
#include <limits>

namespace spf::host {

/// When something happened that has not [s].
inline constexpr double kNever = -std::numeric_limits<double>::infinity();

class StepClock {
 public:
  explicit StepClock(double longest_step) : longest_step_{longest_step} {}

  /// True when the clock has jumped since the last call. A few milliseconds back are no jump: threads read
  /// clocks.
  bool jumped(double now) {
    const bool jumped = started_ && (now < now_ - kBackwards || now > now_ + longest_step_);
    if (!started_ || jumped || now > now_) now_ = now;
    started_ = true;
    count_ += jumped ? 1 : 0;
    return jumped;
  }
  /// The latest time seen [s]; never goes back but in a jump.
  [[nodiscard]] double now() const { return now_; }
  [[nodiscard]] std::uint32_t count() const { return count_; }

 private:
  static constexpr double kBackwards = 0.02;  // [s]
  double longest_step_;                       // [s]
  double now_ = 0.0;                          // [s]
  bool started_ = false;
  std::uint32_t count_ = 0;
};

}  // namespace spf::host
