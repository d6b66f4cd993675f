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
  way_.reserve(512);
}

Eigen::Vector2d SeedMaker::on_way(double distance) const {
  for (std::size_t i = 0; i + 1 < way_.size(); ++i) {
    const Eigen::Vector2d leg = way_[i + 1] - way_[i];
    const double length = leg.norm();
    if (distance <= length && length > 0.0) return way_[i] + distance / length * leg;
    distance -= length;
  }
  return way_.back();
}

LocalTarget SeedMaker::local_target(const PlanRequest& request, const CostToGo& guide,
                                    const ClearanceModel& clearance, double horizon) {
  way_.clear();
  guide.way(request.head.position_world, way_);
  if (way_.size() < 2) way_.assign({request.head.position_world, guide.goal_used()});
  const double whole = length_of(way_);

  LocalTarget target;
  target.way = whole;
  target.state.position_world = way_.back();
  target.is_goal = whole <= horizon;
  if (target.is_goal) return target;

  // A free place near the horizon. Moving things count where they will have come to rest: a target on a place
  // that something crosses is no harm.
  const double step = 0.5 * robot_.radius;
  const auto is_free = [&](double distance) {
    const Eigen::Vector2d place = on_way(distance);
    if (clearance.static_clearance(place) < 0.0) return false;
    for (const MovingDisc& disc : clearance.discs()) {
      if (disc.trajectory == nullptr && !disc.velocity_world.isZero()) continue;
      const Eigen::Vector2d rest =
          disc.trajectory != nullptr ? disc.trajectory->tail_position() : disc.position_world;
      if ((place - rest).norm() < disc.radius + planner_.peer_clearance) return false;
    }
    return true;
  };
  target.way = horizon;
  bool moved = false;
  for (int i = 0; i < 20; ++i, moved = true) {
    const double back = horizon - i * step;
    const double ahead = std::min(whole, horizon + i * step);
    if (back > 0.3 * horizon && is_free(back)) {
      target.way = back;
      break;
    }
    if (is_free(ahead)) {
      target.way = ahead;
      break;
    }
  }
  target.state.position_world = on_way(target.way);

  // Cruise on along the way, slow enough to stop at the goal; stop where something stands beyond the target.
  const double left = whole - target.way;
  const double speed = std::min(robot_.max_speed, std::sqrt(robot_.max_acceleration * left));
  const double stopping_way = speed * speed / (2.0 * robot_.max_acceleration);
  if (moved || !is_free(std::min(whole, target.way + stopping_way))) return target;
  const Eigen::Vector2d ahead =
      on_way(std::min(whole, target.way + robot_.radius)) - target.state.position_world;
  if (ahead.norm() > 1e-6) target.state.velocity_world = speed * ahead.normalized();
  return target;
}

int SeedMaker::pieces_for(double way) const {
  return std::clamp(static_cast<int>(std::lround(way / planner_.piece_length)), 2, planner_.max_pieces);
}

bool SeedMaker::make(SeedKind kind, const PlanRequest& request, const LocalTarget& target,
                     TrajectorySeed& seed) {
  constexpr double kBow = 3.0;  // radii of the robot
  switch (kind) {
    case SeedKind::warm:
      return from_committed(request, target, seed);
    case SeedKind::cold:
    case SeedKind::short_horizon:
      along_way(request, target, 0.0, 1.0, seed);
      return true;
    case SeedKind::bowed_left:
      along_way(request, target, kBow * robot_.radius, 1.1, seed);
      return true;
    case SeedKind::bowed_right:
      along_way(request, target, -kBow * robot_.radius, 1.1, seed);
      return true;
    case SeedKind::slow:
      along_way(request, target, 0.0, kSlowFactor, seed);
      return true;
  }
  return false;
}

/// Waypoints at equal distances along the way; durations from a speed profile that starts at the head's
/// speed, ends at the tail's, and speeds up and down at half the largest acceleration (the rest is for the
/// bends).
void SeedMaker::along_way(const PlanRequest& request, const LocalTarget& target, double bow, double stretch,
                          TrajectorySeed& seed) const {
  const int pieces = pieces_for(target.way);
  seed.resize(pieces);
  const double part = target.way / pieces;
  const double doubled_acceleration = robot_.max_acceleration;  // 2 * (a_max / 2)
  const double head_speed = std::min(request.head.velocity_world.norm(), robot_.max_speed);
  const double tail_speed = target.state.velocity_world.norm();
  const auto speed_at = [&](double distance) {
    const double rising = std::sqrt(head_speed * head_speed + doubled_acceleration * distance);
    const double falling =
        std::sqrt(tail_speed * tail_speed + doubled_acceleration * (target.way - distance));
    return std::min({robot_.max_speed, rising, falling});
  };
  for (int i = 0; i < pieces; ++i) {
    const double from = i * part;
    const double to = (i + 1) * part;
    const double mean_speed = 0.25 * speed_at(from) + 0.5 * speed_at(0.5 * (from + to)) + 0.25 * speed_at(to);
    seed.durations[i] = stretch * std::max(kShortestPiece, part / std::max(mean_speed, 1e-3));
    if (i + 1 == pieces) break;
    Eigen::Vector2d waypoint = on_way(to);
    const Eigen::Vector2d ahead = on_way(std::min(target.way, to + 0.5 * part)) - on_way(to - 0.5 * part);
    if (bow != 0.0 && ahead.norm() > 1e-9) {
      const Eigen::Vector2d left = Eigen::Vector2d{-ahead.y(), ahead.x()}.normalized();
      const double share = to / target.way;
      waypoint += 4.0 * share * (1.0 - share) * bow * left;
    }
    seed.waypoints_world.col(i) = waypoint;
  }
}

/// Equal shares of the time that is left of the committed plan and of the way from its end to the target.
bool SeedMaker::from_committed(const PlanRequest& request, const LocalTarget& target,
                               TrajectorySeed& seed) const {
  const Trajectory* committed = request.committed;
  if (committed == nullptr || committed->empty()) return false;
  const double left = committed->end_time() - request.time;
  if (left < 2.0 * kShortestPiece) return false;
  // Only a plan that the head lies on, and that leads near the target, is a start.
  const FlatState now = committed->state(request.time);
  if ((now.position_world - request.head.position_world).norm() > robot_.radius) return false;
  const Eigen::Vector2d tail = committed->tail_position();
  const double missing = (target.state.position_world - tail).norm();
  if (missing > std::max(planner_.piece_length, 0.5 * target.way)) return false;

  const int pieces =
      std::clamp(static_cast<int>(std::ceil(target.way / planner_.piece_length)), 2, planner_.max_pieces);
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
