#include "spf/world/standing.hpp"

#include <gtest/gtest.h>

#include "spf/world/obstacle_tracker.hpp"
#include "spf/world/peer_table.hpp"

namespace spf {
namespace {

ObstacleTrack track_that_stood(double stood, const Eigen::Vector2d& position) {
  ObstacleTrack track;
  track.state.position_world = position;
  track.stood = stood;
  return track;
}

TEST(Standing, IsWhatHasBeenInOnePlaceForAWhile) {
  const std::vector<ObstacleTrack> tracks{track_that_stood(1.0, {1.0, 0.0}),
                                          track_that_stood(10.0, {2.0, 0.0})};
  std::vector<Peer> peers(4);
  peers[0].state = PeerState::arrived;
  peers[1].state = PeerState::stopped;
  peers[2].state = PeerState::stopped;
  peers[2].stood = 8.0;
  peers[3].state = PeerState::arrived;
  peers[3].expired = true;
  for (std::size_t i = 0; i < peers.size(); ++i)
    peers[i].trajectory = Trajectory::standing({3.0 + static_cast<double>(i), 0.0}, 0.0, 1.0);
  WorldSnapshot world;
  world.tracks = &tracks;
  world.peers = &peers;
  std::vector<StandingDisc> discs;
  find_standing(world, discs);
  keep_nearest({0.0, 0.0}, discs);
  ASSERT_EQ(discs.size(), 3u);
  EXPECT_EQ(discs[0].position_world.x(), 2.0);
  EXPECT_EQ(discs[0].wait, 10.0);
  EXPECT_EQ(discs[1].position_world.x(), 3.0);
  EXPECT_GT(discs[1].wait, discs[0].wait);  // it says that it stays
  EXPECT_EQ(discs[2].position_world.x(), 5.0);
}

TEST(Standing, KeepsTheNearestWhenThereAreTooMany) {
  std::vector<ObstacleTrack> tracks;
  for (int i = 0; i < 100; ++i)
    tracks.push_back(track_that_stood(10.0, {static_cast<double>((37 * i) % 100), 0.0}));
  WorldSnapshot world;
  world.tracks = &tracks;
  std::vector<StandingDisc> discs;
  find_standing(world, discs);
  keep_nearest({0.0, 0.0}, discs);
  ASSERT_EQ(discs.size(), kMostStanding);
  EXPECT_EQ(discs.back().position_world.x(), static_cast<double>(kMostStanding - 1));
}

TEST(Standing, DiffersWhenSomethingComesGoesMovesOrStaysMuchLonger) {
  const std::vector<StandingDisc> before{{{1.0, 0.0}, 0.3, 4.0}};
  EXPECT_FALSE(differ(before, {{{1.05, 0.0}, 0.3, 6.0}}));
  EXPECT_TRUE(differ(before, {}));
  EXPECT_TRUE(differ(before, {{{1.4, 0.0}, 0.3, 4.0}}));
  EXPECT_TRUE(differ(before, {{{1.0, 0.0}, 0.3, 8.0}}));
  EXPECT_TRUE(differ(before, {{{1.0, 0.0}, 0.3, 4.0}, {{2.0, 0.0}, 0.3, 4.0}}));
}

TEST(Standing, OfATrackCountsFromWhereItStopped) {
  ObstacleTracker tracker;
  const auto watch_at = [&](double time, double x) {
    Observation observation;
    observation.time = time;
    Detection detection;
    detection.id = 3;
    detection.position_world = {x, 0.0};
    detection.position_sigma = 0.01;
    observation.detections = {detection};
    tracker.update(observation);
    return tracker.tracks().front().stood;
  };
  double x = 0.0;
  double time = 0.0;
  for (; time < 2.0; time += 0.1) EXPECT_LT(watch_at(time, x += 0.08), 0.4);
  const double stopped = time;
  for (; time < 12.0; time += 0.1) watch_at(time, x);
  EXPECT_NEAR(tracker.tracks().front().stood, time - stopped, 0.5);
  for (const double end = time + 0.5; time < end; time += 0.1) watch_at(time, x += 0.08);
  EXPECT_LT(tracker.tracks().front().stood, 0.4);
}

TEST(Standing, OfAPeerCountsWhileItSaysSo) {
  PeerTable table{1};
  std::uint32_t sequence = 0;
  const auto hear_at = [&](double time, PeerState state, double x) {
    TrajectoryMessage message;
    message.robot_id = 2;
    message.sequence = ++sequence;
    message.sent_time = time;
    message.expiry_time = time + 1.0;
    message.state = state;
    message.trajectory = Trajectory::standing({x, 0.0}, time, 1.0);
    EXPECT_EQ(table.receive(message, time), MessageVerdict::accepted);
    return table.peers(time).front().stood;
  };
  EXPECT_EQ(hear_at(100.0, PeerState::stopped, 0.0), 0.0);  // the first message, beside the world's origin
  EXPECT_NEAR(hear_at(100.9, PeerState::stopped, 0.0), 0.9, 1e-9);
  EXPECT_NEAR(hear_at(101.8, PeerState::arrived, 0.05), 1.8, 1e-9);
  EXPECT_EQ(hear_at(102.0, PeerState::arrived, 1.0), 0.0);
  EXPECT_EQ(hear_at(102.5, PeerState::moving, 1.0), 0.0);
}

}  // namespace
}  // namespace spf
