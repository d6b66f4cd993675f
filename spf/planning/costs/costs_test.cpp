// Every cost term alone, and all together: gradients by waypoints and durations against central differences.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "spf/math/random_stream.hpp"
#include "spf/planning/costs/field_cost.hpp"
#include "spf/planning/costs/peer_cost.hpp"
#include "spf/planning/costs/spacing_cost.hpp"
#include "spf/planning/costs/static_cost.hpp"
#include "spf/planning/trajectory_optimizer.hpp"
#include "spf/testing/gradient_check.hpp"

namespace spf {
namespace {

CostWeights no_weights() {
  CostWeights weights;
  weights.smoothness = weights.time = weights.limits = weights.peers = 0.0;
  weights.static_hard = weights.static_soft = weights.spacing = weights.dynamic = 0.0;
  return weights;
}

/// A wriggling motion of a few metres in 2 to 8 pieces, with obstacles near it on all sides.
struct CostScene {
  TrajectorySeed seed;
  TrajectoryProblem problem;
  std::vector<GuidePair> static_pairs;
  std::vector<GuidePair> field_pairs;
  std::vector<MovingDisc> discs;
  Trajectory course;
};

Eigen::Vector2d draw_vector(RandomStream& random, double size) {
  const double x = random.uniform(-size, size);
  const double y = random.uniform(-size, size);
  return {x, y};
}

void draw_scene(RandomStream& random, int pieces, CostScene& scene) {
  scene.seed.resize(pieces);
  for (int i = 0; i < pieces; ++i) {
    scene.seed.durations[i] = random.uniform(0.6, 1.8);
    if (i + 1 < pieces)
      scene.seed.waypoints_world.col(i) = Eigen::Vector2d{1.0 + i, 0.0} + draw_vector(random, 0.4);
  }
  scene.problem.start_time = 3.0;
  scene.problem.ends.head = {draw_vector(random, 0.2), draw_vector(random, 1.0), draw_vector(random, 0.5)};
  scene.problem.ends.tail = {Eigen::Vector2d{1.0 * pieces, 0.0}, draw_vector(random, 0.5),
                             draw_vector(random, 0.2)};
  for (int k = 1; k < 5 * pieces; ++k) {
    const Eigen::Vector2d at{0.2 * k, random.uniform(-0.5, 0.5)};
    const double angle = random.uniform(-3.0, 3.0);
    const Eigen::Vector2d normal{std::cos(angle), std::sin(angle)};
    const Eigen::Vector2d edge = at + 0.3 * normal;  // most nodes on the bad side
    (k % 3 == 1 ? scene.field_pairs : scene.static_pairs).push_back({k, edge, normal, -1});
  }
  QuinticPiece piece;
  piece.duration = 1.5;
  for (int i = 0; i < 3; ++i) {
    piece.coefficients.row(0) << 0.8 * i, 0.1;
    piece.coefficients.row(1) << 0.3, 0.2;
    piece.coefficients.row(2) << 0.1, -0.1;
    piece.coefficients.row(3) << 0.02, 0.03;
    if (i == 0) scene.course = Trajectory{2.0};
    scene.course.append(piece);
  }
  MovingDisc peer;
  peer.radius = 0.6;
  peer.is_peer = true;
  peer.trajectory = &scene.course;
  scene.discs.push_back(peer);
  for (int i = 0; i < 4; ++i) {
    MovingDisc disc;
    disc.radius = 0.7;
    disc.time = 1.0;
    disc.position_world = Eigen::Vector2d{1.0 + i, 0.0} + draw_vector(random, 0.3);
    disc.velocity_world = draw_vector(random, 0.3);
    scene.discs.push_back(disc);
  }
}

/// Relative error of the gradient of one whole evaluation, largest over many scenes; the cost must not
/// vanish.
double worst_error(const CostWeights& weights, const std::function<void(TrajectoryProblem&)>& adjust = {}) {
  PlannerParameters planner;
  planner.weights = weights;
  planner.peer_clearance = 0.8;  // wide, so that many nodes feel the discs
  planner.soft_clearance = 0.5;
  planner.safety_distance = 0.4;
  TrajectoryOptimizer optimizer{planner, RobotParameters{}};
  double worst = 0.0;
  for (int pieces = 2; pieces <= planner.max_pieces; ++pieces) {
    for (int i = 0; i < 5; ++i) {
      RandomStream random{mix(static_cast<std::uint64_t>(pieces), static_cast<std::uint64_t>(i))};
      CostScene scene;
      draw_scene(random, pieces, scene);
      scene.problem.static_pairs = &scene.static_pairs;
      scene.problem.field_pairs = &scene.field_pairs;
      scene.problem.discs = &scene.discs;
      if (adjust) adjust(scene.problem);
      optimizer.set(scene.problem, scene.seed);
      const DecisionLayout layout{pieces};
      Eigen::VectorXd decision(layout.size());
      layout.pack(scene.seed.waypoints_world, scene.seed.durations, decision);
      const auto cost = [&](const Eigen::VectorXd& x, Eigen::VectorXd& gradient) {
        return optimizer.evaluate(x, gradient);
      };
      Eigen::VectorXd gradient(layout.size());
      EXPECT_GT(cost(decision, gradient), 0.0);
      worst = std::max(worst, check_gradient(cost, decision, 1e-6).relative_error);
    }
  }
  return worst;
}

// Step 1e-6: truncation about 1e-12 times the third derivative, rounding 1e-10 times cost over gradient. The
// penalties are twice continuously differentiable, except the soft static one at its edge. Measured 1e-9 to
// 3e-7.
constexpr double kTolerance = 3e-6;

TEST(Costs, SmoothnessGradient) {
  CostWeights weights = no_weights();
  weights.smoothness = 1.0;
  EXPECT_LT(worst_error(weights), kTolerance);
}

TEST(Costs, TimeGradient) {
  CostWeights weights = no_weights();
  weights.time = 10.0;
  EXPECT_LT(worst_error(weights), kTolerance);
}

TEST(Costs, LimitsGradient) {
  CostWeights weights = no_weights();
  weights.limits = 1.0;
  EXPECT_LT(worst_error(weights), kTolerance);
}

TEST(Costs, SpacingGradient) {
  CostWeights weights = no_weights();
  weights.spacing = 1.0;
  EXPECT_LT(worst_error(weights), kTolerance);
}

TEST(Costs, StaticHardGradient) {
  CostWeights weights = no_weights();
  weights.static_hard = 1.0;
  EXPECT_LT(worst_error(weights), kTolerance);
}

TEST(Costs, StaticSoftGradient) {
  CostWeights weights = no_weights();
  weights.static_soft = 1.0;
  EXPECT_LT(worst_error(weights), kTolerance);
}

TEST(Costs, PeersGradientIncludesTheEarlierPieces) {
  CostWeights weights = no_weights();
  weights.peers = 1.0;
  EXPECT_LT(worst_error(weights), kTolerance);
}

TEST(Costs, FieldGradientWithGuidePointsHeldConstant) {
  CostWeights weights = no_weights();
  weights.dynamic = 1.0;
  EXPECT_LT(worst_error(weights), kTolerance);
}

TEST(Costs, TermOfTheCallersOwnGradientInPositionAndTime) {
  // A sinking ring that moves with absolute time, and pulls at all derivatives.
  const auto term = [](NodeSet& nodes) {
    for (int k = 0; k < nodes.size(); ++k) {
      const NodeSample& node = nodes[k];
      NodePenalty& penalty = nodes.penalty(k);
      const Eigen::Vector2d offset =
          node.position - Eigen::Vector2d{0.3 * node.time, 0.1 * node.time * node.time};
      penalty.integrand += offset.squaredNorm() + node.velocity.squaredNorm() +
                           node.acceleration.squaredNorm() + 0.1 * node.jerk.squaredNorm();
      penalty.wrt_position += 2.0 * offset;
      penalty.wrt_time -= 2.0 * offset.dot(Eigen::Vector2d{0.3, 0.2 * node.time});
      penalty.wrt_velocity += 2.0 * node.velocity;
      penalty.wrt_acceleration += 2.0 * node.acceleration;
      penalty.wrt_jerk += 0.2 * node.jerk;
    }
  };
  const double error =
      worst_error(no_weights(), [&](TrajectoryProblem& problem) { problem.extra = NodeTermRef{term}; });
  EXPECT_LT(error, kTolerance);
}

TEST(Costs, WholeCostGradient) {
  EXPECT_LT(worst_error(CostWeights{}), kTolerance);
}

TEST(Costs, FieldCostIsEquation10WithItsPositivePart) {
  NodeSet nodes{1, 2};
  Minco minco;
  MincoEnds ends;
  ends.tail.position_world = {2.0, 0.0};
  minco.solve(ends, Eigen::Matrix2Xd(2, 0), Eigen::VectorXd::Constant(1, 2.0));
  nodes.sample(minco, 0.0);
  const Eigen::Vector2d n = Eigen::Vector2d::UnitY();
  const Eigen::Vector2d p = nodes[1].position;
  // Node 1 lacks 0.3 m and 0.1 m towards two guide points and is beyond a third.
  const std::vector<GuidePair> pairs{{1, p + 0.2 * n, n, 0}, {1, p, n, 1}, {1, p - 1.0 * n, n, 2}};
  FieldCost{7.0, 0.1}.add(pairs, nodes);
  EXPECT_NEAR(nodes.penalty(1).point_cost, 7.0 * (27.0 + 1.0), 1e-9);
  EXPECT_EQ(nodes.penalty(1).integrand, 0.0);
  EXPECT_EQ(nodes.penalty(0).point_cost, 0.0);
}

TEST(Costs, WeightsSayWhatContactCosts) {
  NodeSet nodes{1, 2};
  Minco minco;
  MincoEnds ends;
  ends.tail.position_world = {2.0, 0.0};
  minco.solve(ends, Eigen::Matrix2Xd(2, 0), Eigen::VectorXd::Constant(1, 2.0));
  nodes.sample(minco, 0.0);
  const Eigen::Vector2d p = nodes[1].position;

  MovingDisc disc;
  disc.radius = 0.6;
  disc.position_world = p + Eigen::Vector2d{0.0, 0.6};
  PeerCost{13.0, 0.25}.add({disc}, 1000, nodes);
  EXPECT_NEAR(nodes.penalty(1).integrand, 13.0, 1e-12);

  StaticCost{5.0, 0.0, 0.1, 0.3}.add({{1, p, Eigen::Vector2d::UnitX(), -1}}, nodes);
  EXPECT_NEAR(nodes.penalty(1).integrand, 18.0, 1e-12);
}

TEST(Costs, MovingThingsDoNotCountBeyondTheLastMovingNode) {
  NodeSet nodes{1, 4};
  Minco minco;
  MincoEnds ends;
  ends.tail.position_world = {0.4, 0.0};
  minco.solve(ends, Eigen::Matrix2Xd(2, 0), Eigen::VectorXd::Constant(1, 2.0));
  nodes.sample(minco, 0.0);
  MovingDisc disc;
  disc.radius = 1.0;
  PeerCost{1.0, 0.25}.add({disc}, 2, nodes);
  EXPECT_GT(nodes.penalty(2).integrand, 0.0);
  EXPECT_EQ(nodes.penalty(3).integrand, 0.0);
  EXPECT_EQ(nodes.penalty(0).integrand, 0.0);  // the head cannot be moved
}

TEST(NodeSet, IntegratesByTheTrapezoidRuleOverSharedJunctions) {
  NodeSet nodes{3, 5};
  Minco minco;
  MincoEnds ends;
  ends.tail.position_world = {3.0, 1.0};
  Eigen::Matrix2Xd waypoints(2, 2);
  waypoints << 1.0, 2.0, 0.5, 0.2;
  const Eigen::Vector3d durations{1.0, 0.7, 1.6};
  minco.solve(ends, waypoints, durations);
  nodes.sample(minco, 10.0);
  ASSERT_EQ(nodes.size(), 16);
  double total = 0.0;
  const Trajectory trajectory = minco.trajectory(10.0);
  for (int k = 0; k < nodes.size(); ++k) {
    SCOPED_TRACE(k);
    total += nodes[k].weight;
    const FlatState state = trajectory.state(nodes[k].time);
    EXPECT_LT((nodes[k].position - state.position_world).norm(), 1e-12);
    EXPECT_LT((nodes[k].velocity - state.velocity_world).norm(), 1e-11);
  }
  EXPECT_NEAR(total, durations.sum(), 1e-12);
}

}  // namespace
}  // namespace spf
