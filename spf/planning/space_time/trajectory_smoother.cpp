#include "spf/planning/space_time/trajectory_smoother.hpp"

#include <algorithm>
#include <cmath>

#include "spf/planning/clearance.hpp"

namespace spf {
namespace {

constexpr int kEvaluations = 40;   // of the cost at most
constexpr int kStepsPerPiece = 5;  // of the roll-out: half a second at 0.1 s

/// The paper's optimiser with the space-time field in place of guide pairs, peers' discs and spacing.
PlannerParameters smoothing_parameters(PlannerParameters planner) {
  planner.weights.peers = 0.0;
  planner.weights.static_hard = 0.0;
  planner.weights.static_soft = 0.0;
  planner.weights.spacing = 0.0;
  planner.weights.dynamic = 0.0;
  planner.nodes_per_piece = kStepsPerPiece;
  planner.run_evaluations = kEvaluations;
  planner.max_pieces = std::max(planner.max_pieces, SpaceTimeRisk::kMaxSteps / kStepsPerPiece);
  return planner;
}

}  // namespace

TrajectorySmoother::TrajectorySmoother(const SpaceTimeParameters& space_time,
                                       const PlannerParameters& planner, const RobotParameters& robot)
    : space_time_{space_time},
      planner_{smoothing_parameters(planner)},
      robot_{robot},
      optimizer_{planner_, robot} {}

bool TrajectorySmoother::smooth(const RollOut& roll_out, const PlanRequest& request,
                                const SpaceTimeRisk& risk, const RollOutSettings& settings,
                                Trajectory& smooth, PlanStats& stats) {
  const int pieces = roll_out.steps / kStepsPerPiece;
  if (pieces < 2) return false;
  seed_.resize(pieces);
  for (int i = 0; i < pieces; ++i) {
    seed_.durations[i] = kStepsPerPiece * settings.step;
    if (i > 0) {
      seed_.waypoints_world.col(i - 1) =
          roll_out.position_world[static_cast<std::size_t>(i * kStepsPerPiece)];
    }
  }
  const auto end = static_cast<std::size_t>(pieces * kStepsPerPiece);
  problem_.start_time = request.time;
  problem_.ends.head = request.head;
  problem_.ends.tail = {roll_out.position_world[end], roll_out.velocity_world[end], Eigen::Vector2d::Zero()};
  problem_.max_speed = std::max(settings.max_speed, request.head.velocity_world.norm());
  cost_.risk = &risk;
  cost_.map = request.world.map;
  cost_.start_time = request.time;
  cost_.price = planner_.weights.time * space_time_.collision_cost;
  cost_.wanted_clearance = robot_.radius + request.world.map->margin(space_time_.static_margin);
  cost_.static_sigma = std::hypot(space_time_.static_sigma, request.position_sigma);
  problem_.extra = NodeTermRef{cost_};

  const OptimizerResult run = optimizer_.optimise(problem_, seed_);
  ++stats.optimiser_calls;
  stats.inner_iterations += run.iterations;
  stats.evaluations += run.evaluations;
  if (run.outcome == LbfgsOutcome::not_finite || !std::isfinite(run.cost)) return false;

  smooth = optimizer_.trajectory();
  const FlatState tail{problem_.ends.tail.position_world, problem_.ends.tail.velocity_world,
                       Eigen::Vector2d::Zero()};
  append_braking(tail, settings, smooth);
  return smooth.max_speed() <= (1.0 + kSpeedTolerance) * std::min(robot_.max_speed, problem_.max_speed) &&
         smooth.max_acceleration() <= std::max((1.0 + kAccelerationTolerance) * robot_.max_acceleration,
                                               request.head.acceleration_world.norm() + 1e-9);
}

}  // namespace spf
