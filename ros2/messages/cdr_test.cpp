#include "ros2/messages/cdr.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <ros2_messages/diagnostic_msgs/DiagnosticArray.hpp>
#include <ros2_messages/geometry_msgs/PoseStamped.hpp>
#include <ros2_messages/geometry_msgs/Twist.hpp>
#include <ros2_messages/nav_msgs/OccupancyGrid.hpp>
#include <ros2_messages/nav_msgs/Odometry.hpp>
#include <ros2_messages/nav_msgs/Path.hpp>
#include <ros2_messages/rcl_interfaces/ParameterValue.hpp>
#include <ros2_messages/rosgraph_msgs/Clock.hpp>
#include <ros2_messages/sensor_msgs/LaserScan.hpp>
#include <ros2_messages/spf_empc_msgs/Trajectory.hpp>
#include <ros2_messages/std_msgs/Header.hpp>
#include <ros2_messages/std_srvs/SetBool.hpp>
#include <ros2_messages/std_srvs/Trigger.hpp>
#include <ros2_messages/tf2_msgs/TFMessage.hpp>
#include <ros2_messages/visualization_msgs/MarkerArray.hpp>
#include <string>

namespace ros2 {
namespace {

template <class Message>
Message read_well(const Bytes& bytes) {
  Message message;
  std::string fault;
  EXPECT_TRUE(from_cdr(bytes, message, fault)) << fault;
  return message;
}

template <class Message>
std::string fault_of(const Bytes& bytes) {
  Message message;
  std::string fault;
  EXPECT_FALSE(from_cdr(bytes, message, fault));
  return fault;
}

TEST(Cdr, WritesAHeaderByteByByte) {
  std_msgs::Header header;
  header.stamp.sec = -2;
  header.stamp.nanosec = 0x01020304;
  header.frame_id = "map";
  EXPECT_EQ(to_cdr(header),
            (Bytes{0, 1, 0, 0, 0xfe, 0xff, 0xff, 0xff, 4, 3, 2, 1, 4, 0, 0, 0, 'm', 'a', 'p', 0}));
}

TEST(Cdr, AlignsFromAfterTheEncapsulation) {
  nav_msgs::OccupancyGrid grid;  // a double follows 4 + 28 bytes
  grid.header.frame_id = "m";
  grid.info.origin.position.x = 1.0;
  grid.data = {100, -1, 0};
  const Bytes bytes = to_cdr(grid);
  // header 8 + 4 + 2 (+ 2), info 8 + 4 + 4 + 4, then x at 36 - aligned to 40.
  ASSERT_EQ(bytes.size(), 4U + 40U + 56U + 4U + 3U + 1U);
  EXPECT_EQ(bytes[4 + 40 + 6], 0xf0);
  EXPECT_EQ(bytes[4 + 40 + 7], 0x3f);
  EXPECT_EQ(bytes[4 + 96], 3);
  EXPECT_EQ(bytes[4 + 101], 0xff);
}

// Sizes of what ROS 2 Jazzy's nodes sent for the same values.
TEST(Cdr, HasTheSizesOfJazzy) {
  EXPECT_EQ(to_cdr(rosgraph_msgs::Clock{}).size(), 12U);
  EXPECT_EQ(to_cdr(geometry_msgs::Twist{}).size(), 52U);
  geometry_msgs::PoseStamped pose;
  pose.header.frame_id = "map";
  EXPECT_EQ(to_cdr(pose).size(), 76U);
  nav_msgs::Odometry odometry;
  odometry.header.frame_id = "odom";
  odometry.child_frame_id = "base";
  EXPECT_EQ(to_cdr(odometry).size(), 716U);
}

TEST(Cdr, WritesARequestByteByByte) {
  std_srvs::SetBool_Request request;
  request.data = true;
  EXPECT_EQ(to_cdr(ServiceHeader{0x678e840e77fa8e2e, 1}, request),
            (Bytes{0,    1,    0,    0,                             // encapsulation
                   0x2e, 0x8e, 0xfa, 0x77, 0x0e, 0x84, 0x8e, 0x67,  // client
                   1,    0,    0,    0,    0,    0,    0,    0,     // sequence
                   1,    0,    0,    0}));
}

TEST(Cdr, WritesAReplyByteByByte) {
  std_srvs::SetBool_Response response;
  response.success = true;
  response.message = "rcl answered";
  const Bytes bytes = to_cdr(ServiceHeader{1, 2}, response);
  ASSERT_EQ(bytes.size(), 4U + 16U + 8U + 13U + 3U);
  EXPECT_EQ(bytes[24], 13);  // aligned behind the bool
  ServiceHeader header;
  std_srvs::SetBool_Response read;
  std::string fault;
  ASSERT_TRUE(from_cdr(bytes, header, read, fault)) << fault;
  EXPECT_EQ(header.client, 1U);
  EXPECT_EQ(header.sequence, 2);
  EXPECT_EQ(read.message, "rcl answered");
}

TEST(Cdr, AnEmptyMessageIsOneByte) {
  EXPECT_EQ(to_cdr(std_srvs::Trigger_Request{}), (Bytes{0, 1, 0, 0, 0, 0, 0, 0}));
}

TEST(Cdr, GoesThereAndBack) {
  spf_empc_msgs::Trajectory trajectory;
  trajectory.header.stamp.sec = 12;
  trajectory.header.frame_id = "map";
  trajectory.robot_id = 3;
  trajectory.state = spf_empc_msgs::Trajectory::ARRIVED;
  trajectory.claimed = true;
  trajectory.claim_entry.y = -0.5;
  trajectory.durations = {1.0, 2.0};
  trajectory.coefficients.assign(24, 0.25);
  trajectory.heading_phases = {0.1, 0.2, 0.3};
  const auto read = read_well<spf_empc_msgs::Trajectory>(to_cdr(trajectory));
  EXPECT_EQ(read.state, 3);
  EXPECT_EQ(read.durations, trajectory.durations);
  EXPECT_EQ(read.heading_phases, trajectory.heading_phases);
  EXPECT_EQ(read, trajectory);

  visualization_msgs::MarkerArray markers;
  markers.markers.resize(2);
  markers.markers[1].points.resize(3);
  markers.markers[1].text = "robot";
  markers.markers[1].mesh_file.data = {1, 2, 3};
  EXPECT_EQ(read_well<visualization_msgs::MarkerArray>(to_cdr(markers)), markers);

  rcl_interfaces::ParameterValue value;
  value.bool_array_value = {true, false, true};
  value.string_array_value = {"", "two"};
  value.integer_array_value = {std::numeric_limits<std::int64_t>::min()};
  const auto read_value = read_well<rcl_interfaces::ParameterValue>(to_cdr(value));
  EXPECT_EQ(read_value.bool_array_value, value.bool_array_value);
  EXPECT_EQ(read_value.string_array_value, value.string_array_value);
  EXPECT_EQ(read_value.integer_array_value, value.integer_array_value);
}

TEST(Cdr, DefaultsAreThoseOfTheDefinition) {
  EXPECT_EQ(geometry_msgs::PoseStamped{}.pose.orientation.w, 1.0);
}

TEST(Cdr, ReadsTheOtherByteOrder) {
  const auto header =
      read_well<std_msgs::Header>(Bytes{0, 0, 0, 0, 0, 0, 0, 7, 1, 2, 3, 4, 0, 0, 0, 4, 'm', 'a', 'p', 0});
  EXPECT_EQ(header.stamp.sec, 7);
  EXPECT_EQ(header.stamp.nanosec, 0x01020304U);
  EXPECT_EQ(header.frame_id, "map");
}

TEST(Cdr, TakesPaddingThatIsCountedInTheOptions) {
  Bytes bytes = to_cdr(std_srvs::Trigger_Request{});
  bytes[3] = 3;
  (void)read_well<std_srvs::Trigger_Request>(bytes);
}

TEST(Cdr, RefusesWhatIsNoPlainCdr) {
  EXPECT_EQ(fault_of<std_msgs::Header>(Bytes{0, 1}), "2 bytes, which is less than a header");
  EXPECT_EQ(fault_of<std_msgs::Header>(Bytes{0, 7, 0, 0, 0, 0, 0, 0}),
            "encapsulation 7 is not plain CDR, which is 0 or 1");
}

TEST(Cdr, NamesTheFieldThatDoesNotFit) {
  diagnostic_msgs::DiagnosticArray array;
  array.status.resize(1);
  array.status[0].values.resize(1);
  Bytes bytes = to_cdr(array);
  const std::size_t count = bytes.size() - 20;  // the number of values; two empty strings of 8 bytes follow
  ASSERT_EQ(bytes[count], 1);
  bytes[count + 3] = 0x7f;
  EXPECT_EQ(fault_of<diagnostic_msgs::DiagnosticArray>(bytes),
            "status.values: 2130706433 elements do not fit into 16 bytes");
  nav_msgs::Path path;
  bytes = to_cdr(path);
  bytes[4 + 8] = 0;
  EXPECT_EQ(fault_of<nav_msgs::Path>(bytes), "header.frame_id: a string without its final NUL");
}

TEST(Cdr, RefusesEveryPartOfAMessage) {
  sensor_msgs::LaserScan scan;
  scan.header.frame_id = "laser";
  scan.ranges.assign(20, 1.5F);
  scan.intensities = {0.5F};
  const Bytes whole = to_cdr(scan);
  for (std::size_t size = 0; size < whole.size(); ++size) {
    const Bytes part(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size));
    EXPECT_FALSE(fault_of<sensor_msgs::LaserScan>(part).empty()) << size;
  }
}

TEST(Cdr, SurvivesAnyBytes) {
  visualization_msgs::MarkerArray markers;
  markers.markers.resize(3);
  const Bytes whole = to_cdr(markers);
  for (std::size_t at = 4; at < whole.size(); ++at)
    for (const int value : {0x01, 0x7f, 0x80, 0xff}) {
      Bytes bytes = whole;
      bytes[at] = static_cast<std::uint8_t>(value);
      visualization_msgs::MarkerArray read;
      std::string fault;
      (void)from_cdr(bytes, read, fault);
      EXPECT_LE(read.markers.size(), bytes.size());
    }
}

}  // namespace
}  // namespace ros2
