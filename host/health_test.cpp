// One level for a robot, and never a good one while something is amiss.
#include "host/health.hpp"

#include <gtest/gtest.h>

#include "host/bench_test.hpp"

namespace spf::host {
namespace {

const std::vector<std::string> kParts{"tracker", "planner", "perception"};

class RobotHealthTest : public ::testing::Test {
 protected:
  void all_tell(double now) {
    for (const std::string& part : kParts) health.hear(part, {Level::ok, part + " works"}, now);
  }
  RobotHealth health{kParts, "planner", 10.0};
};

TEST_F(RobotHealthTest, IsThatOfTheWorstPart) {
  EXPECT_EQ(health.overall(10.0).level, Level::warn);  // nobody was heard yet
  all_tell(10.1);
  EXPECT_EQ(health.overall(10.2).level, Level::ok);
  EXPECT_EQ(health.overall(10.2).text, "planner works");
  health.hear("perception", {Level::warn, "scan: half blind"}, 10.2);
  health.hear("tracker", {Level::error, "stale pose"}, 10.2);
  health.hear("somebody", {Level::error, "noise"}, 10.2);
  EXPECT_EQ(health.overall(10.2).level, Level::error);
  EXPECT_EQ(health.overall(10.2).text, "tracker: stale pose; perception: scan: half blind");
}

TEST_F(RobotHealthTest, NamesAPartThatIsKilled) {
  all_tell(10.1);
  for (double now = 10.2; now < 13.0; now += 0.5)
    for (const char* living : {"planner", "perception"}) health.hear(living, {Level::ok, "works"}, now);
  EXPECT_EQ(health.overall(12.9).level, Level::error);
  EXPECT_EQ(health.overall(12.9).text, "tracker: silent");
  RobotHealth never{kParts, "planner", 10.0};
  EXPECT_EQ(never.overall(12.0).level, Level::error);
}

TEST_F(RobotHealthTest, IsSpokenByTheFirstPartThatLives) {
  all_tell(10.1);
  RobotHealth third{kParts, "perception", 10.0};
  for (const std::string& part : kParts) third.hear(part, {}, 10.1);
  EXPECT_FALSE(health.speaks(11.0));  // the tracker does
  EXPECT_TRUE(health.speaks(11.7));
  third.hear("planner", {}, 11.5);
  EXPECT_FALSE(third.speaks(11.7));
  EXPECT_TRUE(third.speaks(13.1));
}

TEST(RefusalLog, WarnsOfWhatWasRefusedLately) {
  RefusalLog log;
  log.note("odom", "malformed", 10.0);
  log.note("scan", "late or duplicated", 10.5, true);
  Health health{Level::ok, "moving"};
  log.add_to(health, 11.0);
  EXPECT_EQ(health.level, Level::warn);
  EXPECT_EQ(health.text, "moving; odom: malformed");
  EXPECT_EQ(log.count(), 2u);
  EXPECT_EQ(log.last(), "scan: late or duplicated");
  Health later;
  log.add_to(later, 12.1);
  EXPECT_EQ(later.level, Level::ok);
  Health before;
  log.add_to(before, 5.0);  // the clock went back
  EXPECT_EQ(before.level, Level::ok);
}

class HealthOfOneRobot : public ::testing::TestWithParam<Arrangement> {};
INSTANTIATE_TEST_SUITE_P(Both, HealthOfOneRobot,
                         testing::Values(Arrangement::one_process, Arrangement::split), name_of);

/// Is it well? Both halves must say so.
bool well(const Bench& bench) {
  return bench.planner.health(bench.now).level == Level::ok && bench.tracker.health().level == Level::ok;
}

TEST_P(HealthOfOneRobot, IsGoodOnlyWhileItDoesWhatItWasTold) {
  Bench bench{GetParam()};
  EXPECT_FALSE(well(bench));  // knows nothing yet
  bench.run(2.0);
  EXPECT_TRUE(well(bench)) << bench.planner.health(bench.now).text;  // has nothing to do
  bench.drive();
  EXPECT_TRUE(well(bench)) << bench.planner.health(bench.now).text;
  bench.set_switches({false, true});
  bench.run(1.0);
  EXPECT_FALSE(well(bench));
  bench.set_switches({});
  bench.run(2.0);
  EXPECT_TRUE(well(bench));
}

// While it brakes, stands and waits for each of the things that it may lack, at no tick is it well.
TEST_P(HealthOfOneRobot, IsNeverGoodWhileSomethingIsMissing) {
  bool Bench::*const kSwitches[] = {&Bench::send_poses, &Bench::send_scans, &Bench::send_detections};
  for (bool Bench::*const what : kSwitches) {
    Bench bench{GetParam()};
    bench.drive();
    bench.*what = false;
    bench.run(0.41);
    for (int i = 0; i < 300; ++i) {
      bench.tick();
      ASSERT_FALSE(well(bench)) << bench.reason() << ", " << i;
    }
    EXPECT_EQ(bench.planner.health(bench.now).level, Level::error);
  }
}

TEST(Health, NamesAGoalThatCannotBeReached) {
  Bench bench;
  bench.planner.set_goal({{60.0, 0.0}, std::nullopt});  // beyond the map
  bench.run(40.0);
  EXPECT_EQ(bench.planner.health(bench.now).level, Level::warn) << bench.planner.health(bench.now).text;
}

}  // namespace
}  // namespace spf::host
