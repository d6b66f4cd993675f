#include "sim/trial_meter.hpp"

#include <algorithm>
#include <cstring>

#include "spf/math/random_stream.hpp"

namespace spf::sim {
namespace {

constexpr double kArrivalSpeed = 0.2;     // [m/s] who is near the goal and slower than this has arrived
constexpr double kStillSpeed = 0.02;      // [m/s]
constexpr double kLongestWay = 120.0;     // [s] to one goal of many, or
constexpr double kLongestWayTimes = 4.0;  // [1] times what it would take alone

std::uint64_t bits_of(double value) {
  std::uint64_t bits = 0;
  std::memcpy(&bits, &value, sizeof bits);
  return bits;
}

}  // namespace

TrialMeter::TrialMeter(const Scenario& scenario)
    : parameters_{scenario.simulation.trial}, ways_(scenario.robots.size()), robots_(scenario.robots.size()) {
  for (std::size_t i = 0; i < scenario.robots.size(); ++i) {
    const RobotTask& task = scenario.robots[i];
    kinds_.push_back(scenario.robot_of(i));
    goals_.emplace_back(host::Goal{task.goal_world, task.goal_heading});
    ways_[i].from = task.start.position_world;
  }
}

double TrialMeter::fastest(std::size_t robot, double distance) const {
  return rest_to_rest_time(distance, kinds_[robot].max_speed, kinds_[robot].max_acceleration);
}

/// [m] To the present goal.
double TrialMeter::straight(std::size_t robot) const {
  return goals_[robot] ? (goals_[robot]->position_world - ways_[robot].from).norm() : 0.0;
}

bool TrialMeter::excused(std::size_t robot, const RobotTruth& truth) const {
  return !goals_[robot] || truth.broken || (truth.gone && !truth.arrived);
}

void TrialMeter::close_way(std::size_t robot, const Eigen::Vector2d& at) {
  Way& way = ways_[robot];
  const double done = way.ended ? straight(robot) : goals_[robot] ? (at - way.from).norm() : 0.0;
  way.straight_before += done;
  way.fastest_before += done > 0.0 ? fastest(robot, done) : 0.0;
  way.ended = false;
  way.under_way = 0.0;
  way.from = at;
}

void TrialMeter::set_goal(std::size_t robot, const Eigen::Vector2d& from,
                          const std::optional<host::Goal>& goal) {
  close_way(robot, from);
  goals_[robot] = goal;
}

/// Times of a robot over one tick that ended at `time` [s].
void TrialMeter::measure(double time, std::size_t robot, const RobotTruth& truth) {
  const double dt = time - time_;
  Way& way = ways_[robot];
  RobotResult& result = robots_[robot];
  if (!truth.gone) result.life.present_time += dt;
  const bool idle = truth.arrived || truth.gone || truth.broken || !goals_[robot];
  if (idle) way.idle += dt;
  const bool goes = !idle && !truth.paused && !truth.stopped && !truth.wrecked;
  if (goes) way.under_way += dt;
  way.stands = goes && truth.velocity_world.norm() < kStillSpeed ? way.stands + dt : 0.0;
  result.life.longest_stand = std::max(result.life.longest_stand, way.stands);
}

void TrialMeter::moved(double time, std::vector<RobotTruth>& robots) {
  arrivals_.clear();
  for (std::size_t i = 0; i < robots.size(); ++i) {
    RobotTruth& truth = robots[i];
    measure(time, i, truth);
    if (truth.arrived || excused(i, truth)) continue;
    robots_[i].path_length += (truth.motion.to - truth.motion.from).norm();
    robots_[i].travel_time = time - ways_[i].idle;
    const double to_goal = (truth.pose.position_world - goals_[i]->position_world).norm();
    if (truth.wrecked || to_goal > parameters_.arrival_distance ||
        truth.velocity_world.norm() >= kArrivalSpeed)
      continue;
    truth.arrived = true;
    ways_[i].ended = true;
    ++robots_[i].life.goals_reached;
    robots_[i].life.last_arrival = time;
    arrivals_.push_back(static_cast<int>(i));
  }
  time_ = time;
}

void TrialMeter::digest(const std::vector<RobotTruth>& robots,
                        const std::vector<DynamicObstacle>& dynamic_obstacles) {
  const auto add = [this](const Eigen::Vector2d& position) {
    digest_ = mix(digest_ ^ bits_of(position.x()), bits_of(position.y()));
  };
  for (const RobotTruth& truth : robots) add(truth.pose.position_world);
  for (const DynamicObstacle& obstacle : dynamic_obstacles) add(obstacle.motion.from);
}

void TrialMeter::finish(double time, const std::vector<RobotTruth>& robots, const ContactMonitor& monitor,
                        TrialResult& result) {
  result.sim_seconds = time;
  result.digest = digest_;
  result.static_clearance = ContactMonitor::kFarStatic;
  result.dynamic_distance = monitor.dynamic_distance();
  result.dynamic_clearance = monitor.dynamic_clearance();
  result.peer_clearance = monitor.peer_clearance();
  for (std::size_t i = 0; i < robots.size(); ++i) {
    RobotResult& robot = robots_[i];
    const Way& way = ways_[i];
    robot.arrived = robots[i].arrived;
    robot.wrecked = robots[i].wrecked;
    robot.excused = excused(i, robots[i]);
    robot.static_clearance = monitor.static_clearance(static_cast<int>(i));
    const double to_goal = straight(i);
    const double length = way.straight_before + to_goal;
    const double shortest_time = way.fastest_before + (to_goal > 0.0 ? fastest(i, to_goal) : 0.0);
    robot.path_length_ratio = length > 0.0 ? robot.path_length / length : 1.0;
    robot.travel_time_ratio = shortest_time > 0.0 ? robot.travel_time / shortest_time : 1.0;
    const double latest = parameters_.latest_arrival;
    robot.in_time = robot.arrived && (latest <= 0.0 || robot.travel_time_ratio <= latest);
    // Goals without end: none may take longer than a whole trial of one goal.
    if (parameters_.goals != GoalSupply::listed && !robots[i].wrecked && !robot.arrived)
      robot.in_time = way.under_way <= std::max(kLongestWay, kLongestWayTimes * fastest(i, to_goal));
    if (robot.arrived) result.last_arrival = std::max(result.last_arrival, robot.life.last_arrival);
    result.static_clearance = std::min(result.static_clearance, robot.static_clearance);
  }
  result.robots = robots_;
}

}  // namespace spf::sim
