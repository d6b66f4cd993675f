// The wavefront of CostToGo: lazy Theta* from the goal outwards.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "spf/planning/cost_to_go.hpp"

namespace spf {
namespace {

enum NodeState : std::uint8_t {
  blocked,  // nearer to a surface than the clearance
  unseen,   // free, not reached yet
  trusted,  // has a parent that has yet to be checked for line of sight
  seen,     // has a parent in line of sight
  settled,  // its cost is final
};

constexpr std::int64_t kNodeWork = 5;
constexpr std::int64_t kSettlingWork = 25;

template <class Entry>
bool costlier(const Entry& a, const Entry& b) {
  return a.cost > b.cost;
}

}  // namespace

bool CostToGo::wavefront_reached(const Eigen::Vector2d& position_world) const {
  if (!window_covers(position_world)) return false;
  const Eigen::Vector2d local = position_world - window_.origin_world;
  const int i = std::min(static_cast<int>(local.x() / window_.resolution), window_.width - 2);
  const int j = std::min(static_cast<int>(local.y() / window_.resolution), window_.height - 2);
  // From blocked ground (a robot pushed against a wall, or its own goal there) a path may begin a little
  // farther off.
  for (int reach = 0; reach <= 2; ++reach) {
    for (int dj = -reach; dj <= 1 + reach; ++dj) {
      for (int di = -reach; di <= 1 + reach; ++di) {
        if (!window_.contains(i + di, j + dj)) continue;
        if (wavefront_.state[static_cast<std::size_t>(window_.index(i + di, j + dj))] == settled) return true;
      }
    }
    const Eigen::Vector2i nearest = window_.nearest_node(position_world);
    if (wavefront_.state[static_cast<std::size_t>(window_.index(nearest.x(), nearest.y()))] == unseen)
      return false;
  }
  return false;
}

void CostToGo::mark_free_node(const OccupancyMap& map, std::int32_t index) {
  const auto node = static_cast<std::size_t>(index);
  Eigen::Vector2d position = window_.origin_world + grid_position(index);
  double room = map.distance(position);
  work_ += kNodeWork;
  if (narrow()) {
    wavefront_.costly[node] = room < clearance_ || standing_near(position);
    if (room < clearance_) position = roomiest(map, position, room);
    wavefront_.position[node] = (position - window_.origin_world).cast<float>();
  }
  wavefront_.state[node] = room >= least_clearance_ ? unseen : blocked;
}

// Nodes leave the heap in the order of their cost, on the assumption that their parent is in line of sight.
// Only then is that checked, once a node (lazy); a node for which it is wrong gets the best parent that is,
// and goes back to the heap.
bool CostToGo::propagate(const OccupancyMap& map) {
  while (!wavefront_.heap.empty()) {
    if (tired()) return false;
    std::pop_heap(wavefront_.heap.begin(), wavefront_.heap.end(), costlier<Entry>);
    const Entry entry = wavefront_.heap.back();
    wavefront_.heap.pop_back();
    std::uint8_t& state = wavefront_.state[static_cast<std::size_t>(entry.node)];
    Node& node = wavefront_.nodes[static_cast<std::size_t>(entry.node)];
    if (state == settled || entry.cost > own_cost(node, entry.node)) continue;  // an older, costlier entry
    if (state == trusted && !between_viewers(map, entry.node)) {
      const Eigen::Vector2d to_parent{node.parent_x, node.parent_y};
      const std::optional<double> extra = view(map, local_position(entry.node), to_parent);
      if (!extra || *extra > 0.0) {
        find_parent_in_view(map, entry.node, extra);
        wavefront_.state[static_cast<std::size_t>(entry.node)] = seen;
        if (wavefront_.nodes[static_cast<std::size_t>(entry.node)].parent_node != kUnseen) push(entry.node);
        continue;
      }
    }
    state = settled;
    work_ += kSettlingWork;
    const Node parent = parent_of(entry.node);
    for_neighbours(entry.node, [&](std::int32_t next) { offer(next, parent); });
  }
  return true;
}

// Whether the line from a node to its parent passes between two neighbours that see the same parent. Nothing
// fits between their lines of sight: they are less than 1.4 clearance apart and an inflated surface is 2
// clearance wide. (Of a far field the neighbours have to be in view, too; what is smaller than its cells may
// be missed.) Saves most line-of-sight checks. Where the first step may cost more than its length the line
// has to be looked at all the same.
bool CostToGo::between_viewers(const OccupancyMap& map, std::int32_t index) const {
  if (narrow() && wavefront_.costly[static_cast<std::size_t>(index)] != 0) return false;
  const Node& node = wavefront_.nodes[static_cast<std::size_t>(index)];
  const Eigen::Vector2d to_parent = Eigen::Vector2d{node.parent_x, node.parent_y} - local_position(index);
  const double x = std::fabs(to_parent.x());
  const double y = std::fabs(to_parent.y());
  if (std::max(x, y) < 2.0 * window_.resolution) return false;
  const std::int32_t column = to_parent.x() > 0.0 ? 1 : -1;
  const std::int32_t row = to_parent.y() > 0.0 ? 1 : -1;
  const Eigen::Vector2i here{index % window_.width, index / window_.width};
  const auto sees_same = [&](std::int32_t along_x, std::int32_t along_y) {
    if (!window_.contains(here.x() + along_x, here.y() + along_y)) return false;
    const std::int32_t neighbour = index + along_x + along_y * window_.width;
    const Node& other = wavefront_.nodes[static_cast<std::size_t>(neighbour)];
    return wavefront_.state[static_cast<std::size_t>(neighbour)] == settled &&
           other.parent_node == node.parent_node && other.parent_x == node.parent_x &&
           other.parent_y == node.parent_y &&
           wavefront_.surcharge[static_cast<std::size_t>(neighbour)] == 0.0F &&
           (!is_far_field_ || view(map, local_position(index), local_position(neighbour)));
  };
  constexpr double kAlong = 1e-6;  // on a row or column the diagonal neighbour does not matter
  const bool straight = x > y ? sees_same(column, 0) : sees_same(0, row);
  const bool diagonal = std::min(x, y) < kAlong * std::max(x, y) || sees_same(column, row);
  return straight && diagonal;
}

void CostToGo::push(std::int32_t index) {
  wavefront_.heap.push_back({own_cost(wavefront_.nodes[static_cast<std::size_t>(index)], index), index});
  std::push_heap(wavefront_.heap.begin(), wavefront_.heap.end(), costlier<Entry>);
}

// Starts from the nodes beside the goal or, in a narrow passage, the nearest ones in line of sight.
void CostToGo::seed(const OccupancyMap& map) {
  const Eigen::Vector2d local = goal_used_ - window_.origin_world;
  const Node goal{static_cast<float>(local.x()), static_cast<float>(local.y()), 0.0F, kGoal};
  const Eigen::Vector2i centre = window_.nearest_node(goal_used_);
  for (int reach = 1; reach <= 4 && wavefront_.heap.empty(); ++reach) {
    for (int j = centre.y() - reach; j <= centre.y() + reach; ++j) {
      for (int i = centre.x() - reach; i <= centre.x() + reach; ++i) {
        if (!window_.contains(i, j)) continue;
        const std::int32_t index = window_.index(i, j);
        if (wavefront_.state[static_cast<std::size_t>(index)] == unseen &&
            view(map, local_position(index), local))
          offer(index, goal);
      }
    }
  }
}

void CostToGo::offer(std::int32_t index, const Node& parent) {
  std::uint8_t& state = wavefront_.state[static_cast<std::size_t>(index)];
  if (state == blocked || state == settled) return;
  Node& node = wavefront_.nodes[static_cast<std::size_t>(index)];
  if (!(own_cost(parent, index) < own_cost(node, index))) return;
  node = parent;
  wavefront_.surcharge[static_cast<std::size_t>(index)] = 0.0F;
  state = trusted;
  push(index);
}

/// The parent of a node as it is offered to others: without what the path there costs this node.
CostToGo::Node CostToGo::parent_of(std::int32_t index) const {
  Node parent = wavefront_.nodes[static_cast<std::size_t>(index)];
  parent.parent_cost -= wavefront_.surcharge[static_cast<std::size_t>(index)];
  return parent;
}

/// `extra` [m]: what the path to the present parent costs beyond its length; none = it is not in view.
void CostToGo::find_parent_in_view(const OccupancyMap& map, std::int32_t index, std::optional<double> extra) {
  const Eigen::Vector2d here = local_position(index);
  const Node failed = parent_of(index);
  Node best{0.0F, 0.0F, std::numeric_limits<float>::infinity(), kUnseen};
  double lowest = std::numeric_limits<double>::infinity();
  double best_extra = 0.0;
  const auto take = [&](const Node& parent, double extra_cost) {
    const double cost = cost_at(parent, here) + extra_cost;
    if (!(cost < lowest)) return;
    lowest = cost;
    best = parent;
    best_extra = extra_cost;
  };
  const auto try_parent = [&](const Node& parent) {
    if (!(cost_at(parent, here) < lowest)) return false;
    const std::optional<double> cost = view(map, here, {parent.parent_x, parent.parent_y});
    if (cost) take(parent, *cost);
    return cost.has_value();
  };
  if (extra) take(failed, *extra);
  for_neighbours(index, [&](std::int32_t next) {
    if (wavefront_.state[static_cast<std::size_t>(next)] != settled) return;
    const Eigen::Vector2d next_position = local_position(next);
    const Node beside = parent_at(next, next_position);
    if (neighbours_see_each_other())
      take(beside, 0.0);
    else if (!try_parent(beside) && narrow() && cost_at(beside, here) < lowest &&
             bend_between(map, here, next_position))
      try_parent(parent_around_bend(map, next));
    // The corner itself lies between nodes, this one and the last in view, at the clearance.
    for (const Eigen::Vector2d& near : {next_position, Eigen::Vector2d{0.5 * (next_position + here)}}) {
      const Eigen::Vector2d position = at_clearance(map, near);
      Node corner = parent_at(next, position);
      if (cost_at(corner, here) >= lowest) continue;
      const Node of_next = parent_of(next);
      const std::optional<double> beyond = view(map, position, {of_next.parent_x, of_next.parent_y});
      if (!beyond) continue;
      corner.parent_cost = static_cast<float>(cost_at(of_next, position) + *beyond);
      try_parent(corner);
    }
  });
  const Node* last_tried = nullptr;
  for_neighbours(index, [&](std::int32_t next) {
    const Node& parent = wavefront_.nodes[static_cast<std::size_t>(next)];
    if (wavefront_.state[static_cast<std::size_t>(next)] != settled || same_parent(parent, failed)) return;
    if (last_tried != nullptr && same_parent(parent, *last_tried)) return;
    last_tried = &parent;
    try_parent(parent_of(next));
  });
  best.parent_cost += static_cast<float>(best_extra);
  wavefront_.nodes[static_cast<std::size_t>(index)] = best;
  wavefront_.surcharge[static_cast<std::size_t>(index)] = static_cast<float>(best_extra);
}

// A position in view of a node's parent as a parent of its own.
CostToGo::Node CostToGo::parent_at(std::int32_t index, const Eigen::Vector2d& local) const {
  const double cost = cost_at(wavefront_.nodes[static_cast<std::size_t>(index)], local);
  return {static_cast<float>(local.x()), static_cast<float>(local.y()), static_cast<float>(cost), index};
}

bool CostToGo::free_at(std::int32_t index) const {
  return wavefront_.state[static_cast<std::size_t>(index)] != blocked;
}

bool CostToGo::settled_at(std::int32_t index) const {
  return wavefront_.state[static_cast<std::size_t>(index)] == settled;
}

}  // namespace spf
