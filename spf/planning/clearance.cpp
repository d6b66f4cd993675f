#include "spf/planning/clearance.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "spf/planning/braking.hpp"

namespace spf {
namespace {

constexpr double kSlack =
    1e-4;  // [m] tolerated decrease of a distance that is too small already (rounding, sampling)

/// What approaches whom, and how fast at most: one check of the trajectory against one obstacle, peer or the
/// map.
struct Subject {
  ConflictKind kind;
  int id;
  double approach_speed;  // [m/s]
  double until;           // [s]
};

/// Where a sweep ended.
struct WalkEnd {
  bool conflict = false;
  double time = 0.0;       // [s]
  double clearance = 0.0;  // [m] at the conflict
  double least = std::numeric_limits<double>::infinity();
};

/// Sweeps along the trajectory; `clearance(time, position, trajectory)` is a signed distance that changes no
/// faster than approach_speed. A conflict is a clearance below `floor`, or below 0 once it has been above; a
/// start below the floor lowers it. A floor of minus infinity only measures the least clearance.
template <class ClearanceAt>
WalkEnd walk(const Trajectory& trajectory, double from, const Subject& subject, double floor,
             const ClearanceAt& clearance) {
  MovingDisc self;
  self.trajectory = &trajectory;
  DiscCursor cursor{self};
  const double slowness = 1.0 / std::max(subject.approach_speed, 1e-3);
  const bool only_looking = std::isinf(floor);
  WalkEnd end;
  bool inside = false;
  for (double time = from; time <= subject.until;) {
    cursor.move_to(time);
    const double now = clearance(time, cursor.position(), trajectory);
    if (time == from) floor = std::min(floor, now);
    end.least = std::min(end.least, now);
    if (now < floor - kSlack) {
      end.conflict = true;
      end.time = time;
      end.clearance = now;
      return end;
    }
    inside = inside || now < 0.0;
    if (inside && now >= 0.0 && !only_looking) floor = 0.0;
    if (time >= subject.until) break;
    time = std::min(subject.until, time + std::max(ClearanceModel::kShortestStep, std::abs(now) * slowness));
  }
  return end;
}

/// One check against one subject: the plain rule first; after a conflict the rule "no worse than the
/// alternative".
template <class ClearanceAt>
void check_against(const Trajectory& trajectory, const ClearanceWindow& window, Subject subject,
                   double least_floor, const ClearanceAt& clearance, ClearanceReport& report) {
  if (!report.clear()) subject.until = std::min(subject.until, report.time);
  WalkEnd end = walk(trajectory, window.from, subject, 0.0, clearance);
  if (end.conflict && window.alternative != nullptr && !window.alternative->empty()) {
    Subject other = subject;
    other.until = std::min(subject.until, window.alternative->end_time());
    other.approach_speed += speed_bound(*window.alternative);
    const double unlimited = -std::numeric_limits<double>::infinity();
    const double floor = walk(*window.alternative, window.from, other, unlimited, clearance).least;
    if (floor < 0.0) end = walk(trajectory, window.from, subject, std::max(floor, least_floor), clearance);
  }
  report.min_clearance = std::min(report.min_clearance, end.least);
  if (!end.conflict || (!report.clear() && report.time <= end.time)) return;
  report.kind = subject.kind;
  report.id = subject.id;
  report.time = end.time;
  report.clearance = end.clearance;
}

}  // namespace

ClearanceModel::ClearanceModel(const PlannerParameters& planner, const RobotParameters& robot,
                               const FieldParameters& field)
    : planner_{planner}, robot_{robot}, footprint_{robot}, field_{field} {
  constexpr std::size_t kUsualCount = 64;
  discs_.reserve(kUsualCount);
  regions_.reserve(kUsualCount);
}

void ClearanceModel::prepare(const WorldSnapshot& world, double time, PeerSelection selection) {
  assert(world.map != nullptr);
  map_ = world.map;
  static_margin_ = map_->margin(planner_.static_margin);
  discs_.clear();
  regions_.clear();
  if (world.peers != nullptr) {
    for (const Peer& peer : *world.peers)
      if (selection == PeerSelection::all || !yields(peer, world)) add_peer(peer);
  }
  if (world.tracks != nullptr && planner_.dynamic_model != DynamicModel::none)
    for (const ObstacleTrack& track : *world.tracks) add_track(track, time);
}

void ClearanceModel::add_peer(const Peer& peer) {
  MovingDisc disc;
  disc.id = peer.robot_id;
  disc.is_peer = true;
  disc.radius = robot_.radius + peer.radius + (peer.expired ? peer.growth : 0.0);
  if (peer.expired || peer.trajectory->empty()) {
    disc.position_world = peer.position(peer.received_time);
  } else {
    disc.trajectory = &*peer.trajectory;
    disc.speed_bound = speed_bound(peer.trajectory);
  }
  discs_.push_back(disc);
}

void ClearanceModel::add_track(const ObstacleTrack& track, double time) {
  ObstacleState now = track.state;
  now.position_world += (time - track.time) * track.state.velocity_world;
  if (planner_.dynamic_model != DynamicModel::probability_field) {
    MovingDisc disc;
    disc.id = track.id;
    disc.radius = robot_.radius + now.radius;
    disc.time = time;
    disc.position_world = now.position_world;
    if (planner_.dynamic_model == DynamicModel::constant_velocity) disc.velocity_world = now.velocity_world;
    disc.speed_bound = disc.velocity_world.norm();
    discs_.push_back(disc);
    return;
  }
  DangerRegion region;
  region.id = track.id;
  region.field = ProbabilityField{now, robot_.radius, field_};
  region.threshold = region.field.threshold();
  regions_.push_back(region);
}

double ClearanceModel::static_clearance(const Eigen::Vector2d& position_world, double margin_scale) const {
  return map_->distance(position_world) - robot_.radius - margin_scale * static_margin_;
}

double ClearanceModel::static_clearance(const Eigen::Vector2d& position_world, double heading,
                                        double margin_scale) const {
  const auto distance = [this](const Eigen::Vector2d& point) { return map_->distance(point); };
  // Farther off it matters no more how near exactly.
  const double enough = robot_.radius + margin_scale * static_margin_;
  return footprint_.clearance(position_world, {std::cos(heading), std::sin(heading)}, enough, distance) -
         margin_scale * static_margin_;
}

double ClearanceModel::field_clearance(const Eigen::Vector2d& position_world) const {
  double least = std::numeric_limits<double>::infinity();
  for (const DangerRegion& region : regions_)
    least = std::min(least, region.field.clearance(position_world, region.threshold));
  return least;
}

const DangerRegion* ClearanceModel::nearest_region(const Eigen::Vector2d& position_world) const {
  const auto clearance = [&](const DangerRegion& region) {
    return region.field.clearance(position_world, region.threshold);
  };
  const auto nearest = std::min_element(
      regions_.begin(), regions_.end(),
      [&](const DangerRegion& a, const DangerRegion& b) { return clearance(a) < clearance(b); });
  return nearest == regions_.end() ? nullptr : &*nearest;
}

double ClearanceModel::time_in_fields(const Trajectory& trajectory, double from, double until) const {
  constexpr double kStep = 0.05;  // [s]
  if (regions_.empty()) return 0.0;
  for (double time = until; time >= from; time -= kStep)
    if (field_clearance(trajectory.position(time)) < 0.0) return std::min(until, time + kStep) - from;
  return 0.0;
}

ClearanceReport ClearanceModel::check(const Trajectory& trajectory, const ClearanceWindow& window) const {
  assert(map_ != nullptr && !trajectory.empty());
  const double speed = speed_bound(trajectory);
  ClearanceReport report;

  // The interpolated distance may be slightly steeper than the true one.
  constexpr double kInterpolationSteepness = 1.1;
  // No alternative justifies contact, that is, the loss of the whole margin.
  constexpr double kLosable = 0.9;
  const double static_margin = window.margin_scale * static_margin_;
  // As it turns, its corners move besides.
  const double corner_speed = footprint_.is_disc() ? 0.0 : robot_.radius * robot_.max_yaw_rate;
  check_against(
      trajectory, window,
      {ConflictKind::static_map, -1, kInterpolationSteepness * (speed + corner_speed), window.static_until},
      -kLosable * static_margin,
      [&](double time, const Eigen::Vector2d& p, const Trajectory& along) {
        return footprint_.is_disc()
                   ? static_clearance(p, window.margin_scale)
                   : static_clearance(p, along.heading_state(time).heading, window.margin_scale);
      },
      report);

  // Obstacles have no margin.
  const double peer_margin = window.margin_scale * planner_.peer_margin;
  for (const MovingDisc& disc : discs_) {
    DiscCursor other{disc};
    const ConflictKind kind = disc.is_peer ? ConflictKind::peer : ConflictKind::obstacle;
    const double margin = disc.is_peer ? peer_margin : 0.0;
    const double floor = disc.is_peer ? -kLosable * peer_margin : -std::numeric_limits<double>::max();
    check_against(
        trajectory, window, {kind, disc.id, speed + disc.speed_bound, window.moving_until}, floor,
        [&](double time, const Eigen::Vector2d& p, const Trajectory&) {
          other.move_to(time);
          return (p - other.position()).norm() - disc.radius - margin;
        },
        report);
  }
  // Being in a field is not contact.
  if (!window.fields) return report;
  for (const DangerRegion& region : regions_)
    check_against(
        trajectory, window, {ConflictKind::obstacle, region.id, speed, window.moving_until},
        -std::numeric_limits<double>::max(),
        [&](double, const Eigen::Vector2d& p, const Trajectory&) {
          return region.field.clearance(p, region.threshold);
        },
        report);
  return report;
}

LimitReport check_limits(const Trajectory& trajectory, const RobotParameters& robot, const Drive& drive) {
  constexpr int kSamplesPerPiece = 10;
  LimitReport report;
  double piece_start = trajectory.start_time();
  for (int i = 0; i < trajectory.piece_count(); ++i) {
    const QuinticPiece& piece = trajectory.piece(i);
    for (int j = (i == 0 ? 0 : 1); j <= kSamplesPerPiece; ++j) {
      const double local_time = piece.duration * j / kSamplesPerPiece;
      const Eigen::Vector2d velocity = piece.velocity(local_time);
      const HeadingState heading = trajectory.heading_state(piece_start + local_time);
      const DriveInput wheels =
          drive.input_from_world({velocity.x(), velocity.y(), heading.yaw_rate}, heading.heading);
      report.speed = std::max(report.speed, velocity.norm());
      report.acceleration = std::max(report.acceleration, piece.acceleration(local_time).norm());
      report.wheel_speed = std::max(report.wheel_speed, wheels.lpNorm<Eigen::Infinity>());
    }
    piece_start += piece.duration;
  }
  report.speed /= robot.max_speed;
  report.acceleration /= robot.max_acceleration;
  report.wheel_speed /= robot.max_wheel_speed;
  return report;
}

HeadingProfile fitted_heading(const Trajectory& trajectory, const HeadingState& heading,
                              double target_heading, const RobotParameters& robot, const Drive& drive) {
  constexpr int kTries = 6;
  constexpr double kSlowest = 0.02;  // [rad/s]
  double yaw_rate = robot.max_yaw_rate;
  Trajectory trial = trajectory;
  for (int i = 0; i < kTries && yaw_rate > kSlowest; ++i) {
    trial.set_heading(
        {trajectory.start_time(), heading, target_heading, yaw_rate, robot.max_yaw_acceleration});
    if (check_limits(trial, robot, drive).wheel_speed <= 1.0) return trial.heading();
    yaw_rate *= 0.5;
  }
  return stopping_heading(heading, trajectory.start_time(), robot);
}

}  // namespace spf
