// Safety probability field of one moving obstacle (eq. 1-4): an elliptic Gaussian, stretched along the
// obstacle's velocity and shifted ahead of it, for the centre of a disc-shaped robot. Frames: world; field
// (origin at the centre, x along the velocity). All arguments and results in world.
#pragma once

#include <Eigen/Core>

#include "spf/field/field_parameters.hpp"
#include "spf/world/obstacle_state.hpp"

namespace spf {

/// Contour of equal risk, for drawing.
struct FieldEllipse {
  Eigen::Vector2d center_world = Eigen::Vector2d::Zero();  ///< [m]
  Eigen::Vector2d half_axes = Eigen::Vector2d::Zero();     ///< [m] along and across the velocity
  double heading = 0.0;                                    ///< [rad] of the long axis, (-pi, pi]
};

/// Immutable value: build once per obstacle and replan, query often. Queries never allocate.
class ProbabilityField {
 public:
  ProbabilityField() = default;
  /// Half axes a = r + speed * stretch_time / 2 and b = r (below eq. 3), where r is the obstacle's radius
  /// plus the robot's, since the field is evaluated at the robot's centre. It contains no margin (that is
  /// d_saf of eq. 10). A resting obstacle gives a round field, for which the missing direction does not
  /// matter. Requires r > 0.
  ProbabilityField(const ObstacleState& obstacle, double robot_radius, const FieldParameters& parameters);

  /// Probability density U of eq. 1 [1/m^2].
  [[nodiscard]] double density(const Eigen::Vector2d& position_world) const;
  /// dU/dp of eq. 4 [1/m^3]; points towards the centre.
  [[nodiscard]] Eigen::Vector2d density_gradient(const Eigen::Vector2d& position_world) const;

  /// Mahalanobis distance from the centre: 0 there, 1 on the ellipse with half axes a and b [1].
  [[nodiscard]] double mahalanobis(const Eigen::Vector2d& position_world) const;
  /// Density divided by its peak, exp(-m^2 / 2), in [0, 1]. Thresholds use this or m, never U: the peak of U
  /// falls with speed and size, so a bound on U would overlook exactly the fast and the large obstacles
  /// (paper_notes 2).
  [[nodiscard]] double risk(const Eigen::Vector2d& position_world) const;

  /// Smallest Mahalanobis distance whose ellipse holds the (robot-grown) disc of the obstacle both now and
  /// after stretch_time, times threshold_scale: the default limit of danger. At m = 1 both discs stick out at
  /// the sides.
  [[nodiscard]] double threshold() const { return threshold_; }

  /// Unit vector along which the density falls fastest (eq. 11). At the centre, where eq. 11 is undefined,
  /// the side of the velocity to which `preferred_side_world` points (any vector; left of the velocity when
  /// it favours neither).
  [[nodiscard]] Eigen::Vector2d escape_direction(const Eigen::Vector2d& position_world,
                                                 const Eigen::Vector2d& preferred_side_world) const;

  /// Where a ray from a point inside the ellipse `mahalanobis` leaves it; a point outside is returned as it
  /// is. `direction_world` is a unit vector.
  [[nodiscard]] Eigen::Vector2d guide_point(const Eigen::Vector2d& position_world,
                                            const Eigen::Vector2d& direction_world, double mahalanobis) const;

  /// Signed clearance from the ellipse `threshold` [m]: negative inside; never more than the true distance
  /// outside. It changes by at most the distance moved, so a check may advance by as much.
  [[nodiscard]] double clearance(const Eigen::Vector2d& position_world, double threshold) const;

  [[nodiscard]] FieldEllipse ellipse(double mahalanobis) const;
  [[nodiscard]] const Eigen::Vector2d& center_world() const { return center_world_; }
  [[nodiscard]] const Eigen::Vector2d& axis_world() const { return axis_world_; }
  [[nodiscard]] double half_axis_along() const { return along_; }
  [[nodiscard]] double half_axis_across() const { return across_; }

 private:
  Eigen::Vector2d center_world_ = Eigen::Vector2d::Zero();  // [m] eq. 2
  Eigen::Vector2d axis_world_ =
      Eigen::Vector2d::UnitX();  // unit, along the velocity: first column of R, eq. 3
  Eigen::Matrix2d precision_world_ = Eigen::Matrix2d::Identity();  // [1/m^2] inverse of Sigma, eq. 3
  double along_ = 1.0;                                             // [m] a
  double across_ = 1.0;                                            // [m] b
  double peak_density_ = 0.0;                                      // [1/m^2] 1 / (2 pi a b)
  double threshold_ = 1.0;                                         // [1]
};

}  // namespace spf
