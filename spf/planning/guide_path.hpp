// The way to the goal around static obstacles, from everywhere: a cost-to-go in metres. A flood from the goal
// gives every node of a coarse grid its root: the last corner from which it can be seen (lazy Theta*,
// any-angle). The cost at a place is then a distance to a root plus the root's own cost: exact, not the sum
// of grid steps. Frame: world.
#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <optional>
#include <vector>

#include "spf/math/parameters.hpp"
#include "spf/world/occupancy_map.hpp"

namespace spf {

struct GuidePathParameters {
  double clearance = 0.35;  ///< [m] distance to static surfaces that the way keeps
  double resolution = 0.2;  ///< [m] of the flood's nodes, at most 1.4 clearance is used; passages narrower
                            ///< than 2 clearance + this may be missed
  double window_margin = 10.0;  ///< [m] the flood first stays this close to the box around robot and goal

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit("clearance", self.clearance, kMetresBySize, Range{0.0, 20.0},
          "distance to static surfaces that the global way keeps");
    visit("resolution", self.resolution, kMetresBySize, Range{0.005, 5.0},
          "spacing of the nodes of the global way's search");
  }

  /// No settings, but they follow the robot.
  template <class Self, class Visitor>
  static void visit_constants(Self& self, Visitor&& visit) {
    visit(self.window_margin, Scale::way, Range{0.0, 1000.0});
  }
};

enum class GuideOutcome {
  reachable,     ///< a way leads from the robot to the goal
  goal_moved,    ///< likewise, but to goal_used(), the nearest free place to a goal on blocked ground
  unreachable,   ///< no way; the cost-to-go then counts blocked ground several times over and still leads to
                 ///< the goal
  no_free_goal,  ///< the map has no free place near the goal at all (or numbers were not finite): no field
};

class GuidePath {
 public:
  /// Throws std::invalid_argument on parameters out of range.
  explicit GuidePath(const GuidePathParameters& parameters);

  /// Floods from the goal far enough for a robot at `robot_world`. What the flood works with (some 30 bytes a
  /// node) is kept from run to run where the map is being sensed, since the next flood is near, and given
  /// back where all of it is known; what remains is 2 bytes a node and 16 for every different root.
  GuideOutcome update(const OccupancyMap& map, const Eigen::Vector2d& goal_world,
                      const Eigen::Vector2d& robot_world);
  /// Whether update() with these arguments would do work of any use: new goal, changed map, robot out of the
  /// window.
  [[nodiscard]] bool outdated(const OccupancyMap& map, const Eigen::Vector2d& goal_world,
                              const Eigen::Vector2d& robot_world) const;

  [[nodiscard]] bool ready() const { return !roots_.empty(); }
  [[nodiscard]] GuideOutcome outcome() const { return outcome_; }

  // The following need ready(); none allocates (except the growth of way()'s argument).
  /// Length of the shortest way to goal_used() [m]. Continuous; exactly the straight distance where the goal
  /// is in view.
  [[nodiscard]] double cost_to_go(const Eigen::Vector2d& position_world) const;
  /// Gradient of cost_to_go, which points away from the goal; length about 1 on free ground.
  [[nodiscard]] Eigen::Vector2d cost_gradient(const Eigen::Vector2d& position_world) const;
  /// Unit vector of steepest descent: towards the corner ahead, on blocked ground also out of it; zero at the
  /// goal.
  [[nodiscard]] Eigen::Vector2d direction(const Eigen::Vector2d& position_world) const;
  /// The place reached after `distance` metres along the shortest way, at most the goal.
  [[nodiscard]] Eigen::Vector2d descend(const Eigen::Vector2d& position_world, double distance) const;
  /// The corners of the shortest way, from the place itself to goal_used().
  void way(const Eigen::Vector2d& position_world, std::vector<Eigen::Vector2d>& corners_world) const;
  /// Whether a way leads from here to the goal.
  [[nodiscard]] bool reachable(const Eigen::Vector2d& position_world) const;

  /// The goal, or the nearest place that keeps the clearance.
  [[nodiscard]] const Eigen::Vector2d& goal_used() const { return goal_used_; }
  [[nodiscard]] const GuidePathParameters& parameters() const { return parameters_; }

