#include "spf/planning/space_time/space_time_risk.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cmath>

#include "spf/math/random_stream.hpp"

namespace spf {
namespace {

/// A request on an empty map with the given obstacles and peers around a robot at the origin.
struct RiskScene {
  RiskScene()
      : map{GridFrame::covering(Eigen::Vector2d::Constant(-10.0), Eigen::Vector2d::Constant(10.0), 0.2),
            2.0} {}
  OccupancyMap map;
  std::vector<ObstacleTrack> tracks;
  std::vector<Peer> peers;

  [[nodiscard]] PlanRequest request() const {
    PlanRequest request;
    request.world = {0.0, 1, &map, &tracks, &peers};
    request.goal_world = {5.0, 0.0};
    return request;
  }
};

ObstacleTrack track_at(int id, const Eigen::Vector2d& position, const Eigen::Vector2d& velocity) {
  ObstacleTrack track;
  track.id = id;
  track.state.position_world = position;
  track.state.velocity_world = velocity;
  track.state.radius = 0.4;
  track.velocity_diffusion = 0.1;
  return track;
}

std::array<Eigen::Vector2d, SpaceTimeRisk::kMaxSteps + 1> standing_at(const Eigen::Vector2d& position) {
  std::array<Eigen::Vector2d, SpaceTimeRisk::kMaxSteps + 1> positions;
  positions.fill(position);
  return positions;
}

double standing_risk(const SpaceTimeRisk& risk, const Eigen::Vector2d& position) {
  return risk.along(standing_at(position), risk.steps(), position, 1e9);
}

TEST(SpaceTimeRisk, LeavesOutWhatCannotComeNear) {
  RiskScene scene;
  scene.tracks.push_back(track_at(3, {2.0, 0.0}, {0.0, 0.0}));
  scene.tracks.push_back(track_at(4, {9.5, 9.5}, {0.5, 0.5}));
  scene.tracks[1].velocity_diffusion = 0.0;
  SpaceTimeRisk risk{SpaceTimeParameters{}, 0.3, 1.0};
  risk.prepare(scene.request());
  ASSERT_EQ(risk.disc_count(), 1);
  EXPECT_EQ(risk.disc(0).id, 3);
}

TEST(SpaceTimeRisk, KeepsTheNearestWhenThereAreTooMany) {
  RiskScene scene;
  for (int i = 0; i < 200; ++i)
    scene.tracks.push_back(track_at(i, {0.01 * (200 - i) + 1.0, 0.0}, {0.0, 0.0}));
  SpaceTimeRisk risk{SpaceTimeParameters{}, 0.3, 1.0};
  risk.prepare(scene.request());
  ASSERT_EQ(risk.disc_count(), SpaceTimeRisk::kMaxDiscs);
  for (int i = 0; i < risk.disc_count(); ++i) EXPECT_GE(risk.disc(i).id, 200 - SpaceTimeRisk::kMaxDiscs);
}

// An obstacle that crosses x = 2 at t = 1: resting there then is dangerous, resting where it has been is not.
TEST(SpaceTimeRisk, KnowsWhenAnObstacleIsWhere) {
  RiskScene scene;
  scene.tracks.push_back(track_at(0, {2.0, -1.0}, {0.0, 1.0}));
  scene.tracks[0].velocity_diffusion = 0.0;
  SpaceTimeRisk risk{SpaceTimeParameters{}, 0.3, 1.0};
  risk.prepare(scene.request());
  ASSERT_EQ(risk.disc_count(), 1);
  const double discount = std::exp(-1.0 / 0.7);
  EXPECT_NEAR(risk.chance(risk.disc(0), 10, {2.0, 0.0}, 0.0), discount, 1e-9);  // 27 sigma inside
  EXPECT_EQ(risk.chance(risk.disc(0), 30, {2.0, -1.0}, 0.0), 0.0);              // it is 3 m away by then
  EXPECT_GT(standing_risk(risk, {2.0, 0.0}), 0.9 * discount);
}

TEST(SpaceTimeRisk, IsUnchangedWhenTheSceneTurns) {
  RandomStream random{11};
  for (int i = 0; i < 50; ++i) {
    const Eigen::Vector2d position = 2.0 * random.normal2();
    const Eigen::Vector2d velocity = random.normal2();
    const Eigen::Vector2d query = 2.0 * random.normal2();
    const Eigen::Rotation2Dd turn{random.uniform(-3.0, 3.0)};
    RiskScene scene;
    RiskScene turned;
    SpaceTimeParameters parameters;
    parameters.predict_bounces = false;
    scene.tracks.push_back(track_at(0, position, velocity));
    turned.tracks.push_back(track_at(0, turn * position, turn * velocity));
    SpaceTimeRisk risk{parameters, 0.3, 1.0};
    risk.prepare(scene.request());
    const double before = standing_risk(risk, query);
    risk.prepare(turned.request());
    EXPECT_NEAR(standing_risk(risk, turn * query), before, 1e-9);
  }
}

TEST(SpaceTimeRisk, CountsAPeerThatYieldsByItsWeightOnly) {
  RiskScene scene;
  Peer peer;
  peer.robot_id = 5;  // behind robot 1 in rank
  peer.state = PeerState::moving;
  peer.trajectory = Trajectory::standing({1.0, 0.0}, 0.0, 10.0);
  scene.peers.push_back(peer);
  SpaceTimeRisk risk{SpaceTimeParameters{}, 0.3, 1.0};
  risk.prepare(scene.request());
  const double yielding = standing_risk(risk, {1.0, 0.0});
  scene.peers[0].robot_id = 0;
  risk.prepare(scene.request());
  EXPECT_NEAR(yielding / standing_risk(risk, {1.0, 0.0}), SpaceTimeRisk::kLowerPriorityWeight, 1e-9);
}

TEST(SpaceTimeRisk, LetsARobotStopBesideWhatHasStoodForLong) {
  RiskScene scene;
  scene.tracks.push_back(track_at(0, {0.0, 0.0}, {0.0, 0.0}));
  SpaceTimeRisk risk{SpaceTimeParameters{}, 0.3, 1.0};
  double last = 1.0;
  for (const double stood : {0.0, 5.0, 20.0, 100.0}) {
    scene.tracks[0].stood = stood;
    scene.tracks[0].velocity_diffusion = stood > 0.0 ? 0.002 : 0.1;
    risk.prepare(scene.request());
    const double beside = standing_risk(risk, {0.8, 0.0});  // 0.1 m are left between them
    EXPECT_LT(beside, last) << stood;
    last = beside;
    EXPECT_GT(standing_risk(risk, {0.65, 0.0}), 0.4) << stood;  // they would touch
  }
  EXPECT_LT(last, 1e-4);
}

TEST(SpaceTimeRisk, PassesWhatStandsLikeAWallTheNearerTheSlower) {
  RiskScene scene;
  scene.tracks.push_back(track_at(0, {0.0, 0.0}, {0.0, 0.0}));
  scene.tracks[0].stood = 1000.0;
  scene.tracks[0].velocity_diffusion = 0.0;
  SpaceTimeRisk risk{SpaceTimeParameters{}, 0.3, 1.0};
  risk.prepare(scene.request());
  const auto passing = [&](double speed) {
    std::array<Eigen::Vector2d, SpaceTimeRisk::kMaxSteps + 1> positions;
    for (int k = 0; k <= SpaceTimeRisk::kMaxSteps; ++k)
      positions[static_cast<std::size_t>(k)] = {speed * (0.1 * k - 1.5), 0.77};
    return risk.along(positions, risk.steps(), positions.back(), 1e9);
  };
  EXPECT_LT(passing(0.1), 1e-3);
  EXPECT_GT(passing(1.0), 0.1);
}

TEST(SpaceTimeRisk, LetsRobotsParkSideBySide) {
  RiskScene scene;
  Peer peer;
  peer.robot_id = 5;
  peer.state = PeerState::arrived;
  peer.stood = 20.0;
  peer.trajectory = Trajectory::standing({0.0, 0.0}, 0.0, 10.0);
  scene.peers.push_back(peer);
  SpaceTimeRisk risk{SpaceTimeParameters{}, 0.3, 1.0};
  risk.prepare(scene.request());
  const double arrived = standing_risk(risk, {0.66, 0.0});
  EXPECT_LT(arrived, 1e-3);
  scene.peers[0].state = PeerState::stopped;  // it may go on
  scene.peers[0].stood = 1.0;
  risk.prepare(scene.request());
  EXPECT_GT(standing_risk(risk, {0.66, 0.0}), 10.0 * arrived);
}

TEST(SpaceTimeRisk, GrowsWithOwnUncertaintyOutsideTheRadius) {
  RiskScene scene;
  scene.tracks.push_back(track_at(0, {2.0, 0.0}, {0.0, 0.0}));
  SpaceTimeRisk risk{SpaceTimeParameters{}, 0.3, 1.0};
  PlanRequest request = scene.request();
  risk.prepare(request);
  const double sure = standing_risk(risk, {0.9, 0.0});
  request.position_sigma = 0.2;
  risk.prepare(request);
  EXPECT_GT(standing_risk(risk, {0.9, 0.0}), sure);
}

}  // namespace
}  // namespace spf
