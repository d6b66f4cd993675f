// A robot of the program spf-ros2 drives a base that this test is: over DDS alone, on the clock that the test
// tells. The clock waits for the robot, so that nothing depends on how fast the machine is.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <limits>
#include <optional>
#include <ros2_messages/action_msgs/GoalStatus.hpp>
#include <ros2_messages/diagnostic_msgs/DiagnosticArray.hpp>
#include <ros2_messages/geometry_msgs/PoseStamped.hpp>
#include <ros2_messages/geometry_msgs/Twist.hpp>
#include <ros2_messages/nav2_msgs/NavigateToPose.hpp>
#include <ros2_messages/nav2_msgs/SpeedLimit.hpp>
#include <ros2_messages/nav_msgs/OccupancyGrid.hpp>
#include <ros2_messages/nav_msgs/Odometry.hpp>
#include <ros2_messages/nav_msgs/Path.hpp>
#include <ros2_messages/rcl_interfaces/SetParameters.hpp>
#include <ros2_messages/rosgraph_msgs/Clock.hpp>
#include <ros2_messages/sensor_msgs/LaserScan.hpp>
#include <ros2_messages/spf_empc_msgs/ObstacleTracks.hpp>
#include <ros2_messages/spf_empc_msgs/RobotStatus.hpp>
#include <ros2_messages/spf_empc_msgs/Trajectory.hpp>
#include <ros2_messages/spf_empc_msgs/WheelSpeeds.hpp>
#include <ros2_messages/std_msgs/Bool.hpp>

#include "ros2/robot/program_test.hpp"
#include "wire/pose.hpp"

namespace spf_ros2 {
namespace {

using ros2::Qos;
using ros2::spf_empc_msgs::RobotStatus;

constexpr ros2::Nanoseconds kTick = 10'000'000;
constexpr int kTicksOfACommand = 5;  // agent.tracker.control_period
constexpr int kTicksOfAScan = 10;

/// A base that does what it is told, its localisation, its scanner (nothing is in sight), and the clock.
class World {
 public:
  explicit World(int robot_id = 3)
      : process_{{"--ros-args", "-r", "__ns:=/robot" + std::to_string(robot_id)}},
        base_frame_{"robot" + std::to_string(robot_id) + "/base_link"} {
    command_ = &node_.subscribe<ros2::geometry_msgs::Twist>("cmd_vel", Qos::keep_last(10),
                                                            [this](const auto& twist) { twist_ = twist; });
    wheels_ = &node_.subscribe<ros2::spf_empc_msgs::WheelSpeeds>(
        "wheel_speeds", Qos::keep_last(50),
        [this](const auto& wheels) { commanded_ = ros2::nanoseconds_of(wheels.header.stamp); });
    plan_ = &node_.subscribe<ros2::spf_empc_msgs::Trajectory>(
        "trajectory", Qos::keep_last(50),
        [this](const auto& plan) { planned_ = ros2::nanoseconds_of(plan.header.stamp); });
    node_.subscribe<RobotStatus>("status", Qos::keep_last(50),
                                 [this](const auto& status) { status_ = status; });
  }

  /// A tenth of a second. False when the robot has not kept up.
  [[nodiscard]] bool go_on() {
    for (int i = 0; i < kTicksOfAScan; ++i) {
      tick();
      if (i == 0) tell_surroundings();
      if (i % kTicksOfACommand != kTicksOfACommand - 1) continue;
      const ros2::Nanoseconds begin = time_ - kTicksOfACommand * kTick;
      auto next = std::chrono::steady_clock::now() + std::chrono::seconds{1};
      const bool kept_up = ros2::run_until({&process_}, [&] {
        // A first command may be sent before the two have found each other both ways: then it takes another.
        if (commanded_ <= begin && std::chrono::steady_clock::now() > next) {
          next += std::chrono::seconds{1};
          for (int more = 0; more < kTicksOfACommand; ++more) tick();
        }
        // A plan comes every 0.15 s, and with every scan.
        return commanded_ > begin && (planned_ == 0 || planned_ > time_ - 25 * kTick);
      });
      if (!kept_up) return false;
    }
    return true;
  }

  /// Until the robot says that it has started, and listens.
  [[nodiscard]] bool wait_for_robot() {
    return ros2::run_until({&process_}, [&] {
      tell_clock();
      return clock_.subscribers() >= 3 && odometry_.subscribers() >= 2 && scan_.subscribers() >= 2 &&
             obstacles_.subscribers() >= 1 && goal_.subscribers() >= 1 && command_->matched() == 1 &&
             wheels_->matched() == 1 && plan_->matched() == 1;
    });
  }
  void send_goal(double x, double y, double heading) {
    ros2::geometry_msgs::PoseStamped goal;
    goal.header.frame_id = "map";
    spf::wire::fill(spf::Pose2{{x, y}, heading}, goal.pose);
    goal_.publish(goal);
  }

