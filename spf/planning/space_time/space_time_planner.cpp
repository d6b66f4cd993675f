#include "spf/planning/space_time/space_time_planner.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace spf {
namespace {

constexpr int kProgressSamples = 3;
constexpr double kLeastSmoothed = 0.2;  // [s] at max_speed: shorter ways are not smoothed
constexpr double kSqrtHalf = 0.70710678118654752440;

RollOutSettings settings_of(const SpaceTimeParameters& parameters, const RobotParameters& robot, int steps) {
  return {robot.max_speed, robot.max_acceleration, parameters.step, steps};
}

}  // namespace

SpaceTimePlanner::SpaceTimePlanner(const SpaceTimeParameters& parameters, const PlannerParameters& planner,
                                   const RobotParameters& robot)
    : parameters_{validated(parameters)},
      robot_{validated(robot)},
      risk_{parameters_, robot_.radius, robot_.max_speed},
      smoother_{parameters_, planner, robot_} {
  settings_ = settings_of(parameters_, robot_, risk_.steps());
}

SpaceTimePlanner::Score SpaceTimePlanner::score(const RollOut& roll_out, const PlanRequest& request,
                                                const GuidePath& guide, double enough) const {
  Score score;
  const auto end = static_cast<std::size_t>(roll_out.steps);
  const Eigen::Vector2d& tail = roll_out.position_world[end];
  // Travel time: what has passed, the way left at full speed, and half the change of velocity that is still
  // needed.
  const Eigen::Vector2d wanted = goal_velocity(tail, guide, settings_);
  score.time = settings_.step * roll_out.steps + guide.cost_to_go(tail) / settings_.max_speed +
               0.5 * (wanted - roll_out.velocity_world[end]).norm() / settings_.max_acceleration;
  // Progress now is better than the same progress promised for later, which would be promised again and
  // again: a part of the way still to go counts at some instants in between, too.
  double between = 0.0;
  for (int i = 1; i <= kProgressSamples; ++i) {
    const auto at = static_cast<std::size_t>(i * roll_out.steps / (kProgressSamples + 1));
    between += guide.cost_to_go(roll_out.position_world[at]);
  }
  score.time += parameters_.early_progress * between / (kProgressSamples * settings_.max_speed);
  if (score.time > enough) return score;

  // Static surfaces: the chance that the own position error reaches one. It does not fade: a wall will still
  // be there, and a risk that fades would be put off for ever.
  const OccupancyMap& map = *request.world.map;
  const double softness = std::hypot(parameters_.static_sigma, request.position_sigma);
  const double wanted_clearance = robot_.radius + map.margin(parameters_.static_margin);
  double least = std::numeric_limits<double>::infinity();
  for (int k = 1; k <= roll_out.steps; ++k) {
    least = std::min(least, map.distance(roll_out.position_world[static_cast<std::size_t>(k)]));
  }
  // The way must not end where it could not stop, or a blocked robot would take run after run at what blocks
  // it.
  const Eigen::Vector2d& velocity = roll_out.velocity_world[end];
  const Eigen::Vector2d stop = tail + velocity * (velocity.norm() / (2.0 * settings_.max_acceleration));
  least = std::min({least, map.distance(0.5 * (tail + stop)), map.distance(stop)});
  const double clearance = least - wanted_clearance;
  // Deeper is worse without end, so that a robot inside the margin is led out of it.
  const double depth = std::max(0.0, -clearance) / wanted_clearance;
  const double static_chance =
      clearance > 4.0 * softness ? 0.0 : 0.5 * std::erfc(clearance / softness * kSqrtHalf) + depth;
  const double left = (enough - score.time) / std::max(parameters_.risk_price, 1e-9) - static_chance;
  score.risk = static_chance * parameters_.risk_price;
  if (left < 0.0) return score;
  score.risk +=
      risk_.along(roll_out.position_world, roll_out.steps, stop, left, &score.worst) * parameters_.risk_price;
  return score;
}

void SpaceTimePlanner::consider(const Manoeuvre& manoeuvre, const PlanRequest& request,
                                const GuidePath& guide, PlanResult& result, bool keep, double bonus) {
  roll_out(manoeuvre, request.head, guide, settings_, trial_);
  ++result.stats.manoeuvres;
  const double enough = keep ? std::numeric_limits<double>::infinity() : best_score_.total();
  Score trial_score = score(trial_, request, guide, enough + bonus);
  trial_score.time -= bonus;
  if (keep) keep_candidate(trial_, Candidate::Kind::manoeuvre, trial_score, request, result);
  if (trial_score.total() >= best_score_.total()) return;
  best_ = trial_;
  best_score_ = trial_score;
  best_is_previous_ = false;
}

