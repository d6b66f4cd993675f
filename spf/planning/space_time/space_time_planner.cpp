#include "spf/planning/space_time/space_time_planner.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace spf {
namespace {

constexpr double kProgress = 0.3;   // [1] of the radius
constexpr double kElsewhere = 3.0;  // [1] likewise: so much farther it has another path, or was pushed off
constexpr std::array<double, 3> kPaces{0.5, 0.25, 0.12};  // [1] of max_speed: along a tight guide
constexpr double kSlowFraction = 0.5;  // [1] of max_speed: the second speed of the sidesteps
constexpr double kEarlyProgress =
    0.3;  // [1] weight of the distance to go at instants before the horizon: no putting off
constexpr double kBlockedStand = 4.0;  // [1] of stand_bonus, before something that stands in the way
constexpr int kProgressSamples = 3;
// A gap is no wider later on. A robot that has stood before one takes more of its risk, little by little.
constexpr double kHalvedAfter = 2.0;  // [s]
constexpr double kLeastPrice = 0.02;  // [1] of the price of the risk of surfaces
constexpr double kPauseTime = 0.5;    // [s] without a call: the robot did not wait of its own accord
constexpr double kCreepSpeed = 0.15;  // [1] of max_speed
constexpr double kHasteCost = 1e-3;   // [1] of collision_cost, at max_speed where none at all is safe
// Among many people some risk is always ahead. Beyond so many encounters within the horizon its price falls.
constexpr double kCrowd = 0.285;         // [1]
constexpr double kCrowdPower = 8.0;      // [1] how suddenly
constexpr double kCrowdFall = 13.0;      // [1]
constexpr double kCrowdCost = 25.0;      // [1] of the horizon: a certain contact, where it is most crowded
constexpr double kCrowdDiscount = 0.5;   // [1] of discount_time, where it is most crowded
constexpr double kCrowdMemory = 1.33;    // [1] of the horizon
constexpr double kCrowdRange = 2.67;     // [1] of the way at max_speed within the horizon
constexpr double kBehind = 0.3;          // [1] cosine: reversing towards such directions is tried, too
constexpr double kThere = 0.3;           // [1] of the radius from the goal: no need to face it
constexpr double kTurningCircles = 4.0;  // [1] so far the way on decides how long it takes to turn
constexpr double kLongTurn = 0.3;        // [s] whose alternatives are looked at
constexpr double kLeastSmoothed = 0.2;   // [s] at max_speed: shorter motions are not smoothed

RollOutSettings settings_of(const SpaceTimeParameters& parameters, const RobotParameters& robot, int steps) {
  return {robot.max_speed, robot.max_acceleration, parameters.step, steps, nullptr, nullptr, std::nullopt};
}

}  // namespace

SpaceTimePlanner::SpaceTimePlanner(const SpaceTimeParameters& parameters, const PlannerParameters& planner,
                                   const RobotParameters& robot)
    : parameters_{validated(parameters)},
      robot_{validated(robot)},
      risk_{parameters_, robot_.radius, robot_.max_speed},
      encounters_{robot_.radius, robot_.max_speed, kCrowdRange * robot_.max_speed * parameters_.horizon,
                  kCrowdMemory * parameters_.horizon},
      sight_{robot_, parameters_.static_margin},
      passage_{parameters_, robot_},
      surfaces_{parameters_, robot_},
      smoother_{parameters_, planner, robot_},
      judge_{validated(planner), robot_} {
  settings_ = settings_of(parameters_, robot_, risk_.steps());
  if (steers(robot_)) steering_.emplace(robot_);
}

/// The remaining path at full speed, and what its narrow places and turns take longer [s].
double SpaceTimePlanner::time_to_go(const Eigen::Vector2d& position_world, const CostToGo& guide) const {
  const double left = passage_.left_to_go(guide.cost_to_go(position_world));
  return left / settings_.max_speed + passage_.delay(left);
}

