// Robots that run as processes of their own drive bases that a test is, over ROS alone, on the clock that the
// test tells. The clock waits for the robots, so that nothing depends on how fast the machine is.
//
// `Ros` is what carries it (ros2/robot/robot_world_test.hpp, ros/spf_empc_ros/test/robot_world_test.hpp):
// message types by their names in ROS; Node with advertise, subscribe, take and run_until; Part, a process;
// time_of and nanoseconds_of for stamps; kGoalTopic; kNodesCount, whether each node of a process counts as
// a subscriber of its own; kFastest, how many times as fast as time the clock may go.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "wire/pose.hpp"

namespace spf::wire {

using Nanoseconds = std::int64_t;
inline constexpr Nanoseconds kTick = 10'000'000;
inline constexpr int kTicksOfACommand = 5;  // agent.tracker.control_period
inline constexpr int kTicksOfAScan = 10;

/// What a robot's process is told beside its number.
struct PartOptions {
  std::vector<std::pair<std::string, std::string>> renamed;  ///< topics: {"/swarm/trajectories", "/air0"}
  std::string config;                                        ///< path of the robot's file; empty: defaults
};

/// Whom a robot's scanner meets: a disc of a radius [m], where it is at a time [s].
struct Walker {
  double radius = 0.3;
  std::function<Eigen::Vector2d(double time)> path;
};

/// A base that does what it is told, stands when nothing has been told for half a second, its localisation,
/// and its scanner, which meets walkers alone.
template <class Ros>
class RobotBase {
 public:
  using Status = typename Ros::RobotStatus;

  RobotBase(typename Ros::Node& node, int robot_id, const Pose2& pose)
      : name_{"robot" + std::to_string(robot_id)},
        pose_{pose},
        odometry_{node.template advertise<Odometry>(topic("odom"), 50)},
        scan_{node.template advertise<LaserScan>(topic("scan"), 5)},
        obstacles_{node.template advertise<ObstacleTracks>(topic("obstacles"), 10)},
        goal_{node.template advertise<PoseStamped>(topic(Ros::kGoalTopic), 10)} {
    command_ = node.template subscribe<Twist>(topic("cmd_vel"), 10,
                                              [this](const Twist& twist) { take_command(twist); });
    wheels_ = node.template subscribe<WheelSpeeds>(
        topic("wheel_speeds"), 50, [this](const WheelSpeeds& wheels) { take_wheels(wheels); });
    plan_ = node.template subscribe<Trajectory>(topic("trajectory"), 50,
                                                [this](const Trajectory& plan) { take_plan(plan); });
    tracker_ = node.template subscribe<TrackerStatus>(
        topic("tracker_status"), 50, [this](const TrackerStatus& status) { take_tracker(status); });
    said_ = node.template subscribe<Status>(topic("status"), 50,
                                            [this](const Status& status) { status_ = status; });
  }

  void send_goal(double x, double y, double heading) {
    PoseStamped goal;
    goal.header.frame_id = "map";
    fill(Pose2{{x, y}, heading}, goal.pose);
    goal_.publish(goal);
  }
  /// What its sensors tell from now on.
  void set_scans(bool told) { scans_ = told; }
  void set_odometry(bool told) { odometry_told_ = told; }
  void set_obstacles(bool told) { obstacles_told_ = told; }
  /// Added to every position that is told [m].
  void set_error(const Eigen::Vector2d& error) { error_ = error; }
  void set_walkers(std::vector<Walker> walkers) {
    walkers_ = std::move(walkers);
    gap_ = std::numeric_limits<double>::infinity();
  }
  /// Something holds it where it is, whatever it is told.
  void set_held(bool held) { held_ = held; }
  /// Whether the clock waits for its commands and plans: not for those of processes that were killed.
  void set_awaited(bool awaited) { awaited_ = awaited; }