  ros2::Process& process() { return process_; }
  ros2::Node& node() { return node_; }
  [[nodiscard]] const spf::Pose2& pose() const { return pose_; }
  [[nodiscard]] const RobotStatus& status() const { return status_; }
  /// Scanner and tracker of obstacles say nothing from now on, or again.
  void set_scans(bool scans) { scans_ = scans; }
  [[nodiscard]] double speed() const { return std::hypot(twist_.linear.x, twist_.linear.y); }

 private:
  void tell_clock() {
    ros2::rosgraph_msgs::Clock clock;
    clock.clock = ros2::time_of(time_);
    clock_.publish(clock);
  }
  void tick() {
    const double seconds = 1e-9 * static_cast<double>(kTick);
    pose_ = {spf::wire::moved(pose_, Eigen::Vector2d{twist_.linear.x, twist_.linear.y} * seconds),
             pose_.heading + twist_.angular.z * seconds};
    time_ += kTick;
    tell_clock();
    ros2::nav_msgs::Odometry odometry;
    odometry.header.stamp = ros2::time_of(time_);
    odometry.header.frame_id = "map";
    odometry.child_frame_id = base_frame_;
    spf::wire::fill(pose_, odometry.pose.pose);
    odometry_.publish(odometry);
    process_.executor.spin_once(0.0);
  }
  void tell_surroundings() {
    if (!scans_) return;
    ros2::sensor_msgs::LaserScan scan;
    scan.header.stamp = ros2::time_of(time_);
    scan.header.frame_id = base_frame_;
    scan.angle_min = -3.1F;
    scan.angle_increment = 0.02F;
    scan.ranges.assign(311, std::numeric_limits<float>::infinity());
    scan.angle_max = -3.1F + 310 * 0.02F;
    scan.range_min = 0.05F;
    scan.range_max = 10.0F;
    scan_.publish(scan);
    ros2::spf_empc_msgs::ObstacleTracks tracks;
    tracks.header = scan.header;
    tracks.header.frame_id = "map";
    obstacles_.publish(tracks);
  }

