#include "spf/field/probability_field.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "spf/math/angles.hpp"

namespace spf {
namespace {

// Below this speed [m/s] the direction of motion is noise; the stretch it could cause is under a micrometre.
constexpr double kRestingSpeed = 1e-6;
// Below this Mahalanobis distance a point counts as the centre.
constexpr double kCenter = 1e-9;

/// Smallest m such that the ellipse m * (along, across) around the origin holds the disc of radius `across`
/// around (offset, 0). On the disc's rim, with u the cosine of the polar angle, m^2 = (offset + across u)^2 /
/// along^2 + 1 - u^2, a concave parabola in u with its peak at u = across offset / (along^2 - across^2).
double holding_mahalanobis(double along, double across, double offset) {
  const double excess = along * along - across * across;
  const double lever = across * offset;
  const double u = lever < excess ? lever / excess : 1.0;
  const double x = (offset + across * u) / along;
  return std::sqrt(x * x + 1.0 - u * u);
}

}  // namespace

ProbabilityField::ProbabilityField(const ObstacleState& obstacle, double robot_radius,
                                   const FieldParameters& parameters) {
  across_ = obstacle.radius + robot_radius;
  assert(across_ > 0.0);
  double speed = obstacle.velocity_world.norm();
  if (!parameters.directional || speed < kRestingSpeed) speed = 0.0;
  if (speed > 0.0) axis_world_ = obstacle.velocity_world / speed;

  along_ = across_ + 0.5 * speed * parameters.stretch_time;
  const double shift = (1.0 - parameters.attention) * speed * parameters.shift_interval;
  center_world_ = obstacle.position_world + shift * axis_world_;  // eq. 2

  // eq. 3: Sigma^-1 = R diag(1/a^2, 1/b^2) R^T = (R's columns e, e_perp) e e^T / a^2 + (I - e e^T) / b^2.
  const Eigen::Matrix2d outer = axis_world_ * axis_world_.transpose();
  precision_world_ = outer / (along_ * along_) + (Eigen::Matrix2d::Identity() - outer) / (across_ * across_);
  peak_density_ = 1.0 / (2.0 * kPi * along_ * across_);

  const double farther_disc = std::max(shift, std::abs(speed * parameters.stretch_time - shift));
  threshold_ = parameters.threshold_scale * holding_mahalanobis(along_, across_, farther_disc);
}

double ProbabilityField::density(const Eigen::Vector2d& position_world) const {
  return peak_density_ * risk(position_world);  // eq. 1
}

Eigen::Vector2d ProbabilityField::density_gradient(const Eigen::Vector2d& position_world) const {
  return -density(position_world) * (precision_world_ * (position_world - center_world_));  // eq. 4
}

double ProbabilityField::mahalanobis(const Eigen::Vector2d& position_world) const {
  const Eigen::Vector2d offset = position_world - center_world_;
  return std::sqrt(offset.dot(precision_world_ * offset));
}

double ProbabilityField::risk(const Eigen::Vector2d& position_world) const {
  const Eigen::Vector2d offset = position_world - center_world_;
  return std::exp(-0.5 * offset.dot(precision_world_ * offset));
}

Eigen::Vector2d ProbabilityField::escape_direction(const Eigen::Vector2d& position_world,
                                                   const Eigen::Vector2d& preferred_side_world) const {
  // The factor U of eq. 11 cancels in the direction; left out, so that it cannot underflow (paper_notes 6).
  const Eigen::Vector2d offset = position_world - center_world_;
  if (offset.norm() > kCenter * across_) return (precision_world_ * offset).normalized();
  const Eigen::Vector2d left{-axis_world_.y(), axis_world_.x()};
  return left.dot(preferred_side_world) >= 0.0 ? left : Eigen::Vector2d{-left};
}

Eigen::Vector2d ProbabilityField::guide_point(const Eigen::Vector2d& position_world,
                                              const Eigen::Vector2d& direction_world,
                                              double mahalanobis) const {
  // |offset + s direction|^2 in the metric of Sigma^-1 equals mahalanobis^2; the root with s >= 0.
  const Eigen::Vector2d offset = position_world - center_world_;
  const Eigen::Vector2d slope = precision_world_ * direction_world;
  const double quadratic = direction_world.dot(slope);
  const double linear = offset.dot(slope);
  const double constant = offset.dot(precision_world_ * offset) - mahalanobis * mahalanobis;
  if (constant >= 0.0) return position_world;
  const double root = std::sqrt(linear * linear - quadratic * constant);
  // The form without cancellation for either sign of `linear`.
  const double step = linear > 0.0 ? -constant / (linear + root) : (root - linear) / quadratic;
  return position_world + step * direction_world;
}

double ProbabilityField::clearance(const Eigen::Vector2d& position_world, double threshold) const {
  // |grad m| <= 1 / across, so (m - threshold) * across changes no faster than the position.
  return (mahalanobis(position_world) - threshold) * across_;
}

FieldEllipse ProbabilityField::ellipse(double mahalanobis) const {
  return {center_world_, mahalanobis * Eigen::Vector2d{along_, across_},
          std::atan2(axis_world_.y(), axis_world_.x())};
}

}  // namespace spf
