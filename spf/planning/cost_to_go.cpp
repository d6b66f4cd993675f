#include "spf/planning/cost_to_go.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "spf/math/plane.hpp"

namespace spf {
namespace {

constexpr double kBesideLine = 0.5;  // [1] of the resolution: no farther, a position is on a straight line
constexpr int kJustPassed = 4;       // corners at most that are so near that they may lie behind

}  // namespace

/// The four nodes around a position and their weights.
struct CostToGo::Cell {
  Eigen::Vector2d local;  // [m] from the window's origin
  std::array<std::int32_t, 4> node;
  std::array<double, 4> weight;
  double x, y;              // [cells] from the first node
  double outside;           // [m] distance to the window
  Eigen::Vector2d outward;  // unit vector away from the window, zero inside
};

CostToGo::CostToGo(const CostToGoParameters& parameters, double robot_radius, double least_margin)
    : parameters_{validated(parameters)},
      clearance_{parameters.clearance + robot_radius},
      least_clearance_{robot_radius + std::min(parameters.clearance, least_margin)} {}

CostToGo CostToGo::anew() const {
  CostToGo fresh{parameters_};
  fresh.clearance_ = clearance_;
  fresh.least_clearance_ = least_clearance_;
  return fresh;
}

void CostToGo::set_standing(const std::vector<StandingDisc>& discs, double speed) {
  standing_ = discs;
  standing_speed_ = speed;
}

Eigen::Vector2d CostToGo::grid_position(std::int32_t index) const {
  return window_.resolution * Eigen::Vector2d{index % window_.width, index / window_.width};
}

Eigen::Vector2d CostToGo::local_position(std::int32_t index) const {
  if (!wavefront_.position.empty())
    return wavefront_.position[static_cast<std::size_t>(index)].cast<double>();
  if (index >= window_count()) return bends_[static_cast<std::size_t>(index - window_count())].cast<double>();
  const auto by_node = [](const Moved& moved, std::int32_t wanted) { return moved.node < wanted; };
  const auto moved = std::lower_bound(moved_.begin(), moved_.end(), index, by_node);
  if (moved == moved_.end() || moved->node != index) return grid_position(index);
  return grid_position(index) + kMovedUnit * window_.resolution * Eigen::Vector2d{moved->x, moved->y};
}

double CostToGo::cost_at(const Node& node, const Eigen::Vector2d& local) const {
  const double dx = local.x() - static_cast<double>(node.parent_x);
  const double dy = local.y() - static_cast<double>(node.parent_y);
  return static_cast<double>(node.parent_cost) + std::sqrt(dx * dx + dy * dy);
}

// ---- queries

CostToGo::Cell CostToGo::cell_of(const Eigen::Vector2d& position_world) const {
  Cell cell;
  const Eigen::Vector2d asked = position_world - window_.origin_world;
  const double width = window_.resolution * (window_.width - 1);
  const double height = window_.resolution * (window_.height - 1);
  // With this order of arguments NaN becomes 0.
  cell.local = {std::min(std::max(0.0, asked.x()), width), std::min(std::max(0.0, asked.y()), height)};
  const Eigen::Vector2d beyond = asked - cell.local;
  cell.outside = beyond.norm();
  cell.outward = cell.outside > 0.0 ? Eigen::Vector2d{beyond / cell.outside} : Eigen::Vector2d{0.0, 0.0};
  const double per_metre = 1.0 / window_.resolution;
  const double u = cell.local.x() * per_metre;
  const double v = cell.local.y() * per_metre;
  const int i = std::min(static_cast<int>(u), window_.width - 2);
  const int j = std::min(static_cast<int>(v), window_.height - 2);
  const double x = cell.x = u - i;
  const double y = cell.y = v - j;
  const std::int32_t first = window_.index(i, j);
  cell.node = {first, first + 1, first + window_.width, first + window_.width + 1};
  cell.weight = {(1.0 - x) * (1.0 - y), x * (1.0 - y), (1.0 - x) * y, x * y};
  return cell;
}

std::array<std::int32_t, 4> CostToGo::nodes_around(const Eigen::Vector2d& position_world) const {
  return cell_of(position_world).node;
}

double CostToGo::cost_to_go(const Eigen::Vector2d& position_world) const {
  if (const CostToGo* far = beyond(position_world)) return far->cost_to_go(position_world);
  const Cell cell = cell_of(position_world);
  double cost = cell.outside;
  for (std::size_t k = 0; k < 4; ++k) {
    cost += cell.weight[k] * cost_at(node_at(cell.node[k]), cell.local);
  }
  return cost;
}

Eigen::Vector2d CostToGo::cost_gradient(const Eigen::Vector2d& position_world) const {
  if (const CostToGo* far = beyond(position_world)) return far->cost_gradient(position_world);
  const Cell cell = cell_of(position_world);
  if (cell.outside > 0.0) return cell.outward;
  const double per_metre = 1.0 / window_.resolution;
  const Eigen::Vector2d slope[4] = {per_metre * Eigen::Vector2d{cell.y - 1.0, cell.x - 1.0},
                                    per_metre * Eigen::Vector2d{1.0 - cell.y, -cell.x},
                                    per_metre * Eigen::Vector2d{-cell.y, 1.0 - cell.x},
                                    per_metre * Eigen::Vector2d{cell.y, cell.x}};  // of the weights [1/m]
  Eigen::Vector2d gradient = Eigen::Vector2d::Zero();
  for (std::size_t k = 0; k < 4; ++k) {
    const Node& node = node_at(cell.node[k]);
    gradient += cost_at(node, cell.local) * slope[k];
    const Eigen::Vector2d from_parent = cell.local - Eigen::Vector2d{node.parent_x, node.parent_y};
    const double length = from_parent.norm();
    if (length > 0.0) gradient += cell.weight[k] / length * from_parent;
  }
  return gradient;
}

Eigen::Vector2d CostToGo::direction(const Eigen::Vector2d& position_world) const {
  constexpr double kArrived = 1e-4;  // [m] parents are kept as floats
  if ((position_world - goal_used_).squaredNorm() < kArrived * kArrived) return {0.0, 0.0};
  const Eigen::Vector2d gradient = cost_gradient(position_world);
  const double length = gradient.norm();
  return length > 1e-9 ? Eigen::Vector2d{-gradient / length} : Eigen::Vector2d{0.0, 0.0};
}

/// Whether a corner has just been passed on the way to the parent of a node there. A node off its
/// grid position may lie behind the positions of its cell.
bool CostToGo::passed(const Eigen::Vector2d& corner, std::int32_t index, const Eigen::Vector2d& local) const {
  if (!narrow() || is_far_field_ || index < 0) return false;
  const Node& node = node_at(index);
  const Eigen::Vector2d offset = local - corner;
  const Eigen::Vector2d onwards = Eigen::Vector2d{node.parent_x, node.parent_y} - corner;
  const double along = offset.dot(onwards);
  const double far = offset.norm() / window_.resolution;
  if (far < 1.0) return onwards.isZero() || along > 0.0;
  const double beside = std::fabs(cross(offset, onwards));
  return far < 2.0 && along > 0.0 && beside < kBesideLine * window_.resolution * onwards.norm();
}

/// The corners of the far field are no nodes of this one, and told apart by their positions.
bool CostToGo::same_parent(const Node& a, const Node& b) const {
  return a.parent_node == b.parent_node &&
         (!far_field_ || (a.parent_x == b.parent_x && a.parent_y == b.parent_y));
}

std::int32_t CostToGo::best_corner(const Cell& cell) const {
  std::int32_t best = cell.node[0];
  double lowest = std::numeric_limits<double>::infinity();
  for (const std::int32_t index : cell.node) {
    const double cost =
        (cell.local - local_position(index)).norm() + static_cast<double>(own_cost(node_at(index), index));
    if (cost < lowest) {
      lowest = cost;
      best = index;
    }
  }
  return best;
}

// Calls visit(position in the window) for the position itself and every corner until visit returns false.
template <class Visit>
void CostToGo::walk(const Eigen::Vector2d& position_world, const Visit& visit) const {
  const Cell cell = cell_of(position_world);
  if (!visit(Eigen::Vector2d{position_world - window_.origin_world})) return;
  if (cell.outside > 0.0 && !visit(cell.local)) return;
  const std::int32_t corner = best_corner(cell);
  const bool agreed = std::all_of(cell.node.begin(), cell.node.end(), [&](std::int32_t index) {
    return same_parent(node_at(index), node_at(corner));
  });
  // Calls look(corner, its node) for the corners from here on, until it returns false. Costs fall from parent
  // to parent, so this ends at the goal.
  const auto follow = [&](const auto& look) {
    const Node& first = node_at(corner);
    std::int32_t index = corner;
    // Where the four nodes have different parents, the straight line from here to one of these may clip an
    // edge.
    if (!agreed && !on_blocked_ground(first) && !look(local_position(corner), corner)) return;
    if (on_blocked_ground(first) && first.parent_node != kBlocked) {
      index = nearest_reached_of(first);
      if (!look(local_position(index), index)) return;
    }
    while (index >= 0) {
      const Node& node = node_at(index);
      const Eigen::Vector2d parent{node.parent_x, node.parent_y};
      index = node.parent_node;
      if (!look(parent, index)) return;
    }
  };
  int looked = 0;
  int last_passed = 0;
  follow([&](const Eigen::Vector2d& node, std::int32_t index) {
    ++looked;
    if (passed(node, index, cell.local)) last_passed = looked;
    return narrow() && looked < kJustPassed;
  });
  int count = 0;
  follow([&](const Eigen::Vector2d& node, std::int32_t) { return ++count <= last_passed || visit(node); });
}

Eigen::Vector2d CostToGo::descend(const Eigen::Vector2d& position_world, double distance) const {
  if (!(distance > 0.0)) return position_world;
  if (const CostToGo* far = beyond(position_world)) return far->descend(position_world, distance);
  Eigen::Vector2d here = position_world - window_.origin_world;
  double remaining = distance;
  walk(position_world, [&](const Eigen::Vector2d& corner) {
    const double leg = (corner - here).norm();
    if (leg >= remaining) {
      if (leg > 0.0) here += remaining / leg * (corner - here);
      return false;
    }
    remaining -= leg;
    here = corner;
    return true;
  });
  return window_.origin_world + here;
}

void CostToGo::shortest_path(const Eigen::Vector2d& position_world,
                             std::vector<Eigen::Vector2d>& corners_world) const {
  if (const CostToGo* far = beyond(position_world)) {
    far->shortest_path(position_world, corners_world);
    return;
  }
  corners_world.clear();
  walk(position_world, [&](const Eigen::Vector2d& corner) {
    corners_world.push_back(window_.origin_world + corner);
    return true;
  });
}

bool CostToGo::reachable(const Eigen::Vector2d& position_world) const {
  if (const CostToGo* far = beyond(position_world)) return far->reachable(position_world);
  const Cell cell = cell_of(position_world);
  return cell.outside == 0.0 && std::any_of(cell.node.begin(), cell.node.end(), [this](std::int32_t index) {
           return !on_blocked_ground(node_at(index));
         });
}

bool CostToGo::window_covers(const Eigen::Vector2d& position_world) const {
  const Eigen::Vector2d local = position_world - window_.origin_world;
  return local.x() >= 0.0 && local.y() >= 0.0 && local.x() <= window_.resolution * (window_.width - 1) &&
         local.y() <= window_.resolution * (window_.height - 1);
}

bool CostToGo::outdated(const OccupancyMap& map, const Eigen::Vector2d& goal_world,
                        const Eigen::Vector2d& robot_world) const {
  return !ready() || goal_world != goal_asked_ || map.revision() != map_revision_ ||
         (!whole_map_ && !window_covers(robot_world)) || leaves_near_field(robot_world);
}

}  // namespace spf
