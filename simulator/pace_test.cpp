#include <gtest/gtest.h>

#include "simulator/pace.hpp"

namespace spf::simulator {
namespace {

TEST(Pace, RunsAtItsSpeed) {
  Pace pace{4.0};
  pace.start(10.0, 100.0);
  EXPECT_DOUBLE_EQ(pace.due(12.0), 100.5);
}

TEST(Pace, MakesUpForLittleAndShiftsForMuch) {
  Pace pace{2.0};
  pace.start(0.0, 0.0);
  pace.reached(1.0, 0.505);
  EXPECT_DOUBLE_EQ(pace.due(2.0), 1.0);
  EXPECT_EQ(pace.shifts(), 0);
  pace.reached(2.0, 1.25);
  EXPECT_DOUBLE_EQ(pace.due(3.0), 1.75);
  EXPECT_EQ(pace.shifts(), 1);
  EXPECT_DOUBLE_EQ(pace.lost(), 0.25);
}

}  // namespace
}  // namespace spf::simulator