SpaceTimePlanner::Score SpaceTimePlanner::score(const RollOut& roll_out, const PlanRequest& request,
                                                double enough) const {
  const CostToGo& guide = *request.guide;
  Score score;
  const auto end = static_cast<std::size_t>(roll_out.steps);
  const Eigen::Vector2d& tail = roll_out.position_world[end];
  // Travel time: the horizon, the remaining path, and half the time for the remaining change of velocity.
  const Eigen::Vector2d wanted = goal_velocity(tail, guide, settings_);
  score.time = settings_.step * roll_out.steps + time_to_go(tail, guide) +
               0.5 * (wanted - roll_out.velocity_world[end]).norm() / settings_.max_acceleration;
  if (steering_) score.time += turning_time(roll_out.state(*steering_, roll_out.steps), guide);
  // Early progress is better than the same progress planned for later, which could be postponed again and
  // again: a part of the remaining path counts at some instants in between, too.
  double to_go = 0.0;
  for (int i = 1; i <= kProgressSamples; ++i) {
    const auto at = static_cast<std::size_t>(i * roll_out.steps / (kProgressSamples + 1));
    to_go += time_to_go(roll_out.position_world[at], guide);
  }
  score.time += kEarlyProgress * to_go / kProgressSamples;
  // Faster than what may come from beyond its sight allows.
  const auto soon = static_cast<std::size_t>(
      std::min(roll_out.steps, static_cast<int>(std::ceil(request.world.sight.reaction / settings_.step))));
  const double haste = roll_out.velocity_world[soon].norm() - sight_.open_speed();
  if (haste > 0.0) score.time += kHasteCost * parameters_.collision_cost * haste / robot_.max_speed;
  if (score.time > enough) return score;

  // The motion must end where the robot can still stop; otherwise a blocked robot would run at the obstacle
  // again and again.
  const Eigen::Vector2d& velocity = roll_out.velocity_world[end];
  const Eigen::Vector2d stop = tail + velocity * (velocity.norm() / (2.0 * settings_.max_acceleration));
  // By the time a new plan can brake the robot, it must be able to stand within what it has seen.
  double left = (enough - score.time) / std::max(parameters_.collision_cost, 1e-9);
  double static_chance = surfaces_.chance(roll_out, stop, request, left);
  if (static_chance <= left)
    static_chance += sight_.blind_share(roll_out.position_world[soon], roll_out.velocity_world[soon]);
  left -= static_chance;
  score.risk = static_chance * parameters_.collision_cost;
  if (left < 0.0) return score;
  const double moving_chance = risk_.along(roll_out.position_world, roll_out.steps, stop, left, &score.worst);
  score.risk += moving_chance * parameters_.collision_cost;
  return score;
}

void SpaceTimePlanner::take_best(const Score& score, int candidate, bool is_previous) {
  best_ = trial_;
  best_score_ = score;
  best_candidate_ = candidate;
  best_is_previous_ = is_previous;
}

void SpaceTimePlanner::consider(const MotionPrimitive& primitive, const PlanRequest& request,
                                PlanResult& result, double bonus) {
  roll_out(primitive, request.head, request.heading, *request.guide, settings_, trial_);
  ++result.stats.primitives;
  const double enough =
      request.keep_candidates ? std::numeric_limits<double>::infinity() : best_score_.total();
  Score trial_score = score(trial_, request, enough + bonus);
  trial_score.time -= bonus;
  const int candidate = keep_candidate(trial_, Candidate::Kind::primitive, trial_score, request, result);
  if (trial_score.total() < best_score_.total()) take_best(trial_score, candidate, false);
}

