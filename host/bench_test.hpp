// One robot on a bench, in one process or split into two: wheels that obey at once, and a clock, poses and
// sensors that can be made to fail. What is true is kept apart from what the hosts are told. Frame: world.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "host/robot_host.hpp"
#include "host/split_host.hpp"
#include "spf/math/angles.hpp"

namespace spf::host {

inline OccupancyMap open_map() {
  return {GridFrame::covering({-20.0, -20.0}, {20.0, 20.0}, 0.1), 2.0};
}

struct Pillar {
  Eigen::Vector2d center;
  double radius;
};

/// Of a robot's planner and controller.
enum class Arrangement { one_process, split };

inline std::string name_of(const testing::TestParamInfo<Arrangement>& info) {
  return info.param == Arrangement::split ? "split" : "one_process";
}

/// So that failed comparisons can be read.
inline void PrintTo(StopCause cause, std::ostream* stream) {
  *stream << to_string(cause);
}

class Bench {
 public:
  static constexpr double kTick =
      0.01;  // [s] poses; observations and plans come every tenth, commands every fifth

  explicit Bench(Arrangement arrangement = Arrangement::split, const HostParameters& parameters = {},
                 std::uint32_t first_sequence = 0, const AgentParameters& agent_parameters = {})
      : host{parameters},
        agent{agent_parameters},
        robot{0, agent, parameters, Motion::by_wheels, first_sequence},
        planning{0, agent, parameters, first_sequence},
        driving{0, agent, parameters},
        split{arrangement == Arrangement::split},
        planner{split ? planning.planner() : robot.planner()},
        tracker{split ? driving.tracker() : robot.tracker()} {
    planner.set_map(open_map());
  }
  Bench(const Bench&) = delete;
  Bench& operator=(const Bench&) = delete;

  void tick() {
    ++ticks_;
    time += kTick;
    now = time + clock_offset;
    pose.position_world += kTick * (grip * velocity_world + push_world);
    pose.heading = wrap_angle(pose.heading + kTick * grip * yaw_rate);
    if (send_poses) tell_pose({now, distorted(pose)});
    deliver_late_scans();
    if (ticks_ % 10 == 0) observe();
    if (ticks_ % 10 == 0 && each_tenth) each_tenth();
    if (planner_alive) think();
    if (ticks_ % 5 == 0) control();
  }
  void run(double seconds) {
    for (const double end = time + seconds - 1e-9; time < end;) tick();
  }
  /// Seconds until the commanded speed begins to sink, at most `longest`.
  double time_until_braking(double longest = 3.0) {
    const double from = time;
    double top = speed();
    while (time < from + longest) {
      tick();
      if (speed() < top - 0.02) return time - from;
      top = std::max(top, speed());
    }
    return std::numeric_limits<double>::infinity();
  }
  /// Lets it drive towards a far goal at full speed.
  void drive() {
    ASSERT_TRUE(planner.set_goal({{15.0, 0.0}, std::nullopt}));
    run(3.5);
    ASSERT_GT(speed(), 0.9 * agent.robot.max_speed) << planner.status().reason << ", " << to_string(cause());
  }
  [[nodiscard]] double speed() const { return velocity_world.norm(); }
  /// That of the controller's half.
  [[nodiscard]] const Localiser& localiser() const { return split ? driving.localiser() : robot.localiser(); }
  /// Why the controller brakes or stands.
  [[nodiscard]] StopCause cause() const { return tracker.command().stop; }
  void set_switches(const Switches& switches) {
    robot.set_switches(switches);
    planning.planner().set_switches(switches);
    driving.tracker().set_switches(switches);
  }
  [[nodiscard]] std::vector<std::uint32_t> clock_jumps() const {
    if (!split) return {robot.clock_jumps()};
    return {planning.clock_jumps(), driving.clock_jumps()};
  }
  [[nodiscard]] std::string reason() const { return planner.status().reason; }
  /// What a restart by the system does to each.
  void restart_planner() {
    planning = PlannerProcess{0, agent, host};
    planner.set_map(open_map());
  }
  void restart_tracker() { driving = TrackerProcess{0, agent, host}; }

  HostParameters host;
  AgentParameters agent;
  RobotHost robot;          // of one process
  PlannerProcess planning;  // of two
  TrackerProcess driving;   // likewise
  bool split;
  PlannerHost& planner;        // of the arrangement
  const TrackerHost& tracker;  // likewise
  double time = 100.0;         // [s] true
  double now = 100.0;          // [s] as the clock says
  double clock_offset = 0.0;   // [s]
  Pose2 pose;
  Eigen::Vector2d velocity_world = Eigen::Vector2d::Zero();
  double yaw_rate = 0.0;
  bool send_poses = true;
  std::optional<double> localised;  // [s] when the transform that places the poses was last known
  bool send_scans = true;
  double scan_delay = 0.0;  // [s] a scan comes so long after it was made
  bool send_detections = true;
  bool planner_alive = true;
  bool planner_sees_scans = true;  // or the guard alone
  double grip = 1.0;               // [1] share of the wheels' motion that comes true: 0 = held
  Eigen::Vector2d push_world = Eigen::Vector2d::Zero();  // [m/s] by somebody, or by the floor
  std::function<Pose2(const Pose2&)> distort;
  std::function<void()> each_tenth;
  std::vector<Pillar> pillars;
  double clearance = std::numeric_limits<double>::infinity();  // [m] least so far, to pillars
  double hardest_braking = 0.0;                                // [m/s^2] of the commands since the last reset
  /// Of all commands since the last reset, as a share of the robot's limits [1].
  struct Largest {
    double speed = 0.0;
    double acceleration = 0.0;
    double yaw_rate = 0.0;
    double yaw_acceleration = 0.0;
    double wheel_speed = 0.0;
  } largest;

