#include "spf/planning/field/seeds.hpp"

#include <algorithm>
#include <cmath>

namespace spf {
namespace {

constexpr double kSlowFactor = 1.8;     // [1] stretch of time of the slow seed
constexpr double kShortestPiece = 0.3;  // [s] of a seed

double length_of(const std::vector<Eigen::Vector2d>& corners) {
  double length = 0.0;
  for (std::size_t i = 0; i + 1 < corners.size(); ++i) length += (corners[i + 1] - corners[i]).norm();
  return length;
}

}  // namespace

SeedMaker::SeedMaker(const PlannerParameters& planner, const RobotParameters& robot)
    : planner_{planner}, robot_{robot} {
  path_.reserve(512);
}

Eigen::Vector2d SeedMaker::on_path(double distance) const {
  for (std::size_t i = 0; i + 1 < path_.size(); ++i) {
    const Eigen::Vector2d leg = path_[i + 1] - path_[i];
    const double length = leg.norm();
    if (distance <= length && length > 0.0) return path_[i] + distance / length * leg;
    distance -= length;
  }
  return path_.back();
}

LocalTarget SeedMaker::local_target(const PlanRequest& request, const CostToGo& guide,
                                    const ClearanceModel& clearance, double horizon) {
  path_.clear();
  guide.shortest_path(request.head.position_world, path_);
  if (path_.size() < 2) path_.assign({request.head.position_world, guide.goal_used()});
  const double whole = length_of(path_);

  LocalTarget target;
  target.distance = whole;
  target.state.position_world = path_.back();
  // The path may end at a corner far ahead: see CostToGo::shortest_path().
  const bool to_goal = (path_.back() - guide.goal_used()).norm() < 1e-3;
  target.is_goal = to_goal && whole <= horizon;
  if (target.is_goal) return target;

  // A free position near the horizon. Discs count where they will have come to rest: one that only crosses
  // the target does no harm.
  const double step = 0.5 * robot_.radius;
  const auto is_free = [&](double distance) {
    const Eigen::Vector2d position = on_path(distance);
    if (clearance.static_clearance(position) < 0.0) return false;
    for (const MovingDisc& disc : clearance.discs()) {
      if (disc.trajectory == nullptr && !disc.velocity_world.isZero()) continue;
      const Eigen::Vector2d rest =
          disc.trajectory != nullptr ? disc.trajectory->tail_position() : disc.position_world;
      if ((position - rest).norm() < disc.radius + planner_.peer_clearance) return false;
    }
    return true;
  };
  target.distance = horizon;
  bool moved = false;
  for (int i = 0; i < 20; ++i, moved = true) {
    const double back = horizon - i * step;
    const double ahead = std::min(whole, horizon + i * step);
    if (back > 0.3 * horizon && is_free(back)) {
      target.distance = back;
      break;
    }
    if (is_free(ahead)) {
      target.distance = ahead;
      break;
    }
  }
  target.state.position_world = on_path(target.distance);

  // Cruise along the path, slow enough to stop at the goal; stop at the target when the path beyond it is not
  // free.
  const double left = whole - target.distance;
  const double speed = std::min(robot_.max_speed, std::sqrt(robot_.max_acceleration * left));
  const double stopping_distance = speed * speed / (2.0 * robot_.max_acceleration);
  if (moved || !is_free(std::min(whole, target.distance + stopping_distance))) return target;
  const Eigen::Vector2d ahead =
      on_path(std::min(whole, target.distance + robot_.radius)) - target.state.position_world;
  if (ahead.norm() > 1e-6) target.state.velocity_world = speed * ahead.normalized();
  return target;
}

int SeedMaker::pieces_for(double distance) const {
  return std::clamp(static_cast<int>(std::lround(distance / planner_.piece_length)), 2, planner_.max_pieces);
}

bool SeedMaker::make(SeedKind kind, const PlanRequest& request, const LocalTarget& target,
                     TrajectorySeed& seed) {
  constexpr double kBow = 3.0;  // radii of the robot
  switch (kind) {
    case SeedKind::warm:
      return from_committed(request, target, seed);
    case SeedKind::cold:
    case SeedKind::short_horizon:
      along_path(request, target, 0.0, 1.0, seed);
      return true;
    case SeedKind::bowed_left:
      along_path(request, target, kBow * robot_.radius, 1.1, seed);
      return true;
    case SeedKind::bowed_right:
      along_path(request, target, -kBow * robot_.radius, 1.1, seed);
      return true;
    case SeedKind::slow:
      along_path(request, target, 0.0, kSlowFactor, seed);
      return true;
  }
  return false;
}

/// Waypoints at equal distances along the path; durations from a speed profile that starts at the head's
/// speed, ends at the tail's, and accelerates and brakes at half the largest acceleration (the rest is for
/// bends).
void SeedMaker::along_path(const PlanRequest& request, const LocalTarget& target, double bow, double stretch,
                           TrajectorySeed& seed) const {
  const int pieces = pieces_for(target.distance);
  seed.resize(pieces);
  const double part = target.distance / pieces;
  const double doubled_acceleration = robot_.max_acceleration;  // 2 * (a_max / 2)
  const double head_speed = std::min(request.head.velocity_world.norm(), robot_.max_speed);
  const double tail_speed = target.state.velocity_world.norm();
  const auto speed_at = [&](double distance) {
    const double rising = std::sqrt(head_speed * head_speed + doubled_acceleration * distance);
    const double falling =
        std::sqrt(tail_speed * tail_speed + doubled_acceleration * (target.distance - distance));
    return std::min({robot_.max_speed, rising, falling});
  };
  for (int i = 0; i < pieces; ++i) {
    const double from = i * part;
    const double to = (i + 1) * part;
    const double mean_speed = 0.25 * speed_at(from) + 0.5 * speed_at(0.5 * (from + to)) + 0.25 * speed_at(to);
    seed.durations[i] = stretch * std::max(kShortestPiece, part / std::max(mean_speed, 1e-3));
    if (i + 1 == pieces) break;
    Eigen::Vector2d waypoint = on_path(to);
    const Eigen::Vector2d ahead =
        on_path(std::min(target.distance, to + 0.5 * part)) - on_path(to - 0.5 * part);
    if (bow != 0.0 && ahead.norm() > 1e-9) {
      const Eigen::Vector2d left = Eigen::Vector2d{-ahead.y(), ahead.x()}.normalized();
      const double share = to / target.distance;
      waypoint += 4.0 * share * (1.0 - share) * bow * left;
    }
    seed.waypoints_world.col(i) = waypoint;
  }
}

/// Pieces of equal duration over the rest of the committed plan and the path from its end to the target.
bool SeedMaker::from_committed(const PlanRequest& request, const LocalTarget& target,
                               TrajectorySeed& seed) const {
  const Trajectory* committed = request.committed;
  if (committed == nullptr || committed->empty()) return false;
  const double left = committed->end_time() - request.time;
  if (left < 2.0 * kShortestPiece) return false;
  // Only a plan on which the head lies, and which leads near the target, is a usable seed.
  const FlatState now = committed->state(request.time);
  if ((now.position_world - request.head.position_world).norm() > robot_.radius) return false;
  const Eigen::Vector2d tail = committed->tail_position();
  const double missing = (target.state.position_world - tail).norm();
  if (missing > std::max(planner_.piece_length, 0.5 * target.distance)) return false;

  const int pieces = std::clamp(static_cast<int>(std::ceil(target.distance / planner_.piece_length)), 2,
                                planner_.max_pieces);
  seed.resize(pieces);
  const double extension = missing / robot_.max_speed;
  const double share = (left + extension) / pieces;
  for (int i = 0; i < pieces; ++i) {
    seed.durations[i] = share;
    if (i + 1 == pieces) break;
    const double ahead = (i + 1) * share;
    seed.waypoints_world.col(i) =
        ahead <= left
            ? committed->position(request.time + ahead)
            : Eigen::Vector2d{tail + (ahead - left) / extension * (target.state.position_world - tail)};
  }
  return true;
}

}  // namespace spf
