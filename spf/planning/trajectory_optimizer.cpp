#include "spf/planning/trajectory_optimizer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "spf/planning/costs/field_cost.hpp"
#include "spf/planning/costs/limits_cost.hpp"
#include "spf/planning/costs/peer_cost.hpp"
#include "spf/planning/costs/smoothness_cost.hpp"
#include "spf/planning/costs/spacing_cost.hpp"
#include "spf/planning/costs/static_cost.hpp"
#include "spf/planning/costs/time_cost.hpp"

namespace spf {
namespace {

LbfgsParameters with_deadline(LbfgsParameters parameters, int evaluations) {
  parameters.max_evaluations = std::min(parameters.max_evaluations, evaluations);
  return parameters;
}

}  // namespace

TrajectoryOptimizer::TrajectoryOptimizer(const PlannerParameters& planner, const RobotParameters& robot)
    : planner_{validated(planner)},
      robot_{validated(robot)},
      nodes_{planner.max_pieces, planner.nodes_per_piece},
      lbfgs_{3 * planner.max_pieces - 2, with_deadline(planner.optimizer, planner.run_evaluations)},
      decision_{Eigen::VectorXd::Zero(3 * planner.max_pieces - 2)} {}

void TrajectoryOptimizer::begin(const TrajectoryProblem& problem, const TrajectorySeed& seed) {
  assert(seed.pieces() >= 2 && seed.pieces() <= planner_.max_pieces);
  problem_ = problem;
  layout_.piece_count = seed.pieces();
  layout_.pack(seed.waypoints_world, seed.durations, decision_.head(layout_.size()));
}

void TrajectoryOptimizer::set(const TrajectoryProblem& problem, const TrajectorySeed& seed) {
  begin(problem, seed);
  solution_ = seed;
  minco_.solve(problem_.ends, seed.waypoints_world, seed.durations);
  nodes_.sample(minco_, problem_.start_time);
}

OptimizerResult TrajectoryOptimizer::finish(const LbfgsResult& run) {
  // The last evaluation may have been a rejected trial: solve again at the result.
  solution_.resize(layout_.piece_count);
  solution_.waypoints_world = layout_.waypoints(decision_.head(layout_.size()));
  solution_.durations = layout_.durations(decision_.head(layout_.size()));
  minco_.solve(problem_.ends, solution_.waypoints_world, solution_.durations);
  nodes_.sample(minco_, problem_.start_time);
  return {run.outcome, run.cost, run.iterations, run.evaluations};
}

double TrajectoryOptimizer::evaluate(const Lbfgs::Point& decision, Lbfgs::Gradient gradient) {
  const Minco::Durations durations = layout_.durations(decision);
  // Far beyond any sensible motion, powers of the duration lose all digits: the line search takes this as a
  // step too long.
  constexpr double kShortest = 1e-3;  // [s]
  constexpr double kLongest = 1e3;    // [s]
  if (!(durations.minCoeff() > kShortest && durations.maxCoeff() < kLongest)) {
    gradient.setZero();
    return std::numeric_limits<double>::infinity();
  }
  minco_.solve(problem_.ends, layout_.waypoints(decision), durations);
  nodes_.sample(minco_, problem_.start_time);
  add_node_terms();

  wrt_coefficients_.setZero(6 * layout_.piece_count, 2);
  wrt_durations_.setZero(layout_.piece_count);
  const CostWeights& weights = planner_.weights;
  const double reference_jerk = robot_.max_acceleration * robot_.max_acceleration / robot_.max_speed;
  double cost =
      SmoothnessCost{weights.smoothness, reference_jerk}.add(minco_, wrt_coefficients_, wrt_durations_);
  cost += TimeCost{weights.time}.add(minco_, wrt_durations_);
  cost += nodes_.fold(wrt_coefficients_, wrt_durations_);
  layout_.pack_gradient(minco_.propagate(wrt_coefficients_, wrt_durations_), decision, gradient);
  return cost;
}

void TrajectoryOptimizer::add_node_terms() {
  const CostWeights& weights = planner_.weights;
  LimitsCost{weights.limits * problem_.limits_factor,
             kSpeedOnset * std::min(robot_.max_speed, problem_.max_speed),
             kAccelerationOnset * robot_.max_acceleration, robot_.max_jerk}
      .add(nodes_);
  SpacingCost{weights.spacing, planner_.piece_length / planner_.nodes_per_piece}.add(nodes_);
  if (problem_.static_pairs != nullptr)
    StaticCost{weights.static_hard * problem_.static_factor, weights.static_soft * problem_.static_factor,
               planner_.hard_clearance, planner_.soft_clearance}
        .add(*problem_.static_pairs, nodes_);
  if (problem_.discs != nullptr)
    PeerCost{weights.peers * problem_.peer_factor, planner_.peer_clearance}.add(
        *problem_.discs, problem_.last_moving_node, nodes_);
  if (problem_.field_pairs != nullptr)
    FieldCost{weights.dynamic * problem_.dynamic_factor, planner_.safety_distance}.add(*problem_.field_pairs,
                                                                                       nodes_);
  problem_.extra.add(nodes_);
}

}  // namespace spf
