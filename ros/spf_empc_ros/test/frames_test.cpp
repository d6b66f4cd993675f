// Transforms: right in the plane, and never used without knowing how old they are.
#include "spf_empc_ros/frames.hpp"

#include <geometry_msgs/TransformStamped.h>
#include <gtest/gtest.h>

#include <cmath>

namespace spf_empc_ros {
namespace {

geometry_msgs::TransformStamped transform(const std::string& parent, const std::string& child, double time,
                                          const spf::Pose2& pose) {
  geometry_msgs::TransformStamped message;
  message.header.stamp = ros::Time{time};
  message.header.frame_id = parent;
  message.child_frame_id = child;
  message.transform.translation.x = pose.position_world.x();
  message.transform.translation.y = pose.position_world.y();
  message.transform.rotation = to_message(pose).orientation;
  return message;
}

std_msgs::Header header(const std::string& frame, double time) {
  std_msgs::Header result;
  result.frame_id = frame;
  result.stamp = ros::Time{time};
  return result;
}

class Transforms : public ::testing::Test {
 protected:
  /// A localisation that told map -> odom ten times a second, and died at 102 s.
  Transforms() {
    for (int i = 0; i <= 20; ++i)
      buffer.setTransform(transform("map", "odom", 100.0 + 0.1 * i, {{1.0 + 0.01 * i, 2.0}, 0.5}), "test");
    buffer.setTransform(transform("base", "laser", 1.0, {{0.2, 0.0}, 0.0}), "test", true);
  }
  tf2::BufferCore buffer{ros::Duration{30.0}};
};

TEST_F(Transforms, MoveAPoseAsOfItsStamp) {
  const spf::Pose2 in_odom{{3.0, -1.0}, 0.2};
  const Converted<PlacedPose> placed =
      placed_pose(buffer, header("odom", 101.05), to_message(in_odom), "map");
  ASSERT_TRUE(placed) << placed.refusal;
  EXPECT_EQ(placed->age, 0.0);
  EXPECT_FALSE(placed->by_itself);
  const spf::Pose2 expected = compose({{1.105, 2.0}, 0.5}, in_odom);
  EXPECT_NEAR((placed->pose.position_world - expected.position_world).norm(), 0.0, 1e-9);
  EXPECT_NEAR(placed->pose.heading, 0.7, 1e-9);
}

TEST_F(Transforms, SayHowOldTheyAre) {
  for (const double late : {0.05, 0.3, 5.0}) {
    const auto placed = placed_pose(buffer, header("/odom", 102.0 + late), to_message(spf::Pose2{}), "map");
    ASSERT_TRUE(placed) << placed.refusal;
    EXPECT_NEAR(placed->age, late, 1e-6);
    EXPECT_NEAR(placed->pose.position_world.x(), 1.2, 1e-9);
  }
  // However far: a stamp may be the largest there is.
  EXPECT_GT(placement(buffer, "odom", "map", ros::TIME_MAX)->age, 4e9);
  // Before the first one was heard, too.
  EXPECT_NEAR(placement(buffer, "odom", "map", ros::Time{99.5})->age, 2.5, 1e-6);
}

TEST_F(Transforms, ThatNeverChangeHaveNoAge) {
  const Converted<Placement> mount = placement(buffer, "laser", "base", ros::Time{5000.0});
  ASSERT_TRUE(mount) << mount.refusal;
  EXPECT_TRUE(mount->by_itself);
  EXPECT_EQ(mount->age, 0.0);
  EXPECT_TRUE(placement(buffer, "map", "/map", ros::Time{5000.0})->by_itself);
}

TEST_F(Transforms, AreRefusedByName) {
  EXPECT_EQ(placement(buffer, "", "map", ros::Time{101.0}).refusal, "it has no frame_id");
  EXPECT_NE(placement(buffer, "nowhere", "map", ros::Time{101.0}).refusal.find("nowhere"), std::string::npos);
  geometry_msgs::Pose none;
  EXPECT_EQ(placed_pose(buffer, header("odom", 101.0), none, "map").refusal,
            "its orientation is no unit quaternion");
}

}  // namespace
}  // namespace spf_empc_ros