  ros2::Process process_;
  ros2::Node node_{process_.context, process_.executor, {"world"}};
  const ros2::Reader *command_ = nullptr, *wheels_ = nullptr, *plan_ = nullptr;
  ros2::Publisher<ros2::rosgraph_msgs::Clock> clock_ =
      node_.advertise<ros2::rosgraph_msgs::Clock>("/clock", Qos::keep_last(10));
  ros2::Publisher<ros2::nav_msgs::Odometry> odometry_ =
      node_.advertise<ros2::nav_msgs::Odometry>("odom", Qos::keep_last(50));
  ros2::Publisher<ros2::sensor_msgs::LaserScan> scan_ =
      node_.advertise<ros2::sensor_msgs::LaserScan>("scan", Qos::sensor_data());
  ros2::Publisher<ros2::spf_empc_msgs::ObstacleTracks> obstacles_ =
      node_.advertise<ros2::spf_empc_msgs::ObstacleTracks>("obstacles");
  ros2::Publisher<ros2::geometry_msgs::PoseStamped> goal_ =
      node_.advertise<ros2::geometry_msgs::PoseStamped>("goal_pose");
  std::string base_frame_;
  bool scans_ = true;
  spf::Pose2 pose_;
  ros2::Nanoseconds time_ = 1'000'000'000'000;
  ros2::Nanoseconds commanded_ = 0, planned_ = 0;  // stamps of the last command and plan
  ros2::geometry_msgs::Twist twist_;
  RobotStatus status_;
};

const std::vector<std::string> kRobot{"robot", "--ros-args",         "-r", "__ns:=/robot3",
                                      "-p",    "use_sim_time:=true", "-p", "robot_id:=3",
                                      "-p",    "map:=none"};

TEST(Robot, ArrivesAtItsGoal) {
  Program robot{kRobot};
  World world;
  std::vector<std::string> parts;
  world.node().subscribe<ros2::diagnostic_msgs::DiagnosticArray>("/diagnostics", {}, [&](const auto& array) {
    for (const auto& status : array.status) parts.push_back(status.name);
  });
  int paths = 0;
  world.node().subscribe<ros2::nav_msgs::Path>("path", {},
                                               [&](const auto& path) { paths += !path.poses.empty(); });
  ASSERT_TRUE(world.wait_for_robot());
  for (int i = 0; i < 20; ++i) ASSERT_TRUE(world.go_on()) << i;
  EXPECT_EQ(world.speed(), 0.0) << "it has no goal";
  world.send_goal(2.0, 1.0, 1.0);
  double fastest = 0.0;
  int tenths = 0;
  for (; tenths < 300 && world.status().goal_outcome != "reached"; ++tenths) {
    ASSERT_TRUE(world.go_on()) << tenths << " " << world.status().reason;
    fastest = std::max(fastest, world.speed());
  }
  EXPECT_EQ(world.status().goal_outcome, "reached") << world.status().reason;
  EXPECT_LT((world.pose().position_world - Eigen::Vector2d{2.0, 1.0}).norm(), 0.15);
  EXPECT_NEAR(world.pose().heading, 1.0, 0.15);
  EXPECT_GT(fastest, 0.3);
  EXPECT_EQ(world.status().robot_id, 3U);
  EXPECT_GT(paths, 0);
  EXPECT_THAT(parts,
              testing::IsSupersetOf({"robot3", "robot3: planner", "robot3: tracker", "robot3: perception"}));
  EXPECT_EQ(robot.end(SIGTERM), 0);
}

TEST(Robot, PausesByParameterAndTopic) {
  Program robot{kRobot};
  World world;
  using namespace ros2::rcl_interfaces;
  const auto pause = world.node().advertise<ros2::std_msgs::Bool>("pause", Qos::latched());
  const auto speed_limit = world.node().advertise<ros2::nav2_msgs::SpeedLimit>("speed_limit");
  const auto set = world.node().client<SetParameters_Request, SetParameters_Response>(
      "planner/set_parameters", Qos::parameters());
  ASSERT_TRUE(world.wait_for_robot());
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
  world.send_goal(15.0, 0.0, 0.0);
  EXPECT_TRUE(go_on_until([&] { return world.speed() > 0.5; })) << world.status().reason;
  EXPECT_EQ(set_parameter("pause", true), "");
  EXPECT_TRUE(go_on_until([&] { return world.speed() < 0.01; })) << world.status().reason;
  EXPECT_EQ(set_parameter("pause", false), "");
  EXPECT_EQ(set_parameter("speed_limit", 0.3), "");
  EXPECT_TRUE(go_on_until([&] { return world.speed() > 0.25; })) << world.status().reason;
  for (int i = 0; i < 10 && world.go_on(); ++i) EXPECT_LT(world.speed(), 0.33);
  EXPECT_THAT(set_parameter("speed_limit", 1000.0), testing::HasSubstr("speed_limit = 1000"));
  ros2::nav2_msgs::SpeedLimit limit;
  limit.percentage = true;
  limit.speed_limit = 60.0;
  speed_limit.publish(limit);
  EXPECT_TRUE(go_on_until([&] { return world.speed() > 0.55; })) << world.status().reason;
  for (int i = 0; i < 5 && world.go_on(); ++i) EXPECT_LT(world.speed(), 0.63);
  limit.speed_limit = -1.0;
  speed_limit.publish(limit);
  ros2::std_msgs::Bool yes;
  yes.data = true;
  pause.publish(yes);
  EXPECT_TRUE(go_on_until([&] { return world.speed() < 0.01; })) << world.status().reason;
}

TEST(Robot, NavigatesToPoses) {
  using Action = ros2::nav2_msgs::NavigateToPose;
  using ros2::action_msgs::GoalStatus;
  Program robot{kRobot};
  World world;
  ros2::Node& node = world.node();
  const auto send =
      node.client<Action::SendGoalRequest, Action::SendGoalResponse>("navigate_to_pose/_action/send_goal");
  const auto ask =
      node.client<Action::GetResultRequest, Action::GetResultResponse>("navigate_to_pose/_action/get_result");
  std::vector<float> distances;
  node.subscribe<Action::FeedbackMessage>("navigate_to_pose/_action/feedback", {}, [&](const auto& message) {
    distances.push_back(message.feedback.distance_remaining);
  });
  ASSERT_TRUE(world.wait_for_robot());
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
  EXPECT_TRUE(go_on_until([&] { return distances.size() >= 3; })) << world.status().reason;
  EXPECT_LT(distances.back(), distances.front());
  navigate(2, 1.0);  // which replaces it
  EXPECT_TRUE(go_on_until([&] { return results.size() == 2; })) << world.status().reason;
  navigate(3, 100.0);  // where there is no map
  EXPECT_TRUE(go_on_until([&] { return results.size() == 3; })) << world.status().reason;
  EXPECT_EQ(accepted, 3);
  ASSERT_EQ(results.size(), 3U);
  EXPECT_EQ(results[0].status, GoalStatus::STATUS_ABORTED);
  EXPECT_EQ(results[0].result.error_msg, "a newer goal");
  EXPECT_EQ(results[1].status, GoalStatus::STATUS_SUCCEEDED);
  EXPECT_EQ(results[1].result.error_code, 0);
  EXPECT_EQ(results[2].status, GoalStatus::STATUS_ABORTED);
  EXPECT_EQ(results[2].result.error_msg, "the goal is off the map");
}

TEST(Robot, StandsWithoutScansAndGoesOnWithThem) {
  Program robot{kRobot};
  World world;
  ASSERT_TRUE(world.wait_for_robot());
  for (int i = 0; i < 20; ++i) ASSERT_TRUE(world.go_on()) << i;
  world.send_goal(15.0, 0.0, 0.0);
  const auto tenths_until = [&](const auto& done) {
    int tenths = 0;
    for (; tenths < 100 && !done(); ++tenths)
      if (!world.go_on()) return 1000;
    return tenths;
  };
  EXPECT_LT(tenths_until([&] { return world.speed() > 0.5; }), 100) << world.status().reason;
  world.set_scans(false);
  // agent.team.stale_time (0.5 s), and braking from 1 m/s at 1 m/s^2.
  EXPECT_LE(tenths_until([&] { return world.speed() < 0.01; }), 25) << world.status().reason;
  EXPECT_THAT(world.status().reason, testing::HasSubstr("no"));
  world.set_scans(true);
  EXPECT_LT(tenths_until([&] { return world.speed() > 0.5; }), 100) << world.status().reason;
}

TEST(Robot, TellsItsPeersAndHearsThem) {
  using ros2::spf_empc_msgs::Trajectory;
  Program robot{kRobot};
  World world;
  const auto swarm = world.node().advertise<Trajectory>("/swarm/trajectories", Qos::keep_last(50));
  std::optional<Trajectory> told;
  world.node().subscribe<Trajectory>("/swarm/trajectories", Qos::keep_last(50),
                                     [&](const Trajectory& message) {
                                       if (message.robot_id == 3) told = message;
                                     });
  ASSERT_TRUE(world.wait_for_robot());
  ASSERT_TRUE(ros2::run_until({&world.process()}, [&] { return swarm.subscribers() == 2; }));  // itself, too
  for (int i = 0; i < 200 && !told; ++i) ASSERT_TRUE(world.go_on()) << i;
  ASSERT_TRUE(told) << "nothing was told";
  EXPECT_EQ(told->header.frame_id, "map");
  EXPECT_EQ(world.status().messages_accepted, 0U);
  // A peer that does the same 5 m away, and one that talks nonsense.
  Trajectory peer = *told;
  peer.robot_id = 1;
  for (std::size_t i = 0; i < peer.coefficients.size(); i += 12) peer.coefficients[i] += 5.0;
  swarm.publish(peer);
  peer.robot_id = 2;
  peer.durations[0] = -1.0;
  swarm.publish(peer);
  for (int i = 0; i < 100 && world.status().messages_malformed == 0; ++i) ASSERT_TRUE(world.go_on()) << i;
  EXPECT_EQ(world.status().messages_accepted, 1U);
  EXPECT_EQ(world.status().messages_malformed, 1U);
}

TEST(Robot, IsTheSameAsThreeProcesses) {
  const auto part = [](const std::string& role) {
    std::vector<std::string> arguments = kRobot;
    arguments[0] = role;
    return arguments;
  };
  Program tracker{part("tracker")}, planner{part("planner")}, perception{part("perception")};
  World world;
  ASSERT_TRUE(world.wait_for_robot());
  for (int i = 0; i < 20; ++i) ASSERT_TRUE(world.go_on()) << i;
  world.send_goal(1.5, 0.0, 0.0);
  for (int tenths = 0; tenths < 300 && world.status().goal_outcome != "reached"; ++tenths)
    ASSERT_TRUE(world.go_on()) << tenths << " " << world.status().reason;
  EXPECT_EQ(world.status().goal_outcome, "reached") << world.status().reason;
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
  Program robot{kRobot};
  ros2::Process people;
  ros2::Node node{people.context, people.executor, {"world"}};
  const auto clock = node.advertise<ros2::rosgraph_msgs::Clock>("/clock", Qos::keep_last(1));
  ASSERT_TRUE(ros2::run_until({&people}, [&] { return clock.subscribers() > 0; }));
  EXPECT_EQ(robot.end(SIGINT), 0);
}

}  // namespace
}  // namespace spf_ros2
