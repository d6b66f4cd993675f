// Cost-to-go [m]: the length of the shortest path around static obstacles to the goal, from any position. A
// wavefront from the goal assigns to every node of a coarse grid its parent: the next corner on the path to
// the goal, which is in line of sight (lazy Theta*, any-angle). The cost at a position is the distance to a
// parent plus the parent's cost: an exact length, not a sum of grid steps. Frame: world.
#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <optional>
#include <vector>

#include "spf/math/parameters.hpp"
#include "spf/world/occupancy_map.hpp"

namespace spf {

struct CostToGoParameters {
  double clearance = 0.15;      ///< [m] distance to static surfaces that paths keep beyond the robot's radius
  double resolution = 0.2;      ///< [m] spacing of nodes, at most 1.4 times the distance kept is used;
                                ///< passages narrower than twice that + this may be missed
  double window_margin = 10.0;  ///< [m] the wavefront first stays this close to the box around robot and goal

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit("clearance", self.clearance, kMetresBySize, Range{0.0, 20.0},
          "distance to static surfaces that the global path keeps beyond the robot's radius");
    visit("resolution", self.resolution, kMetresBySize, Range{0.005, 5.0},
          "spacing of the nodes of the global path's search");
  }

  /// No settings, but they follow the robot.
  template <class Self, class Visitor>
  static void visit_constants(Self& self, Visitor&& visit) {
    visit(self.window_margin, Scale::stopping_distance, Range{0.0, 1000.0});
  }
};

enum class CostToGoOutcome {
  reachable,    ///< a path leads from the robot to the goal
  goal_moved,   ///< likewise, but to goal_used(), the nearest free position to a goal on blocked ground
  unreachable,  ///< no path; the cost-to-go then charges blocked ground several times over and still leads to
                ///< the goal
  no_free_goal,  ///< no free position near the goal at all (or numbers not finite): no cost-to-go
};

class CostToGo {
 public:
  /// For a robot of this radius [m]; without one for a point. Throws std::invalid_argument on parameters out
  /// of range.
  explicit CostToGo(const CostToGoParameters& parameters, double robot_radius = 0.0);

  /// Propagates from the goal far enough for a robot at `robot_world`. The wavefront's working memory (some
  /// 30 bytes a node) is kept from run to run when the map is being sensed, since the next update comes soon,
  /// and freed when all of the map is known; what remains is 2 bytes a node and 16 for every distinct parent.
  CostToGoOutcome update(const OccupancyMap& map, const Eigen::Vector2d& goal_world,
                         const Eigen::Vector2d& robot_world);
  /// Whether update() with these arguments could change anything: new goal, changed map, robot out of the
  /// window.
  [[nodiscard]] bool outdated(const OccupancyMap& map, const Eigen::Vector2d& goal_world,
                              const Eigen::Vector2d& robot_world) const;

  [[nodiscard]] bool ready() const { return !parents_.empty(); }
  [[nodiscard]] CostToGoOutcome outcome() const { return outcome_; }

  // The following require ready(); none allocates (except to grow shortest_path()'s argument).
  /// Length of the shortest path to goal_used() [m]. Continuous; exactly the straight distance where the goal
  /// is in line of sight.
  [[nodiscard]] double cost_to_go(const Eigen::Vector2d& position_world) const;
  /// Gradient of cost_to_go [1], which points away from the goal; length about 1 on free ground.
  [[nodiscard]] Eigen::Vector2d cost_gradient(const Eigen::Vector2d& position_world) const;
  /// Unit vector of steepest descent: towards the corner ahead, on blocked ground also out of it; zero at the
  /// goal.
  [[nodiscard]] Eigen::Vector2d direction(const Eigen::Vector2d& position_world) const;
  /// The position after `distance` metres along the shortest path, at most the goal.
  [[nodiscard]] Eigen::Vector2d descend(const Eigen::Vector2d& position_world, double distance) const;
  /// The corners of the shortest path, from the position itself to goal_used().
  void shortest_path(const Eigen::Vector2d& position_world,
                     std::vector<Eigen::Vector2d>& corners_world) const;
  /// Whether a path leads from this position to the goal.
  [[nodiscard]] bool reachable(const Eigen::Vector2d& position_world) const;

  /// The goal, or the nearest position that keeps the clearance.
  [[nodiscard]] const Eigen::Vector2d& goal_used() const { return goal_used_; }
  /// Between paths and static surfaces [m]: the robot's radius and the clearance beyond it.
  [[nodiscard]] double clearance() const { return clearance_; }
  [[nodiscard]] double resolution() const { return parameters_.resolution; }

