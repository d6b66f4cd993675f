// Cost-to-go [m]: the length of the shortest path around static obstacles to the goal, from any position. A
// wavefront from the goal assigns to every node of a coarse grid its parent: the next corner on the path to
// the goal, which is in line of sight (lazy Theta*, any-angle). The cost at a position is the distance to a
// parent plus the parent's cost: an exact length, not a sum of grid steps. Where narrow passages may be taken
// they cost more: there a node moves to the position of largest clearance in its cell, and two neighbours
// without line of sight are joined by a path through the middle of the gap between them. Frame: world.
#pragma once

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "spf/planning/cost_to_go_parameters.hpp"
#include "spf/world/occupancy_map.hpp"
#include "spf/world/standing.hpp"

namespace spf {

/// [1] Surcharge of narrow ground, per metre, at most: the robot creeps there. A gap that may turn out to be
/// too narrow costs more than that.
inline constexpr double kNarrowCost = 3.0;

enum class CostToGoOutcome {
  reachable,    ///< a path leads from the robot to the goal
  goal_moved,   ///< likewise, but to goal_used(), the nearest free position to a goal on blocked ground
  unreachable,  ///< no path; the cost-to-go then charges blocked ground several times over and still leads to
                ///< the goal
  no_free_goal,  ///< no free position near the goal at all (or numbers not finite): no cost-to-go
};

class CostToGo {
 public:
  /// For a robot of this radius [m] (0: a point). Throws std::invalid_argument on parameters out of range.
  /// With a finite `least_margin` [m] narrow passages are taken, at a price (kNarrowCost), where they leave
  /// that margin beyond the radius. By default ground with less than the clearance is blocked, and passages
  /// narrower than twice the clearance + the resolution may be missed.
  explicit CostToGo(const CostToGoParameters& parameters, double robot_radius = 0.0,
                    double least_margin = std::numeric_limits<double>::infinity());

  /// An empty one (not ready()) for the same robot and parameters.
  [[nodiscard]] CostToGo anew() const;

  /// Standing obstacles, from the next update() on: a path through one costs the time that it is expected to
  /// stay, times `speed` [m/s]. Ignored without narrow passages (see the constructor).
  void set_standing(const std::vector<StandingDisc>& discs, double speed);
  [[nodiscard]] const std::vector<StandingDisc>& standing() const { return standing_; }

  /// Propagates from the goal far enough for a robot at `robot_world`. The wavefront's working memory (some
  /// 30 bytes a node) is kept between updates while the map is being sensed, since the next one comes soon,
  /// and freed when the whole map is known; what remains is 2 bytes a node and 16 for every distinct parent.
  CostToGoOutcome update(const OccupancyMap& map, const Eigen::Vector2d& goal_world,
                         const Eigen::Vector2d& robot_world);
  /// update() in slices: call begin(), then advance() until it returns true. Until then not ready().
  void begin(const OccupancyMap& map, const Eigen::Vector2d& goal_world, const Eigen::Vector2d& robot_world);
  /// begin() and update() reuse the previous far field while its path is free on the map, and then compute
  /// only a new near field. After this call they reuse that of another cost-to-go to the same goal.
  void share_far_field(const CostToGo& other);
  /// Does about this much work, in units of some 20 ns on a processor of 2020: counted, not timed, so that
  /// slices are reproducible. The map may change between slices; changes behind the wavefront take effect
  /// with the next update. True when done.
  bool advance(const OccupancyMap& map, std::int64_t work);
  [[nodiscard]] bool under_way() const { return progress_.stage != Stage::done; }
  /// Whether the robot needs another near field soon.
  [[nodiscard]] bool leaves_near_field(const Eigen::Vector2d& robot_world) const;
  /// Whether the near field does not reach a position, so that the far one has to do there.
  [[nodiscard]] bool beyond_near_field(const Eigen::Vector2d& robot_world) const {
    return beyond(robot_world) != nullptr;
  }
  /// Whether the running update searches the whole map for a path, which may take minutes.
  [[nodiscard]] bool looks_everywhere() const { return progress_.fine; }
  /// Number of nodes.
  [[nodiscard]] std::int64_t size() const { return window_count(); }
  /// Whether update() with these arguments could change anything: new goal, changed map, robot out of the
  /// window.
  [[nodiscard]] bool outdated(const OccupancyMap& map, const Eigen::Vector2d& goal_world,
                              const Eigen::Vector2d& robot_world) const;

  [[nodiscard]] bool ready() const { return !parents_.empty() && !under_way(); }
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
  /// The corners of the shortest path, from the position itself to goal_used() or, where that is far, to the
  /// first corner beyond the near field.
  void shortest_path(const Eigen::Vector2d& position_world,
                     std::vector<Eigen::Vector2d>& corners_world) const;
  /// Whether the straight line between two positions keeps the clearance of paths, less half a cell of the
  /// map since paths graze corners; where narrow passages are taken, all of the least clearance.
  [[nodiscard]] bool passable(const OccupancyMap& map, const Eigen::Vector2d& from_world,
                              const Eigen::Vector2d& to_world) const;
  /// Whether a path leads from this position to the goal.
  [[nodiscard]] bool reachable(const Eigen::Vector2d& position_world) const;

