// There and back: what a message carries comes out as it went in; what cannot be used is refused by name.
#include "spf_empc_ros/conversions.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "spf/math/angles.hpp"
#include "spf/math/random_stream.hpp"
#include "spf_empc_ros/display.hpp"

namespace spf_empc_ros {
namespace {

const ClockEdge kClock{ros::Time{1700000000, 5}};

spf::TrajectoryMessage some_message(spf::RandomStream& random) {
  spf::Trajectory trajectory{random.uniform(-5.0, 50.0)};
  const int pieces = 1 + static_cast<int>(random.uniform(0.0, 31.99));
  for (int i = 0; i < pieces; ++i) {
    spf::QuinticPiece piece;
    piece.duration = random.uniform(0.01, 2.0);
    for (double& coefficient : piece.coefficients.reshaped()) coefficient = random.normal();
    trajectory.append(piece);
  }
  trajectory.set_heading(spf::HeadingProfile{trajectory.start_time(),
                                             {random.uniform(-3.0, 3.0), random.normal()},
                                             random.uniform(-3.0, 3.0),
                                             1.5,
                                             3.0});
  spf::TrajectoryMessage message;
  message.robot_id = static_cast<int>(random.uniform(0.0, 1e6));
  message.sequence = static_cast<std::uint32_t>(random.uniform(0.0, 4e9));
  message.priority = static_cast<int>(random.uniform(0.0, 1e6));
  message.sent_time = random.uniform(0.0, 100.0);
  message.expiry_time = message.sent_time + 1.5;
  message.radius = random.uniform(0.1, 1.0);
  message.position_sigma = random.uniform(0.0, 0.1);
  message.state = static_cast<spf::PeerState>(static_cast<int>(random.uniform(0.0, 3.99)));
  if (random.uniform(0.0, 1.0) < 0.5)
    message.claim = spf::PassageClaim{{random.normal(), 2.0},
                                      {random.normal(), 3.0},
                                      message.sent_time - 1.0,
                                      random.uniform(0.0, 1.0) < 0.5,
                                      random.uniform(0.0, 1.0) < 0.5};
  message.trajectory = trajectory;
  return message;
}

TEST(Clock, ThereAndBackToTheNanosecond) {
  for (const double seconds : {0.0, 1e-9, 0.5, 12345.123456789, -3.25})
    EXPECT_NEAR(kClock.seconds(kClock.time(seconds)), seconds, 1e-9);
  EXPECT_EQ(kClock.time(0.25), (ros::Time{1700000000, 250000000}));
  EXPECT_EQ(kClock.time(0.9999999999), (ros::Time{1700000001, 0}));
  EXPECT_TRUE(kClock.time(NAN).isZero());
  EXPECT_TRUE(kClock.time(-1e12).isZero());
  EXPECT_EQ(kClock.time(1e12), ros::TIME_MAX);
}

TEST(Conversions, TrajectoryThereAndBack) {
  spf::RandomStream random{1};
  for (int i = 0; i < 50; ++i) {
    const spf::TrajectoryMessage sent = some_message(random);
    const auto told = from_message(to_message({sent, sent.sent_time - 0.1}, kClock, "map"), kClock, "/map");
    ASSERT_TRUE(told) << told.refusal;
    const spf::TrajectoryMessage& got = told->message;
    EXPECT_EQ(got.robot_id, sent.robot_id);
    EXPECT_EQ(got.sequence, sent.sequence);
    EXPECT_EQ(got.priority, sent.priority);
    EXPECT_NEAR(got.sent_time, sent.sent_time, 1e-9);
    EXPECT_NEAR(got.expiry_time, sent.expiry_time, 1e-9);
    EXPECT_NEAR(*told->observed, sent.sent_time - 0.1, 1e-9);
    EXPECT_EQ(got.radius, sent.radius);
    EXPECT_EQ(got.position_sigma, sent.position_sigma);
    EXPECT_EQ(got.state, sent.state);
    ASSERT_EQ(got.claim.has_value(), sent.claim.has_value());
    if (sent.claim) {
      EXPECT_EQ(got.claim->entry_world, sent.claim->entry_world);
      EXPECT_EQ(got.claim->exit_world, sent.claim->exit_world);
      EXPECT_EQ(got.claim->inside, sent.claim->inside);
      EXPECT_EQ(got.claim->waits, sent.claim->waits);
      EXPECT_NEAR(got.claim->since, sent.claim->since, 1e-9);
    }
    ASSERT_EQ(got.trajectory.piece_count(), sent.trajectory.piece_count());
    EXPECT_NEAR(got.trajectory.start_time(), sent.trajectory.start_time(), 1e-9);
    for (int k = 0; k < sent.trajectory.piece_count(); ++k) {
      EXPECT_EQ(got.trajectory.piece(k).coefficients, sent.trajectory.piece(k).coefficients);
      EXPECT_EQ(got.trajectory.piece(k).duration, sent.trajectory.piece(k).duration);
    }
    const spf::HeadingPhases a = sent.trajectory.heading().phases();
    const spf::HeadingPhases b = got.trajectory.heading().phases();
    EXPECT_EQ(a.initial_heading, b.initial_heading);
    EXPECT_EQ(a.target_heading, b.target_heading);
    EXPECT_EQ(a.initial_rate, b.initial_rate);
    EXPECT_EQ(a.cruise_rate, b.cruise_rate);
    EXPECT_EQ(a.ramp_in, b.ramp_in);
    EXPECT_EQ(a.cruise, b.cruise);
    EXPECT_EQ(a.ramp_out, b.ramp_out);
  }
}

TEST(Conversions, NameWhyATrajectoryIsRefused) {
  spf::RandomStream random{2};
  const spf_empc_msgs::Trajectory good = to_message({some_message(random), {}}, kClock, "map");
  ASSERT_TRUE(from_message(good, kClock, "map"));
  const auto refusal = [&](auto spoil) {
    spf_empc_msgs::Trajectory bad = good;
    spoil(bad);
    return from_message(bad, kClock, "map").refusal;
  };
  using Message = spf_empc_msgs::Trajectory;
  EXPECT_EQ(refusal([](Message& m) { m.header.frame_id = "odom"; }),
            "its frame is 'odom', the fleet's is 'map'");
  EXPECT_EQ(refusal([](Message& m) { m.durations.clear(); }), "durations is empty");
  EXPECT_NE(refusal([](Message& m) { m.coefficients.pop_back(); }).find("coefficients has"),
            std::string::npos);
  EXPECT_NE(refusal([](Message& m) { m.durations.push_back(1.0); }).find("coefficients has"),
            std::string::npos);
  EXPECT_EQ(refusal([](Message& m) { m.durations[0] = -1.0; }), "a duration is not above 0");
  EXPECT_EQ(refusal([](Message& m) { m.durations[0] = NAN; }), "a duration is not above 0");
  EXPECT_EQ(refusal([](Message& m) { m.coefficients[3] = INFINITY; }), "a coefficient is not finite");
  EXPECT_EQ(refusal([](Message& m) {
              m.durations.assign(33, 1.0);
              m.coefficients.assign(33 * 12, 0.0);
            }),
            "durations has 33 entries, more than 32");
  EXPECT_EQ(refusal([](Message& m) { m.state = 9; }), "state is none that is known");
  EXPECT_EQ(refusal([](Message& m) { m.radius = NAN; }), "radius is not above 0");
  EXPECT_EQ(refusal([](Message& m) { m.position_sigma = -1.0; }), "position_sigma is negative or not finite");
  EXPECT_EQ(refusal([](Message& m) { m.robot_id = 4000000000U; }), "robot_id is too large");
  const std::string turn = "its heading does not turn to its target";
  EXPECT_EQ(refusal([](Message& m) { m.heading_target += 0.1; }), turn);
  EXPECT_EQ(refusal([](Message& m) { m.heading_phases[0] = -1.0; }), turn);
  EXPECT_EQ(refusal([](Message& m) { m.yaw_rate_cruise = NAN; }), turn);
}

TEST(Conversions, PoseThereAndBackAndRefused) {
  for (double heading = -3.1; heading < 3.14; heading += 0.2) {
    const auto pose = from_message(to_message(spf::Pose2{{1.0, -2.0}, heading}));
    ASSERT_TRUE(pose);
    EXPECT_NEAR(pose->heading, heading, 1e-12);
    EXPECT_EQ(pose->position_world, (Eigen::Vector2d{1.0, -2.0}));
  }
  geometry_msgs::Pose empty;
  EXPECT_EQ(from_message(empty).refusal, "its orientation is no unit quaternion");
  geometry_msgs::Pose nowhere = to_message(spf::Pose2{});
  nowhere.position.x = NAN;
  EXPECT_EQ(from_message(nowhere).refusal, "its position is not finite");
}

TEST(Conversions, ScanThereAndBackAndRefused) {
  spf::RangeScan scan;
  scan.angle_min = -1.5;
  scan.angle_increment = 0.01;
  scan.max_range = 8.0;
  for (int i = 0; i < 301; ++i) scan.ranges.push_back(i % 7 == 0 ? INFINITY : 0.5 + 0.01 * i);
  sensor_msgs::LaserScan message = to_message(scan);
  const auto back = from_message(message);
  ASSERT_TRUE(back) << back.refusal;
  ASSERT_EQ(back->ranges.size(), scan.ranges.size());
  for (std::size_t i = 0; i < scan.ranges.size(); ++i)
    EXPECT_EQ(back->ranges[i], static_cast<float>(scan.ranges[i]));
  message.ranges.resize(250);
  EXPECT_EQ(from_message(message).refusal, "ranges has 250 entries, its angles give 301");
  message.ranges.clear();
  EXPECT_EQ(from_message(message).refusal, "ranges is empty");
  message = to_message(scan);
  message.angle_increment = 0.0F;
  EXPECT_FALSE(from_message(message));
  message = to_message(scan);
  message.range_max = NAN;
  EXPECT_EQ(from_message(message).refusal, "range_min or range_max is not a range");
}

TEST(Conversions, AScanOfADriverKeepsItsDurationAndItsMount) {
  sensor_msgs::LaserScan message;
  message.angle_min = -1.0F;
  message.angle_increment = 0.5F;
  message.angle_max = 1.0F;
  message.range_min = 0.1F;
  message.range_max = 8.0F;
  message.time_increment = 0.01F;
  message.ranges = {1.0F, 0.0F, NAN, INFINITY, 0.05F};
  geometry_msgs::Pose mount = to_message(spf::Pose2{{-0.2, 0.1}, 0.0});
  mount.orientation.w = 0.0;
  mount.orientation.x = 1.0;  // roll pi
  const auto driver = driver_scan(message, mount);
  ASSERT_TRUE(driver) << driver.refusal;
  EXPECT_TRUE(driver->mount.upside_down);
  EXPECT_NEAR(driver->mount.in_body.position_world.x(), -0.2, 1e-12);
  EXPECT_NEAR(driver->duration, 0.05, 1e-6);
  EXPECT_NEAR(driver->min_range, 0.1, 1e-6);
  EXPECT_EQ(driver->scan.ranges[1], 0.0);  // as they come
  EXPECT_TRUE(std::isnan(driver->scan.ranges[2]));
  mount.orientation.x = mount.orientation.w = std::sqrt(0.5);  // on its side
  EXPECT_EQ(driver_scan(message, mount).refusal,
            "its scanner is not mounted level: neither upright nor upside down");
}

TEST(Conversions, ObstaclesAreMovedIntoTheFleetsFrame) {
  spf::ObstacleTrack track;
  track.id = 4;
  track.time = 12.5;
  track.state = {{2.0, 0.0}, {0.5, 0.0}, 0.4};
  track.position_variance = 0.04;
  track.velocity_variance = 0.09;
  track.cross_covariance = 0.01;
  spf_empc_msgs::ObstacleTracks message = to_message(std::vector<spf::ObstacleTrack>{track}, kClock, "map");
  EXPECT_EQ(message.tracks[0].covariance[0], 0.04);
  EXPECT_EQ(message.tracks[0].covariance[5], 0.04);
  EXPECT_EQ(message.tracks[0].covariance[10], 0.09);
  EXPECT_EQ(message.tracks[0].covariance[15], 0.09);
  EXPECT_EQ(message.tracks[0].covariance[2], 0.01);   // x, vx
  EXPECT_EQ(message.tracks[0].covariance[8], 0.01);   // vx, x
  EXPECT_EQ(message.tracks[0].covariance[7], 0.01);   // y, vy
  EXPECT_EQ(message.tracks[0].covariance[13], 0.01);  // vy, y
  const auto moved = from_message(message, spf::Pose2{{1.0, 1.0}, 0.5 * spf::kPi});
  ASSERT_TRUE(moved) << moved.refusal;
  EXPECT_NEAR(((*moved)[0].position_world - Eigen::Vector2d{1.0, 3.0}).norm(), 0.0, 1e-12);
  EXPECT_NEAR((*(*moved)[0].velocity_world - Eigen::Vector2d{0.0, 0.5}).norm(), 0.0, 1e-12);
  EXPECT_NEAR((*moved)[0].position_sigma, 0.2, 1e-12);
  message.tracks[0].covariance[10] = -1.0;
  EXPECT_FALSE((*from_message(message, spf::Pose2{}))[0].velocity_world);
  message.tracks[0].covariance[0] = NAN;
  EXPECT_EQ(from_message(message, spf::Pose2{}).refusal, "obstacle 4 has a covariance that is none");
}

TEST(Conversions, ObservationThereAndBack) {
  spf::host::SensedWorld sensed;
  sensed.has_detections = true;
  sensed.observation.time = 3.5;
  spf::Detection detection;
  detection.id = 7;
  detection.position_world = {1.0, 2.0};
  detection.velocity_world = Eigen::Vector2d{0.1, -0.2};
  detection.position_sigma = 0.05;
  sensed.observation.detections = {detection};
  sensed.observation.scan.emplace();
  sensed.observation.scan->angle_increment = 0.1;
  sensed.observation.scan->ranges.assign(30, 2.0);
  const auto back = from_message(to_message(sensed, kClock, "map"), kClock, "map");
  ASSERT_TRUE(back) << back.refusal;
  EXPECT_TRUE(back->has_detections);
  EXPECT_NEAR(back->observation.time, 3.5, 1e-9);
  ASSERT_EQ(back->observation.detections.size(), 1u);
  EXPECT_EQ(back->observation.detections[0].velocity_world, detection.velocity_world);
  EXPECT_EQ(back->observation.scan->ranges.size(), 30u);
  EXPECT_FALSE(from_message(to_message(sensed, kClock, "map"), kClock, "other"));
}

TEST(Conversions, MapThereAndBackAndRefused) {
  nav_msgs::OccupancyGrid grid;
  grid.header.frame_id = "map";
  grid.info.resolution = 0.1F;
  grid.info.width = 100;
  grid.info.height = 50;
  grid.info.origin = to_message(spf::Pose2{{-5.0, -2.5}, 0.0});
  grid.data.assign(5000, 0);
  for (std::size_t i = 40; i < 45; ++i) grid.data[25 * 100 + i] = 100;  // x in [-1, -0.5], y in [0, 0.1]
  grid.data[10 * 100 + 10] = -1;                                        // unknown is free
  const auto map = from_message(grid, "map", {});
  ASSERT_TRUE(map) << map.refusal;
  EXPECT_NEAR(map->distance({0.5, 0.05}), 1.0, 0.01);
  EXPECT_NEAR(map->distance({-0.7, -0.4}), 0.4, 0.01);
  EXPECT_NEAR(map->distance({4.5, 0.0}), 0.5, 0.01);  // the world's edge
  const nav_msgs::OccupancyGrid shown = to_message(*map, "map");
  EXPECT_EQ(shown.data.size(), shown.info.width * shown.info.height);
  // The same, turned by a quarter in its frame.
  grid.info.origin = to_message(spf::Pose2{{2.5, -5.0}, 0.5 * spf::kPi});
  const auto turned = from_message(grid, "map", {});
  ASSERT_TRUE(turned) << turned.refusal;
  EXPECT_NEAR(turned->distance({-0.05, 0.5}), 1.0, 0.05);
  grid.data.pop_back();
  EXPECT_EQ(from_message(grid, "map", {}).refusal, "data has 4999 entries, not 5000");
  grid.data.push_back(0);
  grid.info.resolution = 0.0F;
  EXPECT_EQ(from_message(grid, "map", {}).refusal, "resolution is not above 0");
  grid.info.width = 4000000000U;
  EXPECT_EQ(from_message(grid, "map", {}).refusal, "it has no cells, or too many");
  grid.header.frame_id = "odom";
  EXPECT_EQ(from_message(grid, "map", {}).refusal, "its frame is 'odom', the fleet's is 'map'");
}

TEST(Conversions, WheelSpeedsGoThereAndBackAndMustBeAsManyAsTheDriveHas) {
  const Eigen::Vector3d speeds{0.1, -1.0 / 3.0, 0.7};
  spf_empc_msgs::WheelSpeeds message = to_message(speeds, 1.5);
  EXPECT_EQ(message.limit, 1.5);
  ASSERT_TRUE(from_message(message, 3));
  EXPECT_EQ(*from_message(message, 3), speeds);
  message.speeds[1] = std::nan("");
  EXPECT_FALSE(from_message(message, 3));
  message.speeds = {0.1, 0.2};
  EXPECT_EQ(from_message(message, 3).refusal, "speeds has 2 entries, not 3");
  EXPECT_TRUE(from_message(message, 2));
}

TEST(Display, ShowsPathRobotFieldsAndTracks) {
  spf::OccupancyMap map{spf::GridFrame::covering({-10.0, -10.0}, {10.0, 10.0}, 0.1), 2.0};
  spf::RobotAgent agent{0, spf::AgentParameters{}, map, spf::Pose2{}, 1.0};
  agent.set_goal({5.0, 0.0});
  spf::Observation observation;
  observation.time = 1.0;
  observation.detections.resize(1);
  observation.detections[0].position_world = {3.0, 2.0};
  agent.observe(observation, spf::Pose2{}, 1.0);
  agent.plan(1.0, spf::StateEstimate{});
  const nav_msgs::Path path = path_message(agent.committed(), 1.0, kClock, "map");
  ASSERT_GT(path.poses.size(), 20u);
  EXPECT_NEAR(path.poses.back().pose.position.x, agent.committed().tail_position().x(), 1e-9);
  std::vector<std::string> kinds;
  for (const auto& marker : marker_message(agent, spf::Pose2{}, 1.0, kClock, "map").markers)
    kinds.push_back(marker.ns);
  for (const std::string kind : {"robot", "plan", "field", "track", "track_sigma"})
    EXPECT_NE(std::find(kinds.begin(), kinds.end(), kind), kinds.end()) << kind;
}

}  // namespace
}  // namespace spf_empc_ros
