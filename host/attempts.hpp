// Attempts that fail: after each a longer wait, until one succeeds. Times are the host's [s].
#pragma once

#include <algorithm>

#include "host/step_clock.hpp"

namespace spf::host {

class Attempts {
 public:
  /// `extra` [s] is what the robot needs to come to rest first.
  void fail(double time, double extra) {
    ++failures_;
    until_ = time + extra + wait_;
    wait_ = std::min(2.0 * wait_, kLongestWait);
  }
  void succeed() {
    failures_ = 0;
    wait_ = kFirstWait;
  }
  void reset() { *this = {}; }

  [[nodiscard]] bool waiting(double now) const { return now < until_; }
  [[nodiscard]] int failures() const { return failures_; }  ///< in a row

  static constexpr double kFirstWait = 1.0;    ///< [s]
  static constexpr double kLongestWait = 8.0;  ///< [s]

 private:
  double until_ = kNever;     // [s]
  double wait_ = kFirstWait;  // [s] next time
  int failures_ = 0;
};

}  // namespace spf::host
