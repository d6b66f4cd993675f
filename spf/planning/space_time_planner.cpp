#include "spf/planning/space_time_planner.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace spf {
namespace {

constexpr double kSqrtHalf = 0.70710678118654752440;

RollOutSettings settings_of(const SpaceTimeParameters& parameters, const RobotParameters& robot, int steps) {
  return {robot.max_speed, robot.max_acceleration, parameters.step, steps};
}

}  // namespace

SpaceTimePlanner::SpaceTimePlanner(const SpaceTimeParameters& parameters, const RobotParameters& robot)
    : parameters_{validated(parameters)},
      robot_{validated(robot)},
      risk_{parameters_, robot_.radius, robot_.max_speed} {
  settings_ = settings_of(parameters_, robot_, risk_.steps());
}

SpaceTimePlanner::Score SpaceTimePlanner::score(const RollOut& roll_out, const PlanRequest& request,
                                                const GuidePath& guide, double enough) const {
  Score score;
  const auto end = static_cast<std::size_t>(roll_out.steps);
  const Eigen::Vector2d& tail = roll_out.position_world[end];
  // Travel time left: the way at full speed, and half the change of velocity that is still needed.
  const Eigen::Vector2d wanted = goal_velocity(tail, guide, settings_);
  score.time = guide.cost_to_go(tail) / settings_.max_speed +
               0.5 * (wanted - roll_out.velocity_world[end]).norm() / settings_.max_acceleration;
  if (score.time > enough) return score;

  // Static surfaces: the chance that the own position error reaches one. It does not fade: a wall will still
  // be there, and a risk that fades would be put off for ever.
  const OccupancyMap& map = *request.world.map;
  const double softness = std::hypot(parameters_.static_sigma, request.position_sigma);
  const double wanted_clearance = robot_.radius + parameters_.static_margin;
  double least = std::numeric_limits<double>::infinity();
  for (int k = 1; k <= roll_out.steps; ++k) {
    least = std::min(least, map.distance(roll_out.position_world[static_cast<std::size_t>(k)]));
  }
  const double clearance = least - wanted_clearance;
  // Deeper is worse without end, so that a robot inside the margin is led out of it.
  const double depth = std::max(0.0, -clearance) / wanted_clearance;
  const double static_chance =
      clearance > 4.0 * softness ? 0.0 : 0.5 * std::erfc(clearance / softness * kSqrtHalf) + depth;
  const double left = (enough - score.time) / std::max(parameters_.risk_price, 1e-9) - static_chance;
  score.risk = static_chance * parameters_.risk_price;
  if (left < 0.0) return score;
  score.risk += risk_.along(roll_out.position_world, left, &score.worst) * parameters_.risk_price;
  return score;
}

void SpaceTimePlanner::consider(const Manoeuvre& manoeuvre, const PlanRequest& request,
                                const GuidePath& guide, PlanResult& result, bool keep) {
  roll_out(manoeuvre, request.head, guide, settings_, trial_);
  ++result.stats.manoeuvres;
  const double enough = keep ? std::numeric_limits<double>::infinity() : best_score_.total();
  const Score trial_score = score(trial_, request, guide, enough);
  if (keep) keep_candidate(trial_, Candidate::Kind::manoeuvre, trial_score, request, result);
  if (trial_score.total() >= best_score_.total()) return;
  best_ = trial_;
  best_score_ = trial_score;
  best_is_previous_ = false;
}

bool SpaceTimePlanner::consider_previous(const PlanRequest& request, const GuidePath& guide,
                                         PlanResult& result, bool keep) {
  const Trajectory* committed = request.committed;
  if (committed == nullptr || committed->empty()) return false;
  if (committed->end_time() < request.time + 1.0) return false;
  const FlatState now = committed->state(request.time);
  // Only when the request starts on it: after a reset the old plan is no longer a way to go.
  if ((now.position_world - request.head.position_world).norm() > 1e-6) return false;
  trial_.steps = settings_.steps;
  for (int k = 0; k <= settings_.steps; ++k) {
    const FlatState state = committed->state(request.time + k * settings_.step);
    trial_.position_world[static_cast<std::size_t>(k)] = state.position_world;
    trial_.velocity_world[static_cast<std::size_t>(k)] = state.velocity_world;
  }
  Score previous = score(trial_, request, guide, std::numeric_limits<double>::infinity());
  previous.time -= parameters_.keep_bonus;
  if (keep) keep_candidate(trial_, Candidate::Kind::previous, previous, request, result);
  if (previous.total() < best_score_.total()) {
    best_ = trial_;
    best_score_ = previous;
    best_is_previous_ = true;
  }
  return true;
}

