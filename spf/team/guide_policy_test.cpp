#include "spf/team/guide_policy.hpp"

#include <gtest/gtest.h>

#include "spf/team/ideal_host_test.hpp"

namespace spf {
namespace {

const std::vector<TrueBox> kRing{{{2.0, -2.0}, {6.0, -1.5}},
                                 {{2.0, 1.5}, {6.0, 2.0}},
                                 {{2.0, -2.0}, {2.5, 2.0}},
                                 {{5.5, -2.0}, {6.0, 2.0}}};
const Eigen::Vector2d kHere{-4.0, 0.0};
const Eigen::Vector2d kGoal{4.0, 0.0};

WorldSnapshot on(const OccupancyMap& map) {
  WorldSnapshot world;
  world.map = &map;
  return world;
}

/// From `time` on, ten times a second; the number of calls until the guide has changed, 0: it has not.
int refresh_until_done(GuidePolicy& guide, double time, const OccupancyMap& map) {
  const double before = guide.cost_to_go().cost_to_go(kHere);
  for (int call = 1; call <= 100; ++call) {
    guide.refresh(time + 0.1 * (call - 1), on(map), kGoal, kHere);
    if (guide.cost_to_go().cost_to_go(kHere) != before) return call;
  }
  return 0;
}

TEST(GuidePolicy, LeadsToTheGoalAndFollowsANewOneAtOnce) {
  GuidePolicy guide{AgentParameters{}, {true}, 0.0};
  const OccupancyMap map = empty_map();
  guide.refresh(0.0, on(map), kGoal, kHere);
  EXPECT_NEAR(guide.cost_to_go().cost_to_go(kHere), 8.0, 1e-3);
  guide.refresh(0.01, on(map), {0.0, 3.0}, kHere);
  EXPECT_NEAR(guide.cost_to_go().cost_to_go(kHere), 5.0, 1e-3);
  EXPECT_FALSE(guide.goal_out_of_reach(kHere));
}

TEST(GuidePolicy, FollowsAMapThatBlocksItsWayAfterOnePeriodAndOneThatDoesNotLater) {
  for (const bool blocks : {true, false}) {
    GuidePolicy guide{AgentParameters{}, {true}, 0.0};
    OccupancyMap map = empty_map();
    guide.refresh(0.0, on(map), kGoal, kHere);
    if (blocks)
      map.add_box({-1.0, -1.0}, {1.0, 1.0});
    else
      map.add_box({-1.0, 6.0}, {1.0, 8.0});
    const Eigen::Vector2d behind{0.0, blocks ? 0.0 : 7.0};
    const double before = guide.cost_to_go().cost_to_go(behind);
    const double period = blocks ? GuidePolicy::kPeriod : GuidePolicy::kIdlePeriod;
    guide.refresh(period - 0.05, on(map), kGoal, kHere);
    EXPECT_EQ(guide.cost_to_go().cost_to_go(behind), before) << blocks;
    for (int call = 0; call < 60; ++call) guide.refresh(period + 1e-3 * call, on(map), kGoal, kHere);
    EXPECT_NE(guide.cost_to_go().cost_to_go(behind), before) << blocks;
  }
}

TEST(GuidePolicy, LeadsAsNearToAWalledInGoalAsAWayDoesWhereTheMethodWantsThat) {
  const OccupancyMap map = map_of(kRing);
  GuidePolicy guide{AgentParameters{}, {true}, 0.0};
  guide.refresh(0.0, on(map), kGoal, kHere);
  EXPECT_TRUE(guide.cut_off());
  EXPECT_TRUE(guide.goal_out_of_reach(kHere));
  const Eigen::Vector2d end = guide.cost_to_go().goal_used();
  EXPECT_GT(kRing[2].distance(end), 0.3);
  EXPECT_LT(kRing[2].distance(end), 0.7);
  EXPECT_TRUE(guide.cost_to_go().reachable(kHere));
}

TEST(GuidePolicy, FollowsAChangedMapInSlicesAndLeadsAsBeforeMeanwhile) {
  GuidePolicy guide{AgentParameters{}, {true}, 0.0};
  OccupancyMap map = empty_map();
  guide.refresh(0.0, on(map), kGoal, kHere);
  map.add_box({-1.0, -4.0}, {1.0, 4.0});
  const int calls = refresh_until_done(guide, 1.0, map);
  EXPECT_GT(calls, 2);
  EXPECT_LT(calls, 40);
  CostToGo at_once{AgentParameters{}.guide, AgentParameters{}.robot.radius};
  at_once.update(map, kGoal, kHere);
  for (const Eigen::Vector2d& position : {kHere, Eigen::Vector2d{0.0, 4.5}, Eigen::Vector2d{-3.0, 2.0}})
    EXPECT_EQ(guide.cost_to_go().cost_to_go(position), at_once.cost_to_go(position));
}

TEST(GuidePolicy, HurriesWhenTheWayIsBlockedWhileAnUpdateIsUnderWay) {
  int calls[2];
  for (const bool blocks : {false, true}) {
    GuidePolicy guide{AgentParameters{}, {true}, 0.0};
    OccupancyMap map = empty_map();
    guide.refresh(0.0, on(map), kGoal, kHere);
    map.add_box({-4.5, 1.0}, {-3.5, 8.0});
    guide.refresh(GuidePolicy::kIdlePeriod, on(map), kGoal, kHere);
    const Eigen::Vector2d behind{-9.0, 4.0};  // from where the way leads round that box
    const double before = guide.cost_to_go().cost_to_go(behind);
    if (blocks) map.add_box({-1.0, -1.0}, {1.0, 1.0});
    int& count = calls[blocks ? 1 : 0] = 1;
    for (; count < 100 && guide.cost_to_go().cost_to_go(behind) == before; ++count)
      guide.refresh(GuidePolicy::kIdlePeriod + 0.01 * count, on(map), kGoal, kHere);
  }
  EXPECT_LT(calls[0], 100);
  EXPECT_LT(calls[1], calls[0]);
}

TEST(GuidePolicy, AGoalThatIsWalledInLaterIsApproachedToo) {
  GuidePolicy guide{AgentParameters{}, {true}, 0.0};
  guide.refresh(0.0, on(empty_map()), kGoal, kHere);
  const OccupancyMap map = map_of(kRing);
  EXPECT_GT(refresh_until_done(guide, 1.0, map), 0);
  EXPECT_TRUE(guide.cut_off());
  EXPECT_TRUE(guide.cost_to_go().reachable(kHere));
  EXPECT_EQ(guide.access(kGoal), GoalAccess::cut_off);
  for (int call = 0; call < 100; ++call) guide.refresh(20.0 + 0.1 * call, on(empty_map()), kGoal, kHere);
  EXPECT_FALSE(guide.cut_off());  // it opens again
}

TEST(GuidePolicy, LeavesAWalledInGoalToAMethodThatStands) {
  GuidePolicy guide{AgentParameters{}, {false}, 0.0};
  guide.refresh(0.0, on(map_of(kRing)), kGoal, kHere);
  EXPECT_FALSE(guide.cut_off());
  EXPECT_EQ(guide.cost_to_go().outcome(), CostToGoOutcome::unreachable);
  EXPECT_TRUE(guide.goal_out_of_reach(kHere));
}

TEST(GuidePolicy, AGoalOnBlockedGroundIsOutOfReachOnlyForARobotThatIsAsNearAsItGets) {
  GuidePolicy guide{AgentParameters{}, {true}, 0.0};
  guide.refresh(0.0, on(map_of({{{3.0, -1.0}, {5.0, 1.0}}})), {3.2, 0.0}, kHere);
  ASSERT_EQ(guide.cost_to_go().outcome(), CostToGoOutcome::goal_moved);
  EXPECT_FALSE(guide.goal_out_of_reach(kHere));
  EXPECT_TRUE(guide.goal_out_of_reach(guide.cost_to_go().goal_used()));
}

TEST(GuidePolicy, SaysHowTheMapLetsTheRobotComeToItsGoal) {
  GuidePolicy guide{AgentParameters{}, {true}, 0.0};
  EXPECT_FALSE(guide.access(kGoal).has_value());
  guide.refresh(0.0, on(empty_map()), kGoal, kHere);
  EXPECT_EQ(guide.access(kGoal), GoalAccess::open);
  EXPECT_FALSE(guide.access({0.0, 0.0}).has_value());  // it leads elsewhere
  guide.refresh(10.0, on(map_of({{{3.0, -1.0}, {5.0, 1.0}}})), {3.2, 0.0}, kHere);
  EXPECT_EQ(guide.access({3.2, 0.0}), GoalAccess::blocked);
  for (const bool approaches : {true, false}) {
    GuidePolicy of_method{AgentParameters{}, {approaches}, 0.0};
    of_method.refresh(0.0, on(map_of(kRing)), kGoal, kHere);
    EXPECT_EQ(of_method.access(kGoal), GoalAccess::cut_off) << approaches;
  }
}

TEST(GuidePolicy, TakesAnotherClearanceAtOnce) {
  AgentParameters parameters;
  GuidePolicy guide{parameters, {true}, 0.0};
  const OccupancyMap map = map_of({{{-0.5, 0.7}, {0.5, 10.0}}, {{-0.5, -10.0}, {0.5, -0.7}}});
  guide.refresh(0.0, on(map), kGoal, kHere);  // a gap of 1.4 m
  EXPECT_EQ(guide.access(kGoal), GoalAccess::open);
  parameters.guide.clearance = 0.5;
  guide.reconfigure(parameters, {true});
  EXPECT_FALSE(guide.access(kGoal).has_value());
  guide.refresh(0.01, on(map), kGoal, kHere);
  EXPECT_EQ(guide.access(kGoal), GoalAccess::cut_off);
}

TEST(GuidePolicy, HandsOnWhatStandsSoNearToThePathThatTheRobotSlowsDownBesideIt) {
  const OccupancyMap map = empty_map();
  const auto handed_on = [&](double beside) {
    std::vector<ObstacleTrack> tracks(1);
    tracks[0].state.position_world = {0.0, beside};
    tracks[0].state.radius = 0.3;
    tracks[0].stood = 60.0;
    WorldSnapshot world = on(map);
    world.tracks = &tracks;
    GuidePolicy guide{AgentParameters{}, {true, true}, 0.0};
    for (int call = 0; call <= 100; ++call) guide.refresh(0.1 * call, world, kGoal, kHere);
    return guide.cost_to_go().standing().size();
  };
  EXPECT_EQ(handed_on(0.55), 1U);  // both radii are 0.6 m
  EXPECT_EQ(handed_on(0.66), 1U);
  EXPECT_EQ(handed_on(0.8), 0U);
}

}  // namespace
}  // namespace spf