 private:
  [[nodiscard]] Pose2 distorted(const Pose2& truth) const { return distort ? distort(truth) : truth; }
  void tell_pose(const PoseMeasurement& measured) {
    if (!split) {
      robot.add_pose(measured, now);
      if (localised) robot.localiser().placed_by_transform_of(*localised);
      return;
    }
    driving.add_pose(measured, now);
    if (localised) driving.localiser().placed_by_transform_of(*localised);
    if (!planner_alive) return;
    planning.add_pose(measured, now);
    if (localised) planning.localiser().placed_by_transform_of(*localised);
  }
  void observe() {
    if (send_detections && planner_alive) {
      SensedWorld sensed;
      sensed.observation.time = now;
      sensed.has_detections = true;
      tell_seen(sensed);
    }
    if (!send_scans) return;
    SensedWorld sensed;
    sensed.observation.time = now;
    sensed.observation.scan = scan();
    if (split) driving.add_scan(now, *sensed.observation.scan, Pose2{}, now);
    if (!planner_sees_scans) return;
    if (scan_delay > 0.0)
      late_scans_.push_back(sensed);
    else if (planner_alive)
      tell_seen(sensed);
  }
  void deliver_late_scans() {
    while (!late_scans_.empty() && late_scans_.front().observation.time + scan_delay <= now + 1e-9) {
      if (planner_alive) tell_seen(late_scans_.front());
      late_scans_.erase(late_scans_.begin());
    }
  }
  void tell_seen(const SensedWorld& sensed) {
    if (split)
      planning.add_observation(sensed, now);
    else
      robot.add_observation(sensed, now);
  }
  [[nodiscard]] RangeScan scan() const {
    constexpr int kBeams = 360;
    RangeScan result;
    result.angle_min = -kPi;
    result.angle_increment = 2.0 * kPi / kBeams;
    for (int i = 0; i < kBeams; ++i) {
      const double angle = pose.heading + result.angle_min + i * result.angle_increment;
      const Eigen::Vector2d direction{std::cos(angle), std::sin(angle)};
      double range = std::numeric_limits<double>::infinity();
      for (const Pillar& pillar : pillars) {
        const Eigen::Vector2d to = pillar.center - pose.position_world;
        const double along = to.dot(direction);
        const double room = pillar.radius * pillar.radius - (to.squaredNorm() - along * along);
        if (along > 0.0 && room >= 0.0) range = std::min(range, along - std::sqrt(room));
      }
      result.ranges.push_back(range <= result.max_range ? range : std::numeric_limits<double>::infinity());
    }
    return result;
  }
  void think() {
    const PlannerOutput& output = split ? planning.step(now) : robot.plan(now);
    if (split && output.planned) driving.add_plan(output.plan, now);
  }
  void control() {
    const TrackerCommand& command = split ? driving.step(now) : robot.control(now);
    if (split && planner_alive) planning.add_command(now, command.wheel_speeds, now, command.guard.action);
    const Eigen::Vector3d twist = twist_in_world(command.twist_body, pose.heading);
    note_limits(command, twist);
    hardest_braking = std::max(hardest_braking, (speed() - twist.head<2>().norm()) / (5.0 * kTick));
    velocity_world = twist.head<2>();
    yaw_rate = twist.z();
    for (const Pillar& pillar : pillars)
      clearance = std::min(clearance, (pose.position_world - pillar.center).norm() - pillar.radius - 0.3);
  }

  void note_limits(const TrackerCommand& command, const Eigen::Vector3d& twist_world) {
    const RobotParameters& limits = agent.robot;
    const double period = 5.0 * kTick;
    const auto note = [](double& most, double value) { most = std::max(most, value); };
    note(largest.speed, twist_world.head<2>().norm() / limits.max_speed);
    note(largest.acceleration,
         (twist_world.head<2>() - velocity_world).norm() / (limits.max_acceleration * period));
    note(largest.yaw_rate, std::abs(twist_world.z()) / limits.max_yaw_rate);
    note(largest.yaw_acceleration,
         std::abs(twist_world.z() - yaw_rate) / (limits.max_yaw_acceleration * period));
    note(largest.wheel_speed, command.wheel_speeds.lpNorm<Eigen::Infinity>() / limits.max_wheel_speed);
  }

  long ticks_ = 0;
  std::vector<SensedWorld> late_scans_;
};

}  // namespace spf::host
