// When the agent's periodic duties are due, and which observations tell about the present. Times [s].
#pragma once

#include <algorithm>

namespace spf {

inline constexpr double kTimeTolerance = 1e-9;   // [s] ticks that fall on a due time within rounding
inline constexpr double kClockError = 0.1;       // [s] by which a sensor's clock may be ahead at most
inline constexpr double kLongestStepGap = 10.0;  // [s] without a step, after which the schedule starts afresh

[[nodiscard]] constexpr bool is_due(double due, double now) {
  return now >= due - kTimeTolerance;
}

/// The next time of a periodic duty that is due by now.
[[nodiscard]] constexpr double next_due(double due, double period, double now) {
  if (now - due > kLongestStepGap) due = now;
  while (due <= now + kTimeTolerance) due += period;
  return due;
}

enum class Timeliness {
  timely,
  late,   ///< too old to rely on
  ahead,  ///< of the clock, by more than clocks differ
};

/// Whether what was observed at a time tells about the present. `stale_time` is that of TeamParameters;
/// `clock_error` counts up to kClockError. A time that is NaN is late.
[[nodiscard]] constexpr Timeliness timeliness(double observed, double now, double stale_time,
                                              double clock_error = kClockError) {
  if (observed > now + std::min(clock_error, kClockError)) return Timeliness::ahead;
  return observed >= now - stale_time - kTimeTolerance ? Timeliness::timely : Timeliness::late;
}

}  // namespace spf
