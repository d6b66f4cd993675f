// Guide points of uncertain moving obstacles (eq. 10-11, Fig. 4): which nodes are in danger, which side to
// pass on, and the memory of sides that keeps the robot from dithering. Frame: world.
#pragma once

#include <Eigen/Core>

#include <vector>

#include "spf/planning/clearance.hpp"
#include "spf/planning/costs/guide_pair.hpp"
#include "spf/planning/costs/node_set.hpp"

namespace spf {

/// Passing side, as seen along the robot's path through the field.
enum class PassingSide { right = -1, left = 1 };

/// One obstacle whose field the trajectory enters.
struct FieldConflict {
  int region = 0;                                         ///< index among the danger regions
  int first = 0;                                          ///< first and last dangerous node
  int last = 0;                                           ///<
  Eigen::Vector2d along = Eigen::Vector2d::UnitX();       ///< unit, entry to exit: line of symmetry of Fig. 4
  Eigen::Vector2d entry_world = Eigen::Vector2d::Zero();  ///< [m] the line passes through it
  PassingSide natural = PassingSide::left;                ///< to which the gradients of the field point
};

/// Which side each region is passed on; by index of the region.
struct SideChoice {
  bool decided = false;
  PassingSide side = PassingSide::left;
  Eigen::Vector2d along = Eigen::Vector2d::UnitX();
  Eigen::Vector2d entry_world = Eigen::Vector2d::Zero();
};

class FieldGuidance {
 public:
  /// `safety_distance`: d_saf of eq. 10. `least_lateral_share`: sine of the least angle between a guide
  /// direction and the line of symmetry. A direction along the line would favour no side, and a point on the
  /// obstacle's axis would never leave it (paper_notes 37).
  FieldGuidance(double safety_distance, double least_lateral_share);

  /// Conflicts of the nodes 1 .. last_node, once per region, in the order of their first node.
  void find_conflicts(const std::vector<DangerRegion>& regions, const NodeSet& nodes, int last_node,
                      const FlatState& head, std::vector<FieldConflict>& conflicts) const;

  /// Gives every node of 1 .. last_node in a region, or nearer than d_saf to it, its guide pair; an older
  /// pair of the same node and obstacle is replaced. Guide points in closed form, mirrored at the line of
  /// symmetry together with their directions where the chosen side requires it. A region without a chosen
  /// side is passed where its gradients point.
  void add_pairs(const std::vector<DangerRegion>& regions, const NodeSet& nodes, int last_node,
                 const FlatState& head, std::vector<SideChoice>& sides, std::vector<GuidePair>& pairs) const;

  /// Side taken last time, if remembered: +1 left, -1 right, 0 unknown.
  [[nodiscard]] int remembered_side(int track_id, double time) const;
  /// Records the side of a committed plan.
  void remember(int track_id, PassingSide side, double time);
  /// Side changes of one obstacle within the last seconds.
  [[nodiscard]] int side_changes(int track_id, double time) const;
  /// Factor on the threshold, above 1 after repeated side changes (the paper's engineering setting).
  [[nodiscard]] double widening(int track_id, double time) const;

 private:
  static constexpr int kMaxChanges = 8;
  struct Memory {
    int track_id = -1;
    PassingSide side = PassingSide::left;
    double time = 0.0;                 // [s] of the last remember()
    double changes[kMaxChanges] = {};  // [s] ring of the latest changes
    int change_count = 0;
  };
  [[nodiscard]] const Memory* find(int track_id) const;
  [[nodiscard]] static Eigen::Vector2d side_of(const SideChoice& choice);
  [[nodiscard]] GuidePair inner_pair(const DangerRegion& region, const Eigen::Vector2d& position,
                                     const SideChoice& choice) const;
  [[nodiscard]] GuidePair rim_pair(const DangerRegion& region, const Eigen::Vector2d& position,
                                   double clearance) const;
  [[nodiscard]] FieldConflict conflict_of(const DangerRegion& region, int index, const NodeSet& nodes,
                                          int first, int last, const FlatState& head) const;

  double safety_distance_;
  double least_lateral_share_;
  std::vector<Memory> memory_;
};

}  // namespace spf