  [[nodiscard]] const Pose2& pose() const { return pose_; }
  [[nodiscard]] const Status& status() const { return status_; }
  [[nodiscard]] double speed() const { return speed_of(twist_); }  ///< [m/s] as told
  [[nodiscard]] Eigen::Vector2d velocity_world() const {           ///< [m/s] as told
    return Eigen::Rotation2D<double>{pose_.heading} * Eigen::Vector2d{twist_.linear.x, twist_.linear.y};
  }
  /// [m] between the robot, a disc, and the nearest walker, since these were set.
  [[nodiscard]] double least_gap() const { return gap_; }
  /// Stamps of the scans that it was told.
  [[nodiscard]] const std::vector<Nanoseconds>& scans() const { return scans_told_; }
  /// What was observed last before each of its plans, and before the plan behind each of its commands.
  [[nodiscard]] const std::vector<Nanoseconds>& planned_with() const { return planned_with_; }
  [[nodiscard]] const std::vector<Nanoseconds>& commanded_with() const { return commanded_with_; }
  /// Its commands and what it says of itself.
  [[nodiscard]] bool heard_since(Nanoseconds time) const {
    return commanded_ > time && Ros::nanoseconds_of(status_.header.stamp) > time;
  }
  /// When it was commanded last to be about as fast as ever since a time: then it began to brake, if it
  /// stands.
  [[nodiscard]] Nanoseconds last_fast(Nanoseconds since) const {
    double fastest = 0.0;
    Nanoseconds last = since;
    for (const Command& command : commands_) {
      if (command.time < since) continue;
      fastest = std::max(fastest, command.speed);
      if (command.speed > fastest - 0.09) last = command.time;
    }
    return last;
  }
  /// [m/s] of the commands since a time.
  [[nodiscard]] double slowest_since(Nanoseconds since) const {
    double slowest = std::numeric_limits<double>::infinity();
    for (const Command& command : commands_)
      if (command.time >= since) slowest = std::min(slowest, command.speed);
    return slowest;
  }
  /// Fails where a command was beyond the limits of the robot [m/s], [m/s^2]; a guard alone may stop it
  /// harder.
  void check_limits(double max_speed, double max_acceleration) const {
    for (const Command& command : commands_) {
      EXPECT_LE(command.speed, 1.01 * max_speed) << name_;
      const bool guarded = std::any_of(guarded_.begin(), guarded_.end(), [&](Nanoseconds time) {
        return std::abs(time - command.time) < 20 * kTick;
      });
      if (guarded) continue;
      const double seconds = 1e-9 * static_cast<double>(command.since_last);
      EXPECT_LE(command.change, 1.1 * max_acceleration * std::max(seconds, 0.05))
          << name_ << " at " << 1e-9 * static_cast<double>(command.time) << " s";
    }
  }
  [[nodiscard]] std::size_t commands() const { return commands_.size(); }

  // ---- for RobotWorld
  [[nodiscard]] bool awaited() const { return awaited_; }
  /// To the nodes of so many processes.
  [[nodiscard]] bool connected(int processes) const {
    const auto heard_by = [&](const auto& publisher, int nodes) {
      return publisher.subscribers() >= (Ros::kNodesCount ? nodes : std::min(nodes, processes));
    };
    return heard_by(odometry_, 2) && heard_by(scan_, 2) && heard_by(obstacles_, 1) && heard_by(goal_, 1) &&
           command_.matched() >= 1 && wheels_.matched() >= 1 && plan_.matched() >= 1;
  }
  [[nodiscard]] bool commanded_since(Nanoseconds time) const { return !awaited_ || commanded_ > time; }
  [[nodiscard]] bool kept_up(Nanoseconds begin, Nanoseconds now) const {
    // A plan comes every 0.15 s, and with every scan, unless the planner has a reason to make none.
    const bool planned = planned_ > now - 25 * kTick || status_.reason != "moving";
    return commanded_since(begin) && (!awaited_ || planned_ == 0 || planned);
  }
  /// What was heard of it in another time is of no use.
  void forget_times() { commanded_ = planned_ = 0; }
  void move(Nanoseconds now) {
    now_ = now;
    if (commands_.empty() || now - commands_.back().time > 50 * kTick) twist_ = {};
    const double seconds = 1e-9 * static_cast<double>(kTick);
    if (!held_)
      pose_ = {moved(pose_, Eigen::Vector2d{twist_.linear.x, twist_.linear.y} * seconds),
               pose_.heading + twist_.angular.z * seconds};
    for (const Walker& walker : walkers_)
      gap_ = std::min(gap_, (walker.path(1e-9 * static_cast<double>(now)) - pose_.position_world).norm() -
                                walker.radius - kRadius);
    if (!odometry_told_) return;
    Odometry odometry;
    odometry.header.stamp = Ros::time_of(now);
    odometry.header.frame_id = "map";
    odometry.child_frame_id = name_ + "/base_link";
    fill(Pose2{pose_.position_world + error_, pose_.heading}, odometry.pose.pose);
    odometry_.publish(odometry);
  }
  void tell_surroundings(Nanoseconds now) {
    if (scans_) tell_scan(now);
    if (!obstacles_told_) return;
    ObstacleTracks tracks;
    tracks.header.stamp = Ros::time_of(now);
    tracks.header.frame_id = "map";
    obstacles_.publish(tracks);
  }

