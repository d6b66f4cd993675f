// MINCO (eq. 5-8): of all curves through given waypoints at given durations, the one with the least jerk
// integral. It is the quintic spline with continuous derivatives up to the fourth; M(T) C = B(q) with M
// banded, solved in O(N). Gradients with respect to coefficients are propagated back to waypoints and
// durations through the same factors (adjoint). Frame: world.
#pragma once

#include <Eigen/Core>

#include "spf/math/banded_matrix.hpp"
#include "spf/trajectory/trajectory.hpp"

namespace spf {

/// Boundary states of a motion.
struct MincoEnds {
  FlatState head;
  FlatState tail;
};

/// Gradient of a cost with respect to what determines the motion.
struct MincoGradient {
  Eigen::Matrix<double, 2, Eigen::Dynamic, Eigen::ColMajor, 2, Trajectory::kMaxPieces>
      waypoints;  ///< a column each
  Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, Trajectory::kMaxPieces, 1> durations;
  Eigen::Vector2d tail_position = Eigen::Vector2d::Zero();
  Eigen::Vector2d tail_velocity = Eigen::Vector2d::Zero();
};

class Minco {
 public:
  static constexpr int kMaxPieces = Trajectory::kMaxPieces;
  /// Rows 6i..6i+5 are the coefficients of piece i in ascending powers of its local time. Fixed capacity.
  using Coefficients = Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor, 6 * kMaxPieces, 2>;
  using Durations = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, kMaxPieces, 1>;
  using WaypointsView = Eigen::Ref<const Eigen::Matrix2Xd>;
  using DurationsView = Eigen::Ref<const Eigen::VectorXd>;

  Minco();

  /// Determines the motion through waypoints (a column each, one fewer than durations) with 1 to kMaxPieces
  /// durations > 0 [s]. Durations so extreme that their powers under- or overflow give coefficients that are
  /// not finite, hence a cost that is not finite, which the optimiser takes as a step too long.
  void solve(const MincoEnds& ends, const WaypointsView& waypoints_world, const DurationsView& durations);

  [[nodiscard]] int piece_count() const { return static_cast<int>(durations_.size()); }
  [[nodiscard]] const Coefficients& coefficients() const { return coefficients_; }
  [[nodiscard]] const Durations& durations() const { return durations_; }
  [[nodiscard]] Trajectory trajectory(double start_time) const;

  /// Integral of |jerk|^2 over the motion [m^2/s^5].
  [[nodiscard]] double smoothness() const;
  /// Adds `weight` times the derivatives of the smoothness with respect to coefficients (durations fixed) and
  /// durations (coefficients fixed).
  void add_smoothness_gradient(double weight, Coefficients& wrt_coefficients, Durations& wrt_durations) const;

  /// Eq. 7-8. Turns the derivatives of a cost with respect to coefficients (durations fixed) and durations
  /// (coefficients fixed) into total derivatives with respect to waypoints, durations and the tail.
  [[nodiscard]] MincoGradient propagate(const Coefficients& wrt_coefficients,
                                        const Durations& wrt_durations) const;

 private:
  void fill_matrix();
  void fill_right_side(const MincoEnds& ends, const WaypointsView& waypoints_world);

  BandedMatrix<6, 6> matrix_;
  Coefficients coefficients_;
  Durations durations_;
};

}  // namespace spf
