#include "spf/planning/moving_disc.hpp"

#include <algorithm>
#include <cmath>

namespace spf {
namespace {

/// Largest norm of the Bernstein control points of the velocity of one piece, whose convex hull contains the
/// velocity.
double piece_speed_bound(const QuinticPiece& piece) {
  // Velocity in u = t / T: sum_k d_k u^k with d_k = (k + 1) c_{k+1} T^k; Bernstein b_i = sum_k C(i,k) /
  // C(4,k) d_k.
  static constexpr double kBernstein[5][5] = {{1.0, 0.0, 0.0, 0.0, 0.0},
                                              {1.0, 0.25, 0.0, 0.0, 0.0},
                                              {1.0, 0.5, 1.0 / 6.0, 0.0, 0.0},
                                              {1.0, 0.75, 0.5, 0.25, 0.0},
                                              {1.0, 1.0, 1.0, 1.0, 1.0}};
  Eigen::Vector2d power[5];
  double scale = 1.0;
  for (int k = 0; k < 5; ++k) {
    power[k] = ((k + 1) * scale) * piece.coefficients.row(k + 1).transpose();
    scale *= piece.duration;
  }
  double largest = 0.0;
  for (const auto& row : kBernstein) {
    Eigen::Vector2d control = Eigen::Vector2d::Zero();
    for (int k = 0; k < 5; ++k) control += row[k] * power[k];
    largest = std::max(largest, control.squaredNorm());
  }
  return std::sqrt(largest);
}

}  // namespace

double speed_bound(const Trajectory& trajectory) {
  double largest = 0.0;
  for (int i = 0; i < trajectory.piece_count(); ++i)
    largest = std::max(largest, piece_speed_bound(trajectory.piece(i)));
  return largest;
}

DiscCursor::DiscCursor(const MovingDisc& disc) : disc_{disc} {
  if (disc.trajectory != nullptr) piece_start_ = disc.trajectory->start_time();
}

void DiscCursor::move_to(double time) {
  if (disc_.trajectory == nullptr) {
    position_ = disc_.position_world + (time - disc_.time) * disc_.velocity_world;
    velocity_ = disc_.velocity_world;
    return;
  }
  const Trajectory& course = *disc_.trajectory;
  if (time < piece_start_) {
    piece_ = 0;
    piece_start_ = course.start_time();
  }
  while (piece_ + 1 < course.piece_count() && time > piece_start_ + course.piece(piece_).duration) {
    piece_start_ += course.piece(piece_).duration;
    ++piece_;
  }
  const QuinticPiece& piece = course.piece(piece_);
  const double local_time = time - piece_start_;
  const bool moving = local_time >= 0.0 && local_time <= piece.duration;
  const double clamped = std::clamp(local_time, 0.0, piece.duration);
  const auto& c = piece.coefficients;
  for (int axis = 0; axis < 2; ++axis) {
    const double* a = c.col(axis).data();
    const double t = clamped;
    position_[axis] = a[0] + t * (a[1] + t * (a[2] + t * (a[3] + t * (a[4] + t * a[5]))));
    velocity_[axis] =
        moving ? a[1] + t * (2.0 * a[2] + t * (3.0 * a[3] + t * (4.0 * a[4] + t * 5.0 * a[5]))) : 0.0;
  }
}

}  // namespace spf
