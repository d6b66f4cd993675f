// Gradients of the space-time cost against central differences: at one node in position and time, and through
// the whole optimisation, where moving a duration moves every later node in time.
#include "spf/planning/space_time/space_time_cost.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "spf/math/random_stream.hpp"
#include "spf/planning/trajectory_optimizer.hpp"
#include "spf/testing/gradient_check.hpp"

namespace spf {
namespace {

constexpr double kStart = 3.0;  // [s]

/// Obstacles and a peer around the path from the origin along x, over a map with a box.
struct SpaceTimeScene {
  explicit SpaceTimeScene(std::uint64_t seed)
      : map{GridFrame::covering({-5.0, -8.0}, {15.0, 8.0}, 0.1), 2.0} {
    RandomStream random{seed};
    for (int id = 0; id < 4; ++id) {
      ObstacleTrack track;
      track.id = id;
      track.time = kStart - 0.07;
      const double x = 1.0 + id;
      track.state.position_world = {x, random.uniform(-1.0, 1.0)};
      track.state.velocity_world = {random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5)};
      track.position_variance = 0.05;
      track.velocity_diffusion = 0.1;
      tracks.push_back(track);
    }
    Peer peer;
    peer.robot_id = 7;
    peer.state = PeerState::moving;
    QuinticPiece piece;
    piece.duration = 5.0;
    piece.coefficients.row(0) << 2.0, 1.5;
    piece.coefficients.row(1) << 0.1, -0.5;
    Trajectory course{kStart - 0.2};
    course.append(piece);
    peer.trajectory = course;
    peers.push_back(peer);
    PlanRequest request;
    request.time = kStart;
    request.position_sigma = 0.05;
    request.world = {kStart, 3, &map, &tracks, &peers};
    risk.prepare(request);
    cost.risk = &risk;
    cost.map = &map;
    cost.start_time = kStart;
  }

  static SpaceTimeParameters parameters() {
    SpaceTimeParameters parameters;
    parameters.discount_time = 2.0;  // so that the later steps count in the check, too
    return parameters;
  }

  OccupancyMap map;
  std::vector<ObstacleTrack> tracks;
  std::vector<Peer> peers;
  SpaceTimeRisk risk{parameters(), 0.3, 1.0};
  SpaceTimeCost cost;
};

/// One node at a given position and time: the first node of a trajectory at rest.
class OneNode {
 public:
  NodePenalty ask(const SpaceTimeCost& cost, const Eigen::Vector2d& position, double time) {
    MincoEnds ends;
    ends.head.position_world = ends.tail.position_world = position;
    minco_.solve(ends, Eigen::Matrix2Xd(2, 0), Eigen::VectorXd::Constant(1, 2.0));
    nodes_.sample(minco_, time);
    cost(nodes_);
    return nodes_.penalty(0);
  }

 private:
  Minco minco_;
  NodeSet nodes_{1, 2};
};

TEST(SpaceTimeCost, NodeGradientInPositionAndTime) {
  constexpr double kStep = 1e-6;
  RandomStream random{8};
  OneNode node;
  int felt = 0;
  for (int i = 0; i < 2000; ++i) {
    const SpaceTimeScene scene{mix(31, static_cast<std::uint64_t>(i / 20))};
    const Eigen::Vector2d position{random.uniform(0.0, 5.0), random.uniform(-1.5, 1.5)};
    // Away from the joints of the table, where the interpolation has a kink.
    const int cell = static_cast<int>(random.uniform(-3.0, 33.0));
    const double time = kStart + 0.1 * (cell + random.uniform(0.05, 0.95));
    const NodePenalty at = node.ask(scene.cost, position, time);
    const auto value = [&](const Eigen::Vector2d& p, double t) {
      return node.ask(scene.cost, p, t).integrand;
    };
    const Eigen::Vector2d x = kStep * Eigen::Vector2d::UnitX();
    const Eigen::Vector2d y = kStep * Eigen::Vector2d::UnitY();
    const Eigen::Vector3d numeric{value(position + x, time) - value(position - x, time),
                                  value(position + y, time) - value(position - y, time),
                                  value(position, time + kStep) - value(position, time - kStep)};
    const Eigen::Vector3d analytic{at.wrt_position.x(), at.wrt_position.y(), at.wrt_time};
    // Costs up to 1e5 with steps of 1e-6: rounding 1e-16 * 1e5 / 1e-6 = 1e-5 per second or metre; slopes
    // reach 1e6. Where a term is cut off (5 sigma) it jumps by 3e-7 of its factor, 6e-3 here: such a step
    // shows as 3e3, and is met with a chance of about 1e-5.
    const double scale = std::max(analytic.norm(), 1.0);
    EXPECT_LT((analytic - numeric / (2.0 * kStep)).norm(), 1e-3 + 1e-6 * scale)
        << "position " << position.transpose() << " time " << time;
    felt += at.wrt_position.norm() > 1.0 && std::abs(at.wrt_time) > 1.0 ? 1 : 0;
  }
  EXPECT_GT(felt, 500);  // most of these points are near a disc
}

TEST(SpaceTimeCost, IsThePriceOfTheChanceThatTheRiskTells) {
  // At a step of the table, far from static surfaces, the integrand is the sum of SpaceTimeRisk::chance.
  const SpaceTimeScene scene{5};
  OneNode node;
  RandomStream random{6};
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector2d position{random.uniform(0.0, 5.0), random.uniform(-1.5, 1.5)};
    const int step = static_cast<int>(random.uniform(0.0, 31.0));
    double sum = 0.0;
    for (int e = 0; e < scene.risk.disc_count(); ++e)
      sum += scene.risk.chance(scene.risk.disc(e), step, position, 0.0);
    const double integrand = node.ask(scene.cost, position, kStart + 0.1 * step).integrand;
    // The risk cuts tails off at 4 sigma (3e-5 each), the cost at 5.
    EXPECT_NEAR(integrand * scene.cost.exposure / scene.cost.price, sum, 5 * 3.2e-5);
  }
}

