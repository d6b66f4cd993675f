// Static surroundings: a grid of occupied cells with a truncated distance field over it. Known shapes enter
// with their exact distance, sensed cells with their hit point. One clearance model for search, optimiser and
// checker: all of them use distance(). Frame: world.
#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "spf/math/pose2.hpp"
#include "spf/world/grid_frame.hpp"
#include "spf/world/observation.hpp"
#include "spf/world/sensed_layer.hpp"

namespace spf {

/// A disc whose scan returns are not entered as static, since a tracked obstacle or a peer causes them.
struct MaskedDisc {
  Eigen::Vector2d position_world = Eigen::Vector2d::Zero();
  double radius = 0.0;
};

/// A value. Copies share the layer of known shapes until one of them adds a shape (hence the shared_ptr to
/// const: a fleet of 1000 robots on a map of 10 MB would otherwise hold 10 GB of the same numbers); the
/// sensed layer is every copy's own. Make one map with the known shapes and copy it to every robot.
class OccupancyMap {
 public:
  /// Distances are exact up to max_distance [m] and read max_distance beyond. Throws std::invalid_argument on
  /// an empty frame or one of more than 2^26 nodes, or a max_distance that is not positive.
  OccupancyMap(const GridFrame& frame, double max_distance);

  // Known shapes: exact distance at the nodes, negative inside; each costs only the nodes within max_distance
  // of it. Throw std::invalid_argument on numbers that are not finite, an empty rectangle, a negative radius
  // or fewer than three corners.
  void add_box(const Eigen::Vector2d& low, const Eigen::Vector2d& high);
  void add_disc(const Eigen::Vector2d& centre, double radius);
  /// The robot's world ends at these lines: outside counts as inside a wall.
  void add_border(const Eigen::Vector2d& low, const Eigen::Vector2d& high);
  /// A simple polygon of three corners or more; inside, at most max_distance deep.
  void add_polygon(const std::vector<Eigen::Vector2d>& corners);
  // Likewise of rectangles in a frame that is turned and lies somewhere in the world.
  void add_box(const Eigen::Vector2d& low, const Eigen::Vector2d& high, const Pose2& frame_world);
  void add_border(const Eigen::Vector2d& low, const Eigen::Vector2d& high, const Pose2& frame_world);

  /// Takes over what was sensed in the map that this one replaces, in place of what was sensed in this one.
  /// A position that is p there is turned by `moved` and then shifted by it: it is that frame's pose here.
  /// What is known here already is left out. On the same grid, unmoved, nothing is lost; elsewhere free cells
  /// are.
  void take_over_sensed(const OccupancyMap& before, const Pose2& moved = {});

  /// From here on a position is unknown until a beam has crossed it: there may be anything. Without this call
  /// the known shapes are all there is.
  void mark_unexplored() { unexplored_ = true; }

  /// Enters one sweep of the range sensor taken at `sensor_pose_world`: cells crossed by beams become free,
  /// cells with returns occupied (log odds), unless the return lies in a masked disc or within half a cell of
  /// a known shape. Ranges that are NaN, -infinity or not positive are skipped; +infinity, or beyond
  /// max_range, is "no return". Time is bounded for any sweep: beams are followed across the grid at most,
  /// and less far where all of them together would cross more than 2 * 10^7 cells. A sweep of more than
  /// kMostBeams, from a position farther from the grid than the grid is long, or with numbers that are not
  /// finite, is ignored. `kept_out`: a flag per beam, set where the return must not become an occupied cell;
  /// null = none is set.
  void integrate(const RangeScan& scan, const Pose2& sensor_pose_world, const std::vector<MaskedDisc>& masked,
                 const std::vector<std::uint8_t>* kept_out = nullptr);

  /// Distance from a point to the nearest static surface [m], bilinear between nodes, negative inside known
  /// shapes, at most max_distance(). Outside the grid: the value at the nearest point of the grid. Beside a
  /// corner or a hit point at distance d the interpolation reads up to resolution^2 / (4 d) too much. NaN
  /// reads as the origin.
  [[nodiscard]] double distance(const Eigen::Vector2d& position_world) const;
  /// Likewise, but also between two surfaces, where interpolation reads up to half a cell too little: there
  /// the distances to both sides are continued from the nodes on either side. Slower; of use where a passage
  /// may be just wide enough. Errors are a twentieth of a cell; not continuous.
  [[nodiscard]] double exact_distance(const Eigen::Vector2d& position_world) const;
  /// distance() from the known shapes alone, without what was sensed.
  [[nodiscard]] double known_distance(const Eigen::Vector2d& position_world) const;
  /// Gradient of that interpolation [1]: points away from the surface; zero where truncated.
  [[nodiscard]] Eigen::Vector2d distance_gradient(const Eigen::Vector2d& position_world) const;
  /// Distance at a node without interpolation; (i, j) inside the frame.
  [[nodiscard]] double node_distance(int i, int j) const {
    const float known = known_node_distance(i, j);
    return sensed_ ? std::min(known, sensed_->distance(i, j)) : known;
  }
  /// Position of a node [m].
  [[nodiscard]] Eigen::Vector2d node_position(int i, int j) const { return frame_.node_position(i, j); }
  /// Nearest node, clamped to the frame.
  [[nodiscard]] Eigen::Vector2i nearest_node(const Eigen::Vector2d& position_world) const {
    return frame_.nearest_node(position_world);
  }