/// A trajectory as a roll-out over the whole horizon: it is driven until `drive_end`, then its velocity is
/// held instead of braking, so that plans of different age are compared over the same time.
void SpaceTimePlanner::sample(const Trajectory& trajectory, double from, double drive_end) {
  trial_.steps = settings_.steps;
  const FlatState last = trajectory.state(drive_end);
  for (int k = 0; k <= trial_.steps; ++k) {
    const auto at = static_cast<std::size_t>(k);
    const double time = from + k * settings_.step;
    const FlatState state = time < drive_end ? trajectory.state(time) : last;
    trial_.position_world[at] = state.position_world + std::max(0.0, time - drive_end) * state.velocity_world;
    trial_.velocity_world[at] = state.velocity_world;
  }
}

void SpaceTimePlanner::consider_previous(const PlanRequest& request, const GuidePath& guide,
                                         PlanResult& result, bool keep) {
  const Trajectory* committed = request.committed;
  if (committed == nullptr || committed->empty() || committed->start_time() != plan_start_) return;
  if (request.time > plan_start_ + parameters_.renewal) return;
  if (drive_end_ - request.time < 0.3 * settings_.step * settings_.steps) return;
  sample(*committed, request.time, drive_end_);
  Score previous = score(trial_, request, guide, std::numeric_limits<double>::infinity());
  previous.time -= parameters_.keep_bonus;
  if (keep) keep_candidate(trial_, Candidate::Kind::previous, previous, request, result);
  best_ = trial_;
  best_score_ = previous;
  best_is_previous_ = true;
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
  // 2. The plan under way and the direct way; enough when the direct way is free.
  consider_previous(request, guide, result, keep_candidates);
  const Eigen::Vector2d still = Eigen::Vector2d::Zero();
  const Manoeuvre direct{still, 0.0, Manoeuvre::Then::goal};
  roll_out(direct, request.head, guide, settings_, trial_);
  const Score direct_score = score(trial_, request, guide, std::numeric_limits<double>::infinity());
  consider(direct, request, guide, result, keep_candidates);
  if (direct_score.risk > parameters_.accepted_risk) {
    // 3. What shapes the plan is named, then every other way is weighed.
    if (direct_score.worst >= 0) {
      const SpaceTimeRisk::Entity& entity = risk_.entity(direct_score.worst);
      (entity.is_peer ? result.blocking_peer : result.blocking_track) = entity.id;
    }
    const bool slow = request.head.velocity_world.norm() < 0.3 * robot_.max_speed;
    consider({still, 0.0, Manoeuvre::Then::brake}, request, guide, result, keep_candidates,
             slow ? parameters_.stand_bonus : 0.0);
    consider({still, parameters_.short_sidestep, Manoeuvre::Then::goal}, request, guide, result,
             keep_candidates);
    consider({still, parameters_.long_sidestep, Manoeuvre::Then::goal}, request, guide, result,
             keep_candidates);
    consider_sidesteps(request, guide, result, keep_candidates);
  }
  // 4. The best of them, made smooth, is the plan.
  finish(request, guide, result, keep_candidates);
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

bool SpaceTimePlanner::smooth_best(const PlanRequest& request, const GuidePath& guide, PlanResult& result,
                                   bool keep) {
  if (!parameters_.smoothing) return false;
  // Standing is smooth as it is; optimised, it would lean away from the risk and back again.
  const Eigen::Vector2d& tail = best_.position_world[static_cast<std::size_t>(best_.steps)];
  if ((tail - best_.position_world[0]).norm() < kLeastSmoothed * robot_.max_speed) return false;
  if (!smoother_.smooth(best_, request, risk_, settings_, smooth_, result.stats)) return false;
  const double braking = best_.velocity_world[static_cast<std::size_t>(best_.steps)].norm();
  const double drive_end = smooth_.end_time() - (braking > 1e-6 ? braking / settings_.max_acceleration : 0.0);
  if (drive_end - request.time < 0.5 * settings_.step * settings_.steps) return false;
  sample(smooth_, request.time, drive_end);
  const double enough = best_score_.total() + parameters_.smoothing_tolerance;
  const Score smooth_score =
      score(trial_, request, guide, keep ? std::numeric_limits<double>::infinity() : enough);
  if (keep) keep_candidate(trial_, Candidate::Kind::optimised, smooth_score, request, result);
  if (smooth_score.total() > enough) return false;
  best_score_ = smooth_score;
  drive_end_ = drive_end;
  return true;
}

void SpaceTimePlanner::finish(const PlanRequest& request, const GuidePath& guide, PlanResult& result,
                              bool keep) {
  result.outcome = PlanOutcome::success;
  if (best_is_previous_) {
    result.trajectory = *request.committed;
  } else {
    plan_start_ = request.time;
    drive_end_ = request.time + settings_.step * best_.steps;
    const bool smooth = smooth_best(request, guide, result, keep);
    result.trajectory = smooth ? smooth_ : to_trajectory(best_, request.time, settings_);
  }
  result.risk = best_score_.risk;
  for (Candidate& candidate : result.candidates) {
    candidate.chosen = candidate.cost == best_score_.total();
  }
}

}  // namespace spf
