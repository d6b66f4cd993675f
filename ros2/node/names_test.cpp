#include "ros2/node/names.hpp"

#include <gtest/gtest.h>

#include <ros2_messages/nav_msgs/Odometry.hpp>
#include <ros2_messages/std_srvs/SetBool.hpp>
#include <stdexcept>

namespace ros2 {
namespace {

const NodeName kPlanner{"planner", "/robot0"};

TEST(Names, AreMadeWhole) {
  EXPECT_EQ(resolved("odom", kPlanner, {}), "/robot0/odom");
  EXPECT_EQ(resolved("/map", kPlanner, {}), "/map");
  EXPECT_EQ(resolved("~/get_parameters", kPlanner, {}), "/robot0/planner/get_parameters");
  EXPECT_EQ(resolved("odom", NodeName{"planner", "/"}, {}), "/odom");
}

TEST(Names, AreRemappedByTheFirstRuleThatFits) {
  const std::vector<RemapRule> rules{{"tracker", "odom", "elsewhere"},
                                     {"", "odom", "/fused"},
                                     {"", "odom", "late"},
                                     {"", "/robot0/scan", "laser"},
                                     {"", "~/x", "y"}};
  EXPECT_EQ(resolved("odom", kPlanner, rules), "/fused");
  EXPECT_EQ(resolved("scan", kPlanner, rules), "/robot0/laser");
  EXPECT_EQ(resolved("~/x", kPlanner, rules), "/robot0/y");
  EXPECT_EQ(resolved("odom", NodeName{"tracker", "/robot0"}, rules), "/robot0/elsewhere");
}

TEST(Names, NodesAreRenamed) {
  const NodeName node = resolved_node(
      kPlanner, {{"", "__ns", "/fleet/robot1"}, {"tracker", "__node", "no"}, {"", "__node", "p"}});
  EXPECT_EQ(node.full(), "/fleet/robot1/p");
  EXPECT_EQ(NodeName{"p"}.full(), "/p");
}

TEST(Names, BadOnesAreRefused) {
  const auto refusal = [](const std::string& name) {
    try {
      return resolved(name, kPlanner, {});
    } catch (const std::invalid_argument& error) {
      return std::string{error.what()};
    }
  };
  EXPECT_EQ(refusal("a b"), "the name 'a b' (/robot0/a b) has ' ', which is no letter, digit or underscore");
  EXPECT_EQ(refusal("a//b"), "the name 'a//b' (/robot0/a//b) has an empty part");
  EXPECT_EQ(refusal("/a/"), "the name '/a/' (/a/) has an empty part");
  EXPECT_EQ(refusal("/3"), "the name '/3' (/3) begins with a digit");
  EXPECT_EQ(refusal("/"), "the name '/' (/) is no topic");
  EXPECT_THROW((void)resolved_node({"a/b", "/"}, {}), std::invalid_argument);
  EXPECT_THROW((void)resolved_node({"a", "b"}, {}), std::invalid_argument);
  EXPECT_FALSE(fault_of_node_name(std::string(256, 'a')).empty());
}

TEST(Names, AreThoseOfDds) {
  const DdsTopic topic = message_topic<nav_msgs::Odometry>("/robot0/odom");
  EXPECT_EQ(topic.name, "rt/robot0/odom");
  EXPECT_EQ(topic.type_name, "nav_msgs::msg::dds_::Odometry_");
  EXPECT_EQ(topic.user_data.size(), 81U);
  EXPECT_EQ(topic.user_data, std::string{"typehash="} + nav_msgs::Odometry::kTypeHash + ";");
  const DdsTopic request = request_topic<std_srvs::SetBool_Request>("/r/s", "serviceid=1.2;");
  EXPECT_EQ(request.name, "rq/r/sRequest");
  EXPECT_EQ(request.type_name, "std_srvs::srv::dds_::SetBool_Request_");
  EXPECT_EQ(request.user_data.rfind("serviceid=1.2;typehash=RIHS01_c62fbb99", 0), 0U);
  EXPECT_EQ(reply_topic<std_srvs::SetBool_Response>("/r/s", "").name, "rr/r/sReply");
}

TEST(Names, UserDataHasKeys) {
  EXPECT_EQ(user_data_value("serviceid=1.2;typehash=R;", "typehash"), "R");
  EXPECT_EQ(user_data_value("serviceid=1.2;typehash=R", "serviceid"), "1.2");
  EXPECT_EQ(user_data_value("xserviceid=1;", "serviceid"), std::nullopt);
  EXPECT_EQ(user_data_value("", "serviceid"), std::nullopt);
}

}  // namespace
}  // namespace ros2
