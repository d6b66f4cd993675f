#include "spf/planning/sight_limit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "spf/planning/cost_to_go.hpp"

namespace spf {
namespace {

constexpr double kUnseenRadius = 0.3;  // [m] of what may come from beyond: a person
constexpr double kCrawl = 0.05;        // [1] of max_speed
constexpr double kThin = 2.0 / 3.0;    // [1] of the radius: width of the thinnest things not to be missed

}  // namespace

double stoppable_speed(double gap, double closing_speed, double reaction, double deceleration) {
  const double left = gap - closing_speed * reaction;
  if (left <= 0.0) return 0.0;
  const double half = deceleration * reaction + closing_speed;
  return std::sqrt(half * half + 2.0 * deceleration * left) - half;
}

SightLimit::SightLimit(const RobotParameters& robot, double margin)
    : robot_{robot}, margin_{margin}, reach_{0.5 * kThin * robot.radius} {}

void SightLimit::prepare(const PlanRequest& request) {
  map_ = request.world.map;
  const Sight& sight = request.world.sight;
  const double own = robot_.radius + margin_;
  // It has to give way to what comes on: until it backs off as fast, or as fast as it can, the gap closes by
  // this beyond what closes until it stands.
  const double backing = std::min(sight.unseen_speed, robot_.max_speed);
  const double giving_way = backing * (sight.unseen_speed - 0.5 * backing) / robot_.max_acceleration;
  open_speed_ = sight.unseen_speed > 0.0
                    ? stoppable_speed(sight.range - own - kUnseenRadius - giving_way, sight.unseen_speed,
                                      sight.reaction, robot_.max_acceleration)
                    : std::numeric_limits<double>::infinity();
  speed_ = std::min(robot_.max_speed, open_speed_);
  if (map_->unexplored()) {
    const double stop = speed_ * (sight.reaction + 0.5 * speed_ / robot_.max_acceleration);
    const double free = explored_path_length(*request.guide, request.head.position_world, stop + own);
    speed_ = std::min(speed_, stoppable_speed(free - own, 0.0, sight.reaction, robot_.max_acceleration));
  }
  speed_ = std::max(speed_, kCrawl * robot_.max_speed);
}

/// Length of a segment from its start to the first position that is unknown.
double SightLimit::explored_length(const Eigen::Vector2d& from, const Eigen::Vector2d& to) const {
  const double length = (to - from).norm();
  const int steps = std::max(1, static_cast<int>(std::ceil(length / (2.0 * reach_))));
  for (int k = 1; k <= steps; ++k) {
    const double share = static_cast<double>(k) / steps;
    if (!map_->explored_free(from + share * (to - from), reach_)) return length * (k - 1) / steps;
  }
  return length;
}

double SightLimit::explored_path_length(const CostToGo& guide, const Eigen::Vector2d& from, double enough) {
  guide.shortest_path(from, path_);
  double length = 0.0;
  for (std::size_t i = 1; i < path_.size() && length < enough; ++i) {
    const Eigen::Vector2d leg = path_[i] - path_[i - 1];
    const double wanted = std::min(leg.norm(), enough - length);
    if (wanted <= 0.0) continue;
    const double free = explored_length(path_[i - 1], path_[i - 1] + leg.normalized() * wanted);
    length += free;
    if (free < wanted) return length;
  }
  return enough;  // as far as needed, or to the goal, where the robot stops anyway
}

double SightLimit::blind_share(const Eigen::Vector2d& position_world,
                               const Eigen::Vector2d& velocity_world) const {
  const double speed = velocity_world.norm();
  if (!map_->unexplored() || speed <= kCrawl * robot_.max_speed) return 0.0;
  const double needed = 0.5 * speed * speed / robot_.max_acceleration + robot_.radius + margin_;
  const double free = explored_length(position_world, position_world + velocity_world * (needed / speed));
  return 1.0 - free / needed;
}

}  // namespace spf
