// Robots of the program spf-ros2 drive bases that the test is: over DDS alone, on the clock that the test
// tells. The clock waits for the robots, so that nothing depends on how fast the machine is.
#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <limits>
#include <memory>
#include <ros2_messages/geometry_msgs/PoseStamped.hpp>
#include <ros2_messages/geometry_msgs/Twist.hpp>
#include <ros2_messages/nav_msgs/Odometry.hpp>
#include <ros2_messages/rosgraph_msgs/Clock.hpp>
#include <ros2_messages/sensor_msgs/LaserScan.hpp>
#include <ros2_messages/spf_empc_msgs/ObstacleTracks.hpp>
#include <ros2_messages/spf_empc_msgs/RobotStatus.hpp>
#include <ros2_messages/spf_empc_msgs/Trajectory.hpp>
#include <ros2_messages/spf_empc_msgs/WheelSpeeds.hpp>
#include <string>
#include <thread>
#include <vector>

#include "ros2/robot/program_test.hpp"
#include "wire/pose.hpp"

namespace spf_ros2 {

inline constexpr ros2::Nanoseconds kTick = 10'000'000;
inline constexpr int kTicksOfACommand = 5;  // agent.tracker.control_period
inline constexpr int kTicksOfAScan = 10;

/// The arguments of a robot's process, or of one of its parts.
inline std::vector<std::string> robot_arguments(int robot_id, const std::string& role = "robot") {
  const std::string number = std::to_string(robot_id);
  return {role, "--ros-args",         "-r", "__ns:=/robot" + number,
          "-p", "use_sim_time:=true", "-p", "robot_id:=" + number,
          "-p", "map:=none"};
}

/// A base that does what it is told, stands when nothing has been told for half a second, its localisation,
/// and its scanner (nothing is in sight).
class Base {
 public:
  Base(ros2::Node& node, int robot_id, const spf::Pose2& pose)
      : node_{node}, name_{"robot" + std::to_string(robot_id)}, pose_{pose} {
    using ros2::Qos;
    command_ = &node_.subscribe<ros2::geometry_msgs::Twist>(topic("cmd_vel"), Qos::keep_last(10),
                                                            [this](const auto& twist) { twist_ = twist; });
    wheels_ = &node_.subscribe<ros2::spf_empc_msgs::WheelSpeeds>(
        topic("wheel_speeds"), Qos::keep_last(50),
        [this](const auto& wheels) { commanded_ = ros2::nanoseconds_of(wheels.header.stamp); });
    plan_ = &node_.subscribe<ros2::spf_empc_msgs::Trajectory>(
        topic("trajectory"), Qos::keep_last(50),
        [this](const auto& plan) { planned_ = ros2::nanoseconds_of(plan.header.stamp); });
    node_.subscribe<ros2::spf_empc_msgs::RobotStatus>(topic("status"), Qos::keep_last(50),
                                                      [this](const auto& status) { status_ = status; });
  }

  void send_goal(double x, double y, double heading) {
    ros2::geometry_msgs::PoseStamped goal;
    goal.header.frame_id = "map";
    spf::wire::fill(spf::Pose2{{x, y}, heading}, goal.pose);
    goal_.publish(goal);
  }
  /// What its sensors tell from now on.
  void set_scans(bool told) { scans_ = told; }
  void set_odometry(bool told) { odometry_told_ = told; }
  void set_obstacles(bool told) { obstacles_told_ = told; }
  /// Added to every position that is told [m].
  void set_error(const Eigen::Vector2d& error) { error_ = error; }
  /// Something holds it where it is, whatever it is told.
  void set_held(bool held) { held_ = held; }
  /// Whether the clock waits for its commands and plans: not for those of processes that were killed.
  void set_awaited(bool awaited) { awaited_ = awaited; }

  [[nodiscard]] const spf::Pose2& pose() const { return pose_; }
  [[nodiscard]] const ros2::spf_empc_msgs::RobotStatus& status() const { return status_; }
  [[nodiscard]] double speed() const {
    return std::hypot(twist_.linear.x, twist_.linear.y);
  }  ///< [m/s] as told

