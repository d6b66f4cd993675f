// Heading over time, the third flat output: planned apart from the position, since an omnidirectional robot
// turns independently of its motion up to the wheel limits (which the planner checks jointly before it
// commits).
#pragma once

#include <optional>

#include "spf/math/angles.hpp"

namespace spf {

struct HeadingState {
  double heading = 0.0;   ///< [rad] (-pi, pi]
  double yaw_rate = 0.0;  ///< [rad/s]
};

/// The numbers of a HeadingProfile, for messages: three phases of constant yaw acceleration, from the initial
/// rate to the cruise rate, cruise, and down to rest at the target.
struct HeadingPhases {
  double start_time = 0.0;       ///< [s]
  double initial_heading = 0.0;  ///< [rad]
  double target_heading = 0.0;   ///< [rad]
  double initial_rate = 0.0;     ///< [rad/s]
  double cruise_rate = 0.0;      ///< [rad/s]
  double ramp_in = 0.0;          ///< [s] each >= 0
  double cruise = 0.0;           ///< [s]
  double ramp_out = 0.0;         ///< [s]
};

/// Turns from an initial heading and yaw rate to a target heading, at rest there, under limits of yaw rate
/// and yaw acceleration (a trapezoid of the rate), and holds it. It turns in the direction that takes less
/// time: the shorter one from rest, and against a spin already under way only if that is faster. Before its
/// start it holds the initial heading. Closed form; queries never allocate.
class HeadingProfile {
 public:
  /// Holds heading 0.
  HeadingProfile() = default;
  /// Holds a heading.
  explicit HeadingProfile(double heading)
      : initial_heading_{wrap_angle(heading)}, target_heading_{initial_heading_} {}
  /// Limits must be positive; start_time [s] is when the turn begins. An initial rate beyond the limit is
  /// first brought back to it.
  HeadingProfile(double start_time, const HeadingState& initial, double target_heading, double max_yaw_rate,
                 double max_yaw_acceleration);

  /// Lossless conversion to phases and back. Empty when the numbers are no such turn: not finite, a negative
  /// phase, or phases that do not end at the target (to 1e-6 rad).
  [[nodiscard]] static std::optional<HeadingProfile> from_phases(const HeadingPhases& phases);
  [[nodiscard]] HeadingPhases phases() const;

  [[nodiscard]] HeadingState state(double time) const;
  [[nodiscard]] double start_time() const { return start_time_; }
  [[nodiscard]] double target_heading() const { return target_heading_; }  ///< [rad] (-pi, pi]
  /// [s] from start_time until the target heading is held.
  [[nodiscard]] double turn_duration() const;

 private:
  double start_time_ = 0.0;
  double initial_heading_ = 0.0;
  double target_heading_ = 0.0;
  // Three phases of constant yaw acceleration: from the initial rate to the cruise rate, cruise, down to
  // rest.
  double initial_rate_ = 0.0;
  double cruise_rate_ = 0.0;
  double ramp_in_ = 0.0;   // [s]
  double cruise_ = 0.0;    // [s]
  double ramp_out_ = 0.0;  // [s]
};

}  // namespace spf
