// A host for tests of the agent: the robot is exactly where its plan says, observations come at 10 Hz,
// messages as the test says. The truth (boxes, obstacles) is kept apart from what the agent is told. Frame:
// world.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <ostream>
#include <utility>
#include <vector>

#include "spf/math/angles.hpp"
#include "spf/team/method_table.hpp"
#include "spf/team/robot_agent.hpp"

namespace spf {

/// So that failed comparisons can be read.
inline void PrintTo(StopCause reason, std::ostream* stream) {
  *stream << to_string(reason);
}

/// An axis-aligned box of the true world.
struct TrueBox {
  Eigen::Vector2d low;   // [m]
  Eigen::Vector2d high;  // [m]

  [[nodiscard]] double distance(const Eigen::Vector2d& p) const {
    return (low - p).cwiseMax(p - high).cwiseMax(0.0).norm();
  }
  /// Distance along a ray to the box [m], infinity when it misses (slab method; the ray starts outside).
  [[nodiscard]] double hit(const Eigen::Vector2d& from, const Eigen::Vector2d& direction) const {
    const Eigen::Array2d a = (low - from).array() / direction.array();
    const Eigen::Array2d b = (high - from).array() / direction.array();
    const double enter = a.min(b).maxCoeff();
    const double leave = a.max(b).minCoeff();
    return enter > 0.0 && enter <= leave ? enter : std::numeric_limits<double>::infinity();
  }
};

/// A disc on a given course.
struct TrueObstacle {
  int id = 0;
  double radius = 0.4;  // [m]
  std::function<Eigen::Vector2d(double)> position;
};

inline OccupancyMap empty_map() {
  OccupancyMap map{GridFrame::covering({-10.0, -10.0}, {10.0, 10.0}, 0.1), 2.0};
  map.add_border({-10.0, -10.0}, {10.0, 10.0});
  return map;
}

inline OccupancyMap map_of(const std::vector<TrueBox>& boxes) {
  OccupancyMap map = empty_map();
  for (const TrueBox& box : boxes) map.add_box(box.low, box.high);
  return map;
}

/// What a teammate on this trajectory would tell.
inline TrajectoryMessage told_by(int robot_id, std::uint32_t sequence, double time, PeerState state,
                                 const Trajectory& trajectory) {
  TrajectoryMessage message;
  message.robot_id = robot_id;
  message.sequence = sequence;
  message.sent_time = time;
  message.expiry_time = time + 1.5;
  message.state = state;
  message.trajectory = trajectory;
  return message;
}

/// A straight motion at constant velocity from a position on.
inline Trajectory straight(const Eigen::Vector2d& from, const Eigen::Vector2d& velocity, double start_time,
                           double duration) {
  QuinticPiece piece;
  piece.duration = duration;
  piece.coefficients.row(0) = from.transpose();
  piece.coefficients.row(1) = velocity.transpose();
  Trajectory trajectory{start_time};
  trajectory.append(piece);
  return trajectory;
}

/// What an agent is told in one tick.
struct AgentInput {
  StateEstimate state;  ///< of the robot, now
  std::optional<Observation> observation;
  std::vector<HeardMessage> messages;
};

struct AgentOutput {
  bool planned = false;
  std::optional<TrajectoryMessage> broadcast;
};

/// Lets an agent take in what it is told, and plan where due.
inline AgentOutput step(RobotAgent& agent, double time, const AgentInput& input,
                        StopCause stop = StopCause::none) {
  for (const HeardMessage& message : input.messages) agent.hear(message, time);
  const std::optional<Pose2> here = input.state.valid ? std::optional{input.state.pose_world} : std::nullopt;
  if (input.observation) agent.observe(*input.observation, here, time);
  if (!agent.plan_due(time)) return {};
  return {true, agent.plan(time, input.state, stop)};
}

class IdealHost {
 public:
  static constexpr double kTick = 0.01;  // [s]

  IdealHost(const AgentParameters& parameters, const OccupancyMap& map, const Eigen::Vector2d& start,
            int robot_id = 1)
      : agent{robot_id, parameters, map, {start, 0.0}, 0.0}, position{start} {}