/// A trajectory as a roll-out over the whole horizon: it is driven until `drive_end`, then its velocity is
/// held instead of braking, so that plans of different age are compared over the same time; or it brakes.
void SpaceTimePlanner::sample(const Trajectory& trajectory, double from, double drive_end, bool brakes) {
  trial_.steps = settings_.steps;
  const FlatState last = trajectory.state(drive_end);
  for (int k = 0; k <= trial_.steps; ++k) {
    const auto at = static_cast<std::size_t>(k);
    const double time = from + k * settings_.step;
    const FlatState state = time < drive_end ? trajectory.state(time) : last;
    double beyond = std::max(0.0, time - drive_end);
    double kept = 1.0;  // of the velocity
    if (brakes) {
      const double stop = std::max(state.velocity_world.norm() / settings_.max_acceleration, 1e-9);
      beyond = std::min(beyond, stop);
      kept = 1.0 - beyond / stop;
    }
    trial_.position_world[at] = state.position_world + 0.5 * (1.0 + kept) * beyond * state.velocity_world;
    trial_.velocity_world[at] = kept * state.velocity_world;
    if (steering_) trial_.heading[at] = trajectory.heading_state(std::min(time, drive_end));
  }
}

void SpaceTimePlanner::consider_previous(const PlanRequest& request, PlanResult& result) {
  const Trajectory* committed = request.committed;
  if (committed == nullptr || committed->empty() || committed->start_time() != plan_start_) return;
  if (request.time > plan_start_ + parameters_.renewal) return;
  if (drive_end_ - request.time < 0.3 * settings_.step * settings_.steps) return;
  constexpr double kAll = std::numeric_limits<double>::infinity();
  sample(*committed, request.time, drive_end_, false);
  Score previous = score(trial_, request, kAll);
  if (previous.risk > parameters_.cost_threshold) {
    // It may end before a turn, where to go straight on is no choice.
    sample(*committed, request.time, drive_end_, true);
    const Score braking = score(trial_, request, kAll);
    if (braking.total() < previous.total())
      previous = braking;
    else
      sample(*committed, request.time, drive_end_, false);
  }
  previous.time -= parameters_.keep_bonus;
  take_best(previous, keep_candidate(trial_, Candidate::Kind::previous, previous, request, result), true);
}

/// How much longer [s] it takes to get on from a state because the robot has to turn.
double SpaceTimePlanner::turning_time(const SteeredState& state, const CostToGo& guide) const {
  const double left = guide.cost_to_go(state.position_world);
  const double goal = (guide.goal_used() - state.position_world).norm();
  if (goal < kThere * robot_.radius) return 0.0;
  const bool near = left < (1.0 + kNarrowCost) * goal && goal < kTurningCircles * turning_reach();
  const Eigen::Vector2d target =
      near ? guide.goal_used()
           : Eigen::Vector2d{state.position_world +
                             kTurningCircles * turning_reach() * guide.direction(state.position_world)};
  return steering_->turning_time(state, target);
}

void SpaceTimePlanner::consider_sidesteps(const PlanRequest& request, PlanResult& result) {
  const Eigen::Vector2d ahead = request.guide->direction(request.head.position_world);
  const double base = ahead.squaredNorm() > 0.0 ? std::atan2(ahead.y(), ahead.x()) : 0.0;
  const std::array<double, 2> speeds{robot_.max_speed, kSlowFraction * robot_.max_speed};
  for (int i = 0; i < parameters_.headings; ++i) {
    const double angle = base + 2.0 * kPi * i / parameters_.headings;
    const Eigen::Vector2d direction{std::cos(angle), std::sin(angle)};
    for (const double speed : speeds) {
      const Eigen::Vector2d velocity = direction * speed;
      const double always = settings_.step * settings_.steps;
      consider({velocity, parameters_.short_sidestep, MotionPrimitive::Then::goal}, request, result);
      consider({velocity, parameters_.long_sidestep, MotionPrimitive::Then::goal}, request, result);
      consider({velocity, always, MotionPrimitive::Then::hold}, request, result);
      consider({velocity, parameters_.short_sidestep, MotionPrimitive::Then::brake}, request, result);
      if (!steering_ || !steering_->may_reverse() || std::cos(angle - request.heading.heading) > kBehind)
        continue;
      for (const double until : {parameters_.short_sidestep, parameters_.long_sidestep})
        consider({velocity, until, MotionPrimitive::Then::goal, 1.0, Gear::reverse}, request, result);
      consider({velocity, always, MotionPrimitive::Then::hold, 1.0, Gear::reverse}, request, result);
      consider({velocity, parameters_.short_sidestep, MotionPrimitive::Then::brake, 1.0, Gear::reverse},
               request, result);
    }
  }
}