  /// The goal, or the nearest position that keeps the clearance.
  [[nodiscard]] const Eigen::Vector2d& goal_used() const { return goal_used_; }
  /// Between paths and static surfaces [m]: the robot's radius and the clearance beyond it.
  [[nodiscard]] double clearance() const { return clearance_; }
  /// Likewise where there is no room for that: what paths keep everywhere [m].
  [[nodiscard]] double least_clearance() const { return least_clearance_; }
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
  /// A node that was moved off its grid position.
  struct Moved {
    std::int32_t node;
    std::int16_t x, y;  // offset in units of kMovedUnit * resolution
  };
  struct Entry {
    float cost;
    std::int32_t node;
  };
  /// State of the wavefront in progress, by node of the window.
  struct Wavefront {
    std::vector<Node> nodes;  // of the window, then those at bends
    std::vector<std::uint8_t> state;
    std::vector<std::uint8_t> costly;       // 1: near a surface or a standing obstacle, where paths cost more
    std::vector<Eigen::Vector2f> position;  // [m] of each node, where narrow passages are taken; else empty
    std::vector<float> surcharge;           // [m] of the path to the parent, contained in parent_cost
    std::vector<Eigen::Vector2d> bend;      // [m] of a path between two neighbours
    std::vector<Entry> heap;
    std::vector<std::int32_t> nearest_reached;
    std::vector<std::int32_t> queue;
  };
  /// What advance() does next.
  enum class Stage : std::uint8_t {
    far_field,
    mark_free_nodes,
    seed,
    propagate,
    find_reached,  // the nodes that the wavefront has reached ...
    find_nearest,  // ... the nearest of them to every other node ...
    extend,        // ... which gets its parent
    keep_parents,
    keep_positions,
    done,
  };
  struct Progress {
    Stage stage = Stage::done;
    std::int32_t next = 0;                  // node of the stage, or index into the queue
    bool everywhere = false;                // the window is the whole map
    bool fine = false;                      // however far the goal is
    Eigen::Vector2d robot_world{0.0, 0.0};  // [m]
    std::int64_t limit = 0;                 // of work, in this slice
  };
  struct Cell;
  static constexpr std::int32_t kGoal = -1;
  static constexpr std::int32_t kUnseen = -2;
  static constexpr std::int32_t kBlocked = -3;  // no path at all; below: kBlocked - 1 - nearest_reached

  [[nodiscard]] static bool on_blocked_ground(const Node& node) { return node.parent_node <= kBlocked; }
  [[nodiscard]] static std::int32_t nearest_reached_of(const Node& node) {
    return kBlocked - 1 - node.parent_node;
  }
  [[nodiscard]] bool narrow() const { return least_clearance_ < clearance_; }
  [[nodiscard]] std::int32_t window_count() const { return window_.width * window_.height; }
  static constexpr double kMovedUnit = 1e-4;  // [1] of the resolution
  [[nodiscard]] Eigen::Vector2d grid_position(std::int32_t index) const;
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
  [[nodiscard]] bool passed(const Eigen::Vector2d& corner, std::int32_t index,
                            const Eigen::Vector2d& local) const;
  [[nodiscard]] std::int32_t best_corner(const Cell& cell) const;
  template <class Visit>
  void walk(const Eigen::Vector2d& position_world, const Visit& visit) const;
  template <class Visit>
  void for_neighbours(std::int32_t index, const Visit& visit) const;

