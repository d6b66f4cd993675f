#include "spf/planning/space_time/surface_risk.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "spf/math/angles.hpp"
#include "spf/math/normal_distribution.hpp"

namespace spf {
namespace {

constexpr double kNoRoomSigmas = 1.5;  // [1] nearer to a surface than that, the price never falls

Eigen::Vector2d between(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double share) {
  return (1.0 - share) * from + share * to;
}

}  // namespace

SurfaceRisk::SurfaceRisk(const SpaceTimeParameters& parameters, const RobotParameters& robot)
    : parameters_{parameters}, max_speed_{robot.max_speed}, footprint_{robot} {}

/// A place on the way.
struct SurfaceRisk::Look {
  Eigen::Vector2d position;
  double speed;           // [m/s]
  Eigen::Vector2d ahead;  // unit vector of the heading, of a robot with corners
};

/// Calls visit(look) along a roll-out and along the path on which the robot then stops, until it returns
/// false, so often that no surface lies between two places that are both free of it.
template <class Visit>
void SurfaceRisk::look_along(const RollOut& roll_out, const Eigen::Vector2d& stop, const Visit& visit) const {
  const double spacing = footprint_.inscribed_radius();
  const bool turns = !footprint_.is_disc();
  Look look{roll_out.position_world[0], 0.0, Eigen::Vector2d::UnitX()};
  double heading = turns ? roll_out.heading[0].heading : 0.0;
  double speed = roll_out.velocity_world[0].norm();
  Eigen::Vector2d from = roll_out.position_world[0];
  const auto look_to = [&](const Eigen::Vector2d& to, double end_speed, double turned, int least_parts) {
    const int parts = std::max(least_parts, static_cast<int>(std::ceil((to - from).norm() / spacing)));
    for (int i = 1; i <= parts; ++i) {
      const double share = static_cast<double>(i) / parts;
      look.position = between(from, to, share);
      look.speed = speed + share * (end_speed - speed);
      if (turns) look.ahead = {std::cos(heading + share * turned), std::sin(heading + share * turned)};
      if (!visit(look)) return false;
    }
    from = to;
    speed = end_speed;
    heading += turned;
    return true;
  };
  for (int k = 1; k <= roll_out.steps; ++k) {
    const auto at = static_cast<std::size_t>(k);
    const double turned = turns ? angle_difference(roll_out.heading[at].heading, heading) : 0.0;
    if (!look_to(roll_out.position_world[at], roll_out.velocity_world[at].norm(), turned, 1)) return;
  }
  look_to(stop, 0.0, 0.0, 2);
}

double SurfaceRisk::chance(const RollOut& roll_out, const Eigen::Vector2d& stop, const PlanRequest& request,
                           double enough) const {
  const OccupancyMap& map = *request.world.map;
  const double margin = map.margin(parameters_.static_margin);
  const double wanted_clearance = footprint_.circumscribed_radius() + margin;
  const double full_softness = std::hypot(parameters_.static_sigma, request.position_sigma);
  double least_clearance = std::numeric_limits<double>::infinity();
  double least_sigmas = kSurfaceSigmas;
  double chance = 0.0;
  look_along(roll_out, stop, [&](const Look& look) {
    double clearance = map.distance(look.position) - wanted_clearance;
    if (clearance > kSurfaceSigmas * full_softness) return true;
    const double sigma = path_sigma(parameters_.static_sigma, request.position_sigma, look.speed, max_speed_);
    // What follows is no less.
    if (clearance >= 0.0 && clearance >= least_sigmas * sigma) return true;
    const auto distance = [&map](const Eigen::Vector2d& point) { return map.exact_distance(point); };
    clearance = footprint_.is_disc() ? map.exact_distance(look.position) - wanted_clearance
                                     : footprint_.clearance(look.position, look.ahead,
                                                            least_sigmas * sigma + margin, distance) -
                                           margin;
    least_clearance = std::min(least_clearance, clearance);
    least_sigmas = std::min(least_sigmas, clearance / sigma);
    if (least_sigmas >= kSurfaceSigmas) return true;
    const double depth = std::max(0.0, -least_clearance) / wanted_clearance;
    const double price = least_sigmas > kNoRoomSigmas ? price_ : 1.0;
    chance = std::max(chance, price * normal_tail(least_sigmas) + depth);
    return chance <= enough;
  });
  return chance;
}

}  // namespace spf