/// Names the disc that shapes the plan most, then tries all other primitives.
void SpaceTimePlanner::consider_all(const PlanRequest& request, const Score& direct, PlanResult& result) {
  if (direct.worst >= 0) {
    const SpaceTimeRisk::PredictedDisc& disc = risk_.disc(direct.worst);
    (disc.is_peer ? result.blocking_peer : result.blocking_track) = disc.id;
  }
  const Eigen::Vector2d still = Eigen::Vector2d::Zero();
  const bool slow = request.head.velocity_world.norm() < 0.3 * robot_.max_speed;
  const double bonus = parameters_.stand_bonus * (passage_.stands_before() ? kBlockedStand : 1.0);
  consider({still, 0.0, MotionPrimitive::Then::brake}, request, result, slow ? bonus : 0.0);
  if (direct.worst >= 0) {  // to wait helps against what moves; a surface would be put off again and again
    consider({still, parameters_.short_sidestep, MotionPrimitive::Then::goal}, request, result);
    consider({still, parameters_.long_sidestep, MotionPrimitive::Then::goal}, request, result);
  }
  for (const double pace : kPaces) consider({still, 0.0, MotionPrimitive::Then::goal, pace}, request, result);
  consider_sidesteps(request, result);
}

void SpaceTimePlanner::update_surface_price(const PlanRequest& request) {
  const bool asked_all_the_time =
      request.time - progress_.asked_time < kPauseTime && request.time >= progress_.asked_time;
  progress_.asked_time = request.time;
  const bool on_its_way = progress_.goal == request.goal_world && asked_all_the_time &&
                          !passage_.stands_before() &&
                          request.guide->cost_to_go(request.head.position_world) > 2.0 * robot_.radius;
  // To hover before a gap is no progress either.
  const double left = request.guide->cost_to_go(request.head.position_world);
  const bool comes_nearer = left < progress_.nearest - kProgress * robot_.radius;
  if (comes_nearer || !on_its_way || left > progress_.nearest + kElsewhere * robot_.radius)
    progress_.nearest = left;
  const bool hovers = passage_.limits() && !comes_nearer;
  if (!on_its_way || (!hovers && request.head.velocity_world.norm() > kCreepSpeed * robot_.max_speed))
    progress_.waits_since = request.time;
  progress_.goal = request.goal_world;
  const double waited = (request.time - progress_.waits_since) / kHalvedAfter;
  surfaces_.set_price(std::max(kLeastPrice, 1.0 / (1.0 + waited * waited)));
}

/// Chosen on crowds made by `spf crowd` and on T2-hard, which it leaves as it was.
MovingRisk SpaceTimePlanner::risk_in_crowd() const {
  const double encounters = encounters_.per_second() * parameters_.horizon;
  const double power = std::pow(encounters / kCrowd, kCrowdPower);
  const double crowd = 1.0 - 1.0 / (1.0 + power);  // also where that is infinite
  const double least = kCrowdCost * parameters_.horizon / std::max(parameters_.collision_cost, 1e-9);
  return {std::max(std::min(1.0, least), 1.0 / (1.0 + kCrowdFall * crowd)),
          1.0 - (1.0 - kCrowdDiscount) * crowd};
}

