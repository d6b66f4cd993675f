// The wavefront of CostToGo: lazy Theta* from the goal outwards.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "spf/planning/cost_to_go.hpp"

namespace spf {
namespace {

constexpr double kBlockedFactor =
    3.0;  // [1] about the cost of a metre on blocked ground, where no path leads

enum NodeState : std::uint8_t {
  blocked,  // nearer to a surface than the clearance
  unseen,   // free, not reached yet
  trusted,  // has a parent that has yet to be checked for line of sight
  seen,     // has a parent in line of sight
  settled,  // its cost is final
};

/// Lines of sight may pass this much nearer than the clearance, in cells of the map: the error of bilinear
/// interpolation and of the steps between nodes.
constexpr double kSightSlack = 0.25;

template <class Entry>
bool costlier(const Entry& a, const Entry& b) {
  return a.cost > b.cost;
}

}  // namespace

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

CostToGoOutcome CostToGo::update(const OccupancyMap& map, const Eigen::Vector2d& goal_world,
                                 const Eigen::Vector2d& robot_world) {
  parents_.clear();
  goal_asked_ = goal_world;
  goal_used_ = goal_world;
  map_revision_ = map.revision();
  outcome_ = CostToGoOutcome::no_free_goal;
  if (!goal_world.allFinite() || !robot_world.allFinite()) return outcome_;
  const std::optional<Eigen::Vector2d> goal = nearest_free_position(map, goal_world);
  if (!goal) return outcome_;
  goal_used_ = *goal;
  const CostToGoOutcome success =
      goal_used_ == goal_world ? CostToGoOutcome::reachable : CostToGoOutcome::goal_moved;

  const Eigen::Vector2d margin = Eigen::Vector2d::Constant(parameters_.window_margin);
  for (const bool everywhere : {false, true}) {
    const Eigen::Vector2d room = everywhere ? Eigen::Vector2d::Constant(1e9) : margin;
    set_window(map, goal_used_.cwiseMin(robot_world) - room, goal_used_.cwiseMax(robot_world) + room);
    mark_free_nodes(map);
    propagate(map);
    if (wavefront_reached(robot_world)) {
      outcome_ = success;
      break;
    }
    outcome_ = CostToGoOutcome::unreachable;
    if (whole_map_) break;
  }
  extend_over_blocked_ground();
  keep(map);
  return outcome_;
}

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

// Coarse nodes on the part of the map that the rectangle covers.
void CostToGo::set_window(const OccupancyMap& map, const Eigen::Vector2d& low, const Eigen::Vector2d& high) {
  const GridFrame& frame = map.frame();
  const Eigen::Vector2d map_low = frame.origin_world;
  const Eigen::Vector2d map_high = frame.node_position(frame.width - 1, frame.height - 1);
  // Two free nodes must not be neighbours across a wall, however thin, so their distance stays below 2
  // clearance.
  const double safe_spacing = clearance_ > 0.0 ? 1.4 * clearance_ : parameters_.resolution;
  const double spacing = std::max(std::min(parameters_.resolution, safe_spacing), frame.resolution);
  // Nodes lie on multiples of the spacing from the map's corner, so that they do not move with the window.
  const auto snapped = [&](const Eigen::Vector2d& corner) {
    const Eigen::Vector2d inside = corner.cwiseMax(map_low).cwiseMin(map_high);
    return Eigen::Vector2d{map_low + spacing * ((inside - map_low) / spacing).array().floor().matrix()};
  };
  whole_map_ = (low.array() <= map_low.array()).all() && (high.array() >= map_high.array()).all();
  const Eigen::Vector2d top = high.cwiseMin(map_high).cwiseMax(map_low);
  window_ = GridFrame::covering(snapped(low), top.cwiseMax(snapped(low)), spacing);
  window_.width = std::max(window_.width, 2);
  window_.height = std::max(window_.height, 2);
}

void CostToGo::mark_free_nodes(const OccupancyMap& map) {
  const std::size_t count =
      static_cast<std::size_t>(window_.width) * static_cast<std::size_t>(window_.height);
  wavefront_.state.resize(count);
  wavefront_.nodes.assign(count, {0.0F, 0.0F, std::numeric_limits<float>::infinity(), kUnseen});
  std::size_t index = 0;
  for (int j = 0; j < window_.height; ++j) {
    for (int i = 0; i < window_.width; ++i, ++index) {
      wavefront_.state[index] = map.distance(window_.node_position(i, j)) >= clearance_ ? unseen : blocked;
    }
  }
}

// Nodes leave the heap in the order of their cost, on the assumption that their parent is in line of sight.
// Only then is that checked, once a node (lazy); a node for which it is wrong gets the best parent that is,
// and goes back to the heap.
void CostToGo::propagate(const OccupancyMap& map) {
  wavefront_.heap.clear();
  seed(map);
  while (!wavefront_.heap.empty()) {
    std::pop_heap(wavefront_.heap.begin(), wavefront_.heap.end(), costlier<Entry>);
    const Entry entry = wavefront_.heap.back();
    wavefront_.heap.pop_back();
    std::uint8_t& state = wavefront_.state[static_cast<std::size_t>(entry.node)];
    Node& node = wavefront_.nodes[static_cast<std::size_t>(entry.node)];
    if (state == settled || entry.cost > own_cost(node, entry.node)) continue;  // an older, costlier entry
    if (state == trusted && !between_viewers(entry.node) && !in_view(map, entry.node, node)) {
      find_parent_in_view(map, entry.node);
      state = seen;
      push(entry.node);
      continue;
    }
    state = settled;
    const Node parent = node;
    for_neighbours(entry.node, [&](std::int32_t next) { offer(next, parent); });
  }
}

// Whether the line from a node to its parent passes between two neighbours that see the same parent. Nothing
// fits between their lines of sight: they are less than 1.4 clearance apart and an inflated surface is 2
// clearance wide. Saves most line-of-sight checks.
bool CostToGo::between_viewers(std::int32_t index) const {
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
           other.parent_y == node.parent_y;
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
        if (wavefront_.state[static_cast<std::size_t>(index)] == unseen && in_view(map, index, goal))
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
  state = trusted;
  push(index);
}

bool CostToGo::in_view(const OccupancyMap& map, std::int32_t index, const Node& parent) const {
  return sees_position(map, parent, local_position(index));
}

bool CostToGo::sees_position(const OccupancyMap& map, const Node& parent,
                             const Eigen::Vector2d& local) const {
  const Eigen::Vector2d there = window_.origin_world + Eigen::Vector2d{parent.parent_x, parent.parent_y};
  return map.segment_clear(window_.origin_world + local, there,
                           clearance_ - kSightSlack * map.frame().resolution);
}

void CostToGo::find_parent_in_view(const OccupancyMap& map, std::int32_t index) {
  const Eigen::Vector2d here = local_position(index);
  Node best{0.0F, 0.0F, std::numeric_limits<float>::infinity(), kUnseen};
  double lowest = std::numeric_limits<double>::infinity();
  const auto try_parent = [&](const Node& parent, bool surely_in_view) {
    const double cost = cost_at(parent, here);
    if (!(cost < lowest) || !(surely_in_view || in_view(map, index, parent))) return;
    lowest = cost;
    best = parent;
  };
  for_neighbours(index, [&](std::int32_t next) {
    if (wavefront_.state[static_cast<std::size_t>(next)] != settled) return;
    try_parent(parent_at(next, local_position(next)), true);
    // The corner itself lies between nodes, this one and the last in view, at the clearance.
    for (const Eigen::Vector2d& near :
         {local_position(next), Eigen::Vector2d{0.5 * (local_position(next) + here)}}) {
      const Node corner = parent_at(next, at_clearance(map, near));
      const Eigen::Vector2d corner_position{corner.parent_x, corner.parent_y};
      if (cost_at(corner, here) < lowest &&
          sees_position(map, wavefront_.nodes[static_cast<std::size_t>(next)], corner_position)) {
        try_parent(corner, false);
      }
    }
  });
  const Node failed = wavefront_.nodes[static_cast<std::size_t>(index)];
  std::int32_t last_tried = failed.parent_node;
  for_neighbours(index, [&](std::int32_t next) {
    const Node& parent = wavefront_.nodes[static_cast<std::size_t>(next)];
    if (wavefront_.state[static_cast<std::size_t>(next)] != settled ||
        parent.parent_node == failed.parent_node)
      return;
    if (parent.parent_node == last_tried) return;
    last_tried = parent.parent_node;
    try_parent(parent, false);
  });
  wavefront_.nodes[static_cast<std::size_t>(index)] = best;
}

// A position in view of a node's parent as a parent of its own.
CostToGo::Node CostToGo::parent_at(std::int32_t index, const Eigen::Vector2d& local) const {
  const double cost = cost_at(wavefront_.nodes[static_cast<std::size_t>(index)], local);
  return {static_cast<float>(local.x()), static_cast<float>(local.y()), static_cast<float>(cost), index};
}

// The nearby position that just keeps the clearance.
Eigen::Vector2d CostToGo::at_clearance(const OccupancyMap& map, const Eigen::Vector2d& local) const {
  Eigen::Vector2d position = window_.origin_world + local;
  for (int step = 0; step < 2; ++step) {
    const double excess = map.distance(position) - clearance_;
    position -= std::clamp(excess, -window_.resolution, window_.resolution) * map.distance_gradient(position);
  }
  return position - window_.origin_world;
}

// A node that the wavefront did not reach takes the parent of the nearest node that it did, with a surcharge
// for every metre of depth beyond the first cells. Nearest, not cheapest, so that the two faces of a wall
// keep their own costs.
void CostToGo::extend_over_blocked_ground() {
  wavefront_.queue.clear();
  wavefront_.nearest_reached.assign(wavefront_.nodes.size(), kUnseen);
  const std::int32_t count = static_cast<std::int32_t>(wavefront_.nodes.size());
  for (std::int32_t index = 0; index < count; ++index) {
    if (wavefront_.state[static_cast<std::size_t>(index)] != settled) continue;
    wavefront_.nearest_reached[static_cast<std::size_t>(index)] = index;
    wavefront_.queue.push_back(index);
  }
  if (wavefront_.queue.empty()) {  // not even the goal's neighbours: straight lines, all of them surcharged
    const Eigen::Vector2d local = goal_used_ - window_.origin_world;
    const Node goal{static_cast<float>(local.x()), static_cast<float>(local.y()), 0.0F, kBlocked};
    std::fill(wavefront_.nodes.begin(), wavefront_.nodes.end(), goal);
    return;
  }
  for (std::size_t head = 0; head < wavefront_.queue.size(); ++head) {
    const std::int32_t nearest_reached =
        wavefront_.nearest_reached[static_cast<std::size_t>(wavefront_.queue[head])];
    const Eigen::Vector2d nearest_position = local_position(nearest_reached);
    for_neighbours(wavefront_.queue[head], [&](std::int32_t next) {
      std::int32_t& known = wavefront_.nearest_reached[static_cast<std::size_t>(next)];
      if (known == next || known == nearest_reached) return;
      const double depth = (local_position(next) - nearest_position).squaredNorm();
      if (known != kUnseen && depth >= (local_position(next) - local_position(known)).squaredNorm()) return;
      known = nearest_reached;
      wavefront_.queue.push_back(next);
    });
  }
  const double free_depth = 1.5 * window_.resolution;
  for (std::int32_t index = 0; index < count; ++index) {
    const std::int32_t nearest_reached = wavefront_.nearest_reached[static_cast<std::size_t>(index)];
    if (nearest_reached == index) continue;
    Node node = wavefront_.nodes[static_cast<std::size_t>(nearest_reached)];
    const double depth =
        std::max((local_position(index) - local_position(nearest_reached)).norm() - free_depth, 0.0);
    node.parent_cost += static_cast<float>((kBlockedFactor - 1.0) * depth);
    node.parent_node = kBlocked - 1 - nearest_reached;
    wavefront_.nodes[static_cast<std::size_t>(index)] = node;
  }
}

// Stores each distinct parent once: whole regions share one, so nearly every node has that of a neighbour.
void CostToGo::keep(const OccupancyMap& map) {
  constexpr std::size_t kMostParents = std::size_t{1} << 16;
  parent_of_.clear();
  parent_of_.reserve(wavefront_.nodes.size());
  const auto count = static_cast<std::int32_t>(wavefront_.nodes.size());
  for (std::int32_t index = 0; index < count; ++index) {
    const std::optional<std::uint16_t> known = kept_beside(index);
    if (!known && parents_.size() == kMostParents) {
      parent_of_.clear();
      parents_ = wavefront_.nodes;
      break;
    }
    parent_of_.push_back(known.value_or(static_cast<std::uint16_t>(parents_.size())));
    if (!known) parents_.push_back(wavefront_.nodes[static_cast<std::size_t>(index)]);
  }
  if (map.sensed()) return;
  wavefront_ = {};
  parents_.shrink_to_fit();
}

/// Index of the stored parent of an earlier neighbour, when it is this node's too.
std::optional<std::uint16_t> CostToGo::kept_beside(std::int32_t index) const {
  const Node& node = wavefront_.nodes[static_cast<std::size_t>(index)];
  const int column = index % window_.width;
  const auto same = [&](std::int32_t beside) {
    const Node& other = wavefront_.nodes[static_cast<std::size_t>(beside)];
    return other.parent_node == node.parent_node && other.parent_x == node.parent_x &&
           other.parent_y == node.parent_y && other.parent_cost == node.parent_cost;
  };
  const std::int32_t below = index - window_.width;
  if (column > 0 && same(index - 1)) return parent_of_[static_cast<std::size_t>(index - 1)];
  if (below < 0) return std::nullopt;
  for (int step : {0, -1, 1}) {
    if (column + step < 0 || column + step >= window_.width) continue;
    if (same(below + step)) return parent_of_[static_cast<std::size_t>(below + step)];
  }
  return std::nullopt;
}

// Rings of map nodes around the wanted position; the position itself when it keeps the clearance.
std::optional<Eigen::Vector2d> CostToGo::nearest_free_position(const OccupancyMap& map,
                                                               const Eigen::Vector2d& wanted) const {
  const GridFrame& frame = map.frame();
  const Eigen::Vector2d high = frame.node_position(frame.width - 1, frame.height - 1);
  const bool inside =
      (wanted.array() >= frame.origin_world.array()).all() && (wanted.array() <= high.array()).all();
  if (inside && map.distance(wanted) >= clearance_) return wanted;
  const Eigen::Vector2i centre = frame.nearest_node(wanted);
  std::optional<Eigen::Vector2d> best;
  double nearest = std::numeric_limits<double>::infinity();
  const auto look = [&](int i, int j) {
    if (!frame.contains(i, j) || map.node_distance(i, j) < clearance_) return;
    const double distance = (frame.node_position(i, j) - wanted).norm();
    if (distance >= nearest) return;
    nearest = distance;
    best = frame.node_position(i, j);
  };
  const double off_centre = (frame.node_position(centre.x(), centre.y()) - wanted).norm();
  const int last_ring = std::max(frame.width, frame.height);
  for (int ring = 0; ring <= last_ring; ++ring) {
    if (ring * frame.resolution > nearest + off_centre) break;  // no later ring can come nearer
    for (int k = -ring; k <= ring; ++k) {
      look(centre.x() + k, centre.y() - ring);
      look(centre.x() + k, centre.y() + ring);
      look(centre.x() - ring, centre.y() + k);
      look(centre.x() + ring, centre.y() + k);
    }
  }
  return best;
}

}  // namespace spf
