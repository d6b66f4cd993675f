// The end of CostToGo's update: blocked ground, and what is kept of the wavefront. Its beginning: a free
// goal.
#include <algorithm>
#include <cmath>
#include <limits>

#include "spf/planning/cost_to_go.hpp"

namespace spf {
namespace {

constexpr double kBlockedFactor =
    3.0;  // [1] about the cost of a metre on blocked ground, where no path leads
constexpr std::int64_t kVisitWork = 2;

}  // namespace

void CostToGo::enter_reached(std::int32_t index) {
  if (!settled_at(index)) return;
  wavefront_.nearest_reached[static_cast<std::size_t>(index)] = index;
  wavefront_.queue.push_back(index);
}

// A node that the wavefront did not reach takes the parent of the nearest node that it did, with a surcharge
// for every metre of depth beyond the first cells. Nearest, not cheapest, so that the two faces of a wall
// keep their own costs.
bool CostToGo::find_nearest() {
  for (; static_cast<std::size_t>(progress_.next) < wavefront_.queue.size(); ++progress_.next) {
    if (tired()) return false;
    ++work_;
    const std::int32_t here = wavefront_.queue[static_cast<std::size_t>(progress_.next)];
    const std::int32_t nearest_reached = wavefront_.nearest_reached[static_cast<std::size_t>(here)];
    const Eigen::Vector2d nearest_position = local_position(nearest_reached);
    for_neighbours(here, [&](std::int32_t next) {
      std::int32_t& known = wavefront_.nearest_reached[static_cast<std::size_t>(next)];
      if (known == next || known == nearest_reached) return;
      const double depth = (local_position(next) - nearest_position).squaredNorm();
      if (known != kUnseen && depth >= (local_position(next) - local_position(known)).squaredNorm()) return;
      known = nearest_reached;
      wavefront_.queue.push_back(next);
      work_ += kVisitWork;
    });
  }
  return true;
}

void CostToGo::extend(std::int32_t index) {
  Node& node = wavefront_.nodes[static_cast<std::size_t>(index)];
  const std::int32_t nearest_reached = wavefront_.nearest_reached[static_cast<std::size_t>(index)];
  if (nearest_reached == index) return;
  if (nearest_reached == kUnseen) {  // not even the goal's neighbours: straight lines, all of them surcharged
    const Eigen::Vector2d local = goal_used_ - window_.origin_world;
    node = {static_cast<float>(local.x()), static_cast<float>(local.y()), 0.0F, kBlocked};
    return;
  }
  work_ += kVisitWork;
  const double free_depth = 1.5 * window_.resolution;
  node = wavefront_.nodes[static_cast<std::size_t>(nearest_reached)];
  const double depth =
      std::max((local_position(index) - local_position(nearest_reached)).norm() - free_depth, 0.0);
  node.parent_cost += static_cast<float>((kBlockedFactor - 1.0) * depth);
  node.parent_node = kBlocked - 1 - nearest_reached;
}

// Stores each distinct parent once: whole regions share one, so nearly every node has that of a neighbour.
bool CostToGo::keep_parents() {
  constexpr std::size_t kMostParents = std::size_t{1} << 16;
  const auto count = static_cast<std::int32_t>(wavefront_.nodes.size());
  return for_nodes(count, [&](std::int32_t index) {
    if (index == 0) parents_.clear();
    if (parent_of_.size() != static_cast<std::size_t>(index)) return;  // too many: by node itself
    const std::optional<std::uint16_t> known = kept_beside(index);
    if (!known && parents_.size() == kMostParents) {
      parent_of_.clear();
      parents_ = wavefront_.nodes;
      return;
    }
    parent_of_.push_back(known.value_or(static_cast<std::uint16_t>(parents_.size())));
    if (!known) parents_.push_back(wavefront_.nodes[static_cast<std::size_t>(index)]);
  });
}

void CostToGo::keep_position(std::int32_t index) {
  const Eigen::Vector2f& position = wavefront_.position[static_cast<std::size_t>(index)];
  if (index >= window_count()) {
    bends_.push_back(position);
    return;
  }
  const double unit = kMovedUnit * window_.resolution;
  const Eigen::Vector2d offset = (position.cast<double>() - grid_position(index)) / unit;
  const auto x = static_cast<std::int16_t>(std::lround(offset.x()));
  const auto y = static_cast<std::int16_t>(std::lround(offset.y()));
  if (x != 0 || y != 0) moved_.push_back({index, x, y});
}

void CostToGo::free_memory(const OccupancyMap& map) {
  if (map.sensed()) return;
  wavefront_ = {};
  parents_.shrink_to_fit();
  moved_.shrink_to_fit();
}

/// Index of the stored parent of an earlier neighbour, when it is this node's too.
std::optional<std::uint16_t> CostToGo::kept_beside(std::int32_t index) const {
  const Node& node = wavefront_.nodes[static_cast<std::size_t>(index)];
  if (index >= window_count()) return std::nullopt;  // at a bend: nobody's neighbour
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
  const auto room = [&] { return narrow() ? map.exact_distance(wanted) : map.distance(wanted); };
  if (inside && room() >= least_clearance_) return wanted;
  const Eigen::Vector2i centre = frame.nearest_node(wanted);
  std::optional<Eigen::Vector2d> best;
  double nearest = std::numeric_limits<double>::infinity();
  const auto look = [&](int i, int j) {
    if (!frame.contains(i, j) || map.node_distance(i, j) < least_clearance_) return;
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
