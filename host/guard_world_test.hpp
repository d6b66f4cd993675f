// A robot that is told to drive and has nothing but its guard, among walls and discs: wheels that brake no
// harder than the robot can and lag, and a scanner with noise. Frame: world.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "host/scan_guard.hpp"
#include "spf/math/angles.hpp"
#include "spf/math/plane.hpp"
#include "spf/math/random_stream.hpp"
#include "spf/math/segment.hpp"
#include "spf/robot/drive.hpp"

namespace spf::host {

struct GuardDisc {
  Eigen::Vector2d center;
  double radius;
  Eigen::Vector2d velocity_world = Eigen::Vector2d::Zero();
};

class GuardWorld {
 public:
  static constexpr double kTick = 0.01;  // [s] of the truth; commands every fifth, scans every tenth

  explicit GuardWorld(const AgentParameters& of_agent = {}, const GuardParameters& of_guard = {})
      : agent{of_agent}, guard{of_guard, of_agent, 0.1} {}

  void tick() {
    if (ticks_ % 10 == 0) scan();
    if (ticks_ % 5 == 0) {
      const Eigen::Vector3d wanted = command(time);
      guard.moves(time, twist_body);
      guard.judge(time, wanted);
      told_ = guard.allowed(wanted);
      if (guard.verdict().action != GuardAction::none) ++held;
    }
    drive();
    for (GuardDisc& disc : discs) disc.center += kTick * disc.velocity_world;
    if (each_tick) each_tick();
    ++ticks_;
    time = 50.0 + kTick * static_cast<double>(ticks_);
    gap = std::min(gap, distance() - agent.robot.radius);
  }
  /// It is under way already, along x.
  void moving(double speed) {
    twist_body = {speed, 0.0, 0.0};
    told_ = limited_ = twist_world_ = twist_body;
  }
  void run(double seconds) {
    for (const double end = time + seconds - 1e-9; time < end;) tick();
  }
  [[nodiscard]] double speed() const { return twist_body.head<2>().norm(); }
  /// From the centre to the nearest surface [m].
  [[nodiscard]] double distance() const {
    double nearest = std::numeric_limits<double>::infinity();
    for (const GuardDisc& disc : discs)
      nearest = std::min(nearest, (disc.center - pose.position_world).norm() - disc.radius);
    for (const LineSegment& wall : walls)
      nearest = std::min(nearest, distance_to_segment(pose.position_world, wall));
    return nearest;
  }
  [[nodiscard]] RangeScan sweep() {
    RangeScan result;
    result.angle_min = -kPi;
    result.angle_increment = 2.0 * kPi / beams;
    result.max_range = 60.0;
    for (int i = 0; i < beams; ++i) {
      const double angle = pose.heading + result.angle_min + i * result.angle_increment;
      const double range = range_along({std::cos(angle), std::sin(angle)});
      result.ranges.push_back(range <= result.max_range ? std::max(1e-3, range + range_sigma * noise.normal())
                                                        : std::numeric_limits<double>::infinity());
    }
    return result;
  }

  AgentParameters agent;
  ScanGuard guard;
  std::function<Eigen::Vector3d(double)> command;  // of a time: a twist in the body
  std::vector<LineSegment> walls;
  std::vector<GuardDisc> discs;
  std::function<void(RangeScan&)> spoil;
  std::function<void()> each_tick;
  int beams = 720;
  double range_sigma = 0.0;  // [m]
  double time = 50.0;        // [s]
  Pose2 pose;
  Eigen::Vector3d twist_body = Eigen::Vector3d::Zero();
  double gap = std::numeric_limits<double>::infinity();  // [m] least so far, negative in a contact
  int held = 0;                                          // control ticks in which the guard acted
  RandomStream noise{7};

 private:
  [[nodiscard]] double range_along(const Eigen::Vector2d& direction) const {
    double range = std::numeric_limits<double>::infinity();
    for (const GuardDisc& disc : discs) {
      const Eigen::Vector2d to = disc.center - pose.position_world;
      const double along = to.dot(direction);
      const double room = disc.radius * disc.radius - (to.squaredNorm() - along * along);
      if (along > 0.0 && room >= 0.0) range = std::min(range, along - std::sqrt(room));
    }
    for (const LineSegment& wall : walls) {
      const Eigen::Vector2d along = wall.to - wall.from;
      const Eigen::Vector2d to = wall.from - pose.position_world;
      const double parallel = cross(direction, along);
      if (std::abs(parallel) < 1e-12) continue;
      const double reach = cross(to, along) / parallel;
      const double share = cross(to, direction) / parallel;
      if (reach > 0.0 && share >= 0.0 && share <= 1.0) range = std::min(range, reach);
    }
    return range;
  }
  void scan() {
    RangeScan seen = sweep();
    if (spoil) spoil(seen);
    guard.add_scan(time, seen, Pose2{}, time);
  }
  /// Brakes and speeds up no harder than the robot can, a motor lag late.
  void drive() {
    const Eigen::Vector3d told = twist_in_world(told_, pose.heading);
    const Eigen::Vector2d change = told.head<2>() - limited_.head<2>();
    const double most = agent.robot.max_acceleration * kTick;
    limited_.head<2>() += change.norm() > most ? Eigen::Vector2d{most / change.norm() * change} : change;
    limited_.z() = told.z();
    const double share = std::min(1.0, kTick / std::max(kTick, agent.robot.motor_lag));
    twist_world_ += share * (limited_ - twist_world_);
    pose.position_world += kTick * twist_world_.head<2>();
    pose.heading = wrap_angle(pose.heading + kTick * twist_world_.z());
    twist_body = twist_in_body(twist_world_, pose.heading);
  }

  long ticks_ = 0;
  Eigen::Vector3d told_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d limited_ = Eigen::Vector3d::Zero();      // world
  Eigen::Vector3d twist_world_ = Eigen::Vector3d::Zero();  // likewise
};

}  // namespace spf::host