 private:
  /// The cost-to-go of a node is parent_cost + |position - parent|. The parent is the goal or another node;
  /// on blocked ground it is the parent of the nearest node that has a path.
  struct Node {
    float parent_x, parent_y;  // [m] from the window's origin
    float parent_cost;         // [m]
    std::int32_t parent_node;  // the node that is the parent, kGoal or kUnseen; on blocked ground see
                               // nearest_reached_of
  };
  struct Entry {
    float cost;
    std::int32_t node;
  };
  /// State of the wavefront in progress, by node of the window.
  struct Wavefront {
    std::vector<Node> nodes;
    std::vector<std::uint8_t> state;
    std::vector<Entry> heap;
    std::vector<std::int32_t> nearest_reached;
    std::vector<std::int32_t> queue;
  };
  struct Cell;
  static constexpr std::int32_t kGoal = -1;
  static constexpr std::int32_t kUnseen = -2;
  static constexpr std::int32_t kBlocked = -3;  // no path at all; below: kBlocked - 1 - nearest_reached

  [[nodiscard]] static bool on_blocked_ground(const Node& node) { return node.parent_node <= kBlocked; }
  [[nodiscard]] static std::int32_t nearest_reached_of(const Node& node) {
    return kBlocked - 1 - node.parent_node;
  }
  [[nodiscard]] Eigen::Vector2d local_position(std::int32_t index) const;
  [[nodiscard]] double cost_at(const Node& node, const Eigen::Vector2d& local) const;
  [[nodiscard]] float own_cost(const Node& node, std::int32_t index) const {
    return static_cast<float>(cost_at(node, local_position(index)));
  }
  [[nodiscard]] const Node& node_at(std::int32_t index) const {
    const auto node = static_cast<std::size_t>(index);
    return parents_[parent_of_.empty() ? node : parent_of_[node]];
  }
  [[nodiscard]] Cell cell_of(const Eigen::Vector2d& position_world) const;
  [[nodiscard]] std::int32_t best_corner(const Cell& cell) const;
  template <class Visit>
  void walk(const Eigen::Vector2d& position_world, const Visit& visit) const;
  template <class Visit>
  void for_neighbours(std::int32_t index, const Visit& visit) const;

  void set_window(const OccupancyMap& map, const Eigen::Vector2d& low, const Eigen::Vector2d& high);
  void mark_free_nodes(const OccupancyMap& map);
  void propagate(const OccupancyMap& map);
  void seed(const OccupancyMap& map);
  [[nodiscard]] bool between_viewers(std::int32_t index) const;
  void push(std::int32_t index);
  void offer(std::int32_t index, const Node& parent);
  void find_parent_in_view(const OccupancyMap& map, std::int32_t index);
  [[nodiscard]] Node parent_at(std::int32_t index, const Eigen::Vector2d& local) const;
  [[nodiscard]] Eigen::Vector2d at_clearance(const OccupancyMap& map, const Eigen::Vector2d& local) const;
  [[nodiscard]] bool sees_position(const OccupancyMap& map, const Node& parent,
                                   const Eigen::Vector2d& local) const;
  [[nodiscard]] bool in_view(const OccupancyMap& map, std::int32_t index, const Node& parent) const;
  [[nodiscard]] bool wavefront_reached(const Eigen::Vector2d& position_world) const;
  void extend_over_blocked_ground();
  void keep(const OccupancyMap& map);
  [[nodiscard]] std::optional<std::uint16_t> kept_beside(std::int32_t index) const;
  [[nodiscard]] std::optional<Eigen::Vector2d> nearest_free_position(const OccupancyMap& map,
                                                                     const Eigen::Vector2d& wanted) const;
  [[nodiscard]] bool window_covers(const Eigen::Vector2d& position_world) const;

  CostToGoParameters parameters_;
  double clearance_;  // [m] of the robot's centre
  CostToGoOutcome outcome_ = CostToGoOutcome::no_free_goal;
  Eigen::Vector2d goal_asked_ = Eigen::Vector2d::Zero();
  Eigen::Vector2d goal_used_ = Eigen::Vector2d::Zero();
  std::uint64_t map_revision_ = 0;
  bool whole_map_ = false;
  GridFrame window_;
  // The wavefront's result. Neighbours mostly share a parent, so each is stored once.
  std::vector<Node> parents_;
  std::vector<std::uint16_t>
      parent_of_;  // by node, an index into parents_; empty: parents_ is by node itself
  Wavefront wavefront_;
};

}  // namespace spf
