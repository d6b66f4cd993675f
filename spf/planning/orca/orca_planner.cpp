#include "spf/planning/orca/orca_planner.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>

#include "spf/math/angles.hpp"
#include "spf/math/plane.hpp"
#include "spf/planning/cost_to_go.hpp"
#include "spf/trajectory/constant_acceleration.hpp"

namespace spf {
namespace {

constexpr int kStaticSamples = 12;  // positions around the robot from which static surfaces are sought
constexpr double kRightHandBias =
    0.01;                             // [rad] the preferred velocity turns right by this when others are near
constexpr double kParallel = 1e-12;   // [1] sine of the angle between lines that count as parallel
constexpr double kTolerance = 1e-10;  // [m/s] below this a violation is rounding
constexpr double kStopped = 1e-6;     // [m/s] slower counts as stopped
constexpr double kStandingTime = 1.0;  // [s] duration of a trajectory at rest

/// Objective of a linear programme: to be near a point, or far along a direction.
struct Objective {
  Eigen::Vector2d target;
  bool is_direction = false;
};

/// The best velocity on the border of planes[index] within the earlier half-planes and the speed limit; none
/// when they leave nothing of it.
std::optional<Eigen::Vector2d> best_on_border(const std::vector<HalfPlane>& planes, std::size_t index,
                                              const Objective& objective, double max_speed) {
  const HalfPlane& border = planes[index];
  const double room = max_speed * max_speed - border.offset * border.offset;
  if (!(room >= 0.0)) return std::nullopt;
  const Eigen::Vector2d foot = border.offset * border.normal;
  const Eigen::Vector2d along = left_of(border.normal);
  double high = std::sqrt(room);
  double low = -high;
  for (std::size_t j = 0; j < index; ++j) {
    // foot + t along must satisfy plane j: slope t >= missing.
    const double slope = planes[j].normal.dot(along);
    const double missing = planes[j].violation(foot);
    if (std::abs(slope) < kParallel) {
      if (missing > kTolerance) return std::nullopt;
    } else if (slope > 0.0) {
      low = std::max(low, missing / slope);
    } else {
      high = std::min(high, missing / slope);
    }
    if (low > high) return std::nullopt;
  }
  const double wanted = along.dot(objective.target);
  if (objective.is_direction) return foot + (wanted > 0.0 ? high : low) * along;
  return foot + std::clamp(wanted, low, high) * along;
}

/// The two-dimensional programme, plane by plane: where the best velocity so far breaks the next plane, the
/// new one lies on its border. Returns how many planes were satisfied; `best` is the best for these.
std::size_t solve(const std::vector<HalfPlane>& planes, std::size_t count, const Objective& objective,
                  double max_speed, Eigen::Vector2d& best) {
  const double length = objective.target.norm();
  best = objective.target;
  if (objective.is_direction || length > max_speed) best *= max_speed / length;
  for (std::size_t i = 0; i < count; ++i) {
    if (planes[i].violation(best) <= kTolerance) continue;
    const std::optional<Eigen::Vector2d> next = best_on_border(planes, i, objective, max_speed);
    if (!next) return i;
    best = *next;
  }
  return count;
}

/// The nearest point of a static surface, by descent of the distance field; none where the field is truncated
/// or does not lead to a surface.
std::optional<Eigen::Vector2d> nearest_surface(const OccupancyMap& map, const Eigen::Vector2d& sample) {
  Eigen::Vector2d position = sample;
  double distance = map.distance(position);
  if (distance >= map.max_distance() - map.frame().resolution) return std::nullopt;
  for (int i = 0; i < 4 && std::abs(distance) > 0.1 * map.frame().resolution; ++i) {
    const Eigen::Vector2d gradient = map.distance_gradient(position);
    const double steepness = gradient.norm();
    if (!(steepness > 1e-6)) return std::nullopt;
    position -= gradient * (distance / steepness);
    distance = map.distance(position);
  }
  if (std::abs(distance) > map.frame().resolution) return std::nullopt;
  return position;
}

/// Constant acceleration (or none) from one velocity to another.
void append_ramp(Trajectory& trajectory, Eigen::Vector2d& position, const Eigen::Vector2d& from,
                 const Eigen::Vector2d& to, double duration) {
  trajectory.append(constant_acceleration(position, from, to, duration));
  position += 0.5 * duration * (from + to);
}

}  // namespace

HalfPlane allowed_velocities(const Encounter& encounter, double horizon, double period,
                             const Eigen::Vector2d& escape) {
  const Eigen::Vector2d& x = encounter.offset;
  const Eigen::Vector2d relative = encounter.own_velocity - encounter.other_velocity;
  const double distance = x.norm();
  const double reach = encounter.reach;
  // Relative velocities that lead to contact within the horizon: a cone of discs D(x / t, reach / t), cut off
  // by the disc of t = horizon. Discs in contact: that of t = period alone.
  const bool apart = distance > reach;
  const double t = apart ? horizon : period;
  const Eigen::Vector2d from_cut_off = relative - x / t;
  const double length = from_cut_off.norm();

  HalfPlane plane;
  double change = 0.0;  // [m/s] along the normal, to bring the relative velocity to the border
  const bool round_end =
      !apart || -from_cut_off.dot(x) > length * reach;  // the border's round part is nearest
  if (round_end) {
    plane.normal = length > 1e-9 ? Eigen::Vector2d{from_cut_off / length} : escape;
    change = reach / t - length;
  } else {
    const double side = cross(x, from_cut_off) > 0.0 ? 1.0 : -1.0;  // left or right leg of the cone
    const double sine = side * reach / distance;
    const double cosine = std::sqrt((distance - reach) * (distance + reach)) / distance;
    const Eigen::Vector2d leg = (cosine * x + sine * left_of(x)) / distance;
    plane.normal = side * left_of(leg);
    change = -plane.normal.dot(relative);
  }
  plane.offset = plane.normal.dot(encounter.own_velocity) + encounter.share * change;
  return plane;
}

VelocityChoice VelocityProgramme::choose(const std::vector<HalfPlane>& planes, std::size_t hard_count,
                                         const Eigen::Vector2d& preferred, double max_speed) {
  VelocityChoice choice;
  const std::size_t satisfied = solve(planes, planes.size(), {preferred, false}, max_speed, choice.velocity);
  choice.feasible = satisfied == planes.size();
  if (choice.feasible) return choice;
  const std::size_t still_hard = satisfied < hard_count ? 0 : hard_count;
  choice.velocity = least_violation(planes, still_hard, choice.velocity, max_speed);
  return choice;
}

// The three-dimensional programme of velocity and largest violation, plane by plane: where the next plane is
// violated by more than the largest so far, it becomes the largest. Among the velocities where the earlier
// planes are violated by no more than this one (half-planes again), the one deepest in its allowed side wins.
Eigen::Vector2d VelocityProgramme::least_violation(const std::vector<HalfPlane>& planes,
                                                   std::size_t hard_count, const Eigen::Vector2d& start,
                                                   double max_speed) {
  Eigen::Vector2d best = start;
  double largest = 0.0;
  for (std::size_t i = hard_count; i < planes.size(); ++i) {
    if (planes[i].violation(best) <= largest + kTolerance) continue;
    projected_.assign(planes.begin(), planes.begin() + static_cast<std::ptrdiff_t>(hard_count));
    for (std::size_t j = hard_count; j < i; ++j) {
      const Eigen::Vector2d normal = planes[j].normal - planes[i].normal;
      const double length = normal.norm();
      if (length < kParallel) continue;  // the same direction: plane i is the stricter one
      projected_.push_back({normal / length, (planes[j].offset - planes[i].offset) / length});
    }
    Eigen::Vector2d next;
    const std::size_t satisfied =
        solve(projected_, projected_.size(), {planes[i].normal, true}, max_speed, next);
    if (satisfied == projected_.size()) best = next;  // else within rounding of it already
    largest = std::max(largest, planes[i].violation(best));
  }
  return best;
}

OrcaPlanner::OrcaPlanner(const OrcaParameters& parameters, const RobotParameters& robot, double period,
                         const PlannerParameters& planner)
    : parameters_{validated(parameters)},
      robot_{validated(robot)},
      period_{period},
      programme_{static_cast<std::size_t>(parameters_.max_neighbours + kStaticSamples + 1)},
      judge_{validated(planner), robot_} {
  if (!(period > 0.0))
    throw std::invalid_argument{"period = " + std::to_string(period) + " [s] must be positive"};
  const auto neighbours = static_cast<std::size_t>(parameters_.max_neighbours);
  const auto points = static_cast<std::size_t>(kStaticSamples + 1);
  surface_points_.reserve(points);
  neighbours_.reserve(neighbours + 1);
  planes_.reserve(neighbours + points);
}

void OrcaPlanner::plan(const PlanRequest& request, PlanResult& result) {
  result.clear();
  if (const std::optional<PlanOutcome> refused = refusal(request)) {
    stand_instead(request, robot_, *refused, result);
    return;
  }
  // 1. The preferred velocity and the neighbours.
  collect_neighbours(request);
  const Eigen::Vector2d wanted = wanted_velocity(request);
  // 2. The half-planes of allowed velocities.
  planes_.clear();
  add_static_planes(request, wanted);
  const std::size_t hard_count = planes_.size();
  add_neighbour_planes();
  // 3. The allowed velocity closest to the preferred one, as a trajectory.
  const VelocityChoice choice = programme_.choose(planes_, hard_count, wanted, robot_.max_speed);
  result.trajectory = trajectory_for(request, choice.velocity);
  result.action = PlanAction::follow;
  // 4. Statistics and outcome.
  result.stats.primitives = 1;
  name_what_blocks(wanted, result);
  judge_.judge(request, result.trajectory.end_time(), result);
  if (!request.keep_candidates) return;
  const double departure = (choice.velocity - wanted).norm();
  result.candidates.push_back({Candidate::Kind::primitive, departure, 0.0, true, result.trajectory});
}

/// Along the guide at max_speed, slower where the robot has to stop at the goal.
Eigen::Vector2d OrcaPlanner::wanted_velocity(const PlanRequest& request) const {
  const CostToGo& guide = *request.guide;
  const Eigen::Vector2d& position = request.head.position_world;
  const double distance = guide.cost_to_go(position);
  if (distance < parameters_.goal_tolerance) return Eigen::Vector2d::Zero();
  double speed = distance / period_;
  if (parameters_.limit_acceleration) {
    // One period at this speed and then braking at the limit ends at the goal.
    const double limit = robot_.max_acceleration;
    speed = limit * (std::sqrt(period_ * period_ + 2.0 * distance / limit) - period_);
  }
  const Eigen::Vector2d velocity = std::min(speed, robot_.max_speed) * guide.direction(position);
  const double bias = neighbours_.empty() ? 0.0 : kRightHandBias;
  return std::cos(bias) * velocity - std::sin(bias) * left_of(velocity);
}

// Surfaces are sampled from the robot's position and from a circle halfway to the farthest relevant surface:
// the nearest surface point of each sample, found by the distance field, counts as a fixed disc of radius
// zero. The nearest point of all is always among them, both walls of an inner corner are, and gaps between
// points of a wall close as the robot approaches.
void OrcaPlanner::add_static_planes(const PlanRequest& request, const Eigen::Vector2d& wanted) {
  const OccupancyMap& map = *request.world.map;
  const Eigen::Vector2d& position = request.head.position_world;
  const double reach = robot_.radius + parameters_.margin;
  const double farthest = reach + robot_.max_speed * parameters_.time_horizon_static;
  const double distance = map.distance(position);
  surface_points_.clear();
  if (distance > farthest) return;
  const Eigen::Vector2d outward = map.distance_gradient(position).stableNormalized();
  if (!(distance > 0.0)) {  // inside a wall: straight out of it
    planes_.push_back({outward.isZero() ? Eigen::Vector2d{1.0, 0.0} : outward, (reach - distance) / period_});
    return;
  }
  add_surface_point(request, position);
  const double ahead = std::atan2(wanted.y(), wanted.x());
  for (int i = 0; i < kStaticSamples; ++i) {
    const double angle = ahead + 2.0 * kPi * i / kStaticSamples;
    add_surface_point(request, position + 0.5 * farthest * Eigen::Vector2d{std::cos(angle), std::sin(angle)});
  }
  for (const Eigen::Vector2d& point : surface_points_) {
    if (point.norm() > farthest) continue;
    const Encounter encounter{point, request.head.velocity_world, Eigen::Vector2d::Zero(), reach, 1.0};
    planes_.push_back(
        allowed_velocities(encounter, parameters_.time_horizon_static, period_, -point / point.norm()));
  }
}

void OrcaPlanner::add_surface_point(const PlanRequest& request, const Eigen::Vector2d& sample) {
  const std::optional<Eigen::Vector2d> surface = nearest_surface(*request.world.map, sample);
  if (!surface) return;
  const Eigen::Vector2d point = *surface - request.head.position_world;
  const double apart = request.world.map->frame().resolution;
  for (const Eigen::Vector2d& known : surface_points_) {
    if ((known - point).squaredNorm() < apart * apart) return;
  }
  if (point.squaredNorm() > 0.0) surface_points_.push_back(point);
}

void OrcaPlanner::collect_neighbours(const PlanRequest& request) {
  neighbours_.clear();
  const double time = request.time;
  if (request.world.peers != nullptr) {
    for (const Peer& peer : *request.world.peers) {
      if (peer.trajectory->empty()) continue;
      Neighbour neighbour;
      // A moving peer shares the avoidance; one that has stopped, brakes or fell silent does not.
      const bool shares = peer.state == PeerState::moving && !peer.expired;
      neighbour.encounter = {peer.position(time) - request.head.position_world, request.head.velocity_world,
                             peer.velocity(time), 0.0, shares ? 0.5 : 1.0};
      neighbour.escape = {0.0, goes_first(request.world.rank(), peer.rank()) ? 1.0 : -1.0};
      neighbour.is_peer = true;
      neighbour.id = peer.robot_id;
      collect(neighbour, peer.radius + peer.growth);
    }
  }
  if (request.world.tracks == nullptr) return;
  for (const ObstacleTrack& track : *request.world.tracks) {
    Neighbour neighbour;
    const Eigen::Vector2d position =
        track.state.position_world + (time - track.time) * track.state.velocity_world;
    neighbour.encounter = {position - request.head.position_world, request.head.velocity_world,
                           track.state.velocity_world, 0.0, parameters_.obstacle_share};
    neighbour.escape = Eigen::Vector2d::UnitY();
    neighbour.id = track.id;
    collect(neighbour, track.state.radius);
  }
}

/// Keeps the nearest.
void OrcaPlanner::collect(Neighbour neighbour, double other_radius) {
  const double radii = robot_.radius + other_radius;
  neighbour.encounter.reach = radii + parameters_.margin;
  neighbour.gap = neighbour.encounter.offset.norm() - radii;
  // Written so that NaN is left out.
  if (!(neighbour.gap <= parameters_.neighbour_distance) || !neighbour.encounter.other_velocity.allFinite()) {
    return;
  }
  const auto slot = std::upper_bound(neighbours_.begin(), neighbours_.end(), neighbour,
                                     [](const Neighbour& a, const Neighbour& b) { return a.gap < b.gap; });
  neighbours_.insert(slot, neighbour);
  if (neighbours_.size() > static_cast<std::size_t>(parameters_.max_neighbours)) neighbours_.pop_back();
}

void OrcaPlanner::add_neighbour_planes() {
  for (const Neighbour& neighbour : neighbours_) {
    planes_.push_back(
        allowed_velocities(neighbour.encounter, parameters_.time_horizon, period_, neighbour.escape));
  }
}

void OrcaPlanner::name_what_blocks(const Eigen::Vector2d& wanted, PlanResult& result) const {
  const std::size_t first = planes_.size() - neighbours_.size();
  double largest = 0.0;
  for (std::size_t k = 0; k < neighbours_.size(); ++k) {
    const double violation = planes_[first + k].violation(wanted);
    if (violation <= largest) continue;
    largest = violation;
    result.blocking_peer = neighbours_[k].is_peer ? neighbours_[k].id : -1;
    result.blocking_track = neighbours_[k].is_peer ? -1 : neighbours_[k].id;
  }
}

Trajectory OrcaPlanner::trajectory_for(const PlanRequest& request, const Eigen::Vector2d& velocity) const {
  constexpr double kShortest = 1e-9;  // [s] shorter pieces are left out
  const double limit = robot_.max_acceleration;
  Eigen::Vector2d position = request.head.position_world;
  Eigen::Vector2d reached = velocity;
  Trajectory trajectory{request.time};
  double ramp = 0.0;
  if (parameters_.limit_acceleration) {
    const Eigen::Vector2d present = request.head.velocity_world;
    const double needed = (velocity - present).norm() / limit;
    ramp = std::min(needed, period_);
    if (ramp < needed) reached = present + (velocity - present) * (ramp / needed);
    if (ramp > kShortest) append_ramp(trajectory, position, present, reached, ramp);
  }
  const double speed = reached.norm();
  if (ramp <= kShortest && speed < kStopped)
    return Trajectory::standing(position, request.time, kStandingTime);
  if (period_ - ramp > kShortest) append_ramp(trajectory, position, reached, reached, period_ - ramp);
  if (speed > kStopped) append_ramp(trajectory, position, reached, Eigen::Vector2d::Zero(), speed / limit);
  return trajectory;
}

}  // namespace spf
