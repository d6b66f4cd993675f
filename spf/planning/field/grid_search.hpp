// Shortest paths over the nodes of an occupancy map that keep a clearance: A* with eight neighbours. For
// local detours (guide pairs of the base planner); the global path to the goal is CostToGo's. Frame: world.
#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <optional>
#include <vector>

#include "spf/math/parameters.hpp"
#include "spf/world/occupancy_map.hpp"

namespace spf {

struct GridSearchParameters {
  int window_nodes = 65536;    ///< [1] most nodes of a search window: 13 bytes a node
  int node_budget = 20000;     ///< [1] most nodes expanded in one search: 112 bytes each
  double push_distance = 1.0;  ///< [m] start and goal on blocked ground are moved at most this far

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit("window_nodes", self.window_nodes, "1", Range{16, 67108864}, "most nodes of a search window");
    visit("node_budget", self.node_budget, "1", Range{1, 67108864}, "most nodes expanded in one search");
    visit("push_distance", self.push_distance, "m", Range{0.0, 100.0},
          "how far start and goal are moved to the nearest free node");
  }
};

enum class GridSearchOutcome {
  found,
  no_path,      ///< the window contains no path
  blocked_end,  ///< no free node near the start or the goal (or they are not finite or out of the window)
  budget_exhausted,  ///< node_budget spent
  window_too_large,  ///< more nodes than window_nodes: ask for a smaller window
};

struct GridSearchRequest {
  Eigen::Vector2d start_world = Eigen::Vector2d::Zero();
  Eigen::Vector2d goal_world = Eigen::Vector2d::Zero();
  double clearance = 0.3;  ///< [m] nodes nearer to a surface are blocked
  std::optional<double>
      window_margin;  ///< [m] margin around the box of start and goal; absent: the whole map
};

struct GridSearchResult {
  GridSearchOutcome outcome = GridSearchOutcome::no_path;
  double cost = 0.0;  ///< [m] length
  int expanded = 0;   ///< nodes closed
};

class GridSearch {
 public:
  /// All memory is allocated here. Throws std::invalid_argument on parameters out of range.
  explicit GridSearch(const GridSearchParameters& parameters = {});

  /// Searches; does not allocate. The result is in path().
  GridSearchResult search(const OccupancyMap& map, const GridSearchRequest& request);
  /// Nodes from start to goal of the last search, positions in world; empty unless one was found. The first
  /// and the last node are the nearest free ones to start and goal, not these themselves.
  [[nodiscard]] const std::vector<Eigen::Vector2d>& path() const { return path_; }

 private:
  struct Entry {
    float total;  // [m] cost so far and estimate
    float cost;   // [m]
    std::int32_t node;
  };
  struct Window {
    int low_i, low_j, width, height;
  };

  [[nodiscard]] bool place_window(const OccupancyMap& map, const GridSearchRequest& request);
  [[nodiscard]] std::int32_t nearest_free(const OccupancyMap& map, const Eigen::Vector2d& wanted) const;
  [[nodiscard]] float estimate(std::int32_t from, std::int32_t to) const;
  [[nodiscard]] double node_distance(const OccupancyMap& map, std::int32_t node) const;
  void expand(const OccupancyMap& map, const Entry& entry, std::int32_t goal);
  void offer(std::int32_t node, std::int32_t parent, float cost, std::int32_t goal);
  void trace_back(const OccupancyMap& map, std::int32_t goal);

  GridSearchParameters parameters_;
  double clearance_ = 0.0;
  double resolution_ = 0.0;
  Window window_{};
  std::uint32_t generation_ = 0;        // of this search; older marks are invalid
  std::vector<std::uint32_t> seen_in_;  // generation in which a node got its cost
  std::vector<float> cost_;             // [m]
  std::vector<std::int32_t> parent_;
  std::vector<std::uint8_t> closed_;
  std::vector<Entry> heap_;
  std::vector<Eigen::Vector2d> path_;
};

}  // namespace spf
