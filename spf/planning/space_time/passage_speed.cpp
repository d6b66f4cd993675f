#include "spf/planning/space_time/passage_speed.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "spf/planning/cost_to_go.hpp"

namespace spf {
namespace {

constexpr double kStillPace = 0.15;  // [1] of max_speed: below, slower is not more exact
constexpr double kCreep = 0.08;      // [1] of max_speed, in the narrowest gap
constexpr double kOffMiddle =
    0.7;                          // [1] of the room beside the robot: the rest is for not being in the middle
constexpr double kBraking = 0.5;  // [1] of max_acceleration
constexpr double kSpacing = 1.0 / 3.0;  // [1] of the radius, between looks

}  // namespace

double way_sigma(double static_sigma, double position_sigma, double speed, double max_speed) {
  return std::hypot(static_sigma * std::min(1.0, kStillPace + speed / max_speed), position_sigma);
}

PassageSpeed::PassageSpeed(const SpaceTimeParameters& parameters, const RobotParameters& robot)
    : parameters_{parameters}, robot_{robot} {}

double PassageSpeed::speed_at(const OccupancyMap& map, const Eigen::Vector2d& position_world,
                              double position_sigma) const {
  const double wanted = robot_.radius + map.margin(parameters_.static_margin);
  const double enough =
      wanted + kSurfaceSigmas / kOffMiddle *
                   way_sigma(parameters_.static_sigma, position_sigma, robot_.max_speed, robot_.max_speed);
  if (map.distance(position_world) >= enough) return robot_.max_speed;
  const double room = kOffMiddle * (map.exact_distance(position_world) - wanted);
  const double sigma = std::max(room, 0.0) / kSurfaceSigmas;
  const double own = std::sqrt(std::max(sigma * sigma - position_sigma * position_sigma, 0.0));
  const double pace = own / parameters_.static_sigma - kStillPace;
  return robot_.max_speed * std::clamp(pace, kCreep, 1.0);
}

void PassageSpeed::prepare(const PlanRequest& request) {
  marks_.clear();
  const CostToGo& guide = *request.guide;
  guide.shortest_path(request.head.position_world, way_);
  const double spacing = kSpacing * robot_.radius;
  const double reach = robot_.max_speed * (parameters_.horizon + robot_.max_speed / robot_.max_acceleration);
  double ahead = 0.0;  // of the last look
  bool narrow = false;
  for (std::size_t i = 1; i < way_.size() && ahead < reach; ++i) {
    const Eigen::Vector2d leg = way_[i] - way_[i - 1];
    const int parts = std::max(1, static_cast<int>(std::ceil(leg.norm() / spacing)));
    for (int part = 1; part <= parts && ahead < reach; ++part) {
      const Eigen::Vector2d here = way_[i - 1] + leg * (static_cast<double>(part) / parts);
      const double speed = speed_at(*request.world.map, here, request.position_sigma);
      narrow = narrow || speed < robot_.max_speed;
      const double cost = guide.cost_to_go(here);
      marks_.push_back({marks_.empty() ? cost : std::min(cost, marks_.back().cost), speed});
      ahead += leg.norm() / parts;
    }
  }
  if (!narrow) marks_.clear();
  for (std::size_t k = marks_.size(); k-- > 1;) {
    const double braked =
        std::sqrt(marks_[k].speed * marks_[k].speed + 2.0 * kBraking * robot_.max_acceleration * spacing);
    marks_[k - 1].speed = std::min(marks_[k - 1].speed, braked);
  }
}

double PassageSpeed::limit(double cost_to_go) const {
  const auto next = std::lower_bound(marks_.begin(), marks_.end(), cost_to_go,
                                     [](const Mark& mark, double cost) { return mark.cost > cost; });
  if (next == marks_.end()) return std::numeric_limits<double>::infinity();
  if (next == marks_.begin()) return next->speed;
  return std::min(next->speed, std::prev(next)->speed);
}

}  // namespace spf
