// Heading over time, the third flat output: planned apart from the position, since an omnidirectional robot turns
// independently of its motion up to the wheel limits (which the planner checks jointly before it commits).
#pragma once

#include "spf/math/angles.hpp"

namespace spf {

struct HeadingState {
  double heading = 0.0;   ///< [rad] (-pi, pi]
  double yaw_rate = 0.0;  ///< [rad/s]
};

/// Turns from an initial heading and yaw rate to a target heading by the shorter way, at rest there, under limits of
/// yaw rate and yaw acceleration (a trapezoid of the rate), and holds it. Closed form; queries never allocate.
class HeadingProfile {
 public:
  /// Holds heading 0.
  HeadingProfile() = default;
  /// Holds a heading.
  explicit HeadingProfile(double heading) : initial_heading_{wrap_angle(heading)} {}
  /// Limits must be positive; start_time [s] is when the turn begins.
  HeadingProfile(double start_time, const HeadingState& initial, double target_heading, double max_yaw_rate,
                 double max_yaw_acceleration);

  [[nodiscard]] HeadingState state(double time) const;
  [[nodiscard]] double start_time() const { return start_time_; }
  /// [s] from start_time until the target heading is held.
  [[nodiscard]] double turn_duration() const;
  void shift(double by) { start_time_ += by; }

 private:
  double start_time_ = 0.0;
  double initial_heading_ = 0.0;
  // Three phases of constant yaw acceleration: from the initial rate to the cruise rate, cruise, down to rest.
  double initial_rate_ = 0.0;
  double cruise_rate_ = 0.0;
  double ramp_in_ = 0.0;   // [s]
  double cruise_ = 0.0;    // [s]
  double ramp_out_ = 0.0;  // [s]
};

}  // namespace spf
