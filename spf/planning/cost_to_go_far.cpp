// The guide of a goal that is far: a coarse field over the whole path, and a fine one around the robot that
// starts from it.
#include <algorithm>
#include <array>
#include <cmath>

#include "spf/planning/cost_to_go.hpp"

namespace spf {
namespace {

constexpr double kMostNodes = 60'000.0;        // of one fine field over all
constexpr double kMostFarNodes = 16'000.0;     // of a coarse one
constexpr double kNearSide = 120.0;            // [nodes] of the fine one around the robot
constexpr double kLeave = 0.2;                 // [1] of that side from its middle: time for another
constexpr std::uint64_t kMostRevisions = 200;  // of the map, for a far field

/// [m] Of the part of a rectangle that is on the map.
Eigen::Vector2d size_on(const OccupancyMap& map, const Eigen::Vector2d& low, const Eigen::Vector2d& high) {
  const GridFrame& frame = map.frame();
  const Eigen::Vector2d map_high = frame.node_position(frame.width - 1, frame.height - 1);
  return (high.cwiseMin(map_high) - low.cwiseMax(frame.origin_world)).cwiseMax(0.0);
}

double nodes_in(const Eigen::Vector2d& size, double spacing) {
  return (size / spacing).array().ceil().prod();
}

}  // namespace

/// Whether a rectangle is too large for one field; then begins the far one, and sets the window of the near
/// one.
bool CostToGo::splits(const OccupancyMap& map, const Eigen::Vector2d& low, const Eigen::Vector2d& high) {
  if (is_far_field_ || progress_.fine) return false;
  const double spacing = spacing_on(map);
  if (nodes_in(size_on(map, low, high), spacing) <= kMostNodes) return false;
  if (!far_field_) {
    far_field_ = std::make_shared<CostToGo>(anew());
    far_field_->is_far_field_ = true;
    far_field_->begin(map, goal_used_, progress_.robot_world);
  }
  const Eigen::Vector2d half = Eigen::Vector2d::Constant(0.5 * kNearSide * spacing);
  set_window(map, progress_.robot_world - half, progress_.robot_world + half);
  return true;
}

void CostToGo::share_far_field(const CostToGo& other) {
  far_field_ = other.far_field_;
}

/// Whether the far field at hand, if any, still holds: for this goal, for a robot there, and on this map, on
/// which its path must be free beyond the near field.
bool CostToGo::far_field_holds(const OccupancyMap& map) const {
  if (!far_field_ || !far_field_->ready() || far_field_->goal_asked_ != goal_used_ ||
      !far_field_->window_covers(progress_.robot_world))
    return false;
  if (map.revision() == far_field_->map_revision_) return true;
  if (map.revision() > far_field_->map_revision_ + kMostRevisions) return false;
  std::vector<Eigen::Vector2d> path;
  far_field_->shortest_path(progress_.robot_world, path);
  if (path.size() < 2) return true;
  const double first = (path[1] - path[0]).norm();
  const double near = std::min(0.5 * kNearSide * spacing_on(map), first);
  if (first > 0.0) path[0] += near / first * (path[1] - path[0]);
  for (std::size_t i = 1; i < path.size(); ++i)
    if (!far_field_->passable(map, path[i - 1], path[i])) return false;
  return true;
}

/// The spacing with which a far field covers a rectangle.
void CostToGo::coarsen(const OccupancyMap& map, const Eigen::Vector2d& low, const Eigen::Vector2d& high) {
  const Eigen::Vector2d size = size_on(map, low, high);
  while (nodes_in(size, parameters_.resolution) > kMostFarNodes) parameters_.resolution *= 2.0;
}

bool CostToGo::advance_far_field(const OccupancyMap& map) {
  CostToGo& far = *far_field_;
  const bool done = far.advance(map, progress_.limit - work_);
  work_ += far.work_;
  if (!done) return false;
  if (far.outcome() == CostToGoOutcome::reachable || far.outcome() == CostToGoOutcome::goal_moved) {
    clear_nodes();
  } else {
    progress_.fine = true;  // it may be too coarse
    open_window(map);
  }
  return true;
}

/// The nodes at the window's edge, counted round it.
std::int32_t CostToGo::edge_node(std::int32_t along) const {
  const std::int32_t width = window_.width;
  if (along < 2 * width) return window_.index(along % width, along < width ? 0 : window_.height - 1);
  const std::int32_t beside = along - 2 * width;
  return window_.index(beside % 2 == 0 ? 0 : width - 1, 1 + beside / 2);
}

/// The cheapest in view of the far field's nodes around a node, and of their parents, becomes its parent.
/// Only what lies outside: within the window the far field knows too little.
void CostToGo::seed_from_far_field(const OccupancyMap& map, std::int32_t index) {
  if (!free_at(index)) return;
  const CostToGo& far = *far_field_;
  const Eigen::Vector2d here = local_position(index);
  const Eigen::Vector2d shift = far.window_.origin_world - window_.origin_world;
  std::array<Node, 8> parents;
  std::size_t count = 0;
  const auto add = [&](const Eigen::Vector2d& corner, double cost) {
    if (window_covers(corner + window_.origin_world)) return;
    parents[count++] = {static_cast<float>(corner.x()), static_cast<float>(corner.y()),
                        static_cast<float>(cost), kGoal};
  };
  for (const std::int32_t beside : far.nodes_around(here + window_.origin_world)) {
    const Node& node = far.node_at(beside);
    if (on_blocked_ground(node)) continue;
    add(Eigen::Vector2d{node.parent_x, node.parent_y} + shift, static_cast<double>(node.parent_cost));
    add(far.local_position(beside) + shift, static_cast<double>(far.own_cost(node, beside)));
  }
  const auto end = parents.begin() + static_cast<std::ptrdiff_t>(count);
  for (auto rest = parents.begin(); rest != end; ++rest) {
    std::iter_swap(rest, std::min_element(rest, end, [&](const Node& a, const Node& b) {
                     return cost_at(a, here) < cost_at(b, here);
                   }));
    if (!view(map, here, {rest->parent_x, rest->parent_y})) continue;
    offer(index, *rest);
    return;
  }
}

bool CostToGo::leaves_near_field(const Eigen::Vector2d& robot_world) const {
  if (!far_field_) return false;
  const double side = kNearSide * window_.resolution;
  return (robot_world - progress_.robot_world).lpNorm<Eigen::Infinity>() > kLeave * side;
}

/// The far field, for a position that the near one does not reach; null: this one tells.
const CostToGo* CostToGo::beyond(const Eigen::Vector2d& position_world) const {
  return far_field_ && !window_covers(position_world) ? far_field_.get() : nullptr;
}

}  // namespace spf
