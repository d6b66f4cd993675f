#include "report/replay_data.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>
#include <stdexcept>

namespace spf {
namespace {

void check_robot(const ReplayRobot& robot, const ReplayData& data, std::ostringstream& problems) {
  const std::size_t frames = frame_count(data);
  if (robot.frames.size() != frames) {
    problems << "robot " << robot.id << " has " << robot.frames.size() << " frames, expected " << frames
             << "; ";
  }
  for (const ReplayRobotFrame& frame : robot.frames) {
    if (frame.state >= 0 && static_cast<std::size_t>(frame.state) < data.states.size()) continue;
    problems << "robot " << robot.id << " has state " << frame.state << ", the table has "
             << data.states.size() << "; ";
    return;
  }
}

}  // namespace

int state_index(ReplayData& data, std::string_view text, ReplayStateKind kind) {
  const auto found = std::find_if(data.states.begin(), data.states.end(), [&](const ReplayState& state) {
    return state.text == text && state.kind == kind;
  });
  const auto index = static_cast<int>(found - data.states.begin());
  if (found == data.states.end()) data.states.push_back({std::string{text}, kind});
  return index;
}

ReplayPoint goal_at(const ReplayRobot& robot, double time) {
  ReplayPoint goal = robot.goal;
  for (const ReplayGoal& next : robot.goals)
    if (next.time <= time) goal = next.position;
  return goal;
}

std::size_t frame_count(const ReplayData& data) {
  std::size_t count = 0;
  for (const ReplayRobot& robot : data.robots) count = std::max(count, robot.frames.size());
  for (const ReplayObstacle& obstacle : data.obstacles) count = std::max(count, obstacle.frames.size());
  return count;
}

void require_consistent(const ReplayData& data) {
  std::ostringstream problems;
  if (!(data.frame_interval > 0.0) || !std::isfinite(data.frame_interval)) {
    problems << "frame_interval = " << data.frame_interval << " [s] must be positive; ";
  }
  const ReplayBox& bounds = data.bounds;
  const bool is_area = bounds.low.x < bounds.high.x && bounds.low.y < bounds.high.y &&
                       std::isfinite(bounds.high.x - bounds.low.x) &&
                       std::isfinite(bounds.high.y - bounds.low.y);
  if (!is_area) problems << "bounds must span a finite area; ";
  std::set<int> ids;
  for (const ReplayRobot& robot : data.robots) {
    if (!ids.insert(robot.id).second) problems << "robot id " << robot.id << " is used twice; ";
    check_robot(robot, data, problems);
  }
  for (const ReplayObstacle& obstacle : data.obstacles) {
    if (obstacle.frames.size() == frame_count(data)) continue;
    problems << "obstacle " << obstacle.id << " has " << obstacle.frames.size() << " frames, expected "
             << frame_count(data) << "; ";
  }
  if (!problems.str().empty()) throw std::invalid_argument("replay data: " + problems.str());
}

}  // namespace spf