 private:
  using Twist = typename Ros::Twist;
  using Odometry = typename Ros::Odometry;
  using LaserScan = typename Ros::LaserScan;
  using PoseStamped = typename Ros::PoseStamped;
  using ObstacleTracks = typename Ros::ObstacleTracks;
  using WheelSpeeds = typename Ros::WheelSpeeds;
  using Trajectory = typename Ros::Trajectory;
  using TrackerStatus = typename Ros::TrackerStatus;
  static constexpr double kRadius = 0.3;  // [m] of a robot without a file of its own

  struct Command {
    Nanoseconds time;
    Nanoseconds since_last;
    double speed;   // [m/s]
    double change;  // [m/s] since the last
  };

  [[nodiscard]] std::string topic(const std::string& name) const { return "/" + name_ + "/" + name; }
  [[nodiscard]] static double speed_of(const Twist& twist) {
    return std::hypot(twist.linear.x, twist.linear.y);
  }
  /// [m/s] as seen from the body that turns, or in the map, where that is less: when a command was given is
  /// known to a period, since messages take their time.
  [[nodiscard]] static double change(const Twist& before, const Twist& after, double seconds) {
    double least = std::numeric_limits<double>::infinity();
    for (const double turning : {0.0, 0.05, std::min(seconds, 0.1)}) {
      const Eigen::Rotation2D<double> turn{0.5 * (before.angular.z + after.angular.z) * turning};
      const Eigen::Vector2d velocity = turn * Eigen::Vector2d{after.linear.x, after.linear.y};
      least = std::min(least, (velocity - Eigen::Vector2d{before.linear.x, before.linear.y}).norm());
    }
    return least;
  }
  void take_command(const Twist& twist) {
    const Nanoseconds since = commands_.empty() ? 0 : now_ - commands_.back().time;
    commands_.push_back(
        {now_, since, speed_of(twist), change(twist_, twist, 1e-9 * static_cast<double>(since))});
    twist_ = twist;
  }
  void take_wheels(const WheelSpeeds& wheels) {
    commanded_ = Ros::nanoseconds_of(wheels.header.stamp);
    if (wheels.guard != WheelSpeeds::CLEAR) guarded_.push_back(now_);
  }
  void take_plan(const Trajectory& plan) {
    planned_ = Ros::nanoseconds_of(plan.header.stamp);
    planned_with_.push_back(Ros::nanoseconds_of(plan.observed));
  }
  void take_tracker(const TrackerStatus& status) {
    if (status.latency_ms >= 0.0)
      commanded_with_.push_back(Ros::nanoseconds_of(status.header.stamp) -
                                static_cast<Nanoseconds>(1e6 * status.latency_ms));
  }
  void tell_scan(Nanoseconds now) {
    constexpr int kBeams = 360;
    LaserScan scan;
    scan.header.stamp = Ros::time_of(now);
    scan.header.frame_id = name_ + "/base_link";
    scan.angle_min = static_cast<float>(-M_PI);
    scan.angle_increment = static_cast<float>(2.0 * M_PI / kBeams);
    scan.angle_max = scan.angle_min + static_cast<float>(kBeams - 1) * scan.angle_increment;
    scan.range_min = 0.05F;
    scan.range_max = 8.0F;
    for (int i = 0; i < kBeams; ++i) {
      const double angle = scan.angle_min + static_cast<double>(i) * scan.angle_increment;
      const double range = range_along(pose_.heading + angle, 1e-9 * static_cast<double>(now));
      scan.ranges.push_back(range < scan.range_max ? static_cast<float>(range)
                                                   : std::numeric_limits<float>::infinity());
    }
    scan_.publish(scan);
    scans_told_.push_back(now);
  }
  /// [m] to the nearest walker in a direction [rad] of the map.
  [[nodiscard]] double range_along(double direction, double time) const {
    const Eigen::Vector2d beam{std::cos(direction), std::sin(direction)};
    double range = std::numeric_limits<double>::infinity();
    for (const Walker& walker : walkers_) {
      const Eigen::Vector2d offset = walker.path(time) - pose_.position_world;
      const double along = offset.dot(beam);
      const double inside = walker.radius * walker.radius - (offset.squaredNorm() - along * along);
      if (along > 0.0 && inside >= 0.0) range = std::min(range, along - std::sqrt(inside));
    }
    return range;
  }

