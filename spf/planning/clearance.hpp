// The one clearance model: optimiser candidates, committed plans and braking trajectories are all accepted or
// refused here, swept over time, against the static map, peers and moving obstacles (by the planner's
// DynamicModel). Frame: world.
#pragma once

#include <limits>
#include <vector>

#include "spf/field/probability_field.hpp"
#include "spf/planning/moving_disc.hpp"
#include "spf/planning/planner_parameters.hpp"
#include "spf/robot/omni_kinematics.hpp"
#include "spf/robot/robot_parameters.hpp"
#include "spf/world/world_snapshot.hpp"

namespace spf {

enum class ConflictKind { none, static_map, peer, obstacle };

/// What a check found. Clearances are beyond contact (or beyond the field's ellipse), margins included: below
/// 0 = too close.
struct ClearanceReport {
  ConflictKind kind = ConflictKind::none;                          ///< of the first conflict
  int id = -1;                                                     ///< peer or track in the first conflict
  double time = 0.0;                                               ///< [s] of the first conflict
  double clearance = 0.0;                                          ///< [m] then
  double min_clearance = std::numeric_limits<double>::infinity();  ///< [m] up to the first conflict
  [[nodiscard]] bool clear() const { return kind == ConflictKind::none; }
};

/// Region around an uncertain obstacle, where m < threshold is dangerous.
struct DangerRegion {
  int id = -1;
  ProbabilityField field;
  double threshold = 1.0;
};

/// Which peers count.
enum class PeerSelection {
  all,       ///< the safety check of a committed plan
  yield_to,  ///< planning: those who go first (spf/world/priority.hpp), and all that stopped, brake, arrived
             ///< or fell silent
};

/// What is checked, and how far. Times are absolute.
struct ClearanceWindow {
  double from = 0.0;          ///< [s]
  double static_until = 0.0;  ///< [s] end of the check against the map
  double moving_until = 0.0;  ///< [s] end of the check against what moves
  double margin_scale = 1.0;  ///< [1] of the margins; a committed plan is checked with less than a new one
  const Trajectory* alternative = nullptr;  ///< what the robot would do otherwise (brake): being as near to
                                            ///< things as that, yet without contact, is no conflict
  bool fields = true;                       ///< false: danger regions do not count
};

class ClearanceModel {
 public:
  ClearanceModel(const PlannerParameters& planner, const RobotParameters& robot,
                 const FieldParameters& field);

  /// Takes over the surroundings; the snapshot must live while checks are made. Allocates only when more
  /// peers or obstacles appear than ever before.
  void prepare(const WorldSnapshot& world, double time, PeerSelection selection);

  /// Multiplies the threshold of every danger region by factor(id of the obstacle).
  template <class Factor>
  void widen_regions(Factor&& factor) {
    for (DangerRegion& region : regions_) region.threshold *= factor(region.id);
  }

  /// Steps along the trajectory no farther than clearance and speeds allow (and not below kShortestStep). A
  /// start that is too close is accepted as long as that distance does not shrink.
  [[nodiscard]] ClearanceReport check(const Trajectory& trajectory, const ClearanceWindow& window) const;

  /// Distance to static surfaces beyond radius and margin [m].
  [[nodiscard]] double static_clearance(const Eigen::Vector2d& position_world,
                                        double margin_scale = 1.0) const;
  /// Smallest clearance from the danger regions [m]; infinite without any.
  [[nodiscard]] double field_clearance(const Eigen::Vector2d& position_world) const;
  /// The danger region that a place lies deepest in, or is nearest to; null without any.
  [[nodiscard]] const DangerRegion* nearest_region(const Eigen::Vector2d& position_world) const;
  /// Time until the trajectory is out of every danger region for good [s]: 0 when it never is in one,
  /// until - from when it is in one to the end.
  [[nodiscard]] double time_in_fields(const Trajectory& trajectory, double from, double until) const;

  [[nodiscard]] const std::vector<MovingDisc>& discs() const { return discs_; }
  [[nodiscard]] const std::vector<DangerRegion>& regions() const { return regions_; }
  [[nodiscard]] const OccupancyMap& map() const { return *map_; }
  /// Kept from static surfaces beyond the radius [m]: as set, or the map's error where that is larger.
  [[nodiscard]] double static_margin() const { return static_margin_; }
  [[nodiscard]] double robot_radius() const { return robot_.radius; }  ///< [m]

  static constexpr double kShortestStep = 0.02;  ///< [s]

 private:
  void add_track(const ObstacleTrack& track, double time);
  void add_peer(const Peer& peer);

  PlannerParameters planner_;
  RobotParameters robot_;
  FieldParameters field_;
  const OccupancyMap* map_ = nullptr;
  double static_margin_ = 0.0;  // [m]
  std::vector<MovingDisc> discs_;
  std::vector<DangerRegion> regions_;
};

/// Dynamic limits along a trajectory, sampled 10 times a piece: the largest values relative to the limits
/// [1].
struct LimitReport {
  double speed = 0.0;         ///< of max_speed
  double acceleration = 0.0;  ///< of max_acceleration
  double wheel_speed = 0.0;   ///< of max_wheel_speed, position and heading together
};
[[nodiscard]] LimitReport check_limits(const Trajectory& trajectory, const RobotParameters& robot,
                                       const OmniKinematics& kinematics);

/// The fastest turn to `target_heading` that keeps the wheels within their limits along the trajectory's
/// motion: the yaw rate is lowered until it fits, in the worst case to a mere stop of the present turn.
[[nodiscard]] HeadingProfile fitted_heading(const Trajectory& trajectory, const HeadingState& heading,
                                            double target_heading, const RobotParameters& robot,
                                            const OmniKinematics& kinematics);

}  // namespace spf
