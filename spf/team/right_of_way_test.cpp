#include "spf/team/right_of_way.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "spf/planning/space_time/space_time_parameters.hpp"

namespace spf {
namespace {

const RobotParameters kRobot;

/// A wall along y at x = 0 with one passage through it, between two rooms.
OccupancyMap wall_with_passage(double width, double thickness) {
  OccupancyMap map{GridFrame::covering({-10.0, -8.0}, {10.0, 8.0}, 0.1), 2.0};
  map.add_box({-0.5 * thickness, 0.5 * width}, {0.5 * thickness, 9.0});
  map.add_box({-0.5 * thickness, -9.0}, {0.5 * thickness, -0.5 * width});
  return map;
}

/// One robot, and what it hears of others.
class Walker {
 public:
  Walker(int id, const OccupancyMap& map, const Eigen::Vector2d& goal, int priority = 0,
         bool gives_way = true)
      : id_{id}, priority_{priority}, map_{&map}, right_of_way_{kRobot, gives_way} {
    EXPECT_EQ(guide_.update(map, goal, {-goal.x(), goal.y()}), CostToGoOutcome::reachable);
  }

  void look(double time, const Eigen::Vector2d& here, const std::vector<Walker*>& others) {
    std::vector<Peer> peers;
    for (const Walker* other : others) peers.push_back(other->as_peer());
    look_at(time, here, peers);
  }
  void look_at(double time, const Eigen::Vector2d& here, const std::vector<Peer>& peers) {
    here_ = here;
    WorldSnapshot world;
    world.time = time;
    world.robot_id = id_;
    world.priority = priority_;
    world.map = map_;
    world.peers = &peers;
    right_of_way_.update(time, here, guide_, world);
  }
  [[nodiscard]] Peer as_peer() const {
    Peer peer;
    peer.robot_id = id_;
    peer.priority = priority_;
    peer.state = PeerState::moving;
    peer.stood = stood;
    peer.claim = right_of_way_.claim() ? &*right_of_way_.claim() : nullptr;
    peer.trajectory = Shared<Trajectory>{Trajectory::standing(here_, 0.0, 1.0)};
    return peer;
  }
  /// Robot number that it lets pass, -1: none.
  [[nodiscard]] int lets_pass() const {
    return right_of_way_.give_way() ? right_of_way_.give_way()->peer : -1;
  }
  [[nodiscard]] const RightOfWay& right_of_way() const { return right_of_way_; }
  [[nodiscard]] const CostToGo& guide() const { return guide_; }

  void stop() { right_of_way_.stop(); }

  double stood = 0.0;  // [s]