void SpaceTimePlanner::plan(const PlanRequest& request, PlanResult& result) {
  result.clear();
  if (const std::optional<PlanOutcome> refused = refusal(request)) {
    stand_instead(request, robot_, *refused, result);
    return;
  }
  best_score_ = {};
  best_score_.time = std::numeric_limits<double>::infinity();
  best_is_previous_ = false;
  best_candidate_ = -1;

  // 1. Predictions of obstacles and peers over the horizon, and how fast sight allows to go.
  encounters_.update(request);
  risk_.prepare(request, risk_in_crowd());
  sight_.prepare(request);
  settings_.max_speed = sight_.speed();
  passage_.prepare(request);
  settings_.passage = &passage_;
  settings_.steering = steering_ ? &*steering_ : nullptr;
  settings_.goal_heading = request.goal_heading;
  update_surface_price(request);
  // 2. The current plan and the direct primitive; these suffice when the direct one is free.
  consider_previous(request, result);
  const MotionPrimitive direct{Eigen::Vector2d::Zero(), 0.0, MotionPrimitive::Then::goal};
  roll_out(direct, request.head, request.heading, *request.guide, settings_, trial_);
  const Score direct_score = score(trial_, request, std::numeric_limits<double>::infinity());
  consider(direct, request, result);
  // 3. Else all primitives.
  const bool in_the_way = passage_.in_the_way(request.guide->cost_to_go(request.head.position_world));
  // A car that has to turn may do so forward or backward.
  const bool manoeuvres =
      steering_ && !steering_->turns_on_the_spot() &&
      turning_time(steering_->state_of(request.head, request.heading), *request.guide) > kLongTurn;
  if (in_the_way || manoeuvres || direct_score.risk > parameters_.cost_threshold)
    consider_all(request, direct_score, result);
  if (request.give_way) result.blocking_peer = request.give_way->peer;
  if (const StandingDisc* blocker = passage_.blocked_by())
    (blocker->is_peer ? result.blocking_peer : result.blocking_track) = blocker->id;
  // 4. The best of them, smoothed, is the plan.
  finish(request, result);
}

int SpaceTimePlanner::keep_candidate(const RollOut& roll_out, Candidate::Kind kind, const Score& score,
                                     const PlanRequest& request, PlanResult& result) const {
  if (!request.keep_candidates) return -1;
  result.candidates.push_back(
      {kind, score.total(), 0.0, false, to_trajectory(roll_out, request.time, settings_)});
  return static_cast<int>(result.candidates.size()) - 1;
}

bool SpaceTimePlanner::smooth_best(const PlanRequest& request, PlanResult& result) {
  if (!parameters_.smoothing || steering_) return false;
  // Standing still is not smoothed: the optimiser would move away from the risk and back again.
  const Eigen::Vector2d& tail = best_.position_world[static_cast<std::size_t>(best_.steps)];
  if ((tail - best_.position_world[0]).norm() < kLeastSmoothed * robot_.max_speed) return false;
  if (!smoother_.smooth(best_, request, risk_, settings_, smooth_, result.stats)) return false;
  const double braking = best_.velocity_world[static_cast<std::size_t>(best_.steps)].norm();
  const double drive_end = smooth_.end_time() - (braking > 1e-6 ? braking / settings_.max_acceleration : 0.0);
  if (drive_end - request.time < 0.5 * settings_.step * settings_.steps) return false;
  sample(smooth_, request.time, drive_end, false);
  const double enough = best_score_.total() + parameters_.smoothing_tolerance;
  const Score smooth_score =
      score(trial_, request, request.keep_candidates ? std::numeric_limits<double>::infinity() : enough);
  const int candidate = keep_candidate(trial_, Candidate::Kind::optimised, smooth_score, request, result);
  if (smooth_score.total() > enough) return false;
  best_score_ = smooth_score;
  best_candidate_ = candidate;
  drive_end_ = drive_end;
  return true;
}

void SpaceTimePlanner::finish(const PlanRequest& request, PlanResult& result) {
  if (best_is_previous_) {
    result.action = PlanAction::keep;
    result.trajectory = *request.committed;
  } else {
    result.action = PlanAction::follow;
    plan_start_ = request.time;
    drive_end_ = request.time + settings_.step * best_.steps;
    const bool smooth = smooth_best(request, result);
    result.trajectory = smooth ? smooth_ : to_trajectory(best_, request.time, settings_);
  }
  judge_.judge(request, drive_end_, result);
  if (best_candidate_ >= 0) result.candidates[static_cast<std::size_t>(best_candidate_)].chosen = true;
}

}  // namespace spf
