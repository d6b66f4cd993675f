#include "spf/trajectory/trajectory.hpp"

#include <algorithm>
#include <cmath>

#include "spf/math/angles.hpp"
#include "spf/math/polynomial_roots.hpp"
#include "spf/math/quadrature.hpp"

namespace spf {
namespace {

/// The k-th time derivative of a piece at local_time, by Horner's rule. With falling factorials.
template <int Order>
Eigen::Vector2d derivative_at(const Eigen::Matrix<double, 6, 2>& coefficients, double local_time) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (int k = 5; k >= Order; --k) {
    double factor = 1.0;
    for (int j = 0; j < Order; ++j) factor *= k - j;
    sum = sum * local_time + factor * coefficients.row(k).transpose();
  }
  return sum;
}

/// Slope d/du of |x|^2, where x is the Order-th time derivative of the piece and u = local_time / duration in
/// [0, 1] (up to a positive factor).
template <int Order>
std::array<double, 2 * (5 - Order)> squared_norm_slope(const QuinticPiece& piece) {
  constexpr int kDegree = 5 - Order;
  Eigen::Matrix<double, kDegree + 1, 2> scaled;
  double power = 1.0;
  for (int k = 0; k <= kDegree; ++k) {
    double factor = power;
    for (int j = 0; j < Order; ++j) factor *= k + Order - j;
    scaled.row(k) = factor * piece.coefficients.row(k + Order);
    power *= piece.duration;
  }
  std::array<double, 2 * kDegree> slope{};
  for (int i = 0; i <= kDegree; ++i)
    for (int j = 0; j <= kDegree; ++j)
      if (i + j > 0) slope[static_cast<std::size_t>(i + j - 1)] += (i + j) * scaled.row(i).dot(scaled.row(j));
  return slope;
}

/// Largest norm of the Order-th derivative over one piece: at an end or where the slope of its square changes
/// sign.
template <int Order>
double largest_norm(const QuinticPiece& piece) {
  double largest = std::max(derivative_at<Order>(piece.coefficients, 0.0).squaredNorm(),
                            derivative_at<Order>(piece.coefficients, piece.duration).squaredNorm());
  const std::array<double, 2 * (5 - Order)> slope = squared_norm_slope<Order>(piece);
  for (const double turn : polynomial_roots(slope, 0.0, 1.0)) {
    const Eigen::Vector2d value = derivative_at<Order>(piece.coefficients, turn * piece.duration);
    largest = std::max(largest, value.squaredNorm());
  }
  return std::sqrt(largest);
}

/// Upper bound of a piece's length [m], in which no terms of the velocity cancel.
double length_bound(const QuinticPiece& piece) {
  double bound = 0.0;
  for (int k = 5; k >= 1; --k)
    bound = (bound + piece.coefficients.row(k).norm() * k) * (k > 1 ? piece.duration : 1.0);
  return bound * piece.duration;
}

/// The speed has its sharp bends where it (nearly) vanishes, so each monotone stretch is integrated on its
/// own.
double piece_length(const QuinticPiece& piece) {
  constexpr double kRelativeTolerance = 1e-10;
  constexpr double kRounding = 1e-15;  // of the speed, relative to the sum of its parts
  constexpr int kMaxHalvings = 16;
  constexpr int kMaxPanels = 256;
  const auto speed = [&](double local_time) { return piece.velocity(local_time).norm(); };
  const double estimate = gauss_legendre(speed, 0.0, piece.duration);
  Quadrature quadrature{std::fmax(kRelativeTolerance * estimate, kRounding * length_bound(piece)),
                        kMaxHalvings, kMaxPanels};
  double length = 0.0;
  double from = 0.0;
  const auto add_up_to = [&](double to) {
    length += quadrature.integrate(speed, from, to);
    from = to;
  };
  for (const double turn : polynomial_roots(squared_norm_slope<1>(piece), 0.0, 1.0))
    add_up_to(turn * piece.duration);
  add_up_to(piece.duration);
  return length;
}

}  // namespace

