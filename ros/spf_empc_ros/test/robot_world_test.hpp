// Robots of this package's nodes drive bases that the test is, over ROS 1 alone (wire/robot_world_test.hpp).
#pragma once

#include "wire/robot_world_test.hpp"

#include <diagnostic_msgs/DiagnosticArray.h>
#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/Twist.h>
#include <gtest/gtest.h>
#include <nav_msgs/Odometry.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <rosgraph_msgs/Clock.h>
#include <sensor_msgs/LaserScan.h>
#include <spf_empc_msgs/ObstacleTracks.h>
#include <spf_empc_msgs/RobotStatus.h>
#include <spf_empc_msgs/TrackerStatus.h>
#include <spf_empc_msgs/Trajectory.h>
#include <spf_empc_msgs/WheelSpeeds.h>
#include <sys/types.h>

#include <chrono>
#include <csignal>
#include <string>
#include <vector>

#include "spf_empc_ros/transport.hpp"

namespace spf_empc_ros {

/// A program of this machine; killed at the end if it still runs.
class Program {
 public:
  /// `variables` ("ROS_NAMESPACE=/robot3") are added to the environment.
  Program(std::vector<std::string> arguments, const std::vector<std::string>& variables);
  ~Program();
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;
  void kill();

 private:
  pid_t id_ = 0;
};

/// Of this package's nodes ("planner_node").
[[nodiscard]] std::string node_program(const std::string& name);

/// What carries wire::RobotWorld. The tests' program has a master of its own, which ends with it.
struct Ros1 {
  using Clock = rosgraph_msgs::Clock;
  using Diagnostics = diagnostic_msgs::DiagnosticArray;
  using LaserScan = sensor_msgs::LaserScan;
  using ObstacleTracks = spf_empc_msgs::ObstacleTracks;
  using Odometry = nav_msgs::Odometry;
  using PoseStamped = geometry_msgs::PoseStamped;
  using RobotStatus = spf_empc_msgs::RobotStatus;
  using TrackerStatus = spf_empc_msgs::TrackerStatus;
  using Trajectory = spf_empc_msgs::Trajectory;
  using Twist = geometry_msgs::Twist;
  using WheelSpeeds = spf_empc_msgs::WheelSpeeds;
  static constexpr const char* kGoalTopic = "goal";
  static constexpr bool kNodesCount = false;  // roscpp joins those of a process
  static constexpr double kFastest = 4.0;     // its timers look at the clock every millisecond

  static ros::Time time_of(spf::wire::Nanoseconds time) {
    return ros::Time{}.fromNSec(static_cast<std::uint64_t>(time));
  }
  static spf::wire::Nanoseconds nanoseconds_of(const ros::Time& stamp) {
    return static_cast<spf::wire::Nanoseconds>(stamp.toNSec());
  }

  template <class Message>
  struct Publisher {
    ros::Publisher publisher;
    void publish(const Message& message) const { publisher.publish(message); }
    [[nodiscard]] int subscribers() const { return static_cast<int>(publisher.getNumSubscribers()); }
  };
  struct Heard {
    ros::Subscriber subscriber;
    [[nodiscard]] int matched() const { return static_cast<int>(subscriber.getNumPublishers()); }
  };

  class Node {
   public:
    explicit Node(int /*robot_id*/) { node_.setCallbackQueue(&queue_); }
    /// What robots kept at the parameter server is not for those of the next test.
    ~Node() {
      std::vector<std::string> names;
      node_.getParamNames(names);
      for (const std::string& name : names)
        if (name.rfind("/robot", 0) == 0) node_.deleteParam(name);
    }
    Node(const Node&) = delete;
    Node& operator=(const Node&) = delete;
    template <class Message>
    Publisher<Message> advertise(const std::string& topic, int depth) {
      return {node_.advertise<Message>(topic, static_cast<std::uint32_t>(depth))};
    }
    template <class Message, class Callback>
    Heard subscribe(const std::string& topic, int depth, Callback callback) {
      const boost::function<void(const boost::shared_ptr<const Message>&)> take =
          [callback](const boost::shared_ptr<const Message>& message) { callback(*message); };
      return {node_.subscribe<Message>(topic, static_cast<std::uint32_t>(depth), take, nullptr, no_delay())};
    }
    void take() { queue_.callAvailable(); }
    template <class Done>
    [[nodiscard]] bool run_until(Done done) {
      const auto end = std::chrono::steady_clock::now() + std::chrono::seconds{20};
      while (!done()) {
        if (std::chrono::steady_clock::now() > end) return false;
        queue_.callAvailable(ros::WallDuration{0.001});
      }
      return true;
    }

   private:
    ros::CallbackQueue queue_;
    ros::NodeHandle node_;
  };

  class Part {
   public:
    Part(int robot_id, const std::string& role, const spf::wire::PartOptions& options = {})
        : program_{arguments(robot_id, role, options), {"ROS_NAMESPACE=/robot" + std::to_string(robot_id)}} {}
    void kill() { program_.kill(); }

   private:
    static std::vector<std::string> arguments(int robot_id, const std::string& role,
                                              const spf::wire::PartOptions& options) {
      std::vector<std::string> words{node_program(role + "_node"), "__name:=" + role,
                                     "_robot_id:=" + std::to_string(robot_id), "_map:=none"};
      for (const auto& [from, to] : options.renamed) words.push_back(from + ":=" + to);
      if (!options.config.empty()) words.push_back("_config:=" + options.config);
      return words;
    }
    Program program_;
  };
};

}  // namespace spf_empc_ros
