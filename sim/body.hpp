// Robots with corners, as they really are: a convex polygon at a pose, and its motion over one step. Frame:
// world [m].
#pragma once

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <optional>

#include "sim/contact.hpp"
#include "spf/robot/footprint.hpp"

namespace spf::sim {

/// A convex polygon at a pose. Distances are 0 where they touch or overlap.
class PlacedPolygon {
 public:
  /// A disc has no corners: its outline must have.
  PlacedPolygon(const Footprint& outline, const Eigen::Vector2d& position, double heading);
  explicit PlacedPolygon(const Box& box);

  [[nodiscard]] bool holds(const Eigen::Vector2d& point) const;
  [[nodiscard]] double distance_to(const Eigen::Vector2d& point) const;
  [[nodiscard]] double distance_to(const Segment& segment) const;
  [[nodiscard]] double distance_to(const PlacedPolygon& other) const;
  /// Its least depth inside a border; negative where it is beyond.
  [[nodiscard]] double depth_in(const Box& border) const;

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] const Eigen::Vector2d& corner(std::size_t i) const { return corners_[i]; }
  [[nodiscard]] Segment side(std::size_t i) const {
    return {corners_[i], corners_[i + 1 < size_ ? i + 1 : 0]};
  }

 private:
  std::array<Eigen::Vector2d, Footprint::kMostCorners> corners_;  // counterclockwise
  std::size_t size_;
};

/// A robot with corners over one step: its centre moves along a line while it turns evenly.
struct BodyMotion {
  const Footprint* outline;
  Motion centre;
  double heading;  ///< [rad] at the beginning
  double turn;     ///< [rad] over the step

  [[nodiscard]] PlacedPolygon at(double share) const {
    return {*outline, centre.at(share), heading + share * turn};
  }
  /// No point of it moves farther over the step [m].
  [[nodiscard]] double reach() const {
    return (centre.to - centre.from).norm() + outline->circumscribed_radius() * std::abs(turn);
  }
};

/// The share of a step at which a distance first comes to nothing: `distance(share)` falls by no more than
/// `fastest` [m] times the share. Exact to a micrometre.
template <class Distance>
[[nodiscard]] std::optional<double> first_touch(double fastest, const Distance& distance) {
  constexpr double kTouch = 1e-6;  // [m]
  double share = 0.0;
  while (true) {
    const double left = distance(share);
    if (left <= kTouch) return share;
    if (share >= 1.0 || !(fastest > 0.0)) return std::nullopt;
    share = std::min(1.0, share + left / fastest);
  }
}

}  // namespace spf::sim