 private:
  /// What a node knows about reaching the goal: root_cost + |place - root|. The root is the goal or another
  /// node; on blocked ground it is the root of the nearest node with a way.
  struct Node {
    float root_x, root_y;  // [m] from the window's origin
    float root_cost;       // [m]
    std::int32_t parent;   // the node that is the root, kGoal or kUnseen; on blocked ground see portal_of
  };
  struct Entry {
    float cost;
    std::int32_t node;
  };
  /// The flood under way, by node of the window.
  struct Flood {
    std::vector<Node> nodes;
    std::vector<std::uint8_t> state;
    std::vector<Entry> heap;
    std::vector<std::int32_t> portal;
    std::vector<std::int32_t> queue;
  };
  struct Cell;
  static constexpr std::int32_t kGoal = -1;
  static constexpr std::int32_t kUnseen = -2;
  static constexpr std::int32_t kBlocked = -3;  // no way at all; below: kBlocked - 1 - portal

  [[nodiscard]] static bool on_blocked_ground(const Node& node) { return node.parent <= kBlocked; }
  [[nodiscard]] static std::int32_t portal_of(const Node& node) { return kBlocked - 1 - node.parent; }
  [[nodiscard]] Eigen::Vector2d place(std::int32_t index) const;
  [[nodiscard]] double cost_at(const Node& node, const Eigen::Vector2d& local) const;
  [[nodiscard]] float own_cost(const Node& node, std::int32_t index) const {
    return static_cast<float>(cost_at(node, place(index)));
  }
  [[nodiscard]] const Node& node_at(std::int32_t index) const {
    const auto node = static_cast<std::size_t>(index);
    return roots_[root_of_.empty() ? node : root_of_[node]];
  }
  [[nodiscard]] Cell cell_of(const Eigen::Vector2d& position_world) const;
  [[nodiscard]] std::int32_t best_corner(const Cell& cell) const;
  template <class Visit>
  void walk(const Eigen::Vector2d& position_world, const Visit& visit) const;
  template <class Visit>
  void for_neighbours(std::int32_t index, const Visit& visit) const;

  void set_window(const OccupancyMap& map, const Eigen::Vector2d& low, const Eigen::Vector2d& high);
  void mark_free_nodes(const OccupancyMap& map);
  void flood(const OccupancyMap& map);
  void seed(const OccupancyMap& map);
  [[nodiscard]] bool between_seers(std::int32_t index) const;
  void push(std::int32_t index);
  void offer(std::int32_t index, const Node& root);
  void find_root_in_view(const OccupancyMap& map, std::int32_t index);
  [[nodiscard]] Node root_at(std::int32_t index, const Eigen::Vector2d& local) const;
  [[nodiscard]] Eigen::Vector2d at_clearance(const OccupancyMap& map, const Eigen::Vector2d& local) const;
  [[nodiscard]] bool sees_place(const OccupancyMap& map, const Node& root,
                                const Eigen::Vector2d& local) const;
  [[nodiscard]] bool in_view(const OccupancyMap& map, std::int32_t index, const Node& root) const;
  [[nodiscard]] bool flood_reached(const Eigen::Vector2d& position_world) const;
  void extend_over_blocked_ground();
  void keep(const OccupancyMap& map);
  [[nodiscard]] std::optional<std::uint16_t> kept_beside(std::int32_t index) const;
  [[nodiscard]] std::optional<Eigen::Vector2d> nearest_free_place(const OccupancyMap& map,
                                                                  const Eigen::Vector2d& wanted) const;
  [[nodiscard]] bool window_covers(const Eigen::Vector2d& position_world) const;

  GuidePathParameters parameters_;
  GuideOutcome outcome_ = GuideOutcome::no_free_goal;
  Eigen::Vector2d goal_asked_ = Eigen::Vector2d::Zero();
  Eigen::Vector2d goal_used_ = Eigen::Vector2d::Zero();
  std::uint64_t map_revision_ = 0;
  bool whole_map_ = false;
  GridFrame window_;
  // What the flood found. Neighbours mostly know the same, so that is kept once.
  std::vector<Node> roots_;
  std::vector<std::uint16_t> root_of_;  // by node, an index into roots_; empty: roots_ is by node itself
  Flood flood_;
};

}  // namespace spf