  // ---- for World
  [[nodiscard]] bool awaited() const { return awaited_; }
  [[nodiscard]] bool connected() const {
    return odometry_.subscribers() >= 2 && scan_.subscribers() >= 2 && obstacles_.subscribers() >= 1 &&
           goal_.subscribers() >= 1 && command_->matched() >= 1 && wheels_->matched() >= 1 &&
           plan_->matched() >= 1;
  }
  [[nodiscard]] bool commanded_since(ros2::Nanoseconds time) const { return !awaited_ || commanded_ > time; }
  [[nodiscard]] bool kept_up(ros2::Nanoseconds begin, ros2::Nanoseconds now) const {
    // A plan comes every 0.15 s, and with every scan, unless the planner has a reason to make none.
    const bool planned = planned_ > now - 25 * kTick || status_.reason != "moving";
    return commanded_since(begin) && (!awaited_ || planned_ == 0 || planned);
  }
  void move(ros2::Nanoseconds now) {
    if (now - commanded_ > 50 * kTick) twist_ = {};
    const double seconds = 1e-9 * static_cast<double>(kTick);
    if (!held_)
      pose_ = {spf::wire::moved(pose_, Eigen::Vector2d{twist_.linear.x, twist_.linear.y} * seconds),
               pose_.heading + twist_.angular.z * seconds};
    if (!odometry_told_) return;
    ros2::nav_msgs::Odometry odometry;
    odometry.header.stamp = ros2::time_of(now);
    odometry.header.frame_id = "map";
    odometry.child_frame_id = name_ + "/base_link";
    spf::wire::fill(spf::Pose2{pose_.position_world + error_, pose_.heading}, odometry.pose.pose);
    odometry_.publish(odometry);
  }
  void tell_surroundings(ros2::Nanoseconds now) {
    if (scans_) tell_scan(now);
    if (!obstacles_told_) return;
    ros2::spf_empc_msgs::ObstacleTracks tracks;
    tracks.header.stamp = ros2::time_of(now);
    tracks.header.frame_id = "map";
    obstacles_.publish(tracks);
  }

 private:
  [[nodiscard]] std::string topic(const std::string& name) const { return "/" + name_ + "/" + name; }
  void tell_scan(ros2::Nanoseconds now) {
    ros2::sensor_msgs::LaserScan scan;
    scan.header.stamp = ros2::time_of(now);
    scan.header.frame_id = name_ + "/base_link";
    scan.angle_min = -3.1F;
    scan.angle_increment = 0.02F;
    scan.ranges.assign(311, std::numeric_limits<float>::infinity());
    scan.angle_max = -3.1F + 310 * 0.02F;
    scan.range_min = 0.05F;
    scan.range_max = 10.0F;
    scan_.publish(scan);
  }

  ros2::Node& node_;
  std::string name_;
  spf::Pose2 pose_;
  const ros2::Reader *command_ = nullptr, *wheels_ = nullptr, *plan_ = nullptr;
  ros2::Publisher<ros2::nav_msgs::Odometry> odometry_ =
      node_.advertise<ros2::nav_msgs::Odometry>(topic("odom"), ros2::Qos::keep_last(50));
  ros2::Publisher<ros2::sensor_msgs::LaserScan> scan_ =
      node_.advertise<ros2::sensor_msgs::LaserScan>(topic("scan"), ros2::Qos::sensor_data());
  ros2::Publisher<ros2::spf_empc_msgs::ObstacleTracks> obstacles_ =
      node_.advertise<ros2::spf_empc_msgs::ObstacleTracks>(topic("obstacles"));
  ros2::Publisher<ros2::geometry_msgs::PoseStamped> goal_ =
      node_.advertise<ros2::geometry_msgs::PoseStamped>(topic("goal_pose"));
  bool scans_ = true, odometry_told_ = true, obstacles_told_ = true, awaited_ = true, held_ = false;
  Eigen::Vector2d error_{0.0, 0.0};
  ros2::Nanoseconds commanded_ = 0, planned_ = 0;  // stamps of the last command and plan
  ros2::geometry_msgs::Twist twist_;
  ros2::spf_empc_msgs::RobotStatus status_;
};

/// Bases and their clock.
class World {
 public:
  struct Start {
    int robot_id = 3;
    spf::Pose2 pose;
  };
  explicit World(const std::vector<Start>& starts = {{}})
      : process_{{"--ros-args", "-r", "__ns:=/robot" + std::to_string(starts.front().robot_id)}} {
    for (const Start& start : starts)
      bases_.push_back(std::make_unique<Base>(node_, start.robot_id, start.pose));
  }