TEST(SpaceTimeCost, StaticSurfacesPushOutOfThemselvesAndNothingElseIsFelt) {
  SpaceTimeScene scene{5};
  scene.tracks.clear();
  scene.peers.clear();
  PlanRequest request;
  request.world = {kStart, 3, &scene.map, &scene.tracks, &scene.peers};
  scene.risk.prepare(request);
  OneNode node;
  EXPECT_EQ(node.ask(scene.cost, {1.0, 0.0}, kStart).integrand, 0.0);
  scene.map.add_box({0.0, -1.0}, {4.0, 1.0});
  double before = 0.0;
  for (const double y : {1.55, 1.4, 1.3, 1.1, 0.9, 0.5}) {  // ever deeper
    const NodePenalty penalty = node.ask(scene.cost, {2.0, y}, kStart);
    EXPECT_GT(penalty.integrand, before) << y;
    EXPECT_LT(penalty.wrt_position.y(), 0.0) << y;  // downhill is outwards
    EXPECT_EQ(penalty.wrt_time, 0.0);
    before = penalty.integrand;
  }
}

TEST(SpaceTimeCost, WholeCostGradientWithDurations) {
  RandomStream random{12};
  double worst = 0.0;
  int felt = 0;
  for (int i = 0; i < 40; ++i) {
    SCOPED_TRACE(i);
    const SpaceTimeScene scene{mix(77, static_cast<std::uint64_t>(i))};
    const PlannerParameters planner;
    const int pieces = 2 + i % (planner.max_pieces - 1);
    TrajectorySeed seed;
    seed.resize(pieces);
    for (int k = 0; k < pieces; ++k) {
      seed.durations[k] = random.uniform(0.8, 1.4);
      if (k + 1 < pieces)
        seed.waypoints_world.col(k) = Eigen::Vector2d{0.6 * (k + 1), random.uniform(-0.4, 0.4)};
    }
    TrajectoryProblem problem;
    problem.start_time = kStart;
    problem.ends.head = {{0.0, 0.1}, {0.8, 0.2}, {0.1, -0.2}};
    problem.ends.tail.position_world = {0.6 * pieces, 0.0};
    TrajectoryOptimizer optimizer{planner, RobotParameters{}};
    const DecisionLayout layout{pieces};
    Eigen::VectorXd decision(layout.size());
    layout.pack(seed.waypoints_world, seed.durations, decision);
    const auto cost = [&](const Eigen::VectorXd& x, Eigen::VectorXd& gradient) {
      return optimizer.evaluate(x, gradient);
    };
    Eigen::VectorXd gradient(layout.size());
    optimizer.set(problem, seed);
    const double without = cost(decision, gradient);
    problem.extra = NodeTermRef{scene.cost};
    optimizer.set(problem, seed);
    felt += cost(decision, gradient) > 1.5 * without ? 1 : 0;
    // Nodes within a step's reach of a joint of the table (kinks every 0.1 s) spoil a component by the change
    // of slope there; with steps of 1e-7 and some 30 nodes one draw in 3000 meets one. Rounding: 1e-16 / 1e-7
    // = 1e-9 of the cost.
    const GradientCheck check = check_gradient(cost, decision, 1e-7);
    EXPECT_LT(check.relative_error, 1e-5) << "component " << check.worst << " of " << layout.size();
    worst = std::max(worst, check.relative_error);
  }
  EXPECT_GT(felt, 10);  // the extra term is no small part of the cost
  RecordProperty("worst", std::to_string(worst));
}

}  // namespace
}  // namespace spf
