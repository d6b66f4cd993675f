#include "spf/planning/field/grid_search.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <utility>
#include <vector>

#include "spf/math/random_stream.hpp"

namespace spf {
namespace {

OccupancyMap cluttered_map(std::uint64_t seed, int discs) {
  OccupancyMap map{GridFrame::covering({-3.0, -3.0}, {3.0, 3.0}, 0.1), 1.5};
  RandomStream random{seed};
  for (int k = 0; k < discs; ++k) {
    const double x = random.uniform(-3.0, 3.0);
    map.add_disc({x, random.uniform(-3.0, 3.0)}, random.uniform(0.05, 0.5));
  }
  return map;
}

/// Oracle: plain Dijkstra in doubles over the same graph, by length.
double dijkstra(const OccupancyMap& map, const Eigen::Vector2i& start, const Eigen::Vector2i& goal,
                double clearance) {
  const int width = map.frame().width;
  const int height = map.frame().height;
  std::vector<double> cost(static_cast<std::size_t>(width * height), std::numeric_limits<double>::infinity());
  using Item = std::pair<double, int>;
  std::priority_queue<Item, std::vector<Item>, std::greater<>> open;
  const auto slot = [&](int i, int j) { return static_cast<std::size_t>(j * width + i); };
  cost[slot(start.x(), start.y())] = 0.0;
  open.emplace(0.0, start.y() * width + start.x());
  while (!open.empty()) {
    const auto [spent, node] = open.top();
    open.pop();
    const int i = node % width;
    const int j = node / width;
    if (spent > cost[slot(i, j)]) continue;
    for (int n = 0; n < 9; ++n) {
      const int di = n % 3 - 1;
      const int dj = n / 3 - 1;
      if (!map.frame().contains(i + di, j + dj) || map.node_distance(i + di, j + dj) < clearance) continue;
      const double next = spent + map.frame().resolution * std::hypot(di, dj);
      if (next >= cost[slot(i + di, j + dj)]) continue;
      cost[slot(i + di, j + dj)] = next;
      open.emplace(next, (j + dj) * width + i + di);
    }
  }
  return cost[slot(goal.x(), goal.y())];
}

TEST(GridSearch, FindsTheShortestPath) {
  GridSearch search;
  int found = 0;
  int none = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const OccupancyMap map = cluttered_map(seed, 20);
    GridSearchRequest request;
    request.clearance = 0.2;
    request.start_world = {-2.9, -2.9};
    request.goal_world = {2.9, 2.8};
    const GridSearchResult result = search.search(map, request);
    if (result.outcome == GridSearchOutcome::blocked_end) continue;
    // The ends that were used are those of the path; without one, any free ends would do: take the asked
    // ones.
    const Eigen::Vector2i start =
        map.nearest_node(search.path().empty() ? request.start_world : search.path().front());
    const Eigen::Vector2i goal =
        map.nearest_node(search.path().empty() ? request.goal_world : search.path().back());
    const double expected = dijkstra(map, start, goal, request.clearance);
    if (result.outcome == GridSearchOutcome::no_path) {
      EXPECT_EQ(expected, std::numeric_limits<double>::infinity()) << seed;
      ++none;
      continue;
    }
    ASSERT_EQ(result.outcome, GridSearchOutcome::found) << seed;
    EXPECT_NEAR(result.cost, expected, 2e-5 * expected) << seed;  // floats summed over some 100 steps
    double length = 0.0;
    for (std::size_t k = 0; k < search.path().size(); ++k) {
      const Eigen::Vector2i node = map.nearest_node(search.path()[k]);
      EXPECT_GE(map.node_distance(node.x(), node.y()), request.clearance);
      if (k > 0) length += (search.path()[k] - search.path()[k - 1]).norm();
    }
    EXPECT_LE(length, result.cost * (1.0 + 2e-5));
    ++found;
  }
  EXPECT_GT(found, 10);
  EXPECT_GT(none, 3);
}

TEST(GridSearch, MovesEndsToTheNearestFreeNodes) {
  OccupancyMap map{GridFrame::covering({-3.0, -3.0}, {3.0, 3.0}, 0.1), 1.5};
  map.add_disc({-2.0, 0.0}, 0.3);
  GridSearch search;
  GridSearchRequest request;
  request.start_world = {-1.83, 0.02};
  request.goal_world = {2.0, 0.0};
  ASSERT_EQ(search.search(map, request).outcome, GridSearchOutcome::found);
  double nearest = std::numeric_limits<double>::infinity();
  for (int j = 0; j < map.frame().height; ++j)
    for (int i = 0; i < map.frame().width; ++i)
      if (map.node_distance(i, j) >= request.clearance)
        nearest = std::min(nearest, (map.node_position(i, j) - request.start_world).norm());
  EXPECT_NEAR((search.path().front() - request.start_world).norm(), nearest, 1e-12);
  map.add_disc({-1.8, 0.0}, 1.2);
  EXPECT_EQ(search.search(map, request).outcome, GridSearchOutcome::blocked_end);
}

TEST(GridSearch, KeepsItsBudgetAndItsWindow) {
  OccupancyMap map{GridFrame::covering({-3.0, -3.0}, {3.0, 3.0}, 0.1), 1.5};
  map.add_box({-0.2, -2.0}, {0.2, 3.0});  // the detour leads far below
  GridSearchRequest request;
  request.start_world = {-1.0, 2.0};
  request.goal_world = {1.0, 2.0};
  GridSearchParameters parameters;
  parameters.node_budget = 50;
  GridSearch hasty{parameters};
  const GridSearchResult cut = hasty.search(map, request);
  EXPECT_EQ(cut.outcome, GridSearchOutcome::budget_exhausted);
  EXPECT_EQ(cut.expanded, 50);
  EXPECT_TRUE(hasty.path().empty());
  GridSearch search;
  EXPECT_EQ(search.search(map, request).outcome, GridSearchOutcome::found);
  request.window_margin = 0.5;
  EXPECT_EQ(search.search(map, request).outcome, GridSearchOutcome::no_path);
  request.window_margin = 6.0;
  EXPECT_EQ(search.search(map, request).outcome, GridSearchOutcome::found);
  parameters.window_nodes = 100;
  GridSearch small{parameters};
  EXPECT_EQ(small.search(map, request).outcome, GridSearchOutcome::window_too_large);
  request.goal_world.x() = std::nan("");
  EXPECT_EQ(search.search(map, request).outcome, GridSearchOutcome::blocked_end);
}

TEST(GridSearch, DoesNotRememberThePreviousSearch) {
  const OccupancyMap map = cluttered_map(3, 12);
  GridSearch used;
  RandomStream random{9};
  for (int k = 0; k < 50; ++k) {
    GridSearchRequest request;
    request.clearance = 0.15;
    for (Eigen::Vector2d* position : {&request.start_world, &request.goal_world}) {
      position->x() = random.uniform(-3.0, 3.0);
      position->y() = random.uniform(-3.0, 3.0);
    }
    GridSearch fresh;
    const GridSearchResult expected = fresh.search(map, request);
    const GridSearchResult result = used.search(map, request);
    EXPECT_EQ(result.outcome, expected.outcome) << k;
    EXPECT_EQ(result.cost, expected.cost) << k;
    EXPECT_EQ(used.path(), fresh.path()) << k;
  }
}

}  // namespace
}  // namespace spf
