#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "spf/planning/cost_to_go.hpp"

namespace spf {
namespace {

constexpr double kDiscRadius = 0.3;
constexpr double kLeastMargin = 0.02;

/// 300 m by 300 m around the origin.
OccupancyMap large_map() {
  return OccupancyMap{GridFrame::covering({-150.0, -150.0}, {150.0, 150.0}, 0.2), 2.0};
}

/// Drives along the guide, which is brought up to date where it has to be; the length of the path.
double drive(CostToGo& guide, const OccupancyMap& map, Eigen::Vector2d here, const Eigen::Vector2d& goal,
             double* least_room) {
  constexpr double kStep = 0.25;
  double length = 0.0;
  while ((here - goal).norm() > kStep && length < 2000.0) {
    if (guide.outdated(map, goal, here)) guide.update(map, goal, here);
    const Eigen::Vector2d next = guide.descend(here, kStep);
    length += (next - here).norm();
    here = next;
    *least_room = std::min(*least_room, map.distance(here));
  }
  return length + (here - goal).norm();
}

TEST(CostToGoFar, LeadsRoundALongWall) {
  OccupancyMap map = large_map();
  map.add_box({-0.2, -149.0}, {0.2, 60.0});
  const Eigen::Vector2d start{-120.0, 0.0}, goal{120.0, 0.0};
  const double shortest = 2.0 * std::hypot(120.0, 60.3);
  for (const double least_margin : {kLeastMargin, 1e9}) {
    CostToGo guide{CostToGoParameters{}, kDiscRadius, least_margin};
    EXPECT_EQ(guide.update(map, goal, start), CostToGoOutcome::reachable);
    EXPECT_LT(guide.size(), 20'000);
    EXPECT_NEAR(guide.cost_to_go(start), shortest, 0.01 * shortest);
    double room = 1e9;
    EXPECT_NEAR(drive(guide, map, start, goal, &room), shortest, 0.01 * shortest);
    EXPECT_GT(room, kDiscRadius);
  }
}

TEST(CostToGoFar, FindsTheOnlyDoorHoweverCoarseTheFarFieldIs) {
  for (const double door : {-97.3, -3.1, 41.7}) {
    OccupancyMap map = large_map();
    map.add_box({-0.2, -150.0}, {0.2, door - 0.5});
    map.add_box({-0.2, door + 0.5}, {0.2, 150.0});
    const Eigen::Vector2d start{-100.0, 20.0}, goal{110.0, -30.0};
    const Eigen::Vector2d middle{0.0, door};
    const double shortest = (start - middle).norm() + (goal - middle).norm();
    CostToGo guide{CostToGoParameters{}, kDiscRadius, kLeastMargin};
    double room = 1e9;
    EXPECT_NEAR(drive(guide, map, start, goal, &room), shortest, 0.02 * shortest) << door;
    EXPECT_GT(room, kDiscRadius) << door;
  }
}

TEST(CostToGoFar, GoesOutOfATrapThatIsSmallerThanItsCells) {
  OccupancyMap map = large_map();
  map.add_box({-95.0, -4.0}, {-94.6, 4.0});  // a U around the start, open towards -x
  map.add_box({-103.0, -4.0}, {-95.0, -3.6});
  map.add_box({-103.0, 3.6}, {-95.0, 4.0});
  const Eigen::Vector2d start{-98.0, 0.5}, goal{120.0, 0.0};
  const Eigen::Vector2d corner{-103.0, 4.0};
  const double shortest = (start - Eigen::Vector2d{-103.3, 3.5}).norm() + 0.7 + (goal - corner).norm();
  CostToGo guide{CostToGoParameters{}, kDiscRadius, kLeastMargin};
  double room = 1e9;
  EXPECT_NEAR(drive(guide, map, start, goal, &room), shortest, 0.02 * shortest);
  EXPECT_GT(room, kDiscRadius);
}

TEST(CostToGoFar, SaysNoPathOnlyWhereThereIsNone) {
  OccupancyMap map = large_map();
  map.add_box({-0.2, -150.0}, {0.2, 150.0});
  CostToGo guide{CostToGoParameters{}, kDiscRadius, kLeastMargin};
  EXPECT_EQ(guide.update(map, {30.0, 0.0}, {-60.0, 0.0}), CostToGoOutcome::unreachable);
}

TEST(CostToGoFar, AFarFieldWhoseWayIsBlockedMeanwhileIsComputedAnew) {
  OccupancyMap map = large_map();
  const Eigen::Vector2d start{-120.0, 0.0}, goal{120.0, 0.0};
  CostToGo guide{CostToGoParameters{}, kDiscRadius, kLeastMargin};
  guide.update(map, goal, start);
  EXPECT_NEAR(guide.cost_to_go(start), 240.0, 0.1);
  map.add_box({-0.2, -150.0}, {0.2, 60.0});
  guide.update(map, goal, start);
  const double shortest = 2.0 * std::hypot(120.0, 60.3);
  EXPECT_NEAR(guide.cost_to_go(start), shortest, 0.01 * shortest);
  map.add_box({-0.2, -150.0}, {0.2, 150.0});
  EXPECT_EQ(guide.update(map, goal, start), CostToGoOutcome::unreachable);
}

/// The goal is near, but the path to it leaves the box around both.
TEST(CostToGoFar, KeepsTheFarFieldOfAWayThatLeavesTheBoxOfRobotAndGoal) {
  OccupancyMap map = large_map();
  map.add_box({-0.2, -100.0}, {0.2, 100.0});
  const Eigen::Vector2d start{-15.0, 0.0}, goal{15.0, 0.0};
  const double shortest = 2.0 * std::hypot(15.0, 100.3);
  CostToGo guide{CostToGoParameters{}, kDiscRadius, kLeastMargin};
  EXPECT_EQ(guide.update(map, goal, start), CostToGoOutcome::reachable);
  EXPECT_NEAR(guide.cost_to_go(start), shortest, 0.02 * shortest);
  guide.begin(map, goal, {-15.0, 4.0});
  EXPECT_TRUE(guide.advance(map, 60 * 15'000));  // a near field, no more
  double room = 1e9;
  EXPECT_NEAR(drive(guide, map, start, goal, &room), shortest, 0.02 * shortest);
  EXPECT_GT(room, kDiscRadius);
}

TEST(CostToGoFar, ANearFieldAloneIsAnewWhereTheRobotHasMovedOn) {
  const OccupancyMap map = large_map();
  const Eigen::Vector2d goal{120.0, 0.0};
  CostToGo guide{CostToGoParameters{}, kDiscRadius, kLeastMargin};
  guide.update(map, goal, {-120.0, 0.0});
  CostToGo next = guide.anew();
  next.share_far_field(guide);
  next.begin(map, goal, {-100.0, 0.0});
  EXPECT_TRUE(next.advance(map, 60 * 15'000));
  CostToGo whole = guide.anew();
  whole.begin(map, goal, {-100.0, 0.0});
  EXPECT_FALSE(whole.advance(map, 60 * 15'000));
  EXPECT_NEAR(next.cost_to_go({-100.0, 0.0}), 220.0, 1e-3);
  // A position beyond the near field still has a path.
  EXPECT_NEAR(next.cost_to_go({-60.0, 5.0}), std::hypot(180.0, 5.0), 1e-3);
  EXPECT_GT(next.direction({-60.0, 5.0}).x(), 0.9);
}

}  // namespace
}  // namespace spf
