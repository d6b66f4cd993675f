#include "sim/trial_meter.hpp"

#include <algorithm>
#include <cstring>

#include "spf/math/random_stream.hpp"

namespace spf::sim {
namespace {

constexpr double kArrivalSpeed = 0.2;  // [m/s] who is near the goal and slower than this has arrived

std::uint64_t bits_of(double value) {
  std::uint64_t bits = 0;
  std::memcpy(&bits, &value, sizeof bits);
  return bits;
}

}  // namespace

TrialMeter::TrialMeter(const Scenario& scenario)
    : tasks_{scenario.robots}, parameters_{scenario.simulation.trial}, robots_(scenario.robots.size()) {
  for (std::size_t i = 0; i < tasks_.size(); ++i) {
    const RobotParameters& robot = scenario.robot_of(i);
    fastest_.push_back(rest_to_rest_time((tasks_[i].goal_world - tasks_[i].start.position_world).norm(),
                                         robot.max_speed, robot.max_acceleration));
  }
}

void TrialMeter::moved(double time, std::vector<RobotTruth>& robots) {
  arrivals_.clear();
  for (std::size_t i = 0; i < robots.size(); ++i) {
    RobotTruth& truth = robots[i];
    if (truth.arrived) continue;
    robots_[i].path_length += (truth.motion.to - truth.motion.from).norm();
    robots_[i].travel_time = time;
    const double to_goal = (truth.pose.position_world - tasks_[i].goal_world).norm();
    if (truth.wrecked || to_goal > parameters_.arrival_distance ||
        truth.velocity_world.norm() >= kArrivalSpeed)
      continue;
    truth.arrived = true;
    arrivals_.push_back(static_cast<int>(i));
  }
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
    robot.arrived = robots[i].arrived;
    robot.wrecked = robots[i].wrecked;
    robot.static_clearance = monitor.static_clearance(static_cast<int>(i));
    const double straight = (tasks_[i].goal_world - tasks_[i].start.position_world).norm();
    robot.path_length_ratio = straight > 0.0 ? robot.path_length / straight : 1.0;
    robot.travel_time_ratio = fastest_[i] > 0.0 ? robot.travel_time / fastest_[i] : 1.0;
    const double latest = parameters_.latest_arrival;
    robot.in_time = robot.arrived && (latest <= 0.0 || robot.travel_time_ratio <= latest);
    if (robot.arrived) result.last_arrival = std::max(result.last_arrival, robot.travel_time);
    result.static_clearance = std::min(result.static_clearance, robot.static_clearance);
  }
  result.robots = robots_;
}

}  // namespace spf::sim
