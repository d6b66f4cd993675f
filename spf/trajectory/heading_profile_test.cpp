#include "spf/trajectory/heading_profile.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "spf/math/random_stream.hpp"

namespace spf {
namespace {

struct Turn {
  HeadingState initial;
  double target;
  double max_rate;
  double max_acceleration;
};

Turn draw_turn(RandomStream& random) {
  Turn turn{};
  turn.max_rate = random.uniform(0.2, 3.0);
  turn.max_acceleration = random.uniform(0.5, 8.0);
  turn.initial.heading = random.uniform(-kPi, kPi);
  turn.initial.yaw_rate = random.uniform(-1.0, 1.0) * turn.max_rate;
  turn.target = random.uniform(-kPi, kPi);
  return turn;
}

HeadingProfile profile_of(const Turn& turn, double start_time) {
  return {start_time, turn.initial, turn.target, turn.max_rate, turn.max_acceleration};
}

TEST(HeadingProfile, HoldsAHeading) {
  EXPECT_EQ(HeadingProfile{}.state(5.0).heading, 0.0);
  const HeadingProfile profile{kPi + 0.5};
  for (const double time : {-1.0, 0.0, 3.0}) {
    EXPECT_DOUBLE_EQ(profile.state(time).heading, -kPi + 0.5);
    EXPECT_EQ(profile.state(time).yaw_rate, 0.0);
  }
  EXPECT_EQ(profile.turn_duration(), 0.0);
}

TEST(HeadingProfile, FollowsTheTrapezoidInClosedForm) {
  // 2 rad at 1 rad/s and 2 rad/s^2: ramps of 0.5 s (0.25 rad each) and 1.5 s of cruise.
  const HeadingProfile profile{10.0, HeadingState{-0.5, 0.0}, 1.5, 1.0, 2.0};
  EXPECT_NEAR(profile.turn_duration(), 2.5, 1e-14);
  EXPECT_NEAR(profile.state(10.5).heading, -0.25, 1e-14);
  EXPECT_NEAR(profile.state(10.5).yaw_rate, 1.0, 1e-14);
  EXPECT_NEAR(profile.state(11.25).heading, 0.5, 1e-14);
  EXPECT_NEAR(profile.state(12.25).heading, 1.5 - 0.0625, 1e-14);
  EXPECT_NEAR(profile.state(12.25).yaw_rate, 0.5, 1e-14);
}

TEST(HeadingProfile, BeginsAndEndsAsAskedWithinLimits) {
  RandomStream random{1};
  constexpr int kSamples = 400;
  for (int i = 0; i < 500; ++i) {
    SCOPED_TRACE(i);
    const Turn turn = draw_turn(random);
    const HeadingProfile profile = profile_of(turn, 3.0);
    EXPECT_NEAR(angle_difference(profile.state(3.0).heading, turn.initial.heading), 0.0, 1e-14);
    EXPECT_NEAR(profile.state(3.0).yaw_rate, turn.initial.yaw_rate, 1e-14);
    EXPECT_DOUBLE_EQ(profile.state(3.0 + profile.turn_duration()).heading, turn.target);
    EXPECT_EQ(profile.state(1e6).yaw_rate, 0.0);

    const double step = profile.turn_duration() / kSamples;
    HeadingState last = profile.state(3.0);
    for (int s = 1; s <= kSamples; ++s) {
      const HeadingState now = profile.state(3.0 + s * step);
      EXPECT_LE(std::fabs(now.yaw_rate), turn.max_rate * (1.0 + 1e-12));
      EXPECT_LE(std::fabs(now.yaw_rate - last.yaw_rate), turn.max_acceleration * step * (1.0 + 1e-9) + 1e-12);
      // Trapezoid rule of the rate: exact but where a step straddles a corner, error <= acceleration * step^2
      // / 2.
      EXPECT_NEAR(angle_difference(now.heading, last.heading), 0.5 * step * (now.yaw_rate + last.yaw_rate),
                  0.5 * turn.max_acceleration * step * step + 1e-12);
      last = now;
    }
  }
}

TEST(HeadingProfile, TurnsTheShorterWayFromRest) {
  const HeadingProfile across{0.0, HeadingState{3.0, 0.0}, -3.0, 1.0, 1.0};
  EXPECT_GT(across.state(0.1).yaw_rate, 0.0);
  EXPECT_NEAR(across.turn_duration(), 2.0 * std::sqrt(2.0 * kPi - 6.0), 1e-12);
  const HeadingProfile back{0.0, HeadingState{0.5, 0.0}, -0.5, 1.0, 1.0};
  EXPECT_LT(back.state(0.1).yaw_rate, 0.0);
}

TEST(HeadingProfile, DoesNotUnwindASpinUnderWay) {
  // Target 0.2 rad behind, but spinning ahead at 3 rad/s: a full circle less 0.2 rad is quicker than back and
  // forth.
  const HeadingProfile profile{0.0, HeadingState{0.0, 3.0}, -0.2, 3.0, 1.0};
  for (double time = 0.0; time < profile.turn_duration(); time += 0.05)
    EXPECT_GE(profile.state(time).yaw_rate, 0.0);
  EXPECT_DOUBLE_EQ(profile.state(100.0).heading, -0.2);
}

TEST(HeadingProfile, NoBangBangTurnIsFaster) {
  // Oracle: any turn accelerates at full power to a peak rate, cruises there if it is the limit, and brakes.
  // Search signed peaks on a grid for turns that end at the target; none may end clearly sooner.
  RandomStream random{2};
  for (int i = 0; i < 100; ++i) {
    SCOPED_TRACE(i);
    const Turn turn = draw_turn(random);
    const double a = turn.max_acceleration;
    double fastest = 1e9;
    const double w0 = turn.initial.yaw_rate;
    for (int circle = -4; circle <= 4; ++circle) {
      const double angle = angle_difference(turn.target, turn.initial.heading) + 2.0 * kPi * circle;
      for (const double limit : {-turn.max_rate, turn.max_rate}) {  // with a cruise
        const double ramps =
            (w0 + limit) / 2.0 * std::fabs(limit - w0) / a + limit * std::fabs(limit) / (2.0 * a);
        const double cruise = (angle - ramps) / limit;
        if (cruise >= 0.0)
          fastest = std::min(fastest, std::fabs(limit - w0) / a + cruise + std::fabs(limit) / a);
      }
      const auto angle_with_peak = [&](double peak) {
        return (w0 + peak) / 2.0 * std::fabs(peak - w0) / a + peak * std::fabs(peak) / (2.0 * a);
      };
      double low = -turn.max_rate;  // the angle covered rises with the signed peak: bisect
      double high = turn.max_rate;
      if (angle_with_peak(low) > angle || angle_with_peak(high) < angle) continue;
      for (int k = 0; k < 100; ++k) {
        const double middle = 0.5 * (low + high);
        (angle_with_peak(middle) < angle ? low : high) = middle;
      }
      fastest = std::min(fastest, std::fabs(low - w0) / a + std::fabs(low) / a);
    }
    EXPECT_NEAR(profile_of(turn, 0.0).turn_duration(), fastest, 1e-6);
  }
}

TEST(HeadingProfile, BrakesARateBeyondTheLimit) {
  const HeadingProfile profile{0.0, HeadingState{0.0, 4.0}, 1.0, 1.0, 2.0};
  EXPECT_NEAR(profile.state(0.5).yaw_rate, 3.0, 1e-14);
  EXPECT_LE(profile.state(1.6).yaw_rate, 1.0);
  EXPECT_NEAR(profile.state(profile.turn_duration()).heading, 1.0, 1e-14);
}

TEST(HeadingProfile, TurnsIntoNumbersAndBackWithoutLoss) {
  RandomStream random{7};
  for (int i = 0; i < 500; ++i) {
    const HeadingProfile profile = profile_of(draw_turn(random), 3.0);
    const std::optional<HeadingProfile> back = HeadingProfile::from_phases(profile.phases());
    ASSERT_TRUE(back);
    for (double time = 2.5; time < 10.0; time += 0.17) {
      EXPECT_EQ(back->state(time).heading, profile.state(time).heading);
      EXPECT_EQ(back->state(time).yaw_rate, profile.state(time).yaw_rate);
    }
  }
  EXPECT_TRUE(HeadingProfile::from_phases(HeadingProfile{}.phases()));
}

TEST(HeadingProfile, RefusesNumbersThatAreNoTurn) {
  const HeadingPhases good = HeadingProfile{1.0, {0.2, 0.5}, 2.0, 1.0, 2.0}.phases();
  const auto refused = [&good](auto spoil) {
    HeadingPhases phases = good;
    spoil(phases);
    return !HeadingProfile::from_phases(phases);
  };
  const double nan = std::nan("");
  EXPECT_FALSE(refused([](HeadingPhases&) {}));
  EXPECT_TRUE(refused([](HeadingPhases& p) { p.ramp_in = -0.1; }));
  EXPECT_TRUE(refused([](HeadingPhases& p) { p.cruise += 0.1; }));
  EXPECT_TRUE(refused([](HeadingPhases& p) { p.target_heading += 0.01; }));
  EXPECT_TRUE(refused([nan](HeadingPhases& p) { p.initial_rate = nan; }));
  EXPECT_TRUE(refused([nan](HeadingPhases& p) { p.start_time = nan; }));
  EXPECT_TRUE(refused([](HeadingPhases& p) { p.cruise_rate = 1e300; }));
  EXPECT_TRUE(refused([](HeadingPhases& p) { p.ramp_out = 1e300; }));
}

}  // namespace
}  // namespace spf
