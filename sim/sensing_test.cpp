#include "sim/sensing.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "spf/math/angles.hpp"

namespace spf::sim {
namespace {

/// Robots and dynamic obstacles at rest, ready to be looked at.
struct Scene {
  Scenario scenario;
  std::vector<DynamicObstacle> dynamic_obstacles;
  std::vector<Eigen::Vector2d> robots;
  UniformGrid grid{2.0};

  void add_robot(double x, double y) {
    robots.emplace_back(x, y);
    scenario.robots.resize(robots.size());
    grid.assign(robots);
  }
  void add_obstacle(int id, double x, double y) {
    const Eigen::Vector2d position{x, y};
    dynamic_obstacles.push_back(
        {id, false, false, 0.4, {position, position + Eigen::Vector2d{0.1, 0.0}}, {1.0, 0.0}});
  }
  Observation observe(Sensing& sensing, int robot, double time = 0.0, double share = 0.0) {
    Observation observation;
    const Pose2 pose{robots[static_cast<std::size_t>(robot)], 0.0};
    sensing.observe(robot, pose, {time, share, &dynamic_obstacles, &robots, &grid}, observation);
    return observation;
  }
};

TEST(Sensing, PoseNoiseHasTheAskedDeviationAndItsOwnStreamPerRobot) {
  Scene scene;
  scene.add_robot(0, 0);
  scene.add_robot(5, 0);
  scene.scenario.simulation.pose_noise.position_sigma = 0.5;
  scene.scenario.simulation.pose_noise.heading_sigma = 0.1;
  Sensing sensing{scene.scenario};
  const Pose2 truth{{1.0, 2.0}, 3.1};  // near the wrap
  constexpr int kDraws = 20000;
  double squares = 0.0;
  double heading_squares = 0.0;
  double product = 0.0;
  for (int i = 0; i < kDraws; ++i) {
    const PoseMeasurement a = sensing.measure_pose(0, 0.01 * i, truth);
    const PoseMeasurement b = sensing.measure_pose(1, 0.01 * i, truth);
    const Eigen::Vector2d error = a.pose_world.position_world - truth.position_world;
    const double heading_error = angle_difference(a.pose_world.heading, truth.heading);
    squares += error.squaredNorm();
    heading_squares += heading_error * heading_error;
    product += error.dot(b.pose_world.position_world - truth.position_world);
    EXPECT_LE(std::abs(a.pose_world.heading), kPi);
  }
  const double allowed = 5.0 * std::sqrt(2.0 / kDraws);  // five deviations of a variance of kDraws normals
  EXPECT_NEAR(squares / (2 * kDraws) / 0.25, 1.0, allowed);
  EXPECT_NEAR(heading_squares / kDraws / 0.01, 1.0, allowed);
  EXPECT_NEAR(product / (2 * kDraws) / 0.25, 0.0, allowed);
}

TEST(Sensing, SeamsMakeThePoseJumpAndTheJumpDecays) {
  Scene scene;
  scene.add_robot(0, 0);
  scene.scenario.seams = {{{-5.0, 0.0}, {5.0, 0.0}}};
  scene.scenario.simulation.pose_noise.seam_sigma = 0.02;
  Sensing sensing{scene.scenario};
  const auto error_at = [&](double time, double y) {
    const Pose2 truth{{0.3, y}, 0.0};
    return Eigen::Vector2d{sensing.measure_pose(0, time, truth).pose_world.position_world -
                           truth.position_world};
  };
  EXPECT_EQ(error_at(0.00, -0.1).norm(), 0.0);
  const Eigen::Vector2d jump = error_at(0.01, 0.1);  // crossed
  EXPECT_GT(jump.norm(), 0.0);
  EXPECT_LT(jump.norm(), 0.1);  // five deviations
  EXPECT_LT((error_at(0.26, 0.1) - 0.5 * jump).norm(), 1e-12);
  EXPECT_LT(error_at(0.52, 0.1).norm(), 1e-12);
}

TEST(Sensing, SeesObstaclesWithinItsRangeExactlyWhereTheyAre) {
  Scene scene;
  scene.add_robot(0, 0);
  scene.add_obstacle(0, 7.85, 0);
  scene.add_obstacle(1, 8.1, 0);
  scene.add_obstacle(2, -3, 4);
  Sensing sensing{scene.scenario};
  const Observation seen = scene.observe(sensing, 0, 1.5, 0.5);
  EXPECT_EQ(seen.time, 1.5);
  EXPECT_FALSE(seen.scan);
  ASSERT_EQ(seen.detections.size(), 2U);
  EXPECT_EQ(seen.detections[0].id, 0);
  EXPECT_LT((seen.detections[0].position_world - Eigen::Vector2d{7.9, 0.0}).norm(), 1e-12);
  EXPECT_EQ(seen.detections[0].velocity_world, Eigen::Vector2d(1.0, 0.0));
  EXPECT_EQ(seen.detections[0].position_sigma, 0.0);
  EXPECT_EQ(seen.detections[1].id, 2);
}

TEST(Sensing, DetectsNobodyBehindAWallOrABody) {
  for (const DetectionQuality quality : {DetectionQuality::exact, DetectionQuality::noisy}) {
    Scene scene;
    scene.scenario.simulation.sensing.detections = quality;
    scene.add_robot(0, 0);
    scene.add_obstacle(0, 0, 3.5);     // behind the wall
    scene.add_obstacle(1, 2.0, 0);     // in the open
    scene.add_obstacle(2, 4.0, 0);     // straight behind that
    scene.add_obstacle(3, -5.5, 3.0);  // looks out past the wall's end
    scene.scenario.boxes = {{{-5.0, 1.0}, {5.0, 1.2}}};
    Sensing sensing{scene.scenario};
    std::vector<int> ids;
    for (const Detection& detection : scene.observe(sensing, 0).detections) ids.push_back(detection.id);
    EXPECT_EQ(ids, (std::vector<int>{1}));
    scene.scenario.boxes = {{{-1.5, 1.0}, {5.0, 1.2}}};
    Sensing further{scene.scenario};
    ids.clear();
    for (const Detection& detection : scene.observe(further, 0).detections) ids.push_back(detection.id);
    EXPECT_EQ(ids, (std::vector<int>{1, 3}));
  }
}

TEST(Sensing, HandsOverScansAloneWhenRobotsFindWhatMovesThemselves) {
  Scene scene;
  scene.add_robot(0, 0);
  scene.add_obstacle(0, 3.0, 0);
  scene.scenario.simulation.sensing.detections = DetectionQuality::scan;
  scene.scenario.simulation.sensing.map = MapKnowledge::known;
  Sensing sensing{scene.scenario};
  const Observation seen = scene.observe(sensing, 0);
  EXPECT_TRUE(seen.detections.empty());
  ASSERT_TRUE(seen.scan);
  EXPECT_NEAR(*std::min_element(seen.scan->ranges.begin(), seen.scan->ranges.end()), 2.6, 0.01);
}

TEST(Sensing, NoisyDetectionsAreDrawnByObstacleAloneAndHideTheVelocity) {
  Scene scene;
  scene.add_robot(0, 0);
  scene.add_obstacle(3, 2, 0);
  scene.scenario.simulation.sensing.detections = DetectionQuality::noisy;
  Sensing alone{scene.scenario};
  Sensing together{scene.scenario};
  Scene crowded = scene;
  crowded.add_obstacle(1, -2, 0);
  constexpr int kDraws = 5000;
  double squares = 0.0;
  for (int i = 0; i < kDraws; ++i) {
    const Observation one = scene.observe(alone, 0);
    const Observation two = crowded.observe(together, 0);
    ASSERT_EQ(one.detections.size(), 1U);
    ASSERT_EQ(two.detections.size(), 2U);
    EXPECT_EQ(one.detections[0].position_world, two.detections[0].position_world);
    EXPECT_FALSE(one.detections[0].velocity_world);
    EXPECT_EQ(one.detections[0].position_sigma, 0.05);
    squares += (one.detections[0].position_world - Eigen::Vector2d{2.0, 0.0}).squaredNorm();
  }
  EXPECT_NEAR(squares / (2 * kDraws) / 0.0025, 1.0, 5.0 * std::sqrt(1.0 / kDraws));  // 2 kDraws normals
}

TEST(Sensing, SeesPeersInScansAndAsDiscsOnlyWhenAsked) {
  Scene scene;
  scene.add_robot(0, 0);
  scene.add_robot(2, 0);
  scene.add_robot(0, 3);
  scene.scenario.simulation.sensing.map = MapKnowledge::sensed;
  scene.scenario.simulation.sensing.beams = 4;
  {
    Sensing sensing{scene.scenario};
    const Observation seen = scene.observe(sensing, 0);
    EXPECT_TRUE(seen.detections.empty());
    ASSERT_TRUE(seen.scan);
    EXPECT_NEAR(seen.scan->ranges[2], 1.7, 1e-12);
    EXPECT_NEAR(seen.scan->ranges[3], 2.7, 1e-12);
  }
  scene.scenario.simulation.sensing.peers_block_beams = false;
  scene.scenario.simulation.sensing.peer_detection_range = 2.5;
  Sensing sensing{scene.scenario};
  const Observation seen = scene.observe(sensing, 0);
  EXPECT_TRUE(std::isinf(seen.scan->ranges[2]));
  ASSERT_EQ(seen.detections.size(), 1U);
  EXPECT_EQ(seen.detections[0].id, kPeerDetectionId + 1);
  EXPECT_FALSE(seen.detections[0].velocity_world);
}

TEST(Crowd, FollowsTheRecordingBetweenItsSamplesOnly) {
  Scenario scenario;
  scenario.crowd = {{0.0, 4, {0.0, 0.0}}, {0.4, 4, {0.4, 0.0}}, {0.4, 9, {5.0, 5.0}},
                    {0.8, 4, {0.4, 0.8}}, {0.8, 9, {5.0, 5.4}}, {1.2, 9, {5.0, 5.8}}};
  DynamicObstacles dynamic_obstacles{scenario};
  dynamic_obstacles.advance(0.1);
  ASSERT_EQ(dynamic_obstacles.all().size(), 1U);
  EXPECT_EQ(dynamic_obstacles.all()[0].id, 4);
  EXPECT_TRUE(dynamic_obstacles.all()[0].person);
  EXPECT_LT((dynamic_obstacles.all()[0].motion.to - Eigen::Vector2d{0.2, 0.0}).norm(), 1e-12);
  dynamic_obstacles.advance(0.5);
  ASSERT_EQ(dynamic_obstacles.all().size(), 2U);
  EXPECT_LT((dynamic_obstacles.all()[0].motion.from - Eigen::Vector2d{0.4, 0.2}).norm(), 1e-12);
  EXPECT_LT((dynamic_obstacles.all()[0].velocity_world - Eigen::Vector2d{0.0, 2.0}).norm(), 1e-12);
  EXPECT_LT((dynamic_obstacles.all()[1].motion.to - Eigen::Vector2d{5.0, 5.2}).norm(), 1e-12);
  dynamic_obstacles.advance(0.9);
  ASSERT_EQ(dynamic_obstacles.all().size(), 1U);  // the first has gone
  EXPECT_EQ(dynamic_obstacles.all()[0].id, 9);
  dynamic_obstacles.advance(1.3);
  EXPECT_TRUE(dynamic_obstacles.all().empty());
}

}  // namespace
}  // namespace spf::sim