Eigen::Vector2d QuinticPiece::position(double local_time) const {
  return derivative_at<0>(coefficients, local_time);
}
Eigen::Vector2d QuinticPiece::velocity(double local_time) const {
  return derivative_at<1>(coefficients, local_time);
}
Eigen::Vector2d QuinticPiece::acceleration(double local_time) const {
  return derivative_at<2>(coefficients, local_time);
}
Eigen::Vector2d QuinticPiece::jerk(double local_time) const {
  return derivative_at<3>(coefficients, local_time);
}

Trajectory Trajectory::standing(const Eigen::Vector2d& position_world, double start_time, double duration,
                                const HeadingProfile& heading) {
  QuinticPiece piece;
  piece.coefficients.row(0) = position_world.transpose();
  piece.duration = duration;
  Trajectory trajectory{start_time};
  trajectory.append(piece);
  trajectory.set_heading(heading);
  return trajectory;
}

void Trajectory::append(const QuinticPiece& piece) {
  assert(piece_count_ < kMaxPieces);
  assert(piece.duration > 0.0);
  pieces_[static_cast<std::size_t>(piece_count_++)] = piece;
  duration_ += piece.duration;
}

void Trajectory::append(const QuinticPiece& piece, const HeadingState& from, const HeadingState& to) {
  assert(steered_ || empty());
  steered_ = true;
  knots_[static_cast<std::size_t>(piece_count_)] = from;
  append(piece);
  knots_[static_cast<std::size_t>(piece_count_)] = to;
}

Trajectory::LocalTime Trajectory::locate(double time) const {
  assert(!empty());
  double local_time = std::max(0.0, time - start_time_);
  int index = 0;
  while (index + 1 < piece_count_ && local_time >= piece(index).duration)
    local_time -= piece(index++).duration;
  return {index, std::min(local_time, piece(index).duration)};
}

FlatState Trajectory::state(double time) const {
  const LocalTime at = locate(time);
  const QuinticPiece& current = piece(at.index);
  FlatState state;
  state.position_world = current.position(at.local_time);
  if (time < start_time_ || time > end_time()) return state;
  state.velocity_world = current.velocity(at.local_time);
  state.acceleration_world = current.acceleration(at.local_time);
  return state;
}

Eigen::Vector2d Trajectory::position(double time) const {
  const LocalTime at = locate(time);
  return piece(at.index).position(at.local_time);
}

HeadingState Trajectory::heading_state(double time) const {
  if (!steered_) return heading_.state(time);
  const LocalTime at = locate(time);
  const HeadingState& from = heading_knot(at.index);
  const HeadingState& to = heading_knot(at.index + 1);
  if (time < start_time_) return {from.heading, 0.0};
  if (time > end_time()) return {to.heading, 0.0};
  const double duration = piece(at.index).duration;
  const double turn = angle_difference(to.heading, from.heading);
  const double r0 = from.yaw_rate * duration;
  const double r1 = to.yaw_rate * duration;
  const double u = at.local_time / duration;
  const double second = 3.0 * turn - 2.0 * r0 - r1;
  const double third = r0 + r1 - 2.0 * turn;
  return {wrap_angle(from.heading + u * (r0 + u * (second + u * third))),
          (r0 + u * (2.0 * second + u * 3.0 * third)) / duration};
}

double Trajectory::rest_time() const {
  return steered_ ? end_time() : std::max(end_time(), heading_.start_time() + heading_.turn_duration());
}

Eigen::Vector2d Trajectory::tail_position() const {
  const QuinticPiece& last = piece(piece_count_ - 1);
  return last.position(last.duration);
}

double Trajectory::max_speed() const {
  double largest = 0.0;
  for (int i = 0; i < piece_count_; ++i) largest = std::max(largest, largest_norm<1>(piece(i)));
  return largest;
}

double Trajectory::max_acceleration() const {
  double largest = 0.0;
  for (int i = 0; i < piece_count_; ++i) largest = std::max(largest, largest_norm<2>(piece(i)));
  return largest;
}

double Trajectory::length() const {
  double sum = 0.0;
  for (int i = 0; i < piece_count_; ++i) sum += piece_length(piece(i));
  return sum;
}

}  // namespace spf
