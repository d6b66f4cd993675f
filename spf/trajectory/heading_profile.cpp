#include "spf/trajectory/heading_profile.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace spf {
namespace {

struct RateTrapezoid {
  double cruise_rate = 0.0;  // [rad/s] signed
  double ramp_in = 0.0;      // [s]
  double cruise = 0.0;       // [s]
  double ramp_out = 0.0;     // [s]
  [[nodiscard]] double duration() const { return ramp_in + cruise + ramp_out; }
};

/// Least time from a rate to rest over a signed turn [rad]. Counted positive in the direction in which the
/// robot turns after (or instead of) braking, the rate rises to a peak sqrt(a D + rate^2 / 2), cut off at the
/// limit, and falls to zero.
RateTrapezoid fastest_turn(double turn, double rate, double max_rate, double max_acceleration) {
  const double braking_turn = rate * std::fabs(rate) / (2.0 * max_acceleration);
  const double side = turn >= braking_turn ? 1.0 : -1.0;
  const double angle = side * turn;
  const double start = side * rate;
  const double peak = std::sqrt(std::max(0.0, max_acceleration * angle + 0.5 * start * start));
  const double top = std::min(peak, max_rate);

  RateTrapezoid result;
  result.cruise_rate = side * top;
  result.ramp_in = std::fabs(top - start) / max_acceleration;
  result.ramp_out = top / max_acceleration;
  const double ramps = 0.5 * (start + top) * result.ramp_in + 0.5 * top * result.ramp_out;
  if (peak > max_rate) result.cruise = std::max(0.0, (angle - ramps) / top);
  return result;
}

}  // namespace

HeadingProfile::HeadingProfile(double start_time, const HeadingState& initial, double target_heading,
                               double max_yaw_rate, double max_yaw_acceleration)
    : start_time_{start_time},
      initial_heading_{wrap_angle(initial.heading)},
      target_heading_{wrap_angle(target_heading)},
      initial_rate_{initial.yaw_rate} {
  assert(max_yaw_rate > 0.0 && max_yaw_acceleration > 0.0);
  // The turns that lead to the target differ by full circles; only those next to where braking would end can
  // be best.
  const double braking_turn = initial_rate_ * std::fabs(initial_rate_) / (2.0 * max_yaw_acceleration);
  const double nearest = braking_turn + angle_difference(target_heading_, initial_heading_ + braking_turn);
  RateTrapezoid best = fastest_turn(nearest, initial_rate_, max_yaw_rate, max_yaw_acceleration);
  for (const double turn : {nearest - 2.0 * kPi, nearest + 2.0 * kPi}) {
    const RateTrapezoid other = fastest_turn(turn, initial_rate_, max_yaw_rate, max_yaw_acceleration);
    constexpr double kClearlyFaster = 1e-9;  // [s] so that rounding does not choose between two equal turns
    if (other.duration() < best.duration() - kClearlyFaster) best = other;
  }
  cruise_rate_ = best.cruise_rate;
  ramp_in_ = best.ramp_in;
  cruise_ = best.cruise;
  ramp_out_ = best.ramp_out;
}

std::optional<HeadingProfile> HeadingProfile::from_phases(const HeadingPhases& phases) {
  constexpr double kTolerance = 1e-6;  // [rad] rounding of turns of many circles stays far below
  const double parts[] = {phases.initial_heading, phases.target_heading, phases.initial_rate,
                          phases.cruise_rate,     phases.ramp_in,        phases.cruise,
                          phases.ramp_out,        phases.start_time};
  for (const double part : parts)
    if (!std::isfinite(part)) return std::nullopt;
  if (phases.ramp_in < 0.0 || phases.cruise < 0.0 || phases.ramp_out < 0.0) return std::nullopt;
  const double turned = 0.5 * (phases.initial_rate + phases.cruise_rate) * phases.ramp_in +
                        phases.cruise_rate * (phases.cruise + 0.5 * phases.ramp_out);
  const double miss = angle_difference(phases.initial_heading + turned, phases.target_heading);
  if (!(std::abs(miss) <= kTolerance)) return std::nullopt;
  HeadingProfile profile;
  profile.start_time_ = phases.start_time;
  profile.initial_heading_ = wrap_angle(phases.initial_heading);
  profile.target_heading_ = wrap_angle(phases.target_heading);
  profile.initial_rate_ = phases.initial_rate;
  profile.cruise_rate_ = phases.cruise_rate;
  profile.ramp_in_ = phases.ramp_in;
  profile.cruise_ = phases.cruise;
  profile.ramp_out_ = phases.ramp_out;
  return profile;
}

HeadingPhases HeadingProfile::phases() const {
  return {start_time_,  initial_heading_, target_heading_, initial_rate_,
          cruise_rate_, ramp_in_,         cruise_,         ramp_out_};
}

HeadingState HeadingProfile::state(double time) const {
  double elapsed = time - start_time_;
  if (elapsed < 0.0) return {initial_heading_, 0.0};
  if (elapsed >= turn_duration()) return {target_heading_, 0.0};
  if (elapsed < ramp_in_) {
    const double acceleration = (cruise_rate_ - initial_rate_) / ramp_in_;
    const double turned = (initial_rate_ + 0.5 * acceleration * elapsed) * elapsed;
    return {wrap_angle(initial_heading_ + turned), initial_rate_ + acceleration * elapsed};
  }
  const double turned_before = 0.5 * (initial_rate_ + cruise_rate_) * ramp_in_;
  elapsed -= ramp_in_;
  if (elapsed < cruise_)
    return {wrap_angle(initial_heading_ + turned_before + cruise_rate_ * elapsed), cruise_rate_};
  // Counted back from the target, where the rate is zero.
  const double remaining = ramp_out_ - (elapsed - cruise_);
  const double rate = cruise_rate_ * remaining / ramp_out_;
  return {wrap_angle(target_heading_ - 0.5 * rate * remaining), rate};
}

double HeadingProfile::turn_duration() const {
  return ramp_in_ + cruise_ + ramp_out_;
}

}  // namespace spf
