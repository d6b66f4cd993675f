#include "spf/planning/field/field_guidance.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "spf/planning/trajectory_optimizer.hpp"

namespace spf {
namespace {

constexpr double kSafety = 0.2;

struct FieldGuidanceScene {
  TrajectoryOptimizer optimizer{PlannerParameters{}, RobotParameters{}};
  FieldGuidance guidance{kSafety, 0.7};
  std::vector<DangerRegion> regions;
  std::vector<FieldConflict> conflicts;
  std::vector<SideChoice> sides;
  std::vector<GuidePair> pairs;
  FlatState head;

  /// A straight run along x at height y, 6 m, four pieces.
  void run_at(double y) {
    TrajectorySeed seed;
    seed.resize(4);
    for (int i = 0; i < 4; ++i) {
      seed.durations[i] = 1.6;
      if (i < 3) seed.waypoints_world.col(i) = Eigen::Vector2d{1.5 * (i + 1), y};
    }
    TrajectoryProblem problem;
    problem.ends.head.position_world = {0.0, y};
    problem.ends.tail.position_world = {6.0, y};
    head = problem.ends.head;
    optimizer.set(problem, seed);
  }
  void add_region(int id, const Eigen::Vector2d& position, const Eigen::Vector2d& velocity) {
    DangerRegion region;
    region.id = id;
    region.field = ProbabilityField{{position, velocity, 0.4}, 0.3, FieldParameters{}};
    region.threshold = region.field.threshold();
    regions.push_back(region);
  }
  [[nodiscard]] int last() const { return optimizer.nodes().size() - 1; }
  void find() { guidance.find_conflicts(regions, optimizer.nodes(), last(), head, conflicts); }
  void make(PassingSide side) {
    find();
    sides.assign(regions.size(), SideChoice{});
    for (const FieldConflict& c : conflicts)
      sides[static_cast<std::size_t>(c.region)] = {true, side, c.along, c.entry_world};
    pairs.clear();
    guidance.add_pairs(regions, optimizer.nodes(), last(), head, sides, pairs);
  }
};

TEST(FieldGuidance, FindsOneConflictPerObstacleInTheOrderOfThePath) {
  FieldGuidanceScene f;
  f.run_at(0.0);
  f.add_region(7, {4.5, 0.2}, {0.0, 0.0});
  f.add_region(8, {1.5, -0.1}, {0.0, -0.3});
  f.add_region(9, {3.0, 4.0}, {0.0, 0.0});
  f.find();
  ASSERT_EQ(f.conflicts.size(), 2U);
  EXPECT_EQ(f.regions[static_cast<std::size_t>(f.conflicts[0].region)].id, 8);
  EXPECT_EQ(f.regions[static_cast<std::size_t>(f.conflicts[1].region)].id, 7);
  EXPECT_EQ(f.conflicts[0].natural, PassingSide::left);  // the obstacle is to the right of the line
  EXPECT_EQ(f.conflicts[1].natural, PassingSide::right);
}

TEST(FieldGuidance, GuidePointsLieOnTheEllipseOnTheChosenSide) {
  for (const double y : {-0.3, 0.0, 0.25}) {
    for (const PassingSide side : {PassingSide::left, PassingSide::right}) {
      SCOPED_TRACE(testing::Message() << "y " << y << " side " << static_cast<int>(side));
      FieldGuidanceScene f;
      f.run_at(y);
      f.add_region(1, {3.0, 0.0}, {-0.5, 0.2});
      f.make(side);
      const DangerRegion& region = f.regions[0];
      int inner = 0;
      for (const GuidePair& pair : f.pairs) {
        EXPECT_NEAR(pair.normal.norm(), 1.0, 1e-12);
        EXPECT_EQ(pair.source, 1);
        const Eigen::Vector2d& p = f.optimizer.nodes()[pair.node].position;
        if (region.field.mahalanobis(p) >= region.threshold) {
          EXPECT_GE(signed_distance(pair, p), 0.0);  // on the rim already
          EXPECT_LE(signed_distance(pair, p), kSafety);
          continue;
        }
        ++inner;
        EXPECT_LT(signed_distance(pair, p), 0.0);
        // On the ellipse, or beyond it where Fig. 4's mirrored point lies farther out.
        EXPECT_GE(region.field.mahalanobis(pair.base), region.threshold - 1e-9);
        EXPECT_GE(pair.normal.y() * static_cast<double>(side), 0.7 - 1e-9);
      }
      EXPECT_GE(inner, 3);
    }
  }
}

TEST(FieldGuidance, TheOtherSideIsTheMirrorImage) {
  // A field symmetric to the line of the run: both candidates must mirror each other exactly.
  FieldGuidanceScene f;
  f.run_at(0.0);
  f.add_region(1, {3.0, 0.0}, {-0.6, 0.0});
  f.make(PassingSide::left);
  const std::vector<GuidePair> left = f.pairs;
  f.make(PassingSide::right);
  ASSERT_EQ(f.pairs.size(), left.size());
  for (std::size_t i = 0; i < left.size(); ++i) {
    const GuidePair& a = left[i];
    const GuidePair& b = f.pairs[i];
    EXPECT_EQ(a.node, b.node);
    if (f.regions[0].field.mahalanobis(f.optimizer.nodes()[a.node].position) >= f.regions[0].threshold)
      continue;
    EXPECT_NEAR(a.normal.x(), b.normal.x(), 1e-9);
    EXPECT_NEAR(a.normal.y(), -b.normal.y(), 1e-9);
    EXPECT_NEAR(a.base.x(), b.base.x(), 1e-9);
    EXPECT_NEAR(a.base.y(), -b.base.y(), 1e-9);
  }
}

TEST(FieldGuidance, BothSidesOfADiscAreFoundByTheOptimiser) {
  for (const PassingSide side : {PassingSide::left, PassingSide::right}) {
    FieldGuidanceScene f;
    f.run_at(0.1);
    f.add_region(1, {3.0, 0.0}, {-0.3, 0.0});
    f.make(side);
    TrajectoryProblem problem;
    problem.ends.head.position_world = {0.0, 0.1};
    problem.ends.tail.position_world = {6.0, 0.1};
    problem.field_pairs = &f.pairs;
    for (int i = 0; i < 4; ++i) {
      f.optimizer.optimise(problem, f.optimizer.solution());
      f.guidance.add_pairs(f.regions, f.optimizer.nodes(), f.last(), f.head, f.sides, f.pairs);
    }
    double at_obstacle = 0.0;
    for (int k = 0; k <= f.last(); ++k) {
      const Eigen::Vector2d& p = f.optimizer.nodes()[k].position;
      EXPECT_GE(f.regions[0].field.mahalanobis(p), f.regions[0].threshold) << "node " << k;
      if (std::abs(p.y()) > std::abs(at_obstacle)) at_obstacle = p.y();
    }
    EXPECT_GT(at_obstacle * static_cast<double>(side), 0.5);
  }
}

TEST(FieldGuidance, PassesBehindAnObstacleThatCrossesHeadOn) {
  // The line runs through the centre of the field: the gradients are neutral.
  FieldGuidanceScene f;
  f.run_at(0.0);
  ObstacleState obstacle{{3.0, 0.0}, {0.0, 0.8}, 0.4};
  obstacle.position_world -= 0.5 * obstacle.velocity_world;  // the centre comes to lie on the line
  f.add_region(1, obstacle.position_world, obstacle.velocity_world);
  f.find();
  ASSERT_EQ(f.conflicts.size(), 1U);
  EXPECT_EQ(f.conflicts[0].natural, PassingSide::right);  // it moves to the left
}

TEST(FieldGuidance, RemembersSidesAndWidensAfterChanges) {
  FieldGuidance guidance{kSafety, 0.7};
  EXPECT_EQ(guidance.remembered_side(4, 0.0), 0);
  guidance.remember(4, PassingSide::left, 0.0);
  EXPECT_EQ(guidance.remembered_side(4, 1.0), 1);
  EXPECT_EQ(guidance.remembered_side(5, 1.0), 0);
  EXPECT_EQ(guidance.widening(4, 1.0), 1.0);
  guidance.remember(4, PassingSide::right, 1.0);
  EXPECT_EQ(guidance.side_changes(4, 1.0), 1);
  EXPECT_EQ(guidance.widening(4, 1.0), 1.0);  // one change is no oscillation
  guidance.remember(4, PassingSide::left, 1.5);
  EXPECT_NEAR(guidance.widening(4, 1.5), 1.1, 1e-12);
  for (int i = 0; i < 6; ++i)
    guidance.remember(4, i % 2 == 0 ? PassingSide::right : PassingSide::left, 2.0 + 0.1 * i);
  EXPECT_NEAR(guidance.widening(4, 2.5), 1.5, 1e-12);  // capped
  EXPECT_EQ(guidance.side_changes(4, 2.5), 8);
  EXPECT_EQ(guidance.side_changes(4, 10.0), 0);  // forgotten
  EXPECT_EQ(guidance.remembered_side(4, 10.0), 0);
}

TEST(FieldGuidance, ForgetsTheOldestWhenTheMemoryIsFull) {
  FieldGuidance guidance{kSafety, 0.7};
  for (int id = 0; id < 100; ++id) guidance.remember(id, PassingSide::left, 0.01 * id);
  EXPECT_EQ(guidance.remembered_side(99, 1.0), 1);
  EXPECT_EQ(guidance.remembered_side(0, 1.0), 0);
}

}  // namespace
}  // namespace spf