  [[nodiscard]] double spacing_on(const OccupancyMap& map) const;
  void set_window(const OccupancyMap& map, const Eigen::Vector2d& low, const Eigen::Vector2d& high);
  void open_window(const OccupancyMap& map);
  [[nodiscard]] bool splits(const OccupancyMap& map, const Eigen::Vector2d& low, const Eigen::Vector2d& high);
  void clear_nodes();
  bool advance_far_field(const OccupancyMap& map);
  [[nodiscard]] bool far_field_holds(const OccupancyMap& map) const;
  void coarsen(const OccupancyMap& map, const Eigen::Vector2d& low, const Eigen::Vector2d& high);
  [[nodiscard]] bool same_parent(const Node& a, const Node& b) const;
  [[nodiscard]] std::int32_t edge_node(std::int32_t along) const;
  void seed_from_far_field(const OccupancyMap& map, std::int32_t index);
  [[nodiscard]] bool neighbours_see_each_other() const { return !narrow() && !is_far_field_; }
  void enter(Stage stage);
  bool run_stage(const OccupancyMap& map);
  [[nodiscard]] bool tired() const { return work_ >= progress_.limit; }
  template <class Visit>
  bool for_nodes(std::int32_t count, const Visit& visit);
  void mark_free_node(const OccupancyMap& map, std::int32_t index);
  bool propagate(const OccupancyMap& map);
  void end_propagation(const OccupancyMap& map);
  void seed(const OccupancyMap& map);
  [[nodiscard]] bool between_viewers(const OccupancyMap& map, std::int32_t index) const;
  void push(std::int32_t index);
  void offer(std::int32_t index, const Node& parent);
  void find_parent_in_view(const OccupancyMap& map, std::int32_t index, std::optional<double> extra);
  [[nodiscard]] Node parent_of(std::int32_t index) const;
  [[nodiscard]] Node parent_at(std::int32_t index, const Eigen::Vector2d& local) const;
  [[nodiscard]] Eigen::Vector2d at_clearance(const OccupancyMap& map, const Eigen::Vector2d& local) const;
  [[nodiscard]] std::optional<double> view(const OccupancyMap& map, const Eigen::Vector2d& from,
                                           const Eigen::Vector2d& to) const;
  [[nodiscard]] bool standing_near(const Eigen::Vector2d& position_world) const;
  [[nodiscard]] double standing_cost(const Eigen::Vector2d& from_world,
                                     const Eigen::Vector2d& to_world) const;
  [[nodiscard]] std::optional<double> narrow_view(const OccupancyMap& map, const Eigen::Vector2d& from,
                                                  const Eigen::Vector2d& to) const;
  [[nodiscard]] Eigen::Vector2d roomiest(const OccupancyMap& map, const Eigen::Vector2d& node_world,
                                         double& room) const;
  [[nodiscard]] std::optional<Eigen::Vector2d> middle_of_gap(const OccupancyMap& map,
                                                             const Eigen::Vector2d& from,
                                                             const Eigen::Vector2d& to) const;
  bool bend_between(const OccupancyMap& map, const Eigen::Vector2d& from, const Eigen::Vector2d& to);
  [[nodiscard]] Node parent_around_bend(const OccupancyMap& map, std::int32_t index);
  [[nodiscard]] bool wavefront_reached(const Eigen::Vector2d& position_world) const;
  [[nodiscard]] bool settled_at(std::int32_t index) const;
  [[nodiscard]] bool free_at(std::int32_t index) const;
  void enter_reached(std::int32_t index);
  bool find_nearest();
  void extend(std::int32_t index);
  bool keep_parents();
  void keep_position(std::int32_t index);
  void free_memory(const OccupancyMap& map);
  [[nodiscard]] std::optional<std::uint16_t> kept_beside(std::int32_t index) const;
  [[nodiscard]] std::optional<Eigen::Vector2d> nearest_free_position(const OccupancyMap& map,
                                                                     const Eigen::Vector2d& wanted) const;
  [[nodiscard]] bool window_covers(const Eigen::Vector2d& position_world) const;
  [[nodiscard]] const CostToGo* beyond(const Eigen::Vector2d& position_world) const;
  [[nodiscard]] std::array<std::int32_t, 4> nodes_around(const Eigen::Vector2d& position_world) const;

  CostToGoParameters parameters_;
  double clearance_;        // [m] of the robot's centre
  double least_clearance_;  // [m] likewise
  CostToGoOutcome outcome_ = CostToGoOutcome::no_free_goal;
  Eigen::Vector2d goal_asked_ = Eigen::Vector2d::Zero();
  Eigen::Vector2d goal_used_ = Eigen::Vector2d::Zero();
  std::uint64_t map_revision_ = 0;
  bool whole_map_ = false;
  GridFrame window_;
  std::vector<StandingDisc> standing_;
  double standing_speed_ = 0.0;         // [m/s] turns waiting time into path length
  std::vector<Moved> moved_;            // by node
  std::vector<Eigen::Vector2f> bends_;  // [m] nodes off the grid, numbered after the window's
  // The wavefront's result. Neighbours mostly share a parent, so each is stored once.
  std::vector<Node> parents_;
  std::vector<std::uint16_t>
      parent_of_;  // by node, an index into parents_; empty: parents_ is by node itself
  Wavefront wavefront_;
  Progress progress_;
  // Where the goal is far there are two fields: this one around the robot, and a coarse one over the whole
  // path, whose costs seed this one at its window's edge.
  std::shared_ptr<CostToGo> far_field_;  // null: none; shared by the fields of one robot once it is done
  bool is_far_field_ = false;
  mutable std::int64_t work_ = 0;  // done in this slice
};

template <class Visit>
bool CostToGo::for_nodes(std::int32_t count, const Visit& visit) {
  for (; progress_.next < count; ++progress_.next) {
    if (tired()) return false;
    visit(progress_.next);
    ++work_;
  }
  return true;
}

template <class Visit>
void CostToGo::for_neighbours(std::int32_t index, const Visit& visit) const {
  const int i = index % window_.width;
  const int j = index / window_.width;
  for (int dj = -1; dj <= 1; ++dj) {
    for (int di = -1; di <= 1; ++di) {
      if ((di != 0 || dj != 0) && window_.contains(i + di, j + dj)) visit(window_.index(i + di, j + dj));
    }
  }
}

}  // namespace spf
