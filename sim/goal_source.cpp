#include "sim/goal_source.hpp"

#include <algorithm>
#include <cmath>

#include "sim/extent.hpp"

namespace spf::sim {
namespace {

constexpr int kBlocked = -1;
constexpr int kUnvisited = -2;
constexpr double kSpacing = 0.25;    // [m] of the lattice, at most the radius of the largest robot
constexpr double kMostNodes = 1e6;   // coarser where there were more
constexpr double kRoom = 0.1;        // [m] between a robot at a drawn goal and what is static
constexpr double kGoalsApart = 1.0;  // [m] between robots at two goals
constexpr int kDraws = 100;          // for a goal apart from the others'

}  // namespace

GoalSource::GoalSource(const Scenario& scenario) : supply_{scenario.simulation.trial.goals} {
  for (std::size_t i = 0; i < scenario.robots.size(); ++i) {
    const RobotTask& task = scenario.robots[i];
    Itinerary& itinerary = itineraries_.emplace_back();
    itinerary.goals.push_back({task.goal_world, task.goal_heading});
    itinerary.goals.insert(itinerary.goals.end(), task.next_goals.begin(), task.next_goals.end());
    itinerary.radius = scenario.robot_of(i).radius;
    itinerary.random = RandomStream{stream_seed(scenario, StreamRole::goal, i)};
  }
  if (supply_ == GoalSupply::drawn) find_free_places(scenario);
}

std::optional<host::Goal> GoalSource::next(std::size_t robot, const Eigen::Vector2d& from,
                                           const std::vector<std::optional<host::Goal>>& taken) {
  Itinerary& itinerary = itineraries_[robot];
  if (itinerary.reached + 1 < itinerary.goals.size()) return itinerary.goals[++itinerary.reached];
  if (supply_ == GoalSupply::drawn) return draw(robot, from, taken);
  if (supply_ == GoalSupply::listed || itinerary.goals.size() < 2) return std::nullopt;
  itinerary.reached = 0;
  return itinerary.goals.front();
}

host::Goal GoalSource::draw(std::size_t robot, const Eigen::Vector2d& from,
                            const std::vector<std::optional<host::Goal>>& taken) {
  Itinerary& itinerary = itineraries_[robot];
  const std::optional<std::size_t> here = place_near(from);
  if (!here) return {from, std::nullopt};
  const std::vector<std::size_t>& nodes = parts_[static_cast<std::size_t>(part_of_[*here])];
  host::Goal goal;
  for (int draws = 0; draws < kDraws; ++draws) {
    const double at = itinerary.random.uniform(0.0, static_cast<double>(nodes.size()));
    goal.position_world = position(nodes[static_cast<std::size_t>(at)]);
    bool apart = (goal.position_world - from).norm() > 2.0 * itinerary.radius + kGoalsApart;
    for (std::size_t i = 0; apart && i < taken.size(); ++i)
      apart = i == robot || !taken[i] ||
              (taken[i]->position_world - goal.position_world).norm() >
                  itinerary.radius + itineraries_[i].radius + kGoalsApart;
    if (apart) break;
  }
  return goal;
}

void GoalSource::find_free_places(const Scenario& scenario) {
  const Box extent = extent_of(scenario);
  const double radius = scenario.largest_radius();
  const Eigen::Vector2d size = extent.high - extent.low;
  spacing_ = std::max(std::min(kSpacing, radius), std::sqrt(size.prod() / kMostNodes));
  low_ = extent.low;
  columns_ = static_cast<std::size_t>(size.x() / spacing_) + 1;
  rows_ = static_cast<std::size_t>(size.y() / spacing_) + 1;
  const StaticShapes shapes{scenario};
  // Two free nodes side by side are free all the way between them: a disc of half their distance is.
  const double room = std::max(kRoom, 0.5 * spacing_ - radius);
  part_of_.assign(columns_ * rows_, kBlocked);
  for (std::size_t node = 0; node < part_of_.size(); ++node) {
    const bool inside = !scenario.map || !scenario.map->occupied(position(node));
    if (inside && shapes.clearance(position(node), radius, 1.0) > room) part_of_[node] = kUnvisited;
  }
  for (std::size_t node = 0; node < part_of_.size(); ++node)
    if (part_of_[node] == kUnvisited) flood(node, static_cast<int>(parts_.size()));
}

void GoalSource::flood(std::size_t node, int part) {
  std::vector<std::size_t>& found = parts_.emplace_back();
  const auto visit = [&](std::size_t next) {
    if (part_of_[next] != kUnvisited) return;
    part_of_[next] = part;
    found.push_back(next);
  };
  visit(node);
  for (std::size_t i = 0; i < found.size(); ++i) {
    const std::size_t at = found[i];
    if (at % columns_ > 0) visit(at - 1);
    if (at % columns_ + 1 < columns_) visit(at + 1);
    if (at >= columns_) visit(at - columns_);
    if (at + columns_ < part_of_.size()) visit(at + columns_);
  }
}

Eigen::Vector2d GoalSource::position(std::size_t node) const {
  return low_ + spacing_ * Eigen::Vector2d{static_cast<double>(node % columns_),
                                           static_cast<double>(node / columns_)};
}

/// The nearest free node, looked for in growing squares.
std::optional<std::size_t> GoalSource::place_near(const Eigen::Vector2d& point) const {
  const auto index = [&](double offset, std::size_t count) {
    return static_cast<long>(std::clamp(std::round(offset / spacing_), 0.0, static_cast<double>(count - 1)));
  };
  const long column = index(point.x() - low_.x(), columns_), row = index(point.y() - low_.y(), rows_);
  const long farthest = static_cast<long>(std::max(columns_, rows_));
  std::optional<std::size_t> nearest;
  double distance = 0.0;
  for (long ring = 0; ring <= farthest && !nearest; ++ring)
    for (long r = row - ring; r <= row + ring; ++r)
      for (long c = column - ring; c <= column + ring; ++c) {
        if (std::max(std::abs(r - row), std::abs(c - column)) != ring) continue;
        if (r < 0 || c < 0 || r >= static_cast<long>(rows_) || c >= static_cast<long>(columns_)) continue;
        const std::size_t node = static_cast<std::size_t>(r) * columns_ + static_cast<std::size_t>(c);
        const double away = (position(node) - point).norm();
        if (part_of_[node] == kBlocked || (nearest && away >= distance)) continue;
        nearest = node;
        distance = away;
      }
  return nearest;
}

}  // namespace spf::sim
