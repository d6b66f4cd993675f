#include "spf/trajectory/trajectory.hpp"

#include <algorithm>
#include <cmath>

#include "spf/math/polynomial_roots.hpp"

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

/// Integral of the speed over [from, to] by Gauss-Legendre with 10 nodes (symmetric: node, weight).
double speed_integral(const QuinticPiece& piece, double from, double to) {
  constexpr std::array<std::array<double, 2>, 5> kRule{{{0.1488743389816312, 0.2955242247147529},
                                                        {0.4333953941292472, 0.2692667193099963},
                                                        {0.6794095682990244, 0.2190863625159820},
                                                        {0.8650633666889845, 0.1494513491505806},
                                                        {0.9739065285171717, 0.0666713443086881}}};
  const double middle = 0.5 * (from + to);
  const double half = 0.5 * (to - from);
  double sum = 0.0;
  for (const auto& [node, weight] : kRule)
    sum +=
        weight * (piece.velocity(middle - half * node).norm() + piece.velocity(middle + half * node).norm());
  return half * sum;
}

/// The same, halved until both halves together agree with the whole.
double refined_speed_integral(const QuinticPiece& piece, double from, double to, double whole, int depth) {
  constexpr double kRelativeTolerance = 1e-9;
  const double middle = 0.5 * (from + to);
  const double left = speed_integral(piece, from, middle);
  const double right = speed_integral(piece, middle, to);
  if (depth == 0 || std::fabs(left + right - whole) <= kRelativeTolerance * (left + right))
    return left + right;
  return refined_speed_integral(piece, from, middle, left, depth - 1) +
         refined_speed_integral(piece, middle, to, right, depth - 1);
}

/// The speed has its sharp bends where it (nearly) vanishes, so each monotone stretch is integrated on its
/// own.
double piece_length(const QuinticPiece& piece) {
  constexpr int kMaxHalvings = 20;
  double length = 0.0;
  double from = 0.0;
  const auto add_up_to = [&](double to) {
    const double whole = speed_integral(piece, from, to);
    length += refined_speed_integral(piece, from, to, whole, kMaxHalvings);
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

void Trajectory::set_start_time(double start_time) {
  heading_.shift(start_time - start_time_);
  start_time_ = start_time;
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