void SpaceTimePlanner::consider_sidesteps(const PlanRequest& request, const GuidePath& guide,
                                          PlanResult& result, bool keep) {
  const Eigen::Vector2d ahead = guide.direction(request.head.position_world);
  const double base = ahead.squaredNorm() > 0.0 ? std::atan2(ahead.y(), ahead.x()) : 0.0;
  const std::array<double, 2> speeds{settings_.max_speed, parameters_.slow_fraction * settings_.max_speed};
  for (int i = 0; i < parameters_.headings; ++i) {
    const double angle = base + 2.0 * kPi * i / parameters_.headings;
    const Eigen::Vector2d direction{std::cos(angle), std::sin(angle)};
    for (const double speed : speeds) {
      const Eigen::Vector2d velocity = direction * speed;
      const double always = settings_.step * settings_.steps;
      consider({velocity, parameters_.short_sidestep, Manoeuvre::Then::goal}, request, guide, result, keep);
      consider({velocity, parameters_.long_sidestep, Manoeuvre::Then::goal}, request, guide, result, keep);
      consider({velocity, always, Manoeuvre::Then::hold}, request, guide, result, keep);
      consider({velocity, parameters_.short_sidestep, Manoeuvre::Then::brake}, request, guide, result, keep);
    }
  }
}

void SpaceTimePlanner::plan(const PlanRequest& request, const GuidePath& guide, bool keep_candidates,
                            PlanResult& result) {
  result.stats = {};
  result.candidates.clear();
  result.blocking_track = -1;
  result.blocking_peer = -1;
  best_score_ = {};
  best_score_.time = std::numeric_limits<double>::infinity();
  best_is_previous_ = false;

  // 1. Where everything that moves is believed to be over the horizon.
  risk_.prepare(request);
  // 2. The direct way, at once when it is free.
  consider({{}, 0.0, Manoeuvre::Then::goal}, request, guide, result, keep_candidates);
  const int obstructing = best_score_.worst;
  if (best_score_.risk > parameters_.accepted_risk) {
    // 3. What shapes the plan is named, then every other way is weighed.
    if (obstructing >= 0) {
      const SpaceTimeRisk::Entity& entity = risk_.entity(obstructing);
      (entity.is_peer ? result.blocking_peer : result.blocking_track) = entity.id;
    }
    consider_previous(request, guide, result, keep_candidates);
    consider({{}, 0.0, Manoeuvre::Then::brake}, request, guide, result, keep_candidates);
    consider({{}, parameters_.short_sidestep, Manoeuvre::Then::goal}, request, guide, result,
             keep_candidates);
    consider({{}, parameters_.long_sidestep, Manoeuvre::Then::goal}, request, guide, result, keep_candidates);
    consider_sidesteps(request, guide, result, keep_candidates);
  }
  // 4. The best of them is the plan.
  finish(request, result);
}

void SpaceTimePlanner::keep_candidate(const RollOut& roll_out, Candidate::Kind kind, const Score& score,
                                      const PlanRequest& request, PlanResult& result) const {
  Candidate candidate;
  candidate.kind = kind;
  candidate.cost = score.total();
  candidate.risk = score.risk;
  candidate.trajectory = to_trajectory(roll_out, request.time, settings_);
  result.candidates.push_back(candidate);
}

void SpaceTimePlanner::finish(const PlanRequest& request, PlanResult& result) const {
  result.risk = best_score_.risk;
  result.outcome = PlanOutcome::success;
  result.trajectory = best_is_previous_ ? *request.committed : to_trajectory(best_, request.time, settings_);
  for (Candidate& candidate : result.candidates) {
    candidate.chosen = candidate.cost == best_score_.total();
  }
}

}  // namespace spf
