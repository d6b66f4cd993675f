// Values to ROS 2's messages and back, byte by byte over CDR: room wire with these messages.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <ros2_messages/geometry_msgs/Pose.hpp>
#include <ros2_messages/nav_msgs/OccupancyGrid.hpp>
#include <ros2_messages/sensor_msgs/LaserScan.hpp>
#include <ros2_messages/spf_empc_msgs/Observation.hpp>
#include <ros2_messages/spf_empc_msgs/ObstacleTracks.hpp>
#include <ros2_messages/spf_empc_msgs/Trajectory.hpp>
#include <ros2_messages/spf_empc_msgs/WheelSpeeds.hpp>

#include "ros2/messages/cdr.hpp"
#include "ros2/robot/clock_edge.hpp"
#include "wire/map.hpp"
#include "wire/sensing.hpp"
#include "wire/trajectory.hpp"

namespace spf_ros2 {
namespace {

namespace msg = ros2::spf_empc_msgs;
using spf::wire::fill;

const ClockEdge kClock{1'700'000'000'500'000'000};

template <class Message>
Message sent(const Message& message) {
  Message received;
  std::string fault;
  EXPECT_TRUE(ros2::from_cdr(ros2::to_cdr(message), received, fault)) << fault;
  return received;
}

TEST(Wire, TimesCrossToTheNanosecond) {
  EXPECT_EQ(kClock.seconds(1'700'000'000'500'000'000), 0.5);
  EXPECT_EQ(kClock.time(0.5).sec, 1'700'000'000);
  EXPECT_EQ(kClock.time(-1.25).nanosec, 750'000'000U);
  EXPECT_EQ(kClock.time(1e5 + 0.999999999).nanosec, 999'999'999U);
  EXPECT_EQ(kClock.time(std::nan("")), ros2::builtin_interfaces::Time{});
  EXPECT_EQ(kClock.time(1e300).sec, std::numeric_limits<std::int32_t>::max());
  for (const double seconds : {0.0, 1.0 / 3.0, 12345.678901234, -7.1})
    EXPECT_NEAR(kClock.seconds(kClock.time(seconds)), seconds, 1e-9);
}

spf::wire::StampedTrajectory a_trajectory() {
  spf::wire::StampedTrajectory stamped;
  stamped.observed = 4.5;
  spf::TrajectoryMessage& message = stamped.message;
  message.robot_id = 3;
  message.priority = 7;
  message.sequence = 4'000'000'000U;
  message.sent_time = 5.0;
  message.expiry_time = 6.25;
  message.radius = 0.3;
  message.position_sigma = 0.02;
  message.claim = spf::PassageClaim{{1.0, 2.0}, {3.0, 4.0}, 4.0, true, false};
  message.trajectory = spf::Trajectory{5.0};
  for (const double start : {0.0, 1.0}) {
    spf::QuinticPiece piece;
    piece.duration = 1.0;
    piece.coefficients.setZero();
    piece.coefficients(0, 0) = start;
    piece.coefficients(1, 0) = 1.0;
    message.trajectory.append(piece);
  }
  return stamped;
}

TEST(Wire, TrajectoriesGoThereAndBack) {
  const spf::wire::StampedTrajectory stamped = a_trajectory();
  msg::Trajectory message;
  fill(stamped, kClock, "map", message);
  const auto back = spf::wire::read_trajectory(sent(message), kClock, "/map");
  ASSERT_TRUE(back) << back.refusal;
  EXPECT_EQ(back->message.robot_id, 3);
  EXPECT_EQ(back->message.priority, 7);
  EXPECT_EQ(back->message.sequence, 4'000'000'000U);
  EXPECT_NEAR(back->message.expiry_time, 6.25, 1e-9);
  EXPECT_EQ(back->message.trajectory.piece_count(), 2);
  EXPECT_TRUE(back->message.trajectory.position(6.5).isApprox(Eigen::Vector2d{1.5, 0.0}, 1e-9));
  ASSERT_TRUE(back->message.claim);
  EXPECT_EQ(back->message.claim->exit_world, (Eigen::Vector2d{3.0, 4.0}));
  EXPECT_TRUE(back->message.claim->inside);
  EXPECT_NEAR(back->observed.value_or(0.0), 4.5, 1e-9);
}

TEST(Wire, TrajectoriesWithoutSenseAreRefused) {
  msg::Trajectory well;
  fill(a_trajectory(), kClock, "map", well);
  const auto refusal = [&](const std::function<void(msg::Trajectory&)>& spoil) {
    msg::Trajectory message = well;
    spoil(message);
    return spf::wire::read_trajectory(message, kClock, "map").refusal;
  };
  EXPECT_EQ(refusal([](auto&) {}), "");
  EXPECT_EQ(refusal([](auto& m) { m.header.frame_id = "odom"; }),
            "its frame is 'odom', the fleet's is 'map'");
  EXPECT_EQ(refusal([](auto& m) { m.durations.clear(); }), "durations is empty");
  EXPECT_EQ(refusal([](auto& m) { m.durations[0] = -1.0; }), "a duration is not above 0");
  EXPECT_EQ(refusal([](auto& m) { m.coefficients.pop_back(); }), "coefficients has 23 entries, not 24");
  EXPECT_EQ(refusal([](auto& m) { m.coefficients[5] = std::nan(""); }), "a coefficient is not finite");
  EXPECT_EQ(refusal([](auto& m) { m.state = 4; }), "state is none that is known");
  EXPECT_EQ(refusal([](auto& m) { m.radius = 0.0; }), "radius is not above 0");
  EXPECT_EQ(refusal([](auto& m) { m.robot_id = 3'000'000'000U; }), "robot_id is too large");
  EXPECT_EQ(refusal([](auto& m) { m.claim_entry.x = std::nan(""); }), "its claim to a passage is not finite");
  EXPECT_NE(refusal([](auto& m) { m.headings = {0.0}; }), "");
}

TEST(Wire, ObservationsGoThereAndBack) {
  spf::host::SensedWorld sensed;
  sensed.observation.time = 2.0;
  sensed.has_detections = true;
  spf::Detection person;
  person.id = -5;
  person.position_world = {1.0, 2.0};
  person.velocity_world = Eigen::Vector2d{0.5, 0.0};
  person.radius = 0.3;
  sensed.observation.detections = {person, person};
  sensed.observation.detections[1].velocity_world.reset();
  spf::RangeScan scan;
  scan.angle_min = -1.0;
  scan.angle_increment = 0.5;
  scan.max_range = 8.0;
  scan.ranges = {1.0, std::numeric_limits<double>::infinity(), 2.5, 3.0, 4.0};
  sensed.observation.scan = scan;
  msg::Observation message;
  fill(sensed, kClock, message);
  message.header.frame_id = "map";
  const auto back = spf::wire::read_observation(sent(message), kClock, "map");
  ASSERT_TRUE(back) << back.refusal;
  EXPECT_NEAR(back->observation.time, 2.0, 1e-9);
  ASSERT_EQ(back->observation.detections.size(), 2U);
  EXPECT_EQ(back->observation.detections[0].id, -5);
  EXPECT_TRUE(back->observation.detections[0].velocity_world);
  EXPECT_FALSE(back->observation.detections[1].velocity_world);
  ASSERT_TRUE(back->observation.scan);
  EXPECT_EQ(back->observation.scan->ranges[2], 2.5);
  message.scan.ranges.pop_back();
  message.scan.ranges.pop_back();
  EXPECT_EQ(spf::wire::read_observation(message, kClock, "map").refusal,
            "its scan's ranges has 3 entries, its angles give 5");
}

TEST(Wire, TracksAreMovedToTheFleetsFrame) {
  msg::ObstacleTracks tracks;
  tracks.tracks.resize(2);
  tracks.tracks[0].position.x = 1.0;
  tracks.tracks[0].velocity.x = 1.0;
  tracks.tracks[0].covariance[0] = 0.04;
  tracks.tracks[1].covariance[10] = -1.0;  // velocity unknown
  const spf::Pose2 frame{{0.0, 5.0}, M_PI_2};
  const auto seen = spf::wire::read_tracks(sent(tracks), frame);
  ASSERT_TRUE(seen) << seen.refusal;
  EXPECT_TRUE((*seen)[0].position_world.isApprox(Eigen::Vector2d{0.0, 6.0}, 1e-12));
  EXPECT_NEAR((*seen)[0].position_sigma, 0.2, 1e-12);
  EXPECT_NEAR(((*seen)[0].velocity_world.value() - Eigen::Vector2d{0.0, 1.0}).norm(), 0.0, 1e-12);
  EXPECT_FALSE((*seen)[1].velocity_world);
  tracks.tracks[1].covariance[0] = std::nan("");
  tracks.tracks[1].covariance[5] = std::nan("");
  EXPECT_FALSE(spf::wire::read_tracks(tracks, frame));
}

TEST(Wire, MapsAreReadAndShown) {
  ros2::nav_msgs::OccupancyGrid grid;
  grid.header.frame_id = "map";
  grid.info.resolution = 0.1F;
  grid.info.width = 40;
  grid.info.height = 30;
  grid.data.assign(1200, 0);
  grid.data[15 * 40 + 20] = 100;
  const auto map = spf::wire::read_map(sent(grid), "map", {});
  ASSERT_TRUE(map) << map.refusal;
  ros2::nav_msgs::OccupancyGrid shown;
  fill(*map, shown);
  EXPECT_EQ(shown.data.size(), static_cast<std::size_t>(shown.info.width) * shown.info.height);
  EXPECT_EQ(std::count(shown.data.begin(), shown.data.end(), 100) > 0, true);
  EXPECT_TRUE(spf::wire::same_cells(grid, sent(grid)));
  auto other = grid;
  other.data[3] = 100;
  EXPECT_FALSE(spf::wire::same_cells(grid, other));
  grid.data.pop_back();
  EXPECT_FALSE(spf::wire::read_map(grid, "map", {}));
  EXPECT_FALSE(spf::wire::read_map(grid, "odom", {}));
}

TEST(Wire, WheelsAreAsManyAsTheDriveHas) {
  msg::WheelSpeeds message;
  fill(spf::DriveInput{Eigen::Vector3d{0.1, -0.2, 0.3}}, 1.5, message);
  const auto back = spf::wire::read_wheels(sent(message), 3);
  ASSERT_TRUE(back) << back.refusal;
  EXPECT_EQ((*back)[1], -0.2);
  EXPECT_EQ(spf::wire::read_wheels(message, 4).refusal, "speeds has 3 entries, not 4");
  message.speeds[0] = std::nan("");
  EXPECT_EQ(spf::wire::read_wheels(message, 3).refusal, "a speed is not finite");
}

TEST(Wire, PosesArePlanar) {
  ros2::geometry_msgs::Pose pose;
  fill(spf::Pose2{{1.0, 2.0}, -3.0}, pose);
  const auto back = spf::wire::read_pose(sent(pose));
  ASSERT_TRUE(back) << back.refusal;
  EXPECT_NEAR(back->heading, -3.0, 1e-12);
  pose.orientation.w = 5.0;
  EXPECT_EQ(spf::wire::read_pose(pose).refusal, "its orientation is no unit quaternion");
  pose.position.x = std::nan("");
  EXPECT_EQ(spf::wire::read_pose(pose).refusal, "its position is not finite");
}

}  // namespace
}  // namespace spf_ros2