  std::string name_;
  Pose2 pose_;
  typename Ros::Heard command_, wheels_, plan_, said_, tracker_;
  typename Ros::template Publisher<Odometry> odometry_;
  typename Ros::template Publisher<LaserScan> scan_;
  typename Ros::template Publisher<ObstacleTracks> obstacles_;
  typename Ros::template Publisher<PoseStamped> goal_;
  bool scans_ = true, odometry_told_ = true, obstacles_told_ = true, awaited_ = true, held_ = false;
  Eigen::Vector2d error_{0.0, 0.0};
  Nanoseconds now_ = 0, commanded_ = 0, planned_ = 0;  // stamps of the last command and plan
  Twist twist_;
  std::vector<Command> commands_;
  std::vector<Nanoseconds> guarded_;  // when the guard held a command back
  std::vector<Nanoseconds> scans_told_, planned_with_, commanded_with_;
  std::vector<Walker> walkers_;
  double gap_ = std::numeric_limits<double>::infinity();  // [m]
  Status status_;
};

/// Bases and their clock.
template <class Ros>
class RobotWorld {
 public:
  using Base = RobotBase<Ros>;
  struct Start {
    int robot_id = 3;
    Pose2 pose;
  };
  explicit RobotWorld(const std::vector<Start>& starts = {{}}) : node_{starts.front().robot_id} {
    for (const Start& start : starts)
      bases_.push_back(std::make_unique<Base>(node_, start.robot_id, start.pose));
  }

  /// A tenth of a second. False when a robot has not kept up, and ever after.
  [[nodiscard]] bool go_on() {
    auto began = std::chrono::steady_clock::now();
    for (int i = 0; i < kTicksOfAScan && !left_behind_; ++i) {
      if (i == kTicksOfACommand) began = std::chrono::steady_clock::now();
      tick();
      if (i == 0)
        for (const auto& base : bases_) base->tell_surroundings(time_);
      if (i % kTicksOfACommand != kTicksOfACommand - 1) continue;
      const Nanoseconds begin = time_ - kTicksOfACommand * kTick;
      auto next = std::chrono::steady_clock::now() + std::chrono::seconds{1};
      const bool kept_up = node_.run_until([&] {
        // A first command may be sent before the two have found each other both ways: then it takes another.
        if (!all([&](const Base& base) { return base.commanded_since(begin); }) &&
            std::chrono::steady_clock::now() > next) {
          next += std::chrono::seconds{1};
          for (int more = 0; more < kTicksOfACommand; ++more) tick();
        }
        return all([&](const Base& base) { return base.kept_up(begin, time_); });
      });
      left_behind_ = !kept_up;
      // At most so many times as fast as time: what is under way, messages and timers, takes some of it; and
      // five times where the clock waits for nobody.
      const double rate = all([](const Base& base) { return base.awaited(); }) ? Ros::kFastest : 5.0;
      std::this_thread::sleep_until(began +
                                    std::chrono::duration<double>{1e-9 * kTicksOfACommand * kTick / rate});
    }
    return !left_behind_;
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

  /// The clock jumps [s], to a whole tick.
  void jump(double seconds) {
    time_ += kTick * std::llround(seconds * 1e9 / static_cast<double>(kTick));
    for (const auto& base : bases_) base->forget_times();
  }

  /// Until the robots, each of so many processes, say that they have started, and listen.
  [[nodiscard]] bool wait_for_robots(int processes = 1) {
    const int clocks = static_cast<int>(bases_.size()) * (Ros::kNodesCount ? 3 : processes);
    return node_.run_until([&] {
      tell_clock();
      return clock_.subscribers() >= clocks &&
             all([&](const Base& base) { return base.connected(processes); });
    });
  }

  typename Ros::Node& ros() { return node_; }
  [[nodiscard]] Base& base(std::size_t i = 0) { return *bases_.at(i); }
  [[nodiscard]] Nanoseconds time() const { return time_; }
  [[nodiscard]] double seconds() const { return 1e-9 * static_cast<double>(time_); }  ///< [s]

 private:
  template <class Holds>
  [[nodiscard]] bool all(Holds holds) const {
    return std::all_of(bases_.begin(), bases_.end(), [&](const auto& base) { return holds(*base); });
  }
  void tell_clock() {
    typename Ros::Clock clock;
    clock.clock = Ros::time_of(time_);
    clock_.publish(clock);
  }
  void tick() {
    time_ += kTick;
    tell_clock();
    for (const auto& base : bases_) base->move(time_);
    node_.take();
  }

  typename Ros::Node node_;
  typename Ros::template Publisher<typename Ros::Clock> clock_ =
      node_.template advertise<typename Ros::Clock>("/clock", 10);
  std::vector<std::unique_ptr<Base>> bases_;
  bool left_behind_ = false;
  Nanoseconds time_ = 1'000'000'000'000;
};

}  // namespace spf::wire
