#include "host/swept_outline.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "spf/math/angles.hpp"
#include "spf/math/plane.hpp"

namespace spf::host {
namespace {

constexpr double kStraight = 1e-6;  // [1/m] less is straight
constexpr double kNotMet = std::numeric_limits<double>::infinity();

}  // namespace

SweptOutline::SweptOutline(const Footprint& outline, double heading, const Eigen::Vector2d& direction,
                           double curvature)
    : polygon_{outline.placed(Eigen::Vector2d::Zero(), heading)},
      direction_{direction},
      curvature_{curvature} {}

/// Seen from the outline, the point comes along a line.
double SweptOutline::straight_distance_to(const Eigen::Vector2d& point) const {
  double nearest = kNotMet;
  for (std::size_t i = 0; i < polygon_.size(); ++i) {
    const LineSegment edge = polygon_.edge(i);
    const Eigen::Vector2d side = edge.to - edge.from;
    const Eigen::Vector2d offset = point - edge.from;
    // point - distance * direction = corner + share * side
    const double across = cross(direction_, side);
    if (across == 0.0) continue;  // the sides beside it are met instead
    const double distance = cross(offset, side) / across;
    const double share = cross(direction_, offset) / across;
    if (distance >= 0.0 && share >= 0.0 && share <= 1.0) nearest = std::min(nearest, distance);
  }
  return nearest;
}

/// Seen from the outline, which turns around `middle` to a side (+1: left), the point comes along a circle
/// the other way. The angle [rad] until it meets the outline.
double SweptOutline::turn_around(const Eigen::Vector2d& middle, double side,
                                 const Eigen::Vector2d& point) const {
  const Eigen::Vector2d arm = point - middle;
  double least = kNotMet;
  for (std::size_t i = 0; i < polygon_.size(); ++i) {
    const LineSegment edge = polygon_.edge(i);
    const Eigen::Vector2d from = edge.from - middle;
    const Eigen::Vector2d along = edge.to - edge.from;
    // |from + share * along| = |arm|
    const double a = along.squaredNorm();
    const double b = from.dot(along);
    const double room = b * b - a * (from.squaredNorm() - arm.squaredNorm());
    if (room < 0.0) continue;
    for (const double root : {-std::sqrt(room), std::sqrt(room)}) {
      const double share = (root - b) / a;
      if (!(share >= 0.0 && share <= 1.0)) continue;
      const Eigen::Vector2d met = from + share * along;
      double angle = side * std::atan2(cross(met, arm), met.dot(arm));
      if (angle < 0.0) angle += 2.0 * kPi;
      least = std::min(least, angle);
    }
  }
  return least;
}

double SweptOutline::distance_to(const Eigen::Vector2d& point) const {
  if (polygon_.contains(point)) return direction_.dot(point) > 0.0 ? 0.0 : kNotMet;
  if (std::abs(curvature_) < kStraight) return straight_distance_to(point);
  const Eigen::Vector2d middle = Eigen::Vector2d{-direction_.y(), direction_.x()} / curvature_;
  return turn_around(middle, curvature_ > 0.0 ? 1.0 : -1.0, point) / std::abs(curvature_);
}

double SweptOutline::turn_to(const Eigen::Vector2d& point, bool left) const {
  return polygon_.contains(point) ? kNotMet : turn_around(Eigen::Vector2d::Zero(), left ? 1.0 : -1.0, point);
}

}  // namespace spf::host
