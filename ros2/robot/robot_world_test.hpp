// Robots of the program spf-ros2 drive bases that the test is, over DDS alone (wire/robot_world_test.hpp).
#pragma once

#include "wire/robot_world_test.hpp"

#include <gtest/gtest.h>

#include <ros2_messages/diagnostic_msgs/DiagnosticArray.hpp>
#include <ros2_messages/geometry_msgs/PoseStamped.hpp>
#include <ros2_messages/geometry_msgs/Twist.hpp>
#include <ros2_messages/nav_msgs/Odometry.hpp>
#include <ros2_messages/rosgraph_msgs/Clock.hpp>
#include <ros2_messages/sensor_msgs/LaserScan.hpp>
#include <ros2_messages/spf_empc_msgs/ObstacleTracks.hpp>
#include <ros2_messages/spf_empc_msgs/RobotStatus.hpp>
#include <ros2_messages/spf_empc_msgs/TrackerStatus.hpp>
#include <ros2_messages/spf_empc_msgs/Trajectory.hpp>
#include <ros2_messages/spf_empc_msgs/WheelSpeeds.hpp>
#include <string>
#include <vector>

#include "ros2/robot/program_test.hpp"

namespace spf_ros2 {

/// The arguments of a robot's process, or of one of its parts.
inline std::vector<std::string> robot_arguments(int robot_id, const std::string& role = "robot") {
  const std::string number = std::to_string(robot_id);
  return {role, "--ros-args",         "-r", "__ns:=/robot" + number,
          "-p", "use_sim_time:=true", "-p", "robot_id:=" + number,
          "-p", "map:=none"};
}

/// What carries wire::RobotWorld.
struct Ros2 {
  using Clock = ros2::rosgraph_msgs::Clock;
  using Diagnostics = ros2::diagnostic_msgs::DiagnosticArray;
  using LaserScan = ros2::sensor_msgs::LaserScan;
  using ObstacleTracks = ros2::spf_empc_msgs::ObstacleTracks;
  using Odometry = ros2::nav_msgs::Odometry;
  using PoseStamped = ros2::geometry_msgs::PoseStamped;
  using RobotStatus = ros2::spf_empc_msgs::RobotStatus;
  using TrackerStatus = ros2::spf_empc_msgs::TrackerStatus;
  using Trajectory = ros2::spf_empc_msgs::Trajectory;
  using Twist = ros2::geometry_msgs::Twist;
  using WheelSpeeds = ros2::spf_empc_msgs::WheelSpeeds;
  template <class Message>
  using Publisher = ros2::Publisher<Message>;
  static constexpr const char* kGoalTopic = "goal_pose";
  static constexpr bool kNodesCount = true;
  static constexpr double kFastest = 5.0;

  static auto time_of(ros2::Nanoseconds time) { return ros2::time_of(time); }
  template <class Stamp>
  static ros2::Nanoseconds nanoseconds_of(const Stamp& stamp) {
    return ros2::nanoseconds_of(stamp);
  }

  struct Heard {
    const ros2::Reader* reader = nullptr;
    [[nodiscard]] int matched() const { return reader->matched(); }
  };

  /// In the namespace of a robot.
  struct Node {
    explicit Node(int robot_id) : process{{"--ros-args", "-r", "__ns:=/robot" + std::to_string(robot_id)}} {}
    template <class Message>
    Publisher<Message> advertise(const std::string& topic, int depth) {
      return node.advertise<Message>(topic, ros2::Qos::keep_last(depth));
    }
    template <class Message, class Callback>
    Heard subscribe(const std::string& topic, int depth, Callback callback) {
      return {&node.subscribe<Message>(topic, ros2::Qos::keep_last(depth), std::move(callback))};
    }
    void take() { process.executor.spin_once(0.0); }
    template <class Done>
    [[nodiscard]] bool run_until(Done done) {
      return ros2::run_until({&process}, std::move(done));
    }

    ros2::Process process;
    ros2::Node node{process.context, process.executor, {"world"}};
  };

  class Part {
   public:
    Part(int robot_id, const std::string& role, const spf::wire::PartOptions& options = {})
        : program_{arguments(robot_id, role, options)} {}
    void kill() { EXPECT_EQ(program_.end(SIGKILL), -1); }

   private:
    static std::vector<std::string> arguments(int robot_id, const std::string& role,
                                              const spf::wire::PartOptions& options) {
      std::vector<std::string> words = robot_arguments(robot_id, role);
      for (const auto& [from, to] : options.renamed) words.insert(words.end(), {"-r", from + ":=" + to});
      if (!options.config.empty()) words.insert(words.end(), {"-p", "config:=" + options.config});
      return words;
    }
    Program program_;
  };
};

using Base = spf::wire::RobotBase<Ros2>;

class World : public spf::wire::RobotWorld<Ros2> {
 public:
  using spf::wire::RobotWorld<Ros2>::RobotWorld;
  ros2::Process& process() { return ros().process; }
  ros2::Node& node() { return ros().node; }
};

}  // namespace spf_ros2
