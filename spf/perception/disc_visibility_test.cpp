#include "spf/perception/disc_visibility.hpp"

#include <gtest/gtest.h>

#include "spf/perception/test/scan_scene.hpp"

namespace spf {
namespace {

struct Look {
  ScanScene scene;
  RangeScan scan;
  SensorSweep sweep;
  void take() {
    RandomStream random{1};
    scene.range_sigma = 0.0;
    scene.scan(sweep, scan, random);
  }
};

TEST(DiscVisibility, TellsSeenThroughOnAndBlocked) {
  Look look;
  look.scene.discs = {{{3.0, 0.0}, 0.3}, {{0.0, 2.0}, 0.5}};
  look.take();
  const DiscVisibility there = look_at_disc(look.sweep, {3.0, 0.0}, 0.3, 0.06);
  EXPECT_EQ(there.on, there.all());
  const DiscVisibility gone = look_at_disc(look.sweep, {-3.0, 0.0}, 0.3, 0.06);
  EXPECT_EQ(gone.through, gone.all());
  const DiscVisibility before = look_at_disc(look.sweep, {2.0, 0.0}, 0.3, 0.06);
  EXPECT_GT(before.through, 0);  // returns behind it
  EXPECT_EQ(before.blocked, 0);
  const DiscVisibility behind = look_at_disc(look.sweep, {0.0, 4.0}, 0.3, 0.06);
  EXPECT_EQ(behind.blocked, behind.all());
  const DiscVisibility beyond = look_at_disc(look.sweep, {-9.0, 0.0}, 0.3, 0.06);
  EXPECT_EQ(beyond.unknown, beyond.all());
}

TEST(DiscVisibility, KnowsItsFieldOfView) {
  Look look;
  look.scene.field_of_view = 1.5 * kPi;
  look.take();
  const DiscVisibility behind = look_at_disc(look.sweep, {-3.0, 0.0}, 0.3, 0.06);
  EXPECT_EQ(behind.unknown, behind.all());
  EXPECT_FALSE(vacated(look.sweep, {-3.0, 0.0}, 0.1));
  EXPECT_TRUE(vacated(look.sweep, {3.0, 0.0}, 0.1));
}

TEST(DiscVisibility, AWallThatBeamsGrazeIsNotVacated) {
  Look look;
  look.scene.beams = 180;  // 2 degrees: returns 0.5 m apart out there
  look.scene.walls = {{{-7.0, 0.5}, {7.0, 0.5}}};
  look.take();
  RandomStream random{2};
  for (int k = 0; k < 200; ++k) {
    const double x = random.uniform(-5.0, 5.0);
    EXPECT_FALSE(vacated(look.sweep, {x, 0.5}, 0.1)) << x;
    // In front of the wall by 0.4 m nothing stands, as long as both beams beside meet the wall behind it.
    if (std::abs(x) < 1.0) {
      EXPECT_TRUE(vacated(look.sweep, {x, 0.1}, 0.1)) << x;
    }
  }
}

}  // namespace
}  // namespace spf