 private:
  int id_;
  int priority_;
  const OccupancyMap* map_;
  Eigen::Vector2d here_ = Eigen::Vector2d::Zero();
  CostToGo guide_{CostToGoParameters{}, kRobot.radius, SpaceTimeParameters{}.static_margin};
  RightOfWay right_of_way_;
};

TEST(RightOfWay, ClaimsADoorThatTwoDoNotFitThroughInTimeAndNothingWide) {
  for (const double thickness : {0.05, 0.3}) {
    const OccupancyMap narrow = wall_with_passage(0.9, thickness);
    Walker other{2, narrow, {-6.0, 0.0}};
    Walker walker{1, narrow, {6.0, 0.0}};
    walker.look(0.0, {-3.0, 0.0}, {});
    EXPECT_FALSE(walker.right_of_way().claim()) << "nobody hears it";
    walker.look(0.0, {-9.0, 0.0}, {&other});
    EXPECT_FALSE(walker.right_of_way().claim()) << "far away";
    walker.look(1.0, {-3.0, 0.0}, {&other});
    ASSERT_TRUE(walker.right_of_way().claim());
    const PassageClaim claim = *walker.right_of_way().claim();
    EXPECT_LT(claim.entry_world.x(), -0.5 * thickness);
    EXPECT_GT(claim.exit_world.x(), 0.5 * thickness);
    EXPECT_LT((claim.exit_world - claim.entry_world).norm(), thickness + 2.0);
    EXPECT_EQ(claim.since, 1.0);
    EXPECT_FALSE(claim.inside);
    walker.look(2.0, {0.0, 0.0}, {&other});
    ASSERT_TRUE(walker.right_of_way().claim());
    EXPECT_TRUE(walker.right_of_way().claim()->inside);
    EXPECT_EQ(walker.right_of_way().claim()->since, 1.0);
    walker.look(3.0, {2.0, 0.0}, {&other});
    EXPECT_FALSE(walker.right_of_way().claim()) << "it is through";
  }
  const OccupancyMap wide = wall_with_passage(2.2, 3.0);
  Walker other{2, wide, {-6.0, 0.0}};
  Walker walker{1, wide, {6.0, 0.0}};
  walker.look(0.0, {-3.0, 0.0}, {&other});
  EXPECT_FALSE(walker.right_of_way().claim());
}

TEST(RightOfWay, WhoClaimsFirstGoesAndTheOtherWaitsBesideTheMouthUntilItIsOut) {
  const OccupancyMap map = wall_with_passage(0.9, 0.3);
  Walker left{2, map, {6.0, 0.0}};
  Walker right{1, map, {-6.0, 0.0}};
  left.look(1.0, {-3.0, 0.0}, {&right});
  right.look(1.5, {3.0, 0.0}, {&left});
  EXPECT_EQ(right.lets_pass(), 2);
  const double stop = right.right_of_way().give_way()->cost_to_go;
  EXPECT_GT(stop, right.guide().cost_to_go({1.0, 0.0}));
  EXPECT_LT(stop, right.guide().cost_to_go({2.5, 0.0}));
  left.look(2.0, {-2.0, 0.0}, {&right});
  EXPECT_EQ(left.lets_pass(), -1);
  left.look(4.0, {0.0, 0.0}, {&right});
  right.look(4.0, {1.8, 0.0}, {&left});
  EXPECT_EQ(left.lets_pass(), -1);
  EXPECT_EQ(right.lets_pass(), 2);
  left.look(6.0, {1.6, 0.8}, {&right});
  right.look(6.0, {1.8, 0.0}, {&left});
  EXPECT_EQ(right.lets_pass(), -1);
}

TEST(RightOfWay, OneDirectionGoesOnForThoseWhoCameSoonAndThenTheOther) {
  const OccupancyMap map = wall_with_passage(0.9, 0.3);
  Walker first{1, map, {6.0, 0.0}};
  Walker soon{2, map, {6.0, 1.0}};
  Walker late{3, map, {6.0, -1.0}};
  Walker against{4, map, {-6.0, 0.0}};
  const std::vector<Walker*> all{&first, &soon, &late, &against};
  const auto others = [&](const Walker* self) {
    std::vector<Walker*> rest;
    for (Walker* walker : all)
      if (walker != self) rest.push_back(walker);
    return rest;
  };
  first.look(1.0, {-3.0, 0.0}, others(&first));
  against.look(1.5, {3.0, 0.0}, others(&against));
  soon.look(3.0, {-3.0, 1.0}, others(&soon));
  late.look(20.0, {-3.0, -1.0}, others(&late));
  first.look(20.0, {0.0, 0.0}, others(&first));
  for (Walker* walker : {&soon, &late, &against})
    walker->look(20.1, walker == &against ? Eigen::Vector2d{2.0, 0.0} : Eigen::Vector2d{-2.5, 0.5},
                 others(walker));
  EXPECT_EQ(soon.lets_pass(), -1) << "follows the first";
  EXPECT_EQ(late.lets_pass(), 4) << "came long after the one from the other side";
  EXPECT_EQ(against.lets_pass(), 1);
  first.look(21.0, {3.0, 0.0}, others(&first));  // out, and the next is not yet in
  for (Walker* walker : {&soon, &against})
    walker->look(21.0, walker == &against ? Eigen::Vector2d{2.0, 0.0} : Eigen::Vector2d{-1.5, 0.3},
                 others(walker));
  EXPECT_EQ(soon.lets_pass(), -1);
  EXPECT_EQ(against.lets_pass(), 2);
  soon.look(22.0, {0.0, 0.0}, others(&soon));
  against.look(22.0, {2.0, 0.0}, others(&against));
  soon.look(24.0, {3.0, 1.0}, others(&soon));
  against.look(24.0, {2.0, 0.0}, others(&against));
  late.look(24.0, {-2.5, -0.5}, others(&late));
  EXPECT_EQ(against.lets_pass(), -1);
  EXPECT_EQ(late.lets_pass(), 4);
}

TEST(RightOfWay, RobotsThatCrossAThinWallAtAnyAngleGoTheSameWay) {
  const OccupancyMap map = wall_with_passage(0.9, 0.05);
  Walker up{1, map, {2.0, 4.0}};
  Walker down{2, map, {2.0, -4.0}};
  up.look(1.0, {-2.0, -4.0}, {&down});
  down.look(1.5, {-2.0, 4.0}, {&up});
  ASSERT_TRUE(up.right_of_way().claim() && down.right_of_way().claim());
  EXPECT_EQ(down.lets_pass(), -1);
  EXPECT_EQ(up.lets_pass(), -1);
}

TEST(RightOfWay, TheMoreImportantGoesFirstAndNobodyWaitsForOneThatDoesNotGo) {
  const OccupancyMap map = wall_with_passage(0.9, 0.3);
  Walker left{1, map, {6.0, 0.0}, 5};
  Walker right{2, map, {-6.0, 0.0}, 0};
  left.look(1.0, {-3.0, 0.0}, {&right});
  right.look(1.5, {3.0, 0.0}, {&left});
  EXPECT_EQ(right.lets_pass(), -1);
  left.look(1.6, {-3.0, 0.0}, {&right});
  EXPECT_EQ(left.lets_pass(), 2);
  right.stood = 9.0;
  left.look(12.0, {-2.0, 0.0}, {&right});
  EXPECT_EQ(left.lets_pass(), -1);
}

TEST(RightOfWay, OfTwoInsideTheLaterBacksOut) {
  const OccupancyMap map = wall_with_passage(0.9, 4.0);
  Walker left{1, map, {6.0, 0.0}};
  Walker right{2, map, {-6.0, 0.0}};
  left.look(1.0, {-1.5, 0.0}, {&right});
  left.stop();  // for another cause: it is inside all the same
  right.look(1.5, {1.5, 0.0}, {&left});
  left.look(1.6, {-1.5, 0.0}, {&right});
  EXPECT_EQ(left.lets_pass(), -1);
  ASSERT_EQ(right.lets_pass(), 1);
  EXPECT_GT(right.right_of_way().give_way()->cost_to_go, right.guide().cost_to_go({2.5, 0.0}));
}

TEST(RightOfWay, NobodyWaitsInAQueueForOneWhoseTurnComesLater) {
  const OccupancyMap map = wall_with_passage(0.9, 0.3);
  Walker early{1, map, {6.0, 0.0}};
  Walker late{2, map, {6.0, 1.0}};
  Walker against{3, map, {-6.0, 0.0}};
  early.look(1.0, {-3.0, 0.0}, {&late, &against});
  against.look(4.0, {3.0, 0.0}, {&early, &late});
  late.look(15.0, {-2.5, 0.0}, {&early, &against});
  for (const double time : {15.1, 15.2}) {
    early.look(time, {-2.8, 0.5}, {&late, &against});
    late.look(time, {-2.2, 0.0}, {&early, &against});
    against.look(time, {2.5, 0.0}, {&early, &late});
  }
  EXPECT_EQ(early.lets_pass(), -1);  // though the other one is nearer
  EXPECT_EQ(late.lets_pass(), 3);
  EXPECT_EQ(against.lets_pass(), 1);
}

TEST(RightOfWay, ClaimsNothingAtItsGoalAndPromisesNothingForAMethodThatGoesOn) {
  const OccupancyMap map = wall_with_passage(0.9, 4.0);
  Walker other{2, map, {-6.0, 0.0}};
  Walker inside{1, map, {1.0, 0.0}};
  inside.look(1.0, {-1.0, 0.0}, {&other});
  EXPECT_TRUE(inside.right_of_way().claim());
  inside.look(4.0, {0.9, 0.0}, {&other});
  EXPECT_FALSE(inside.right_of_way().claim());

  Walker left{3, map, {6.0, 0.0}};
  Walker right{4, map, {-6.0, 0.0}, 0, false};
  left.look(1.0, {-3.0, 0.0}, {&right});
  right.look(1.5, {3.0, 0.0}, {&left});
  ASSERT_EQ(right.lets_pass(), 3);
  EXPECT_FALSE(right.right_of_way().claim()->waits);
}

TEST(RightOfWay, IgnoresClaimsToPassagesFarFromWhoMakesThem) {
  const OccupancyMap map = wall_with_passage(0.9, 0.3);
  Walker left{1, map, {6.0, 0.0}};
  Walker right{2, map, {-6.0, 0.0}};
  right.look(0.0, {3.0, 0.0}, {&left});
  left.look(1.0, {-3.0, 0.0}, {&right});
  EXPECT_EQ(left.lets_pass(), 2);
  Peer liar = right.as_peer();
  liar.trajectory = Shared<Trajectory>{Trajectory::standing({500.0, 0.0}, 0.0, 1.0)};
  left.look_at(1.1, {-3.0, 0.0}, {liar});
  EXPECT_EQ(left.lets_pass(), -1);
  PassageClaim long_claim = *right.right_of_way().claim();
  long_claim.entry_world.x() = 1e6;
  Peer greedy = right.as_peer();
  greedy.claim = &long_claim;
  left.look_at(1.2, {-3.0, 0.0}, {greedy});
  EXPECT_EQ(left.lets_pass(), -1);
}

TEST(RightOfWay, GoesFirstAllTheSameWhenItIsOutBeforeTheOtherCanBeThere) {
  const OccupancyMap map = wall_with_passage(0.9, 0.3);
  for (const bool far : {true, false}) {
    Walker left{2, map, {6.0, 0.0}};
    Walker right{1, map, {-6.0, 0.0}};
    left.look(0.0, {far ? -6.0 : -2.5, 0.0}, {&right});
    ASSERT_TRUE(left.right_of_way().claim());
    right.look(1.0, {1.2, 0.0}, {&left});
    ASSERT_TRUE(right.right_of_way().claim());
    EXPECT_EQ(right.lets_pass(), far ? -1 : 2);
  }
}

TEST(RightOfWay, WhenBothSidesHaveWaitedForLongTheEarlierGoes) {
  const OccupancyMap map = wall_with_passage(0.9, 0.3);
  Walker first{2, map, {6.0, 0.0}};
  Walker right{1, map, {-6.0, 0.0}};
  Walker late{3, map, {6.0, 0.0}};
  first.look(0.0, {0.0, 0.0}, {&right});
  right.look(1.0, {4.0, 0.0}, {&first});
  EXPECT_EQ(right.lets_pass(), 2);
  // One that has not seen the first go through waits for the earlier claim, which counts on it to go along.
  late.look(3.0, {-4.0, 0.0}, {&right});
  EXPECT_EQ(late.lets_pass(), 1);
  right.look(3.1, {4.0, 0.0}, {&late});
  EXPECT_EQ(right.lets_pass(), 3);
  late.stood = right.stood = 24.0;
  right.look(24.0, {4.0, 0.0}, {&late});
  EXPECT_EQ(right.lets_pass(), 3);
  late.stood = right.stood = 26.0;
  late.look(26.0, {-4.0, 0.0}, {&right});
  right.look(26.0, {4.0, 0.0}, {&late});
  EXPECT_EQ(late.lets_pass(), 1);
  EXPECT_EQ(right.lets_pass(), -1);
}

TEST(RightOfWay, OfAQueueTheNextStandsReadyAndTheOthersLeaveRoom) {
  const OccupancyMap map = wall_with_passage(0.9, 0.3);
  Walker a{1, map, {6.0, 0.0}};
  Walker b{2, map, {6.0, 0.0}};
  Walker c{3, map, {6.0, 0.0}};
  for (const double time : {0.0, 0.1}) {
    a.look(time, {-2.0, 0.0}, {&b, &c});
    b.look(time, {-3.0, 0.0}, {&a, &c});
    c.look(time, {-4.0, 0.0}, {&a, &b});
  }
  EXPECT_FALSE(a.right_of_way().give_way());
  const auto stops_before = [&](const Walker& walker) {
    const Eigen::Vector2d entry = walker.right_of_way().claim()->entry_world;
    return walker.right_of_way().give_way()->cost_to_go - walker.guide().cost_to_go(entry);
  };
  ASSERT_TRUE(b.right_of_way().give_way());
  ASSERT_TRUE(c.right_of_way().give_way());
  EXPECT_NEAR(stops_before(b), kRobot.radius, 0.1);
  EXPECT_NEAR(stops_before(c), 6.0 * kRobot.radius, 0.1);
}

}  // namespace
}  // namespace spf
