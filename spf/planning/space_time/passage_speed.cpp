#include "spf/planning/space_time/passage_speed.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "spf/math/plane.hpp"
#include "spf/planning/cost_to_go.hpp"

namespace spf {
namespace {

constexpr double kCreep = 0.08;  // [1] of max_speed, in the narrowest gap
constexpr double kOffMiddle =
    0.8;  // [1] of the room beside the robot: the rest is for not being in the middle
constexpr double kNearlyAsFar = 0.9;  // [1] of the most standard deviations from a surface
constexpr double kMostParts = 1e6;    // of a leg
constexpr std::size_t kCorners = 64;  // of a path: more have to be allocated
constexpr double kLookAhead = 0.5;    // [1] of the radius
constexpr double kLeastPart = 0.5;    // [1] of the reach of a turn
constexpr double kStraight = 0.1;     // [rad]
constexpr double kCut = 0.5;          // [1] of the room
constexpr double kTurning = 0.4;      // [1] of max_acceleration
constexpr double kTurnShare =
    0.4;  // [rad] half of a common turn, which takes speed^2 / acceleration times that
constexpr double kBraking = 0.5;        // [1] of max_acceleration
constexpr double kSpacing = 1.0 / 3.0;  // [1] of the radius, between looks

}  // namespace

double path_sigma(double static_sigma, double position_sigma, double speed, double max_speed) {
  return std::hypot(static_sigma * std::min(1.0, kStillPace + speed / max_speed), position_sigma);
}

PassageSpeed::PassageSpeed(const SpaceTimeParameters& parameters, const RobotParameters& robot)
    : parameters_{parameters}, robot_{robot}, footprint_{robot} {
  path_.reserve(kCorners);
  legs_.reserve(kCorners);
  marks_.reserve(kCorners + static_cast<std::size_t>(std::min(reach() / (kSpacing * robot_.radius), 1e4)));
}

/// For a robot that heads along `ahead`, the unit vector of the path.
PassageSpeed::Room PassageSpeed::room_at(const PlanRequest& request, const Eigen::Vector2d& position_world,
                                         const Eigen::Vector2d& ahead) const {
  const OccupancyMap& map = *request.world.map;
  const double margin = map.margin(parameters_.static_margin);
  const auto distance = [&map](const Eigen::Vector2d& point) { return map.exact_distance(point); };
  Room room;
  room.at_surface = map.distance(position_world) - (robot_.radius + margin);
  if (room.at_surface < robot_.radius)
    room.at_surface =
        footprint_.is_disc()
            ? map.exact_distance(position_world) - (robot_.radius + margin)
            : footprint_.clearance(position_world, ahead, robot_.radius + margin, distance) - margin;
  for (const StandingDisc& disc : request.guide->standing()) {
    const double size = (disc.position_world - position_world).norm() - disc.radius -
                        footprint_.half_width() - parameters_.static_margin;
    if (size >= room.at_standing) continue;
    room.at_standing = size;
    room.beside = &disc;
  }
  return room;
}

/// Largest speed on a straight path with this room [m] on its narrower side.
double PassageSpeed::straight_speed(const PlanRequest& request, double room) const {
  const double inner = kOffMiddle * std::max(room, 0.0);
  const auto sigma_at = [&](double speed) {
    return path_sigma(parameters_.static_sigma, request.position_sigma, speed, robot_.max_speed);
  };
  if (inner >= kSurfaceSigmas * sigma_at(robot_.max_speed)) return robot_.max_speed;
  // No slower than helps: what is not known of the own position does not get better by it.
  const double sigmas = std::min(kSurfaceSigmas, kNearlyAsFar * inner / sigma_at(0.0));
  const double sigma = sigmas > 0.0 ? inner / sigmas : 0.0;
  const double own =
      std::sqrt(std::max(sigma * sigma - request.position_sigma * request.position_sigma, 0.0));
  const double pace = own / parameters_.static_sigma - kStillPace;
  return robot_.max_speed * std::clamp(pace, kCreep, 1.0);
}

/// As far as the robot can come within the horizon and then stop [m].
double PassageSpeed::reach() const {
  return robot_.max_speed * (parameters_.horizon + robot_.max_speed / robot_.max_acceleration);
}

/// Calls look(position, unit vector along the path) until it returns false, as far as the robot can come.
template <class Look>
void PassageSpeed::look_along(const Look& look) const {
  const double spacing = kSpacing * robot_.radius;
  const double far = reach();
  double ahead = 0.0;  // of the last look
  for (std::size_t i = 1; i < path_.size() && ahead < far; ++i) {
    const Eigen::Vector2d leg = path_[i] - path_[i - 1];
    const int parts = std::max(1, static_cast<int>(std::ceil(std::min(leg.norm() / spacing, kMostParts))));
    const Eigen::Vector2d along = leg.normalized();
    for (int part = 1; part <= parts && ahead < far; ++part) {
      if (!look(Eigen::Vector2d{path_[i - 1] + leg * (static_cast<double>(part) / parts)}, along)) return;
      ahead += leg.norm() / parts;
    }
  }
}

void PassageSpeed::prepare(const PlanRequest& request) {
  marks_.clear();
  blocker_ = nullptr;
  stop_cost_ = exit_cost_ = 0.0;
  waits_ = false;
  const CostToGo& guide = *request.guide;
  guide.shortest_path(request.head.position_world, path_);
  bool narrow = request.give_way.has_value();
  if (!narrow)
    look_along([&](const Eigen::Vector2d& here, const Eigen::Vector2d& ahead) {
      narrow = straight_speed(request, room_at(request, here, ahead).least()) < robot_.max_speed;
      return !narrow;
    });
  if (!narrow) return;
  look_along([&](const Eigen::Vector2d& here, const Eigen::Vector2d& ahead) {
    const Room room = room_at(request, here, ahead);
    const double cost = guide.cost_to_go(here);
    Mark mark{here, cost, straight_speed(request, room.least()), room};
    if (!marks_.empty()) {
      const Mark& last = marks_.back();
      mark.cost = std::min(cost, last.cost);
      mark.along = last.along + (here - last.position_world).norm();
    }
    marks_.push_back(mark);
    return true;
  });
  keep_legs();
  slow_down_in_turns();
  leave_room_to_brake();
  add_delays();  // before any stop: to stand is none
  stop_before_what_stands();
  if (request.give_way && request.give_way->cost_to_go >= stop_cost_) {
    waits_ = true;
    stop_cost_ = request.give_way->cost_to_go;
    exit_cost_ = 0.0;
    for (Mark& mark : marks_)
      if (mark.cost <= stop_cost_) mark.speed = 0.0;
  }
  leave_room_to_brake();
}

void PassageSpeed::leave_room_to_brake() {
  for (std::size_t k = marks_.size(); k-- > 1;) {
    const double step = (marks_[k].position_world - marks_[k - 1].position_world).norm();
    const double braked =
        std::sqrt(marks_[k].speed * marks_[k].speed + 2.0 * kBraking * robot_.max_acceleration * step);
    marks_[k - 1].speed = std::min(marks_[k - 1].speed, braked);
  }
}

/// Narrow ground costs more than its length already, and where the path leads through what stands the guide
/// counts how long that may take.
void PassageSpeed::add_delays() {
  for (std::size_t k = marks_.size(); k-- > 1;) {
    const Mark& next = marks_[k];
    Mark& mark = marks_[k - 1];
    const double step = (next.position_world - mark.position_world).norm();
    const double speed = std::max(0.5 * (mark.speed + next.speed), kCreep * robot_.max_speed);
    const double counted = (mark.cost - next.cost) / robot_.max_speed;
    mark.delay = next.delay + (next.room.at_standing < 0.0 ? 0.0 : std::max(0.0, step / speed - counted));
  }
}

void PassageSpeed::keep_legs() {
  legs_.clear();
  double ahead = 0.0;
  for (std::size_t i = 1; i < path_.size() && ahead < reach(); ++i) {
    const Eigen::Vector2d step = path_[i] - path_[i - 1];
    const double length = step.norm();
    if (!(length > 0.0)) continue;
    legs_.push_back({path_[i - 1], step / length, length});
    ahead += length;
  }
}

/// A turn at a speed has a radius, and cuts its corner by no more than a share of the room there. The turn is
/// that of the path as far before and behind as the robot's radius, however many corners it has there.
void PassageSpeed::slow_down_in_turns() {
  const double reach = robot_.radius;
  std::size_t first = 0;
  std::size_t last = 0;
  for (std::size_t k = 0; k < marks_.size(); ++k) {
    const Mark& here = marks_[k];
    while (first < k && marks_[first + 1].along <= here.along - reach) ++first;
    while (last + 1 < marks_.size() && marks_[last].along < here.along + reach) ++last;
    if (here.along - marks_[first].along < kLeastPart * reach ||
        marks_[last].along - here.along < kLeastPart * reach)
      continue;  // the path begins or ends
    const Eigen::Vector2d before = here.position_world - marks_[first].position_world;
    const Eigen::Vector2d after = marks_[last].position_world - here.position_world;
    const double angle = std::fabs(std::atan2(cross(before, after), before.dot(after)));
    if (angle < kStraight) continue;
    const double by_curvature = 0.5 * (before.norm() + after.norm()) / angle;
    const double cut = kCut * std::max(here.room.least(), 0.0);
    const double by_cut = cut / (1.0 / std::cos(0.5 * std::min(angle, 3.0)) - 1.0);
    const double speed = std::sqrt(kTurning * robot_.max_acceleration * std::max(by_curvature, by_cut));
    marks_[k].speed = std::min(marks_[k].speed, speed);
  }
}

/// Where the path leads through what stands, and from where it comes near to it on.
void PassageSpeed::stop_before_what_stands() {
  auto inside = std::find_if(marks_.begin(), marks_.end(), [this](const Mark& mark) {
    return mark.room.at_standing < -parameters_.static_margin;
  });
  if (inside == marks_.end()) return;
  blocker_ = inside->room.beside;
  const auto exit =
      std::find_if(inside, marks_.end(), [](const Mark& mark) { return mark.room.at_standing >= 0.0; });
  if (exit != marks_.end()) exit_cost_ = exit->cost;
  while (inside != marks_.begin() && std::prev(inside)->room.at_standing < parameters_.margin) --inside;
  stop_cost_ = inside->cost;
  for (auto mark = inside; mark != marks_.end(); ++mark) mark->speed = 0.0;
}

std::optional<Eigen::Vector2d> PassageSpeed::direction(const Eigen::Vector2d& position_world,
                                                       double speed) const {
  if (!limits()) return std::nullopt;
  double nearest = robot_.radius * robot_.radius;
  auto leg = legs_.end();
  double along = 0.0;  // [m] from the leg's start to the nearest point
  for (auto trial = legs_.begin(); trial != legs_.end(); ++trial) {
    const Eigen::Vector2d offset = position_world - trial->from_world;
    const double at = std::clamp(offset.dot(trial->direction_world), 0.0, trial->length);
    const double gap = (offset - at * trial->direction_world).squaredNorm();
    if (gap >= nearest) continue;
    nearest = gap;
    leg = trial;
    along = at;
  }
  if (leg == legs_.end()) return std::nullopt;
  double left =
      along + std::max(kLookAhead * robot_.radius, kTurnShare * speed * speed / robot_.max_acceleration);
  for (; left >= leg->length && std::next(leg) != legs_.end(); ++leg) left -= leg->length;
  const Eigen::Vector2d target = leg->from_world + std::min(left, leg->length) * leg->direction_world;
  const Eigen::Vector2d onwards = target - position_world;
  const double length = onwards.norm();
  if (!(length > 1e-6)) return std::nullopt;
  return Eigen::Vector2d{onwards / length};
}

std::vector<PassageSpeed::Mark>::const_iterator PassageSpeed::mark_at(double cost_to_go) const {
  return std::lower_bound(marks_.begin(), marks_.end(), cost_to_go,
                          [](const Mark& mark, double cost) { return mark.cost > cost; });
}

double PassageSpeed::delay(double left) const {
  const auto next = mark_at(left);
  if (next == marks_.end()) return 0.0;
  if (next == marks_.begin()) return next->delay;
  const Mark& before = *std::prev(next);
  const double step = before.cost - next->cost;
  const double share = step > 0.0 ? (left - next->cost) / step : 0.0;
  return next->delay + share * (before.delay - next->delay);
}

double PassageSpeed::limit(double cost_to_go) const {
  const auto next = mark_at(cost_to_go);
  if (next == marks_.end()) return std::numeric_limits<double>::infinity();
  if (next == marks_.begin()) return next->speed;
  return std::min(next->speed, std::prev(next)->speed);
}

}  // namespace spf
