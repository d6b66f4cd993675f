// Guide pairs of static obstacles: where a trajectory runs through one, a path search finds a detour, and
// each node in the obstacle gets a half plane whose border touches the surface on the side of the detour.
// Frame: world.
#pragma once

#include <Eigen/Core>

#include <vector>

#include "spf/planning/clearance.hpp"
#include "spf/planning/costs/guide_pair.hpp"
#include "spf/planning/costs/node_set.hpp"

namespace spf {

/// Reference to a path search between two free positions: fills a polyline from `from` to `to` that keeps the
/// static clearance; false when there is none.
class PathSearchRef {
 public:
  template <class Search>
  explicit PathSearchRef(Search& search)
      : object_{&search},
        find_{[](void* object, const Eigen::Vector2d& from, const Eigen::Vector2d& to,
                 std::vector<Eigen::Vector2d>& path) {
          return (*static_cast<Search*>(object))(from, to, path);
        }} {}
  bool operator()(const Eigen::Vector2d& from, const Eigen::Vector2d& to,
                  std::vector<Eigen::Vector2d>& path) const {
    return find_(object_, from, to, path);
  }

 private:
  void* object_;
  bool (*find_)(void*, const Eigen::Vector2d&, const Eigen::Vector2d&, std::vector<Eigen::Vector2d>&);
};

class GuidePairFinder {
 public:
  enum class Outcome {
    clear,    ///< no collision
    added,    ///< pairs were appended
    blocked,  ///< the tail lies in an obstacle, or there is no detour around one
  };

  explicit GuidePairFinder(int max_nodes);

  /// Checks the curve through the nodes densely (cubic between neighbours, whose error is far below the
  /// margin), and appends pairs for every stretch in collision. A stretch that is still inside at the end is
  /// a collision, too.
  Outcome find(const ClearanceModel& model, const NodeSet& nodes, PathSearchRef search,
               std::vector<GuidePair>& pairs);

  /// Whether a node lies in an obstacle for which it has no pair: the run must be cut short ("rebound").
  [[nodiscard]] static bool new_collision(const ClearanceModel& model, const NodeSet& nodes,
                                          const std::vector<GuidePair>& pairs);

  [[nodiscard]] int searches() const { return searches_; }
  void reset_searches() { searches_ = 0; }

 private:
  /// Free nodes before and after a stretch in collision (`first` may be in collision when it is the head).
  struct Stretch {
    int first;
    int last;
  };
  [[nodiscard]] bool collect_stretches(const ClearanceModel& model, const NodeSet& nodes);
  [[nodiscard]] bool add_pairs(const ClearanceModel& model, const NodeSet& nodes, const Stretch& stretch,
                               std::vector<GuidePair>& pairs);
  [[nodiscard]] bool pair_at(const ClearanceModel& model, const Eigen::Vector2d& position,
                             const Eigen::Vector2d& tangent, GuidePair& pair) const;

  std::vector<Stretch> stretches_;
  std::vector<Eigen::Vector2d> path_;
  int searches_ = 0;
};

}  // namespace spf
