#include "spf/planning/field/guide_pairs.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "spf/planning/field/grid_search.hpp"
#include "spf/planning/trajectory_optimizer.hpp"

namespace spf {
namespace {

struct GuidePairsScene {
  PlannerParameters planner;
  RobotParameters robot;
  OccupancyMap map{GridFrame::covering({-6.0, -6.0}, {6.0, 6.0}, 0.1), 2.0};
  GridSearch search;
  ClearanceModel clearance{planner, robot, FieldParameters{}};
  GuidePairFinder finder{64};
  TrajectoryOptimizer optimizer{planner, robot};
  std::vector<GuidePair> pairs;
  TrajectorySeed seed;
  TrajectoryProblem problem;

  void begin() {
    clearance.prepare({0.0, 0, &map, nullptr, nullptr}, 0.0, PeerSelection::all);
    pairs.reserve(1000);
  }
  /// A straight seed at rest at both ends.
  void straight(const Eigen::Vector2d& from, const Eigen::Vector2d& to, int pieces) {
    seed.resize(pieces);
    for (int i = 0; i < pieces; ++i) {
      seed.durations[i] = 1.6;
      if (i + 1 < pieces) seed.waypoints_world.col(i) = from + (i + 1.0) / pieces * (to - from);
    }
    problem.ends.head.position_world = from;
    problem.ends.tail.position_world = to;
    problem.static_pairs = &pairs;
    optimizer.set(problem, seed);
  }
  GuidePairFinder::Outcome find() {
    auto detour = [this](const Eigen::Vector2d& from, const Eigen::Vector2d& to,
                         std::vector<Eigen::Vector2d>& path) {
      const GridSearchRequest request{from, to, robot.radius + planner.static_margin, std::nullopt};
      if (search.search(map, request).outcome != GridSearchOutcome::found) return false;
      path.push_back(from);
      path.insert(path.end(), search.path().begin(), search.path().end());
      path.push_back(to);
      return true;
    };
    return finder.find(clearance, optimizer.nodes(), PathSearchRef{detour}, pairs);
  }
  /// Smallest distance of the robot's rim to static surfaces along a trajectory, every millisecond.
  [[nodiscard]] double brute_clearance() const {
    const Trajectory trajectory = optimizer.trajectory();
    double least = 1e9;
    for (double time = 0.0; time <= trajectory.duration(); time += 1e-3)
      least = std::min(least, map.distance(trajectory.position(time)) - robot.radius);
    return least;
  }
};

TEST(GuidePairs, NothingInTheWayNeedsNone) {
  GuidePairsScene f;
  f.map.add_box({-1.0, 2.0}, {1.0, 4.0});
  f.begin();
  f.straight({-4.0, 0.0}, {4.0, 0.0}, 5);
  EXPECT_EQ(f.find(), GuidePairFinder::Outcome::clear);
  EXPECT_TRUE(f.pairs.empty());
  EXPECT_EQ(f.finder.searches(), 0);
}

TEST(GuidePairs, StandOnTheSurfaceAndPointToTheWayRound) {
  GuidePairsScene f;
  f.map.add_box({-1.0, -1.5}, {1.0, 1.0});  // the shorter detour is above
  f.begin();
  f.straight({-4.0, 0.0}, {4.0, 0.0}, 5);
  ASSERT_EQ(f.find(), GuidePairFinder::Outcome::added);
  EXPECT_EQ(f.finder.searches(), 1);
  for (const GuidePair& pair : f.pairs) {
    EXPECT_NEAR(pair.normal.norm(), 1.0, 1e-12);
    EXPECT_GT(pair.normal.y(), 0.0);
    EXPECT_NEAR(f.clearance.static_clearance(pair.base), 0.0, 0.02);
    EXPECT_LT(signed_distance(pair, f.optimizer.nodes()[pair.node].position), 0.0);
  }
}

TEST(GuidePairs, LeadTheOptimiserRoundABox) {
  for (const double low : {-1.5, -1.1, -0.9}) {
    for (const double width : {0.15, 1.0, 2.0}) {
      SCOPED_TRACE(testing::Message() << "low " << low << " width " << width);
      GuidePairsScene f;
      f.map.add_box({-0.5 * width, low}, {0.5 * width, 1.0});
      f.begin();
      f.straight({-4.0, 0.0}, {4.0, 0.0}, 5);
      ASSERT_EQ(f.find(), GuidePairFinder::Outcome::added);
      // As the planner does: run, check, run again.
      for (int i = 0; i < 6; ++i) {
        f.optimizer.optimise(f.problem, f.optimizer.solution());
        if (f.find() == GuidePairFinder::Outcome::clear) break;
      }
      EXPECT_GT(f.brute_clearance(), 0.0);
    }
  }
}

TEST(GuidePairs, AnEndInsideAnObstacleIsACollision) {
  GuidePairsScene f;
  f.map.add_box({3.0, -2.0}, {5.0, 2.0});
  f.begin();
  f.straight({-4.0, 0.0}, {4.0, 0.0}, 5);
  EXPECT_EQ(f.find(), GuidePairFinder::Outcome::blocked);
}

TEST(GuidePairs, NoWayRoundIsReported) {
  GuidePairsScene f;
  f.map.add_box({0.0, -7.0}, {0.5, 7.0});
  f.begin();
  f.straight({-4.0, 0.0}, {4.0, 0.0}, 5);
  EXPECT_EQ(f.find(), GuidePairFinder::Outcome::blocked);
}

TEST(GuidePairs, AThinObstacleBetweenTwoNodesIsSeen) {
  GuidePairsScene f;
  f.robot.radius = 0.02;
  f.planner.static_margin = 0.01;
  f.clearance = ClearanceModel{f.planner, f.robot, FieldParameters{}};
  f.map = OccupancyMap{GridFrame::covering({-6.0, -6.0}, {6.0, 6.0}, 0.02), 2.0};
  f.map.add_box({0.17, -0.5}, {0.21, 0.4});
  f.search = GridSearch{[] {
    GridSearchParameters parameters;
    parameters.window_nodes = 1 << 20;
    parameters.node_budget = 1 << 20;
    return parameters;
  }()};
  f.begin();
  f.straight({-4.0, 0.0}, {4.0, 0.0}, 5);
  EXPECT_EQ(f.find(), GuidePairFinder::Outcome::added);
  EXPECT_FALSE(GuidePairFinder::new_collision(f.clearance, f.optimizer.nodes(), f.pairs));
}

TEST(GuidePairs, ACollisionIsNewUnlessItsPairsKnowOfIt) {
  GuidePairsScene f;
  f.map.add_box({-1.0, -1.5}, {1.0, 1.0});
  f.begin();
  f.straight({-4.0, 0.0}, {4.0, 0.0}, 5);
  EXPECT_TRUE(GuidePairFinder::new_collision(f.clearance, f.optimizer.nodes(), f.pairs));
  ASSERT_EQ(f.find(), GuidePairFinder::Outcome::added);
  EXPECT_FALSE(GuidePairFinder::new_collision(f.clearance, f.optimizer.nodes(), f.pairs));
}

}  // namespace
}  // namespace spf
