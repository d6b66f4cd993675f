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

}  // namespace

// A node that the wavefront did not reach takes the parent of the nearest node that it did, with a surcharge
// for every metre of depth beyond the first cells. Nearest, not cheapest, so that the two faces of a wall
// keep their own costs.
void CostToGo::extend_over_blocked_ground() {
  wavefront_.queue.clear();
  wavefront_.nearest_reached.assign(wavefront_.nodes.size(), kUnseen);
  const std::int32_t count = window_count();
  for (std::int32_t index = 0; index < count; ++index) {
    if (!settled_at(index)) continue;
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
  moved_.clear();
  bends_.clear();
  if (map.sensed()) return;
  keep_places();
  wavefront_ = {};
  parents_.shrink_to_fit();
}

void CostToGo::keep_places() {
  const double unit = kMovedUnit * window_.resolution;
  for (std::size_t index = 0; index < wavefront_.place.size(); ++index) {
    const auto node = static_cast<std::int32_t>(index);
    const Eigen::Vector2f& place = wavefront_.place[index];
    if (node >= window_count()) {
      bends_.push_back(place);
      continue;
    }
    const Eigen::Vector2d offset = (place.cast<double>() - grid_position(node)) / unit;
    const auto x = static_cast<std::int16_t>(std::lround(offset.x()));
    const auto y = static_cast<std::int16_t>(std::lround(offset.y()));
    if (x != 0 || y != 0) moved_.push_back({node, x, y});
  }
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