  /// A tenth of a second. False when a robot has not kept up.
  [[nodiscard]] bool go_on() {
    for (int i = 0; i < kTicksOfAScan; ++i) {
      tick();
      if (i == 0)
        for (const auto& base : bases_) base->tell_surroundings(time_);
      if (i % kTicksOfACommand != kTicksOfACommand - 1) continue;
      const ros2::Nanoseconds begin = time_ - kTicksOfACommand * kTick;
      auto next = std::chrono::steady_clock::now() + std::chrono::seconds{1};
      const bool kept_up = ros2::run_until({&process_}, [&] {
        // A first command may be sent before the two have found each other both ways: then it takes another.
        if (!all([&](const Base& base) { return base.commanded_since(begin); }) &&
            std::chrono::steady_clock::now() > next) {
          next += std::chrono::seconds{1};
          for (int more = 0; more < kTicksOfACommand; ++more) tick();
        }
        return all([&](const Base& base) { return base.kept_up(begin, time_); });
      });
      if (!kept_up) return false;
      // Where the clock waits for nobody, it goes five times as fast as time.
      if (!all([](const Base& base) { return base.awaited(); }))
        std::this_thread::sleep_for(std::chrono::milliseconds{10});
    }
    return true;
  }
  /// Goes on until `done`, for `tenths` of a second at most: how many it took, `tenths` where it never was.
  template <class Done>
  [[nodiscard]] int tenths_until(int tenths, Done done) {
    for (int i = 0; i < tenths; ++i) {
      if (done()) return i;
      if (!go_on()) return tenths;
    }
    return tenths;
  }

  /// Until the robots say that they have started, and listen.
  [[nodiscard]] bool wait_for_robots() {
    return ros2::run_until({&process_}, [&] {
      tell_clock();
      return clock_.subscribers() >= 3 && all([](const Base& base) { return base.connected(); });
    });
  }

  ros2::Process& process() { return process_; }
  ros2::Node& node() { return node_; }
  [[nodiscard]] Base& base(std::size_t i = 0) { return *bases_.at(i); }
  [[nodiscard]] ros2::Nanoseconds time() const { return time_; }

 private:
  template <class Holds>
  [[nodiscard]] bool all(Holds holds) const {
    for (const auto& base : bases_)
      if (!holds(*base)) return false;
    return true;
  }
  void tell_clock() {
    ros2::rosgraph_msgs::Clock clock;
    clock.clock = ros2::time_of(time_);
    clock_.publish(clock);
  }
  void tick() {
    time_ += kTick;
    tell_clock();
    for (const auto& base : bases_) base->move(time_);
    process_.executor.spin_once(0.0);
  }

  ros2::Process process_;
  ros2::Node node_{process_.context, process_.executor, {"world"}};
  ros2::Publisher<ros2::rosgraph_msgs::Clock> clock_ =
      node_.advertise<ros2::rosgraph_msgs::Clock>("/clock", ros2::Qos::keep_last(10));
  std::vector<std::unique_ptr<Base>> bases_;
  ros2::Nanoseconds time_ = 1'000'000'000'000;
};

}  // namespace spf_ros2
