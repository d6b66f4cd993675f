// One robot on a bench: both hosts, wheels that obey at once, and a clock, poses and sensors that can be made
// to fail. What is true is kept apart from what the hosts are told. Frame: world.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "host/planner_host.hpp"
#include "host/tracker_host.hpp"
#include "spf/math/angles.hpp"

namespace spf::host {

inline OccupancyMap open_map() {
  return {GridFrame::covering({-20.0, -20.0}, {20.0, 20.0}, 0.1), 2.0};
}

struct Pillar {
  Eigen::Vector2d center;
  double radius;
};

class Bench {
 public:
  static constexpr double kTick =
      0.01;  // [s] poses; observations and plans come every tenth, commands every fifth

  explicit Bench(const HostParameters& parameters = {}, int robot_id = 0)
      : host{parameters},
        planner{robot_id, AgentParameters{}, parameters},
        tracker{robot_id, AgentParameters{}, parameters} {
    planner.set_map(open_map());
  }

  void tick() {
    ++ticks_;
    time += kTick;
    now = time + clock_offset;
    pose.position_world += kTick * velocity_world;
    pose.heading = wrap_angle(pose.heading + kTick * yaw_rate);
    if (send_poses) tell_pose({now, distorted(pose)});
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
    ASSERT_GT(speed(), 0.9) << planner.status().reason << ", " << to_string(tracker.command().mode);
  }
  [[nodiscard]] double speed() const { return velocity_world.norm(); }
  [[nodiscard]] TrackerMode mode() const { return tracker.command().mode; }
  [[nodiscard]] std::string reason() const { return planner.status().reason; }
  /// What a restart by the system does to each.
  void restart_planner() {
    planner = PlannerHost{0, AgentParameters{}, host};
    planner.set_map(open_map());
  }
  void restart_tracker() { tracker = TrackerHost{0, AgentParameters{}, host}; }

  HostParameters host;
  PlannerHost planner;
  TrackerHost tracker;
  double time = 100.0;        // [s] true
  double now = 100.0;         // [s] as the clock says
  double clock_offset = 0.0;  // [s]
  Pose2 pose;
  Eigen::Vector2d velocity_world = Eigen::Vector2d::Zero();
  double yaw_rate = 0.0;
  bool send_poses = true;
  bool send_scans = true;
  bool send_detections = true;
  bool planner_alive = true;
  std::function<Pose2(const Pose2&)> distort;
  std::function<void()> each_tenth;
  std::vector<Pillar> pillars;
  double clearance = std::numeric_limits<double>::infinity();  // [m] least so far, to pillars
  double hardest_braking = 0.0;                                // [m/s^2] of the commands since the last reset
  std::vector<PoseVerdict> pose_verdicts;

 private:
  [[nodiscard]] Pose2 distorted(const Pose2& truth) const { return distort ? distort(truth) : truth; }
  void tell_pose(const PoseMeasurement& measured) {
    pose_verdicts.push_back(tracker.add_pose(measured, now));
    if (planner_alive) planner.add_pose(measured, now);
  }
  void observe() {
    if (!planner_alive) return;
    if (send_detections) {
      SensedWorld sensed;
      sensed.observation.time = now;
      sensed.has_detections = true;
      planner.add_observation(sensed, now);
    }
    if (!send_scans) return;
    SensedWorld sensed;
    sensed.observation.time = now;
    sensed.observation.scan = scan();
    planner.add_observation(sensed, now);
  }
  [[nodiscard]] RangeScan scan() const {
    constexpr int kBeams = 360;
    RangeScan result;
    result.angle_min = -kPi;
    result.angle_increment = 2.0 * kPi / kBeams;
    for (int i = 0; i < kBeams; ++i) {
      const double angle = pose.heading + result.angle_min + i * result.angle_increment;
      const Eigen::Vector2d way{std::cos(angle), std::sin(angle)};
      double range = std::numeric_limits<double>::infinity();
      for (const Pillar& pillar : pillars) {
        const Eigen::Vector2d to = pillar.center - pose.position_world;
        const double along = to.dot(way);
        const double room = pillar.radius * pillar.radius - (to.squaredNorm() - along * along);
        if (along > 0.0 && room >= 0.0) range = std::min(range, along - std::sqrt(room));
      }
      result.ranges.push_back(range <= result.max_range ? range : std::numeric_limits<double>::infinity());
    }
    return result;
  }
  void think() {
    const PlannerOutput& output = planner.step(now);
    if (output.planned) tracker.add_plan(output.plan, now);
  }
  void control() {
    const TrackerCommand& command = tracker.step(now);
    const Eigen::Vector3d twist = twist_in_world(command.twist_body, pose.heading);
    hardest_braking = std::max(hardest_braking, (speed() - twist.head<2>().norm()) / (5.0 * kTick));
    velocity_world = twist.head<2>();
    yaw_rate = twist.z();
    for (const Pillar& pillar : pillars)
      clearance = std::min(clearance, (pose.position_world - pillar.center).norm() - pillar.radius - 0.3);
  }

  long ticks_ = 0;
};

}  // namespace spf::host
