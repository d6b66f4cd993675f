#include "spf/planning/trajectory_optimizer.hpp"

#include <gtest/gtest.h>

#include "spf/testing/allocation_guard.hpp"

namespace spf {
namespace {

/// A run of 4 m with a half plane across the path and a further term of the caller.
struct OptimizerScene {
  std::vector<GuidePair> pairs;
  std::vector<MovingDisc> discs;
  TrajectoryProblem problem;
  TrajectorySeed seed;

  OptimizerScene() {
    seed.resize(4);
    for (int i = 0; i < 4; ++i) {
      seed.durations[i] = 1.5;
      if (i < 3) seed.waypoints_world.col(i) = Eigen::Vector2d{1.0 * (i + 1), 0.0};
    }
    problem.ends.tail.position_world = {4.0, 0.0};
    pairs.push_back({10, {2.0, 0.4}, Eigen::Vector2d::UnitY(), -1});
    MovingDisc disc;
    disc.radius = 0.6;
    disc.position_world = {3.0, -0.3};
    discs.push_back(disc);
    problem.static_pairs = &pairs;
    problem.discs = &discs;
  }
};

TEST(TrajectoryOptimizer, LowersTheCostAndHeedsItsTerms) {
  OptimizerScene f;
  TrajectoryOptimizer optimizer{PlannerParameters{}, RobotParameters{}};
  optimizer.set(f.problem, f.seed);
  const DecisionLayout layout{4};
  Eigen::VectorXd decision(layout.size());
  layout.pack(f.seed.waypoints_world, f.seed.durations, decision);
  Eigen::VectorXd gradient(layout.size());
  const double before = optimizer.evaluate(decision, gradient);
  const OptimizerResult result = optimizer.optimise(f.problem, f.seed);
  EXPECT_LT(result.cost, before);
  EXPECT_LT(signed_distance(f.pairs[0], {2.0, 0.0}), 0.0);
  EXPECT_GT(signed_distance(f.pairs[0], optimizer.nodes()[10].position), 0.0);
  const Trajectory plan = optimizer.trajectory();
  EXPECT_LT((plan.tail_position() - f.problem.ends.tail.position_world).norm(), 1e-9);
  EXPECT_LT(plan.max_speed(), 1.1);
}

TEST(TrajectoryOptimizer, StaysWithinTheDeadlineOfARun) {
  OptimizerScene f;
  PlannerParameters parameters;
  parameters.run_evaluations = 7;
  TrajectoryOptimizer optimizer{parameters, RobotParameters{}};
  EXPECT_LE(optimizer.optimise(f.problem, f.seed).evaluations, 7);
}

TEST(TrajectoryOptimizer, GivesBackAPointWhenTheHookCancels) {
  OptimizerScene f;
  TrajectoryOptimizer optimizer{PlannerParameters{}, RobotParameters{}};
  int calls = 0;
  const OptimizerResult result = optimizer.optimise(f.problem, f.seed, [&](const NodeSet& nodes) {
    EXPECT_EQ(nodes.size(), 21);
    return ++calls == 5 ? LbfgsSignal::cancel : LbfgsSignal::proceed;
  });
  EXPECT_EQ(result.outcome, LbfgsOutcome::cancelled);
  EXPECT_EQ(calls, 5);
  EXPECT_EQ(optimizer.solution().pieces(), 4);
  EXPECT_TRUE(optimizer.solution().durations.allFinite());
}

TEST(TrajectoryOptimizer, FollowsATermOfTheCallersOwn) {
  // Pulls the middle of the motion to y = 1.
  const auto pull = [](NodeSet& nodes) {
    for (int k = 8; k <= 12; ++k) {
      const double lack = 1.0 - nodes[k].position.y();
      nodes.penalty(k).integrand += 1000.0 * lack * lack;
      nodes.penalty(k).wrt_position.y() -= 2000.0 * lack;
    }
  };
  OptimizerScene f;
  f.problem.extra = NodeTermRef{pull};
  TrajectoryOptimizer optimizer{PlannerParameters{}, RobotParameters{}};
  optimizer.optimise(f.problem, f.seed);
  EXPECT_NEAR(optimizer.nodes()[10].position.y(), 1.0, 0.15);
}

TEST(TrajectoryOptimizer, DoesNotAllocate) {
  const OptimizerScene f;
  TrajectoryOptimizer optimizer{PlannerParameters{}, RobotParameters{}};
  const AllocationGuard guard;
  optimizer.optimise(f.problem, f.seed);
  optimizer.optimise(f.problem, optimizer.solution());
  const Trajectory plan = optimizer.trajectory();
  EXPECT_GT(plan.duration(), 0.0);
  EXPECT_EQ(guard.allocations(), 0);
}

}  // namespace
}  // namespace spf
