#include "spf/planning/plan_judge.hpp"

#include <gtest/gtest.h>

#include "spf/planning/cost_to_go.hpp"
#include "spf/trajectory/constant_acceleration.hpp"

namespace spf {
namespace {

/// A plan that goes 4 m straight ahead at 1 m/s, from the origin, and stops there at once.
class PlanJudgeTest : public ::testing::Test {
 protected:
  PlanJudgeTest() {
    map.add_border({-10.0, -10.0}, {10.0, 10.0});
    request.goal_world = {4.0, 0.0};
    request.head.velocity_world = {1.0, 0.0};
    request.world = {0.0, 3, &map, &tracks, &peers};
    request.guide = &guide;
    result.clear();
    result.trajectory = Trajectory{0.0};
    result.trajectory.append(constant_acceleration({0.0, 0.0}, {1.0, 0.0}, {1.0, 0.0}, 4.0));
  }
  PlanOutcome judged(double until = 4.0) {
    result.blocking_track = result.blocking_peer = -1;
    guide.update(map, request.goal_world, request.head.position_world);
    judge.judge(request, until, result);
    return result.outcome;
  }
  void add_peer(int id, int priority, PeerState state) {
    Peer peer;
    peer.robot_id = id;
    peer.priority = priority;
    peer.state = state;
    peer.trajectory = Trajectory::standing({3.0, 0.0}, 0.0, 1.0);
    peers.push_back(peer);
  }

  OccupancyMap map{GridFrame::covering({-10.0, -10.0}, {10.0, 10.0}, 0.1), 2.0};
  std::vector<ObstacleTrack> tracks;
  std::vector<Peer> peers;
  CostToGo guide{CostToGoParameters{}, 0.2};
  PlanRequest request;
  PlanResult result;
  PlanJudge judge{PlannerParameters{}, RobotParameters{}};
};

TEST_F(PlanJudgeTest, PassesAPlanThatMeetsNothing) {
  EXPECT_EQ(judged(), PlanOutcome::success);
}

TEST_F(PlanJudgeTest, NamesTheObstacleThatThePlanMeetsWithinTheTimeThatCounts) {
  ObstacleTrack track;
  track.id = 17;
  track.state = {{4.0, 3.0}, {0.0, -1.0}, 0.4};  // where the plan is after 3 s
  track.state.position_world = {3.0, 3.0};
  tracks = {track};
  EXPECT_EQ(judged(), PlanOutcome::unsafe);
  EXPECT_EQ(result.blocking_track, 17);
  EXPECT_EQ(judged(1.5), PlanOutcome::success);
}

TEST_F(PlanJudgeTest, CountsPeersThatGoFirstOrStand) {
  add_peer(7, 0, PeerState::moving);  // comes after robot 3
  EXPECT_EQ(judged(), PlanOutcome::success);
  peers.clear();
  add_peer(7, -1, PeerState::moving);  // goes first by its priority
  EXPECT_EQ(judged(), PlanOutcome::unsafe);
  EXPECT_EQ(result.blocking_peer, 7);
  peers.clear();
  add_peer(7, 0, PeerState::stopped);
  EXPECT_EQ(judged(), PlanOutcome::unsafe);
}

TEST_F(PlanJudgeTest, RefusesAWayIntoAWall) {
  map.add_box({2.0, -1.0}, {3.0, 1.0});
  EXPECT_EQ(judged(), PlanOutcome::unsafe);
  EXPECT_EQ(result.blocking_track, -1);
}

TEST_F(PlanJudgeTest, SaysThatTheGoalIsCutOffAlthoughTheWayAsFarIsFree) {
  request.goal_cut_off = true;
  EXPECT_EQ(judged(), PlanOutcome::no_path);
}

TEST_F(PlanJudgeTest, StandingAtTheGoalIsTheGoalReached) {
  request.goal_world = {0.0, 0.0};
  request.head.velocity_world = {0.0, 0.0};
  result.trajectory = Trajectory::standing({0.0, 0.0}, 0.0, 1.0);
  EXPECT_EQ(judged(), PlanOutcome::goal_reached);
  request.goal_world = {1.0, 0.0};
  EXPECT_EQ(judged(), PlanOutcome::success);
}

}  // namespace
}  // namespace spf
