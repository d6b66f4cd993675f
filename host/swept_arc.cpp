#include "host/swept_arc.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "spf/math/angles.hpp"
#include "spf/math/plane.hpp"

namespace spf::host {
namespace {

constexpr double kLeastCurvature = 1e-6;  // [1/m] less is straight
constexpr double kOutOfTheWay = std::numeric_limits<double>::infinity();

double turn_of(double curvature) {
  const double amount = std::abs(curvature);
  return amount < kLeastCurvature ? kOutOfTheWay : 1.0 / amount;
}

}  // namespace

SweptArc::SweptArc(const Eigen::Vector2d& direction, double curvature, double radius)
    : direction_{direction},
      side_{curvature < 0.0 ? -1.0 : 1.0},
      turn_{turn_of(curvature)},
      radius_{radius} {}

double SweptArc::straight_distance_to(double along, double aside) const {
  const double room = radius_ * radius_ - aside * aside;
  if (along <= 0.0 || room <= 0.0) return kOutOfTheWay;
  return along - std::sqrt(room);
}

double SweptArc::distance_to(const Eigen::Vector2d& point) const {
  const double along = direction_.dot(point);
  const double aside = side_ * cross(direction_, point);
  const double squared_distance = point.squaredNorm();
  if (squared_distance <= radius_ * radius_) return along > 0.0 ? 0.0 : kOutOfTheWay;
  if (std::isinf(turn_)) return straight_distance_to(along, aside);

  // Seen from the middle of the arc: the point lies `past` [m] outside of it, so that the disc touches it
  // from `half_width` [rad] before it is abreast of it.
  const double to_middle = std::hypot(along, turn_ - aside);
  const double past = (squared_distance - 2.0 * turn_ * aside) / (to_middle + turn_);
  const double room = radius_ * radius_ - past * past;
  if (room <= 0.0 || to_middle <= 0.0) return kOutOfTheWay;
  const double half_width = 2.0 * std::asin(std::min(1.0, std::sqrt(room / (4.0 * turn_ * to_middle))));
  double abreast = std::atan2(along, turn_ - aside);
  if (abreast < 0.0) abreast += 2.0 * kPi;
  return std::max(0.0, turn_ * (abreast - half_width));
}

}  // namespace spf::host
