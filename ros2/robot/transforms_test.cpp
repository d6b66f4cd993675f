#include "ros2/robot/transforms.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace spf_ros2 {
namespace {

using ros2::kSecond;
using ros2::Nanoseconds;
using ros2::geometry_msgs::TransformStamped;

TransformStamped transform(const std::string& child, const std::string& parent, Nanoseconds time, double x,
                           double heading = 0.0) {
  TransformStamped result;
  result.header.frame_id = parent;
  result.header.stamp = ros2::time_of(time);
  result.child_frame_id = child;
  result.transform.translation.x = x;
  result.transform.rotation.z = std::sin(0.5 * heading);
  result.transform.rotation.w = std::cos(0.5 * heading);
  return result;
}

TEST(Transforms, LeadUpAndDownTheTree) {
  Transforms transforms;
  ASSERT_TRUE(transforms.add(transform("base", "map", kSecond, 2.0, M_PI_2), false));
  ASSERT_TRUE(transforms.add(transform("laser", "/base", 0, 0.5), true));
  ASSERT_TRUE(transforms.add(transform("camera", "base", 0, -0.5), true));
  const auto laser = transforms.find("laser", "map", kSecond);
  ASSERT_TRUE(laser) << laser.refusal;
  EXPECT_TRUE(laser->pose.position.isApprox(Eigen::Vector3d{2.0, 0.5, 0.0}, 1e-12));
  EXPECT_FALSE(laser->never_changes);
  const auto back = transforms.find("map", "laser", kSecond);
  ASSERT_TRUE(back);
  EXPECT_TRUE((back->pose * laser->pose).position.isZero(1e-12));
  const auto across = transforms.find("camera", "laser", std::nullopt);
  ASSERT_TRUE(across);
  EXPECT_TRUE(across->pose.position.isApprox(Eigen::Vector3d{-1.0, 0.0, 0.0}, 1e-12));
  EXPECT_TRUE(across->never_changes);
}

TEST(Transforms, AreInterpolatedAndElseTheNewest) {
  Transforms transforms;
  for (const int second : {3, 1, 2})  // they may overtake each other
    ASSERT_TRUE(
        transforms.add(transform("base", "map", second * kSecond, 10.0 * second, 0.2 * second), false));
  const auto between = transforms.find("base", "map", kSecond * 5 / 2);
  ASSERT_TRUE(between);
  EXPECT_NEAR(between->pose.position.x(), 25.0, 1e-9);
  EXPECT_NEAR(2.0 * std::atan2(between->pose.orientation.z(), between->pose.orientation.w()), 0.5, 1e-9);
  EXPECT_EQ(between->time, kSecond * 5 / 2);
  for (const Nanoseconds unknown : {kSecond / 2, 4 * kSecond}) {
    const auto newest = transforms.find("base", "map", unknown);
    ASSERT_TRUE(newest);
    EXPECT_EQ(newest->time, 3 * kSecond);
    EXPECT_NEAR(newest->pose.position.x(), 30.0, 1e-9);
  }
}

TEST(Transforms, BeginAnewWhenTheClockJumpsBack) {
  Transforms transforms;
  ASSERT_TRUE(transforms.add(transform("base", "map", 100 * kSecond, 1.0), false));
  ASSERT_TRUE(transforms.add(transform("base", "map", 5 * kSecond, 2.0), false));
  const auto found = transforms.find("base", "map", std::nullopt);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->time, 5 * kSecond);
}

TEST(Transforms, WhatIsNoneIsRefused) {
  Transforms transforms;
  EXPECT_FALSE(transforms.add(transform("base", "base", 0, 0.0), false));
  EXPECT_FALSE(transforms.add(transform("", "map", 0, 0.0), false));
  EXPECT_FALSE(transforms.add(transform("base", "map", 0, std::numeric_limits<double>::quiet_NaN()), false));
  TransformStamped unturned = transform("base", "map", 0, 0.0);
  unturned.transform.rotation.w = 0.0;
  EXPECT_FALSE(transforms.add(unturned, false));
  EXPECT_EQ(transforms.find("base", "map", std::nullopt).refusal, "no transform leads from 'base' to 'map'");
}

TEST(Transforms, CirclesAndFloodsAreBounded) {
  Transforms transforms;
  ASSERT_TRUE(transforms.add(transform("a", "b", 0, 1.0), true));
  ASSERT_TRUE(transforms.add(transform("b", "a", 0, 1.0), true));
  (void)transforms.find("a", "c", std::nullopt);
  for (std::size_t i = 0; i < Transforms::kMostFrames + 10; ++i)
    (void)transforms.add(transform("f" + std::to_string(i), "map", 0, 1.0), true);
  EXPECT_FALSE(transforms.add(transform("another", "map", 0, 1.0), true));
  EXPECT_TRUE(transforms.add(transform("f1", "map", 0, 2.0), true));
}

}  // namespace
}  // namespace spf_ros2
