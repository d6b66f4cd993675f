// A robot of the program spf-ros2, over DDS alone: what it is told and tells.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <optional>
#include <ros2_messages/action_msgs/GoalStatus.hpp>
#include <ros2_messages/diagnostic_msgs/DiagnosticArray.hpp>
#include <ros2_messages/nav2_msgs/NavigateToPose.hpp>
#include <ros2_messages/nav2_msgs/SpeedLimit.hpp>
#include <ros2_messages/nav_msgs/Path.hpp>
#include <ros2_messages/rcl_interfaces/SetParameters.hpp>
#include <ros2_messages/rosgraph_msgs/Clock.hpp>
#include <ros2_messages/spf_empc_msgs/Trajectory.hpp>
#include <ros2_messages/std_msgs/Bool.hpp>

#include "ros2/robot/robot_world_test.hpp"

namespace spf_ros2 {
namespace {

using ros2::Qos;

TEST(Robot, ArrivesAtItsGoal) {
  Program robot{robot_arguments(3)};
  World world;
  Base& base = world.base();
  std::vector<std::string> parts;
  world.node().subscribe<ros2::diagnostic_msgs::DiagnosticArray>("/diagnostics", {}, [&](const auto& array) {
    for (const auto& status : array.status) parts.push_back(status.name);
  });
  int paths = 0;
  world.node().subscribe<ros2::nav_msgs::Path>("path", {},
                                               [&](const auto& path) { paths += !path.poses.empty(); });
  ASSERT_TRUE(world.wait_for_robots());
  for (int i = 0; i < 20; ++i) ASSERT_TRUE(world.go_on()) << i;
  EXPECT_EQ(base.speed(), 0.0) << "it has no goal";
  base.send_goal(2.0, 1.0, 1.0);
  double fastest = 0.0;
  int tenths = 0;
  for (; tenths < 300 && base.status().goal_outcome != "reached"; ++tenths) {
    ASSERT_TRUE(world.go_on()) << tenths << " " << base.status().reason;
    fastest = std::max(fastest, base.speed());
  }
  EXPECT_EQ(base.status().goal_outcome, "reached") << base.status().reason;
  EXPECT_LT((base.pose().position_world - Eigen::Vector2d{2.0, 1.0}).norm(), 0.15);
  EXPECT_NEAR(base.pose().heading, 1.0, 0.15);
  EXPECT_GT(fastest, 0.3);
  EXPECT_EQ(base.status().robot_id, 3U);
  EXPECT_GT(paths, 0);
  EXPECT_THAT(parts,
              testing::IsSupersetOf({"robot3", "robot3: planner", "robot3: tracker", "robot3: perception"}));
  EXPECT_EQ(robot.end(SIGTERM), 0);
}

TEST(Robot, PausesByParameterAndTopic) {
  Program robot{robot_arguments(3)};
  World world;
  Base& base = world.base();
  using namespace ros2::rcl_interfaces;
  const auto pause = world.node().advertise<ros2::std_msgs::Bool>("pause", Qos::latched());
  const auto speed_limit = world.node().advertise<ros2::nav2_msgs::SpeedLimit>("speed_limit");
  const auto set = world.node().client<SetParameters_Request, SetParameters_Response>(
      "planner/set_parameters", Qos::parameters());
  ASSERT_TRUE(world.wait_for_robots());
  ASSERT_TRUE(ros2::run_until({&world.process()}, [&] { return set.ready(); }));
  const auto set_parameter = [&](const char* name, const ros2::ParameterValue& value) {
    SetParameters_Request request;
    request.parameters.resize(1);
    request.parameters[0].name = name;
    request.parameters[0].value = ros2::to_message(value);
    std::string reason = "no answer";
    set.call(request, [&](const auto& response) { reason = response.results.at(0).reason; });
    EXPECT_TRUE(ros2::run_until({&world.process()}, [&] { return reason != "no answer"; }));
    return reason;
  };
  const auto go_on_until = [&](const auto& done) {
    for (int i = 0; i < 100; ++i)
      if (!world.go_on() || done()) break;
    return done();
  };
  for (int i = 0; i < 20; ++i) ASSERT_TRUE(world.go_on()) << i;
  base.send_goal(15.0, 0.0, 0.0);
  EXPECT_TRUE(go_on_until([&] { return base.speed() > 0.5; })) << base.status().reason;
  EXPECT_EQ(set_parameter("pause", true), "");
  EXPECT_TRUE(go_on_until([&] { return base.speed() < 0.01; })) << base.status().reason;
  EXPECT_EQ(set_parameter("pause", false), "");
  EXPECT_EQ(set_parameter("speed_limit", 0.3), "");
  EXPECT_TRUE(go_on_until([&] { return base.speed() > 0.25; })) << base.status().reason;
  for (int i = 0; i < 10 && world.go_on(); ++i) EXPECT_LT(base.speed(), 0.33);
  EXPECT_THAT(set_parameter("speed_limit", 1000.0), testing::HasSubstr("speed_limit = 1000"));
  ros2::nav2_msgs::SpeedLimit limit;
  limit.percentage = true;
  limit.speed_limit = 60.0;
  speed_limit.publish(limit);
  EXPECT_TRUE(go_on_until([&] { return base.speed() > 0.55; })) << base.status().reason;
  for (int i = 0; i < 5 && world.go_on(); ++i) EXPECT_LT(base.speed(), 0.63);
  limit.speed_limit = -1.0;
  speed_limit.publish(limit);
  ros2::std_msgs::Bool yes;
  yes.data = true;
  pause.publish(yes);
  EXPECT_TRUE(go_on_until([&] { return base.speed() < 0.01; })) << base.status().reason;
}

TEST(Robot, NavigatesToPoses) {
  using Action = ros2::nav2_msgs::NavigateToPose;
  using ros2::action_msgs::GoalStatus;
  Program robot{robot_arguments(3)};
  World world;
  Base& base = world.base();
  ros2::Node& node = world.node();
  const auto send =
      node.client<Action::SendGoalRequest, Action::SendGoalResponse>("navigate_to_pose/_action/send_goal");
  const auto ask =
      node.client<Action::GetResultRequest, Action::GetResultResponse>("navigate_to_pose/_action/get_result");
  std::vector<float> distances;
  node.subscribe<Action::FeedbackMessage>("navigate_to_pose/_action/feedback", {}, [&](const auto& message) {
    distances.push_back(message.feedback.distance_remaining);
  });
  ASSERT_TRUE(world.wait_for_robots());
  ASSERT_TRUE(ros2::run_until({&world.process()}, [&] { return send.ready() && ask.ready(); }));
  std::vector<Action::GetResultResponse> results;
  int accepted = 0;
  const auto navigate = [&](std::uint8_t number, double x) {
    Action::SendGoalRequest request;
    request.goal_id.uuid[0] = number;
    request.goal.pose.header.frame_id = "map";
    request.goal.pose.pose.position.x = x;
    send.call(request, [&, id = request.goal_id](const auto& response) {
      accepted += response.accepted ? 1 : 0;
      Action::GetResultRequest wanted;
      wanted.goal_id = id;
      ask.call(wanted, [&](const auto& result) { results.push_back(result); });
    });
  };
  const auto go_on_until = [&](const auto& done) {
    for (int i = 0; i < 200 && !done(); ++i)
      if (!world.go_on()) return false;
    return done();
  };
  for (int i = 0; i < 20; ++i) ASSERT_TRUE(world.go_on()) << i;
  navigate(1, 5.0);
  EXPECT_TRUE(go_on_until([&] { return distances.size() >= 3; })) << base.status().reason;
  EXPECT_LT(distances.back(), distances.front());
  navigate(2, 1.0);  // which replaces it
  EXPECT_TRUE(go_on_until([&] { return results.size() == 2; })) << base.status().reason;
  navigate(3, 100.0);  // where there is no map
  EXPECT_TRUE(go_on_until([&] { return results.size() == 3; })) << base.status().reason;
  EXPECT_EQ(accepted, 3);
  ASSERT_EQ(results.size(), 3U);
  EXPECT_EQ(results[0].status, GoalStatus::STATUS_ABORTED);
  EXPECT_EQ(results[0].result.error_msg, "a newer goal");
  EXPECT_EQ(results[1].status, GoalStatus::STATUS_SUCCEEDED);
  EXPECT_EQ(results[1].result.error_code, 0);
  EXPECT_EQ(results[2].status, GoalStatus::STATUS_ABORTED);
  EXPECT_EQ(results[2].result.error_msg, "the goal is off the map");
}

TEST(Robot, TellsItsPeersAndHearsThem) {
  using ros2::spf_empc_msgs::Trajectory;
  Program robot{robot_arguments(3)};
  World world;
  Base& base = world.base();
  const auto swarm = world.node().advertise<Trajectory>("/swarm/trajectories", Qos::keep_last(50));
  std::optional<Trajectory> told;
  world.node().subscribe<Trajectory>("/swarm/trajectories", Qos::keep_last(50),
                                     [&](const Trajectory& message) {
                                       if (message.robot_id == 3) told = message;
                                     });
  ASSERT_TRUE(world.wait_for_robots());
  ASSERT_TRUE(ros2::run_until({&world.process()}, [&] { return swarm.subscribers() == 2; }));  // itself, too
  for (int i = 0; i < 200 && !told; ++i) ASSERT_TRUE(world.go_on()) << i;
  ASSERT_TRUE(told) << "nothing was told";
  EXPECT_EQ(told->header.frame_id, "map");
  EXPECT_EQ(base.status().messages_accepted, 0U);
  // A peer that does the same 5 m away, and one that talks nonsense.
  Trajectory peer = *told;
  peer.robot_id = 1;
  for (std::size_t i = 0; i < peer.coefficients.size(); i += 12) peer.coefficients[i] += 5.0;
  swarm.publish(peer);
  peer.robot_id = 2;
  peer.durations[0] = -1.0;
  swarm.publish(peer);
  for (int i = 0; i < 100 && base.status().messages_malformed == 0; ++i) ASSERT_TRUE(world.go_on()) << i;
  EXPECT_EQ(base.status().messages_accepted, 1U);
  EXPECT_EQ(base.status().messages_malformed, 1U);
}

TEST(Robot, IsTheSameAsThreeProcesses) {
  Program tracker{robot_arguments(3, "tracker")}, planner{robot_arguments(3, "planner")},
      perception{robot_arguments(3, "perception")};
  World world;
  Base& base = world.base();
  ASSERT_TRUE(world.wait_for_robots());
  for (int i = 0; i < 20; ++i) ASSERT_TRUE(world.go_on()) << i;
  base.send_goal(1.5, 0.0, 0.0);
  for (int tenths = 0; tenths < 300 && base.status().goal_outcome != "reached"; ++tenths)
    ASSERT_TRUE(world.go_on()) << tenths << " " << base.status().reason;
  EXPECT_EQ(base.status().goal_outcome, "reached") << base.status().reason;
  for (Program* program : {&tracker, &planner, &perception}) EXPECT_EQ(program->end(SIGTERM), 0);
}

TEST(Program, RefusesWhatItCannotUse) {
  EXPECT_EQ(Program({"driver"}).end(0), 2);
  EXPECT_EQ(Program({"robot", "--ros-args", "-p", "robot_id:=-1"}).end(0), 2);
  EXPECT_EQ(Program({"robot", "--ros-args", "-p", "config:=/nowhere/robot.yaml"}).end(0), 2);
  EXPECT_EQ(Program({"robot", "--ros-args", "-p", "speed_limit:=900.0"}).end(0), 2);
  EXPECT_EQ(Program({"simulator"}).end(0), 2) << "no scenario";
  EXPECT_EQ(Program({"simulator", "--ros-args", "-p", "scenario:=/nowhere/scene.yaml"}).end(0), 2);
  EXPECT_EQ(Program({"--help"}).end(0), 0);
}

TEST(Program, EndsWhileItWaitsForAClock) {
  Program robot{robot_arguments(3)};
  ros2::Process people;
  ros2::Node node{people.context, people.executor, {"world"}};
  const auto clock = node.advertise<ros2::rosgraph_msgs::Clock>("/clock", Qos::keep_last(1));
  ASSERT_TRUE(ros2::run_until({&people}, [&] { return clock.subscribers() > 0; }));
  EXPECT_EQ(robot.end(SIGINT), 0);
}

}  // namespace
}  // namespace spf_ros2
