// When the agent's periodic duties are due. Times [s].
#pragma once

namespace spf {

inline constexpr double kTimeTolerance = 1e-9;   // [s] ticks that fall on a due time within rounding
inline constexpr double kClockError = 0.1;       // [s] by which a sensor's clock may be ahead
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

}  // namespace spf
