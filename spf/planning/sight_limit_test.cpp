#include "spf/planning/sight_limit.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "spf/planning/cost_to_go.hpp"

namespace spf {
namespace {

constexpr double kQuarterTurn = 1.5707963267948966;

/// Gap that is left [m] between a robot that goes on for `reaction`, then brakes, and what comes at it.
double least_gap(double speed, double gap, double closing, double reaction, double deceleration) {
  const double standing = reaction + speed / deceleration;
  return gap - speed * reaction - 0.5 * speed * speed / deceleration - closing * standing;
}

TEST(StoppableSpeed, LeavesNoGapAndNoContact) {
  for (const double gap : {0.5, 2.0, 8.0})
    for (const double closing : {0.0, 0.5, 1.5})
      for (const double reaction : {0.0, 0.2, 0.5})
        for (const double deceleration : {0.1, 1.0, 5.0}) {
          const double speed = stoppable_speed(gap, closing, reaction, deceleration);
          if (closing * reaction >= gap)
            EXPECT_EQ(speed, 0.0);
          else
            EXPECT_NEAR(least_gap(speed, gap, closing, reaction, deceleration), 0.0, 1e-9 * gap);
        }
  EXPECT_EQ(stoppable_speed(-1.0, 0.0, 0.2, 1.0), 0.0);
  EXPECT_TRUE(std::isinf(stoppable_speed(std::numeric_limits<double>::infinity(), 1.0, 0.2, 1.0)));
}

/// A robot at the origin of a hall 40 m wide that wants to go to +x and looks ahead through a slit.
class SightLimitTest : public ::testing::Test {
 protected:
  SightLimitTest() : map{GridFrame::covering({-20.0, -20.0}, {20.0, 20.0}, 0.1), 2.0} {
    map.add_border({-20.0, -20.0}, {20.0, 20.0});
    request.goal_world = {15.0, 0.0};
  }
  /// One sweep of a full turn with a beam every degree; nothing returns within `reach`.
  void look(double reach) {
    RangeScan scan;
    scan.angle_min = -2.0 * kQuarterTurn;
    scan.angle_increment = kQuarterTurn / 90.0;
    scan.max_range = reach;
    scan.ranges.assign(360, std::numeric_limits<double>::infinity());
    map.integrate(scan, {request.head.position_world, 0.0}, {});
  }
  const SightLimit& prepared() {
    guide.update(map, request.goal_world, request.head.position_world);
    request.guide = &guide;
    request.world.map = &map;
    limit.prepare(request);
    return limit;
  }

  RobotParameters robot;
  OccupancyMap map;
  CostToGo guide{CostToGoParameters{}, 0.2};
  PlanRequest request;
  SightLimit limit{robot, 0.02};
};

TEST_F(SightLimitTest, AKnownMapAndFarSightLimitNothing) {
  EXPECT_EQ(prepared().speed(), robot.max_speed);
  EXPECT_EQ(limit.blind_share({0.0, 0.0}, {1.0, 0.0}), 0.0);
}

TEST_F(SightLimitTest, ShortSightSlowsSoThatItStandsBeforeWhateverComes) {
  request.world.sight = {1.6, 1.0, 0.2};
  const double gap = 1.6 - 0.32 - 0.3 - 0.5;  // half a metre while it starts to back off
  EXPECT_NEAR(prepared().speed(), stoppable_speed(gap, 1.0, 0.2, robot.max_acceleration), 1e-12);
  EXPECT_LT(limit.speed(), 0.6);
  request.world.sight.range = 0.3;  // less than its own radius: it crawls
  EXPECT_GT(prepared().speed(), 0.0);
  EXPECT_LT(limit.speed(), 0.1);
}

TEST_F(SightLimitTest, StandsWithinWhatBeamsHaveCrossed) {
  map.mark_unexplored();
  EXPECT_LT(prepared().speed(), 0.1);  // nothing was seen yet
  double last = limit.speed();
  for (const double reach : {0.5, 0.8, 1.1, 1.5}) {
    look(reach);
    const double speed = prepared().speed();
    EXPECT_GE(speed, last);
    const double stop = speed * 0.2 + 0.5 * speed * speed / robot.max_acceleration;
    EXPECT_LE(stop + robot.radius, reach + 0.2);  // known to a cell, and to half of something thin
    EXPECT_GE(stop + robot.radius, std::min(reach - 0.3, 1.0));  // 1 m: all that its top speed needs
    last = speed;
  }
  look(3.0);
  EXPECT_EQ(prepared().speed(), robot.max_speed);
}

TEST_F(SightLimitTest, ASingleReturnOnTheWayCounts) {
  map.mark_unexplored();
  RangeScan scan;
  scan.angle_increment = 0.01;
  scan.angle_min = -0.1;
  scan.ranges.assign(21, std::numeric_limits<double>::infinity());
  scan.ranges[10] = 1.0;
  map.integrate(scan, {}, {});
  EXPECT_GT(map.distance({1.0, 0.0}), 1.0);  // no surface yet: one return may be an error
  EXPECT_LT(prepared().speed(), robot.max_speed);
}

TEST_F(SightLimitTest, TheBlindShareIsThatOfTheStop) {
  map.mark_unexplored();
  look(2.0);
  prepared();
  EXPECT_EQ(limit.blind_share({0.0, 0.0}, {1.0, 0.0}), 0.0);  // 0.5 m and 0.32 m
  EXPECT_EQ(limit.blind_share({0.0, 0.0}, {0.0, 0.0}), 0.0);
  const double needed = 0.5 + robot.radius + 0.02;
  EXPECT_NEAR(limit.blind_share({1.8, 0.0}, {1.0, 0.0}), 1.0 - 0.2 / needed, 0.25 / needed);
  EXPECT_NEAR(limit.blind_share({5.0, 0.0}, {1.0, 0.0}), 1.0, 1e-12);
  EXPECT_EQ(limit.blind_share({1.8, 0.0}, {-1.0, 0.0}), 0.0);  // back to where it has been
}

}  // namespace
}  // namespace spf
