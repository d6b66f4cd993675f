#include "spf/trajectory/minco.hpp"

#include <cassert>

namespace spf {
namespace {

using PieceCoefficients = Eigen::Matrix<double, 6, 2>;
using PowerRow = Eigen::Matrix<double, 1, 6>;

/// Rows that turn a piece's coefficients into its position and derivatives at local time t.
struct EndRows {
  explicit EndRows(double t) : t2{t * t}, t3{t2 * t}, t4{t2 * t2} {
    position << 1.0, t, t2, t3, t4, t4 * t;
    velocity << 0.0, 1.0, 2.0 * t, 3.0 * t2, 4.0 * t3, 5.0 * t4;
    acceleration << 0.0, 0.0, 2.0, 6.0 * t, 12.0 * t2, 20.0 * t3;
    jerk << 0.0, 0.0, 0.0, 6.0, 24.0 * t, 60.0 * t2;
    snap << 0.0, 0.0, 0.0, 0.0, 24.0, 120.0 * t;
  }
  double t2, t3, t4;
  PowerRow position, velocity, acceleration, jerk, snap;
};

/// Writes the non-zero tail of a row, from power `first` on.
void put(BandedMatrix<6, 6>& matrix, int row, int first_column, const PowerRow& values, int first) {
  for (int k = first; k < 6; ++k) matrix(row, first_column + k) = values[k];
}

}  // namespace

Minco::Minco() : matrix_{6 * kMaxPieces} {}

void Minco::solve(const MincoEnds& ends, const WaypointsView& waypoints_world,
                  const DurationsView& durations) {
  assert(1 <= durations.size() && durations.size() <= kMaxPieces);
  assert(waypoints_world.cols() == durations.size() - 1);
  assert(!(durations.array() < 0.0).any());  // zero and NaN, from a line search gone far, are let through
  durations_ = durations;
  fill_matrix();
  matrix_.factorize();
  fill_right_side(ends, waypoints_world);
  matrix_.solve_in_place(coefficients_);
}

/// M(T) of eq. 5. Row order: head; then for each junction the continuity of jerk and snap, the waypoint, and
/// the continuity of position, velocity and acceleration; tail. It leaves no zero on the diagonal.
void Minco::fill_matrix() {
  const int n = piece_count();
  matrix_.reset(6 * n);
  matrix_(0, 0) = 1.0;
  matrix_(1, 1) = 1.0;
  matrix_(2, 2) = 2.0;
  for (int i = 0; i + 1 < n; ++i) {
    const int row = 6 * i;
    const EndRows end{durations_[i]};
    put(matrix_, row + 3, row, end.jerk, 3);
    matrix_(row + 3, row + 9) = -6.0;
    put(matrix_, row + 4, row, end.snap, 4);
    matrix_(row + 4, row + 10) = -24.0;
    put(matrix_, row + 5, row, end.position, 0);
    put(matrix_, row + 6, row, end.position, 0);
    matrix_(row + 6, row + 6) = -1.0;
    put(matrix_, row + 7, row, end.velocity, 1);
    matrix_(row + 7, row + 7) = -1.0;
    put(matrix_, row + 8, row, end.acceleration, 2);
    matrix_(row + 8, row + 8) = -2.0;
  }
  const int row = 6 * (n - 1);
  const EndRows end{durations_[n - 1]};
  put(matrix_, row + 3, row, end.position, 0);
  put(matrix_, row + 4, row, end.velocity, 1);
  put(matrix_, row + 5, row, end.acceleration, 2);
}

void Minco::fill_right_side(const MincoEnds& ends, const WaypointsView& waypoints_world) {
  const int n = piece_count();
  coefficients_.setZero(6 * n, 2);
  coefficients_.row(0) = ends.head.position_world.transpose();
  coefficients_.row(1) = ends.head.velocity_world.transpose();
  coefficients_.row(2) = ends.head.acceleration_world.transpose();
  for (int i = 0; i + 1 < n; ++i) coefficients_.row(6 * i + 5) = waypoints_world.col(i).transpose();
  coefficients_.row(6 * n - 3) = ends.tail.position_world.transpose();
  coefficients_.row(6 * n - 2) = ends.tail.velocity_world.transpose();
  coefficients_.row(6 * n - 1) = ends.tail.acceleration_world.transpose();
}

Trajectory Minco::trajectory(double start_time) const {
  Trajectory trajectory{start_time};
  QuinticPiece piece;
  for (int i = 0; i < piece_count(); ++i) {
    piece.coefficients = coefficients_.middleRows<6>(6 * i);
    piece.duration = durations_[i];
    trajectory.append(piece);
  }
  return trajectory;
}

double Minco::smoothness() const {
  double sum = 0.0;
  for (int i = 0; i < piece_count(); ++i) {
    const Eigen::Vector2d c3 = coefficients_.row(6 * i + 3).transpose();
    const Eigen::Vector2d c4 = coefficients_.row(6 * i + 4).transpose();
    const Eigen::Vector2d c5 = coefficients_.row(6 * i + 5).transpose();
    const double t = durations_[i];
    // Horner form of 36 c3.c3 T + 144 c3.c4 T^2 + (192 c4.c4 + 240 c3.c5) T^3 + 720 c4.c5 T^4 + 720 c5.c5
    // T^5.
    sum += t * (36.0 * c3.dot(c3) +
                t * (144.0 * c3.dot(c4) + t * (192.0 * c4.dot(c4) + 240.0 * c3.dot(c5) +
                                               t * (720.0 * c4.dot(c5) + t * 720.0 * c5.dot(c5)))));
  }
  return sum;
}

void Minco::add_smoothness_gradient(double weight, Coefficients& wrt_coefficients,
                                    Durations& wrt_durations) const {
  assert(wrt_coefficients.rows() == coefficients_.rows() && wrt_durations.size() == durations_.size());
  for (int i = 0; i < piece_count(); ++i) {
    const Eigen::RowVector2d c3 = coefficients_.row(6 * i + 3);
    const Eigen::RowVector2d c4 = coefficients_.row(6 * i + 4);
    const Eigen::RowVector2d c5 = coefficients_.row(6 * i + 5);
    const double t = durations_[i];
    const double t2 = t * t;
    const double t3 = t2 * t;
    wrt_coefficients.row(6 * i + 3) += weight * t * (72.0 * c3 + 144.0 * t * c4 + 240.0 * t2 * c5);
    wrt_coefficients.row(6 * i + 4) += weight * t2 * (144.0 * c3 + 384.0 * t * c4 + 720.0 * t2 * c5);
    wrt_coefficients.row(6 * i + 5) += weight * t3 * (240.0 * c3 + 720.0 * t * c4 + 1440.0 * t2 * c5);
    const Eigen::RowVector2d jerk_end = 6.0 * c3 + 24.0 * t * c4 + 60.0 * t2 * c5;
    wrt_durations[i] += weight * jerk_end.squaredNorm();
  }
}

MincoGradient Minco::propagate(const Coefficients& wrt_coefficients, const Durations& wrt_durations) const {
  assert(wrt_coefficients.rows() == coefficients_.rows() && wrt_durations.size() == durations_.size());
  const int n = piece_count();
  Coefficients multipliers = wrt_coefficients;
  matrix_.solve_transposed_in_place(multipliers);

  MincoGradient gradient;
  gradient.waypoints.resize(2, n - 1);
  gradient.durations = wrt_durations;
  for (int i = 0; i < n; ++i) {
    const PieceCoefficients piece = coefficients_.middleRows<6>(6 * i);
    const EndRows end{durations_[i]};
    const Eigen::RowVector2d velocity = end.velocity * piece;
    const Eigen::RowVector2d acceleration = end.acceleration * piece;
    const Eigen::RowVector2d jerk = end.jerk * piece;
    // dJ/dT_i = dJ/dT_i at held C - < multipliers, dM/dT_i C >; each row of M C is differentiated in time.
    if (i + 1 < n) {
      const Eigen::RowVector2d snap = end.snap * piece;
      const Eigen::RowVector2d crackle = 120.0 * piece.row(5);
      const int row = 6 * i;
      gradient.waypoints.col(i) = multipliers.row(row + 5).transpose();
      gradient.durations[i] -= multipliers.row(row + 3).dot(snap) + multipliers.row(row + 4).dot(crackle) +
                               (multipliers.row(row + 5) + multipliers.row(row + 6)).dot(velocity) +
                               multipliers.row(row + 7).dot(acceleration) +
                               multipliers.row(row + 8).dot(jerk);
    } else {
      gradient.durations[i] -= multipliers.row(6 * n - 3).dot(velocity) +
                               multipliers.row(6 * n - 2).dot(acceleration) +
                               multipliers.row(6 * n - 1).dot(jerk);
    }
  }
  gradient.tail_position = multipliers.row(6 * n - 3).transpose();
  gradient.tail_velocity = multipliers.row(6 * n - 2).transpose();
  return gradient;
}

}  // namespace spf
