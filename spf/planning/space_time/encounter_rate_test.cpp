#include "spf/planning/space_time/encounter_rate.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "spf/math/angles.hpp"

namespace spf {
namespace {

constexpr double kRange = 8.0;  // [m]

ObstacleTrack moving_at(const Eigen::Vector2d& position, double radius = 0.3, double speed = 1.0) {
  ObstacleTrack track;
  track.state.position_world = position;
  track.state.velocity_world = {0.0, speed};
  track.state.radius = radius;
  return track;
}

/// After so long that the average is what it is now.
double rate_of(const std::vector<ObstacleTrack>& tracks) {
  EncounterRate encounters{0.3, 1.0, kRange, 4.0};
  PlanRequest request;
  request.world.tracks = &tracks;
  request.time = 1e3;
  encounters.update(request);
  return encounters.per_second();
}

TEST(EncounterRate, IsThatOfTheKineticTheory) {
  EXPECT_EQ(rate_of({}), 0.0);
  const double area = kPi * kRange * kRange;
  const double one = 2.0 * 0.6 * std::sqrt(2.0) / area;
  EXPECT_NEAR(rate_of({moving_at({7.9, 0.0})}), one, 0.03 * one);
  EXPECT_NEAR(rate_of({moving_at({7.9, 0.0}), moving_at({-7.9, 0.0})}), 2.0 * one, 0.06 * one);
}

TEST(EncounterRate, LeavesOutWhatIsFarOrStands) {
  ObstacleTrack stands = moving_at({3.0, 0.0});
  stands.stood = 2.0;
  EXPECT_EQ(rate_of({stands, moving_at({8.1, 0.0})}), 0.0);
}

TEST(EncounterRate, TakesWhatHidesBehindOthersForAsCrowdedAsWhatItSees) {
  const double open = rate_of({moving_at({4.0, 0.0}, 0.1)});
  std::vector<ObstacleTrack> ring;
  for (int i = 0; i < 12; ++i) {
    const double angle = 2.0 * kPi * i / 12;
    ring.push_back(moving_at({2.0 * std::cos(angle), 2.0 * std::sin(angle)}, 0.6));
  }
  // The ring hides all but the inner 2 m: a sixteenth of the area, not below a tenth.
  const double hidden = rate_of(ring);
  const double without_hiding = 12.0 * 2.0 * 0.9 * std::sqrt(2.0) / (kPi * kRange * kRange);
  EXPECT_GT(hidden, 5.0 * without_hiding);
  EXPECT_LE(hidden, 10.0 * without_hiding * (1.0 + 1e-9));
  EXPECT_GT(open, 0.0);
}

TEST(EncounterRate, IsAverage) {
  const std::vector<ObstacleTrack> tracks{moving_at({3.0, 0.0})};
  EncounterRate encounters{0.3, 1.0, kRange, 4.0};
  PlanRequest request;
  request.world.tracks = &tracks;
  for (int i = 1; i <= 40; ++i) {
    request.time = 0.1 * i;
    encounters.update(request);
  }
  EXPECT_NEAR(encounters.per_second(), (1.0 - std::exp(-1.0)) * rate_of(tracks), 1e-12);
  request.time = 1.0;  // a clock that was set back changes nothing
  const double before = encounters.per_second();
  encounters.update(request);
  EXPECT_EQ(encounters.per_second(), before);
}

}  // namespace
}  // namespace spf