  /// Whether every position of the segment from a to b keeps this distance [m]. Long free stretches cost one
  /// look-up each (sphere tracing); near surfaces it looks every quarter of a cell, so it can miss a dip of
  /// an eighth of a cell. Stops at the first position that is too near.
  [[nodiscard]] bool segment_clear(const Eigen::Vector2d& a, const Eigen::Vector2d& b,
                                   double clearance) const;

  [[nodiscard]] const GridFrame& frame() const { return frame_; }
  [[nodiscard]] double max_distance() const { return max_distance_; }
  /// How much nearer than distance() a surface may be [m]: an eighth of a cell once a sweep was entered,
  /// since a cell keeps in which of its 4 x 4 parts beams have ended; 0 where all shapes are known.
  [[nodiscard]] double surface_error() const { return sensed_ ? sensed_->error() : 0.0; }
  /// Whether sweeps have been entered: the map may then change at any time.
  [[nodiscard]] bool sensed() const { return sensed_.has_value(); }
  /// The margin to keep by distance() so that the `wanted` one [m] is kept: `wanted`, but at least
  /// surface_error().
  [[nodiscard]] double margin(double wanted) const { return std::max(wanted, surface_error()); }
  /// Grows whenever any distance changes: cached paths compare it.
  [[nodiscard]] std::uint64_t revision() const { return revision_; }
  /// Whether beams have shown a point's cell and its neighbours to be free: a return there is of something
  /// that has moved there.
  [[nodiscard]] bool seen_free(const Eigen::Vector2d& position_world) const {
    if (!sensed_) return false;
    const Eigen::Vector2i node = nearest_node(position_world);
    return sensed_->free_around(node.x(), node.y());
  }
  [[nodiscard]] bool unexplored() const { return unexplored_; }
  /// Whether nothing static can be at a position for all that is known: in an unexplored map a beam has
  /// crossed a cell within `reach` [m] of it, and not even a single return came from there; elsewhere always,
  /// since there distance() tells.
  [[nodiscard]] bool explored_free(const Eigen::Vector2d& position_world, double reach) const;
  /// Hit points of the sensed occupied cells: for display [m].
  [[nodiscard]] std::vector<Eigen::Vector2d> occupied_points() const;

 private:
  struct Patch;
  struct Surroundings;
  template <class NodeValue>
  [[nodiscard]] Patch patch_of(const Eigen::Vector2d& position_world, const NodeValue& node_value) const;
  [[nodiscard]] Surroundings surroundings_of(const Patch& patch) const;
  [[nodiscard]] std::shared_ptr<std::vector<float>> writable_layer() const;
  template <class SignedDistance>
  void add_shape(const Eigen::Vector2i& low, const Eigen::Vector2i& high,
                 const SignedDistance& signed_distance);
  [[nodiscard]] float known_node_distance(int i, int j) const {
    const std::size_t slot =
        static_cast<std::size_t>(j) * static_cast<std::size_t>(frame_.width) + static_cast<std::size_t>(i);
    return known_ ? (*known_)[slot] : static_cast<float>(max_distance_);
  }
  [[nodiscard]] bool on_known_surface(const Eigen::Vector2d& position_world) const;
  [[nodiscard]] double reach_of(const RangeScan& scan) const;
  void collect_beams(const RangeScan& scan, const Pose2& sensor_pose_world, double reach,
                     const std::vector<MaskedDisc>& masked, const std::vector<std::uint8_t>* kept_out);

  GridFrame frame_;
  double max_distance_;
  bool unexplored_ = false;
  std::uint64_t revision_ = 0;
  std::shared_ptr<const std::vector<float>> known_;  // [m] of known shapes per node, null = none; see above
  std::optional<SensedLayer> sensed_;                // since the first sweep
  std::vector<SensedBeam> beams_;                    // of the current sweep, kept for its capacity
};

}  // namespace spf
