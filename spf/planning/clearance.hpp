// The one clearance model: it accepts or rejects optimiser candidates, committed plans and braking
// trajectories alike, swept over time, against the static map, peers and moving obstacles (by the planner's
// DynamicModel). Frame: world.
#pragma once

#include <limits>
#include <vector>

#include "spf/field/probability_field.hpp"
#include "spf/planning/moving_disc.hpp"
#include "spf/planning/planner_parameters.hpp"
#include "spf/robot/drive.hpp"
#include "spf/robot/footprint.hpp"
#include "spf/robot/robot_parameters.hpp"
#include "spf/world/world_snapshot.hpp"

namespace spf {

enum class ConflictKind { none, static_map, peer, obstacle };

/// Result of a check. Clearances are beyond contact (or beyond the field's ellipse) and margins; below 0 =
/// too close.
struct ClearanceReport {
  ConflictKind kind = ConflictKind::none;                          ///< of the first conflict
  int id = -1;                                                     ///< peer or track in the first conflict
  double time = 0.0;                                               ///< [s] of the first conflict
  double clearance = 0.0;                                          ///< [m] then
  double min_clearance = std::numeric_limits<double>::infinity();  ///< [m] up to the first conflict
  [[nodiscard]] bool clear() const { return kind == ConflictKind::none; }
};

/// Region around an uncertain obstacle; points with Mahalanobis distance m < threshold are dangerous.
struct DangerRegion {
  int id = -1;
  ProbabilityField field;
  double threshold = 1.0;
};

/// Which peers are checked against.
enum class PeerSelection {
  all,       ///< the safety check of a committed plan
  yield_to,  ///< planning: peers that go first (spf/world/priority.hpp), and all that stopped, brake, arrived
             ///< or fell silent
};

/// What is checked, and how far. Times are absolute.
struct ClearanceWindow {
  double from = 0.0;          ///< [s]
  double static_until = 0.0;  ///< [s] end of the check against the map
  double moving_until = 0.0;  ///< [s] end of the check against peers and moving obstacles
  double margin_scale = 1.0;  ///< [1] factor on the margins; lower for a committed plan than for a new one
  const Trajectory* alternative = nullptr;  ///< what the robot would do otherwise (brake): to be as near
                                            ///< as that, yet without contact, is no conflict
  bool fields = true;                       ///< false: danger regions are ignored
};

class ClearanceModel {
 public:
  ClearanceModel(const PlannerParameters& planner, const RobotParameters& robot,
                 const FieldParameters& field);

  /// Takes in the surroundings; the snapshot must outlive the checks. Allocates only when there are more
  /// peers or obstacles than ever before.
  void prepare(const WorldSnapshot& world, double time, PeerSelection selection);

  /// Multiplies the threshold of every danger region by factor(id of the obstacle).
  template <class Factor>
  void widen_regions(Factor&& factor) {
    for (DangerRegion& region : regions_) region.threshold *= factor(region.id);
  }

  /// Steps along the trajectory as far as clearance and speeds allow, but at least kShortestStep. A start
  /// that is too close is accepted as long as that distance does not shrink.
  [[nodiscard]] ClearanceReport check(const Trajectory& trajectory, const ClearanceWindow& window) const;

  /// Distance to static surfaces beyond radius and margin [m], whatever the heading.
  [[nodiscard]] double static_clearance(const Eigen::Vector2d& position_world,
                                        double margin_scale = 1.0) const;
  /// Likewise beyond the robot's outline and margin, at a heading [rad].
  [[nodiscard]] double static_clearance(const Eigen::Vector2d& position_world, double heading,
                                        double margin_scale) const;
  /// Smallest clearance from the danger regions [m]; infinite without any.
  [[nodiscard]] double field_clearance(const Eigen::Vector2d& position_world) const;
  /// The danger region in which a position lies deepest, or else the nearest one; null without any.
  [[nodiscard]] const DangerRegion* nearest_region(const Eigen::Vector2d& position_world) const;
  /// Time until the trajectory has left all danger regions for good [s]: 0 when it enters none, until - from
  /// when it is in one at the end.
  [[nodiscard]] double time_in_fields(const Trajectory& trajectory, double from, double until) const;

  [[nodiscard]] const std::vector<MovingDisc>& discs() const { return discs_; }
  [[nodiscard]] const std::vector<DangerRegion>& regions() const { return regions_; }
  [[nodiscard]] const OccupancyMap& map() const { return *map_; }
  /// Margin to static surfaces beyond the radius [m]: as set, or the map's error where that is larger.
  [[nodiscard]] double static_margin() const { return static_margin_; }
  [[nodiscard]] double robot_radius() const { return robot_.radius; }  ///< [m]

  static constexpr double kShortestStep = 0.02;  ///< [s]

 private:
  void add_track(const ObstacleTrack& track, double time);
  void add_peer(const Peer& peer);

  PlannerParameters planner_;
  RobotParameters robot_;
  Footprint footprint_;
  FieldParameters field_;
  const OccupancyMap* map_ = nullptr;
  double static_margin_ = 0.0;  // [m]
  std::vector<MovingDisc> discs_;
  std::vector<DangerRegion> regions_;
};

/// Largest values along a trajectory relative to the dynamic limits [1], sampled 10 times a piece.
struct LimitReport {
  double speed = 0.0;         ///< of max_speed
  double acceleration = 0.0;  ///< of max_acceleration
  double wheel_speed = 0.0;   ///< of max_wheel_speed, position and heading together
};
[[nodiscard]] LimitReport check_limits(const Trajectory& trajectory, const RobotParameters& robot,
                                       const Drive& drive);

/// The fastest turn to `target_heading` that keeps the wheels within their limits along the trajectory's
/// motion: the yaw rate is lowered until it fits, at worst until only the present turn is stopped.
[[nodiscard]] HeadingProfile fitted_heading(const Trajectory& trajectory, const HeadingState& heading,
                                            double target_heading, const RobotParameters& robot,
                                            const Drive& drive);

}  // namespace spf