  RobotAgent agent;
  std::vector<TrueBox> boxes;           // true static surroundings, for the clearance and the scan
  std::vector<TrueObstacle> obstacles;  // true moving obstacles, reported exactly but without velocity
  bool send_scans = false;
  StopCause stop = StopCause::none;                     // as its watchdog says
  std::function<void(double, AgentInput&)> more_input;  // may add to what the agent is told
  std::vector<TrajectoryMessage> told;                  // by the agent

  Eigen::Vector2d position;                                             // [m] of the robot now
  double box_clearance = std::numeric_limits<double>::infinity();       // [m] least so far, between surfaces
  double obstacle_clearance = std::numeric_limits<double>::infinity();  // [m] likewise
  double highest_speed = 0.0;                                           // [m/s] of all committed plans
  double highest_acceleration = 0.0;                                    // [m/s^2]
  double largest_jump = 0.0;  // [m] of the position from tick to tick, beyond what max_speed allows

  [[nodiscard]] double time() const { return kTick * ticks_; }
  [[nodiscard]] double speed() const { return agent.committed().state(time()).velocity_world.norm(); }

  [[nodiscard]] AgentInput input() {
    AgentInput input;
    const double now = time();
    input.state.valid = true;
    input.state.pose_world = {position, agent.committed().heading_state(now).heading};
    if (ticks_ % 10 == 0) {
      input.observation.emplace();
      input.observation->time = now;
      for (const TrueObstacle& obstacle : obstacles)
        input.observation->detections.push_back(
            {obstacle.id, obstacle.position(now), std::nullopt, obstacle.radius, 0.0});
      if (send_scans) input.observation->scan = sweep();
    }
    if (more_input) more_input(now, input);
    return input;
  }

  AgentOutput tick() {
    ++ticks_;
    const double now = time();
    move_to(agent.committed().position(now));
    const AgentOutput output = step(agent, now, input(), stop);
    if (output.broadcast) told.push_back(*output.broadcast);
    if (output.planned) {
      highest_speed = std::max(highest_speed, agent.committed().max_speed());
      highest_acceleration = std::max(highest_acceleration, agent.committed().max_acceleration());
    }
    // A plan committed now has to go on from here.
    largest_jump = std::max(largest_jump, (agent.committed().position(now) - position).norm());
    return output;
  }

  void run(double seconds) {
    const auto ticks = static_cast<int>(std::lround(seconds / kTick));
    for (int i = 0; i < ticks; ++i) tick();
  }

  /// Runs until the agent says that it has arrived; false when it has not in time.
  bool arrives_within(double seconds) {
    const double end = time() + seconds;
    while (time() < end) {
      tick();
      if (agent.status().reason == StopCause::arrived) return true;
    }
    return false;
  }

 private:
  void move_to(const Eigen::Vector2d& next) {
    const double allowed = 1.1 * agent.parameters().robot.max_speed * kTick;
    largest_jump = std::max(largest_jump, (next - position).norm() - allowed);
    position = next;
    const double radius = agent.parameters().robot.radius;
    for (const TrueBox& box : boxes) box_clearance = std::min(box_clearance, box.distance(position) - radius);
    for (const TrueObstacle& obstacle : obstacles) {
      const double gap = (obstacle.position(time()) - position).norm() - radius - obstacle.radius;
      obstacle_clearance = std::min(obstacle_clearance, gap);
    }
  }

  [[nodiscard]] RangeScan sweep() const {
    constexpr int kBeams = 360;
    RangeScan scan;
    scan.angle_min = -kPi;
    scan.angle_increment = 2.0 * kPi / kBeams;
    const double heading = agent.committed().heading_state(time()).heading;
    for (int i = 0; i < kBeams; ++i) {
      const double angle = heading + scan.angle_min + i * scan.angle_increment;
      double range = std::numeric_limits<double>::infinity();
      for (const TrueBox& box : boxes)
        range = std::min(range, box.hit(position, {std::cos(angle), std::sin(angle)}));
      scan.ranges.push_back(range <= scan.max_range ? range : std::numeric_limits<double>::infinity());
    }
    return scan;
  }

  int ticks_ = 0;
};

}  // namespace spf
