#include "sim/walker.hpp"

#include <algorithm>
#include <cmath>

namespace spf::sim {
namespace {

constexpr double kLookAhead = 3.0;   // [s]
constexpr double kUrgency = 1.0;     // [s] a meeting this far ahead counts 1/e
constexpr double kAvoiding = 4.0;    // [m/s^2] for a meeting at once and at touching bodies
constexpr double kPush = 6.0;        // [m/s^2] at touching bodies, and
constexpr double kPushRange = 0.12;  // [m] the distance over which it falls to 1/e
constexpr double kComfort = 0.25;    // [m] beyond touching over which avoiding falls to 1/e

}  // namespace

Eigen::Vector2d avoidance(const Body& self, const Body& other, double touching, bool standing) {
  const Eigen::Vector2d apart = self.position - other.position;
  const Eigen::Vector2d closing = self.velocity - other.velocity;
  const double distance = apart.norm();
  Eigen::Vector2d push = Eigen::Vector2d::Zero();
  if (distance > 1e-9 && distance < 2.0 * touching)
    push = kPush * std::exp((touching - distance) / kPushRange) * apart / distance;
  const double closing_square = closing.squaredNorm();
  if (standing || closing_square < 1e-4) return push;
  const double time = -apart.dot(closing) / closing_square;
  if (time <= 0.0 || time > kLookAhead) return push;
  const Eigen::Vector2d nearest = apart + time * closing;
  const Eigen::Vector2d to_the_right = Eigen::Vector2d{closing.y(), -closing.x()} / std::sqrt(closing_square);
  const Eigen::Vector2d escape = nearest + 0.1 * to_the_right;
  const double strength =
      kAvoiding * std::exp(-time / kUrgency + std::min(0.0, touching - nearest.norm()) / kComfort);
  constexpr double kUndecided = 1e-6;  // [m] the other side is as good
  const double size = escape.norm();
  return push + strength * (size > kUndecided ? Eigen::Vector2d{escape.normalized()} : to_the_right);
}

Eigen::Vector2d within_strength(const Eigen::Vector2d& acceleration) {
  const double size = acceleration.norm();
  if (size > kWalkerStrongest) return acceleration * (kWalkerStrongest / size);
  return acceleration;
}

void advance(Body& body, const Eigen::Vector2d& acceleration, double wanted_speed, double step) {
  body.velocity += step * acceleration;
  const double speed = body.velocity.norm();
  const double fastest = kWalkerHurry * wanted_speed;
  if (speed > fastest) body.velocity *= fastest / speed;
  body.position += step * body.velocity;
}

}  // namespace spf::sim
