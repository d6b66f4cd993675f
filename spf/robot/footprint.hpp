// The robot's outline: a disc, or a convex polygon that turns with the body. A polygon is covered by
// discs that lie within it, so that its distance from anything is that of its discs: a map, which knows the
// distances of points, needs nothing else. Frame: body, with the robot's centre at the
// origin.
#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "spf/math/convex_polygon.hpp"
#include "spf/robot/robot_parameters.hpp"

namespace spf {

/// A value. Queries never throw or allocate.
class Footprint {
 public:
  static constexpr std::size_t kMostCorners = ConvexPolygon::kMostCorners;

  /// Throws std::invalid_argument with footprint_problem(robot) when there is one.
  explicit Footprint(const RobotParameters& robot);

  [[nodiscard]] bool is_disc() const { return corners_.empty(); }
  /// Counterclockwise [m]; none of a disc.
  [[nodiscard]] const std::vector<Eigen::Vector2d>& corners() const { return corners_; }
  /// The corners with the centre at `position` and a heading [rad], in the frame of these. Not of a disc.
  [[nodiscard]] ConvexPolygon placed(const Eigen::Vector2d& position, double heading) const;
  /// Of the largest disc around the centre within the outline [m]: what is nearer is hit whatever the
  /// heading.
  [[nodiscard]] double inscribed_radius() const { return inscribed_; }
  /// Of the smallest disc around the centre that holds the outline [m]: what is farther is never hit.
  [[nodiscard]] double circumscribed_radius() const { return circumscribed_; }
  /// What it needs to either side of a straight path that it drives along its heading [m].
  [[nodiscard]] double half_width() const { return half_width_; }
  /// From a point to the outline [m], negative inside.
  [[nodiscard]] double distance_to(const Eigen::Vector2d& point_body) const;

  /// The least distance [m] from the outline to what `distance(point)` tells distances of points to, with the
  /// outline's centre at `position` and its heading given by its unit vector. Too little by
  /// cover_error() at most. Not exact from `enough` on, and where the surface is within the inscribed disc,
  /// of which the depth is told. `distance` must change by no more than the point moves.
  template <class Distance>
  [[nodiscard]] double clearance(const Eigen::Vector2d& position, const Eigen::Vector2d& ahead, double enough,
                                 const Distance& distance) const {
    const double centre = distance(position);
    if (is_disc() || centre >= circumscribed_ + enough) return centre - circumscribed_;
    double least = centre - inscribed_;
    if (least <= 0.0) return least;
    least = std::min(least, enough);
    for (const Disc& disc : cover_) {
      if (centre - disc.reach >= least) break;  // they are ordered by that
      const Eigen::Vector2d offset{ahead.x() * disc.centre.x() - ahead.y() * disc.centre.y(),
                                   ahead.y() * disc.centre.x() + ahead.x() * disc.centre.y()};
      least = std::min(least, distance(Eigen::Vector2d{position + offset}) - disc.radius);
    }
    return least;
  }
  /// How far the discs of the cover reach beyond the outline [m]: a fiftieth of the radius of the largest
  /// disc within it.
  [[nodiscard]] double cover_error() const { return cover_error_; }

 private:
  /// Part of the cover.
  struct Disc {
    Eigen::Vector2d centre;  // [m]
    double radius;           // [m]
    double reach;            // [m] from the body's centre to its farthest point
  };
  void cover();

  std::vector<Eigen::Vector2d> corners_;
  double inscribed_;
  double circumscribed_;
  double half_width_;
  double cover_error_ = 0.0;
  std::vector<Disc> cover_;  // by falling reach
};

/// Why the robot's outline is none, as a sentence that begins with the parameter's name; empty when it is
/// one: a convex polygon of three to kMostCorners corners around the centre. Whether `radius` fits to it is
/// not asked.
[[nodiscard]] std::string footprint_problem(const RobotParameters& robot);

/// Whether the robot's outline is a polygon.
[[nodiscard]] inline bool has_corners(const RobotParameters& robot) {
  return robot.length > 0.0 || robot.width > 0.0 || !robot.footprint.empty();
}

/// The robot with the radius of the disc around its outline; as it is when that is a disc. Throws as
/// Footprint does.
[[nodiscard]] RobotParameters with_radius_of_footprint(RobotParameters robot);

}  // namespace spf
