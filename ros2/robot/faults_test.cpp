// Robots on ROS 2: what holds on every ROS, and packets that are lost.
#include "wire/robot_faults_test.hpp"
#include "wire/robot_scanner_test.hpp"

#include "ros2/robot/robot_world_test.hpp"

namespace spf::wire {

INSTANTIATE_TYPED_TEST_SUITE_P(OnRos2, RobotFaults, spf_ros2::Ros2);
INSTANTIATE_TYPED_TEST_SUITE_P(OnRos2, RobotScanner, spf_ros2::Ros2);
INSTANTIATE_TYPED_TEST_SUITE_P(OnRos2, RobotArrivals, spf_ros2::Ros2);

}  // namespace spf::wire

namespace spf_ros2 {
namespace {

TEST(LossyNetworkSlow, WithThreeOfTenPacketsLostARobotArrives) {
  const ros2::MoreSettings lossy{
      "<CycloneDDS><Domain><Internal><Test><XmitLossiness>300</XmitLossiness></Test></Internal></Domain></"
      "CycloneDDS>"};
  Program robot{robot_arguments(3)};
  World world;
  ASSERT_TRUE(world.wait_for_robots());
  for (int i = 0; i < 20; ++i) ASSERT_TRUE(world.go_on()) << i;
  for (int i = 0; i < 10 && world.base().status().goal_outcome != "reached"; ++i) {
    if (i == 0) world.base().send_goal(1.5, 0.0, 0.0);
    (void)world.tenths_until(30, [&] { return world.base().status().goal_outcome == "reached"; });
  }
  EXPECT_EQ(world.base().status().goal_outcome, "reached") << world.base().status().reason;
  EXPECT_LT((world.base().pose().position_world - Eigen::Vector2d{1.5, 0.0}).norm(), 0.15);
}

}  // namespace
}  // namespace spf_ros2
