#include "spf/planning/field/grid_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace spf {
namespace {

constexpr double kDiagonal = 1.41421356237309504880;

}  // namespace

GridSearch::GridSearch(const GridSearchParameters& parameters) : parameters_{validated(parameters)} {
  const auto nodes = static_cast<std::size_t>(parameters_.window_nodes);
  seen_in_.assign(nodes, 0);
  cost_.resize(nodes);
  parent_.resize(nodes);
  closed_.resize(nodes);
  path_.reserve(std::min(nodes, static_cast<std::size_t>(parameters_.node_budget) + 1));
  // Every expanded node pushes at most 8 entries; a search ends before the heap outgrows this.
  heap_.reserve(8 * std::min(nodes, static_cast<std::size_t>(parameters_.node_budget)) + 1);
}

GridSearchResult GridSearch::search(const OccupancyMap& map, const GridSearchRequest& request) {
  GridSearchResult result;
  path_.clear();
  heap_.clear();
  result.outcome = GridSearchOutcome::blocked_end;
  if (!request.start_world.allFinite() || !request.goal_world.allFinite()) return result;
  clearance_ = request.clearance;
  resolution_ = map.frame().resolution;
  if (!place_window(map, request)) {
    result.outcome = GridSearchOutcome::window_too_large;
    return result;
  }
  const std::int32_t start = nearest_free(map, request.start_world);
  const std::int32_t goal = nearest_free(map, request.goal_world);
  if (start < 0 || goal < 0) return result;

  if (++generation_ == 0) {
    std::fill(seen_in_.begin(), seen_in_.end(), 0U);
    generation_ = 1;
  }
  offer(start, -1, 0.0F, goal);
  result.outcome = GridSearchOutcome::no_path;
  const auto costlier = [](const Entry& a, const Entry& b) { return a.total > b.total; };
  while (!heap_.empty()) {
    std::pop_heap(heap_.begin(), heap_.end(), costlier);
    const Entry entry = heap_.back();
    heap_.pop_back();
    std::uint8_t& closed = closed_[static_cast<std::size_t>(entry.node)];
    if (closed) continue;  // an older, costlier entry
    closed = 1;
    if (entry.node == goal) {
      result.outcome = GridSearchOutcome::found;
      result.cost = static_cast<double>(entry.cost);
      trace_back(map, goal);
      return result;
    }
    if (result.expanded == parameters_.node_budget) {
      result.outcome = GridSearchOutcome::budget_exhausted;
      return result;
    }
    ++result.expanded;
    expand(map, entry, goal);
  }
  return result;
}

bool GridSearch::place_window(const OccupancyMap& map, const GridSearchRequest& request) {
  const GridFrame& frame = map.frame();
  Eigen::Vector2i low{0, 0};
  Eigen::Vector2i high{frame.width - 1, frame.height - 1};
  if (request.window_margin) {
    const Eigen::Vector2d margin = Eigen::Vector2d::Constant(*request.window_margin);
    low = frame.nearest_node(request.start_world.cwiseMin(request.goal_world) - margin);
    high = frame.nearest_node(request.start_world.cwiseMax(request.goal_world) + margin);
  }
  window_ = {low.x(), low.y(), high.x() - low.x() + 1, high.y() - low.y() + 1};
  return static_cast<std::int64_t>(window_.width) * window_.height <= parameters_.window_nodes;
}

double GridSearch::node_distance(const OccupancyMap& map, std::int32_t node) const {
  return map.node_distance(window_.low_i + node % window_.width, window_.low_j + node / window_.width);
}

// Rings of nodes around the wanted position; -1 when none is free within push_distance.
std::int32_t GridSearch::nearest_free(const OccupancyMap& map, const Eigen::Vector2d& wanted) const {
  const Eigen::Vector2i centre = map.frame().nearest_node(wanted);
  const int reach = static_cast<int>(std::ceil(parameters_.push_distance / resolution_)) + 1;
  // The nearest node itself is no push, though it may be half a cell's diagonal away.
  double nearest = std::max(parameters_.push_distance, 0.7072 * resolution_);
  std::int32_t best = -1;
  for (int ring = 0; ring <= reach && (ring - 1) * resolution_ <= nearest; ++ring) {
    for (int dj = -ring; dj <= ring; ++dj) {
      const int stride = std::abs(dj) == ring ? 1 : std::max(2 * ring, 1);
      for (int di = -ring; di <= ring; di += stride) {
        const int i = centre.x() + di - window_.low_i;
        const int j = centre.y() + dj - window_.low_j;
        if (i < 0 || j < 0 || i >= window_.width || j >= window_.height) continue;
        const std::int32_t node = j * window_.width + i;
        const double away = (map.node_position(centre.x() + di, centre.y() + dj) - wanted).norm();
        if (away > nearest || node_distance(map, node) < clearance_) continue;
        nearest = away;
        best = node;
      }
    }
  }
  return best;
}

// Octile distance: never more than the cost. A little is taken off, so that rounding does not make it so.
float GridSearch::estimate(std::int32_t from, std::int32_t to) const {
  const int di = std::abs(from % window_.width - to % window_.width);
  const int dj = std::abs(from / window_.width - to / window_.width);
  const double cells = std::max(di, dj) + (kDiagonal - 1.0) * std::min(di, dj);
  return static_cast<float>((1.0 - 1e-5) * resolution_ * cells);
}

void GridSearch::expand(const OccupancyMap& map, const Entry& entry, std::int32_t goal) {
  const int i = entry.node % window_.width;
  const int j = entry.node / window_.width;
  for (int dj = -1; dj <= 1; ++dj) {
    for (int di = -1; di <= 1; ++di) {
      const bool inside = i + di >= 0 && j + dj >= 0 && i + di < window_.width && j + dj < window_.height;
      if (!inside || (di == 0 && dj == 0)) continue;
      const std::int32_t node = (j + dj) * window_.width + i + di;
      const double distance = node_distance(map, node);
      if (distance < clearance_) continue;
      const double length = resolution_ * (di != 0 && dj != 0 ? kDiagonal : 1.0);
      offer(node, entry.node, entry.cost + static_cast<float>(length), goal);
    }
  }
}

void GridSearch::offer(std::int32_t node, std::int32_t parent, float cost, std::int32_t goal) {
  const auto slot = static_cast<std::size_t>(node);
  if (seen_in_[slot] == generation_) {
    if (closed_[slot] || cost >= cost_[slot]) return;
  } else {
    seen_in_[slot] = generation_;
    closed_[slot] = 0;
  }
  cost_[slot] = cost;
  parent_[slot] = parent;
  heap_.push_back({cost + estimate(node, goal), cost, node});
  std::push_heap(heap_.begin(), heap_.end(),
                 [](const Entry& a, const Entry& b) { return a.total > b.total; });
}

void GridSearch::trace_back(const OccupancyMap& map, std::int32_t goal) {
  for (std::int32_t node = goal; node >= 0; node = parent_[static_cast<std::size_t>(node)]) {
    path_.push_back(
        map.node_position(window_.low_i + node % window_.width, window_.low_j + node / window_.width));
  }
  std::reverse(path_.begin(), path_.end());
}

}  // namespace spf
