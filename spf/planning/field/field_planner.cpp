#include "spf/planning/field/field_planner.hpp"

#include <algorithm>
#include <cmath>

#include "spf/planning/braking.hpp"

namespace spf {
namespace {

constexpr double kCheckedFraction = 0.667;  // [1] of the plan, from its start, that heeds what moves; the
                                            // rest is planned again before it is driven (ES2: 2/3)
constexpr int kMaxSideCombinations = 8;     // ways past the obstacles in conflict that are optimised
constexpr double kSideBonus = 0.15;         // [1] discount of the side taken last time
constexpr int kUnsafeRetries = 2;           // further runs of a candidate after a failed check (ES2)
constexpr int kMaxRebounds = 20;            // runs cut short by a newly met static obstacle (ES2)
constexpr std::size_t kPairCapacity = 1024;
constexpr int kEarliestRebound = 3;  // evaluations of a run before it may be cut short (es2)

/// Detours are local: a window of a few metres, in a memory of about a megabyte.
constexpr GridSearchParameters detour_search() {
  GridSearchParameters parameters;
  parameters.window_nodes = 32768;
  parameters.node_budget = 8000;
  return parameters;
}

/// Path search for the guide pairs, at the clearance of the checks.
struct StaticSearch {
  GridSearch& search;
  const OccupancyMap& map;
  double clearance;  // [m] of the robot's centre
  bool operator()(const Eigen::Vector2d& from, const Eigen::Vector2d& to,
                  std::vector<Eigen::Vector2d>& path) const {
    for (const double margin : {1.5, 4.0}) {
      GridSearchRequest request{from, to, clearance, margin};
      const GridSearchOutcome outcome = search.search(map, request).outcome;
      if (outcome == GridSearchOutcome::no_path) continue;
      if (outcome != GridSearchOutcome::found) return false;
      path.push_back(from);
      path.insert(path.end(), search.path().begin(), search.path().end());
      path.push_back(to);
      return true;
    }
    return false;
  }
};

/// Last node that takes peers and moving obstacles into account: at `fraction` of the plan, but at least
/// twice the stopping time plus 1 s ahead.
int last_moving_node(const NodeSet& nodes, double fraction, bool tail_is_goal, const RobotParameters& robot) {
  const int tail = nodes.size() - 1;
  if (tail_is_goal) return tail;
  const double enough = 1.0 + 2.0 * robot.max_speed / robot.max_acceleration;  // [s]
  int last = std::clamp(static_cast<int>(std::ceil(fraction * tail)), 1, tail);
  while (last < tail && nodes[last].time < nodes[0].time + enough) ++last;
  return last;
}

/// The planned speed that the wheels can follow in every direction while the robot does not turn (no wheel is
/// ever faster than the centre then). The remainder for turning is found per plan (fitted_heading).
RobotParameters within_wheel_limits(RobotParameters robot) {
  robot.max_speed = std::min(robot.max_speed, robot.max_wheel_speed / (1.0 + kSpeedTolerance));
  return robot;
}

}  // namespace

FieldPlanner::FieldPlanner(const PlannerParameters& planner, const RobotParameters& robot,
                           const FieldParameters& field)
    : planner_{validated(planner)},
      robot_{within_wheel_limits(validated(robot))},
      drive_{robot},
      clearance_{planner, robot, validated(field)},
      guidance_{planner.safety_distance, planner.least_lateral_share},
      finder_{planner.max_pieces * planner.nodes_per_piece + 1},
      search_{detour_search()},
      seeds_{planner, robot_},
      optimizer_{planner, robot_} {
  for (std::vector<GuidePair>* pairs : {&seed_pairs_, &static_pairs_, &field_pairs_})
    pairs->reserve(kPairCapacity);
  conflicts_.reserve(64);
  sides_.reserve(64);
  best_.sides.reserve(64);
}

void FieldPlanner::plan(const PlanRequest& request, PlanResult& result) {
  result.clear();
  best_.valid = false;
  last_report_ = {};
  finder_.reset_searches();

  // 1. Reject invalid requests; resting at the goal is a plan.
  if (!usable(request)) {
    stand_instead(request, robot_, PlanOutcome::invalid_request, result);
    return;
  }
  const CostToGo& guide = *request.guide;
  // 2. Peers, obstacles and their fields as believed now.
  prepare(request);
  brake_ = braking_trajectory(request.head, request.heading, request.time, robot_);
  const CostToGoOutcome found = guide.outcome();
  const bool no_field = found == CostToGoOutcome::no_free_goal;
  if (!no_field && stands_at_goal(request, result)) return;
  if (no_field || found == CostToGoOutcome::unreachable) {
    conclude(request, PlanOutcome::no_path, result);
    return;
  }

  // 3. Seeds in turn, until one leads to an accepted plan.
  LocalTarget target = seeds_.local_target(request, guide, clearance_, planner_.horizon);
  bool in_budget = true;
  for (const SeedKind kind : {SeedKind::warm, SeedKind::cold, SeedKind::bowed_left, SeedKind::bowed_right,
                              SeedKind::slow, SeedKind::short_horizon}) {
    if (kind == SeedKind::short_horizon) {
      if (target.distance < planner_.piece_length) break;
      target =
          seeds_.local_target(request, guide, clearance_, 0.5 * std::min(target.distance, planner_.horizon));
    }
    in_budget = try_seed(kind, request, target, result);
    if (best_.valid || !in_budget) break;
  }
  // 4. The best accepted plan, or braking.
  conclude(request, in_budget ? PlanOutcome::unsafe : PlanOutcome::deadline, result);
}

void FieldPlanner::prepare(const PlanRequest& request) {
  clearance_.prepare(request.world, request.time, PeerSelection::yield_to);
  clearance_.widen_regions([&](int id) { return guidance_.widening(id, request.time); });
}

bool FieldPlanner::stands_at_goal(const PlanRequest& request, PlanResult& result) {
  constexpr double kRestSpeed = 0.01;
  if ((request.head.position_world - request.guide->goal_used()).norm() > planner_.goal_tolerance)
    return false;
  if (request.head.velocity_world.norm() > kRestSpeed * std::max(1.0, robot_.max_speed)) return false;
  result.trajectory = brake_;
  add_heading(request, result.trajectory);
  result.outcome = PlanOutcome::goal_reached;
  result.action = PlanAction::follow;
  return true;
}

bool FieldPlanner::try_seed(SeedKind kind, const PlanRequest& request, const LocalTarget& target,
                            PlanResult& result) {
  if (!seeds_.make(kind, request, target, seed_)) return true;
  problem_ = {};
  problem_.start_time = request.time;
  problem_.ends = {request.head, target.state};
  optimizer_.set(problem_, seed_);
  const NodeSet& nodes = optimizer_.nodes();
  problem_.last_moving_node = last_moving_node(nodes, kCheckedFraction, target.is_goal, robot_);
  problem_.discs = &clearance_.discs();
  problem_.static_pairs = &static_pairs_;
  problem_.field_pairs = &field_pairs_;

  // Static obstacles that the seed runs through, and obstacles whose field it enters.
  seed_pairs_.clear();
  StaticSearch search{search_, clearance_.map(), robot_.radius + clearance_.static_margin()};
  if (finder_.find(clearance_, nodes, PathSearchRef{search}, seed_pairs_) ==
      GuidePairFinder::Outcome::blocked) {
    last_report_.kind = ConflictKind::static_map;
    return true;
  }
  guidance_.find_conflicts(clearance_.regions(), nodes, problem_.last_moving_node, request.head, conflicts_);

  // Every combination of sides (Fig. 4), the first obstacles first.
  const int sides = static_cast<int>(conflicts_.size());
  int free_sides = 0;
  while (free_sides < sides && (2 << free_sides) <= kMaxSideCombinations) ++free_sides;
  for (int mask = 0; mask < (1 << free_sides); ++mask) {
    sides_.assign(clearance_.regions().size(), SideChoice{});
    for (std::size_t i = 0; i < conflicts_.size(); ++i) {
      const FieldConflict& conflict = conflicts_[i];
      const bool mirror = static_cast<int>(i) < free_sides && ((mask >> i) & 1) != 0;
      const int side = static_cast<int>(conflict.natural) * (mirror ? -1 : 1);
      sides_[static_cast<std::size_t>(conflict.region)] = {true, static_cast<PassingSide>(side),
                                                           conflict.along, conflict.entry_world};
    }
    Candidate::Kind label = kind == SeedKind::warm ? Candidate::Kind::previous : Candidate::Kind::optimised;
    if (free_sides > 0) label = mask == 0 ? Candidate::Kind::side_a : Candidate::Kind::side_b;
    if (!run_candidate(request, label, result)) return false;
  }
  return true;
}

bool FieldPlanner::run_candidate(const PlanRequest& request, Candidate::Kind kind, PlanResult& result) {
  static_pairs_ = seed_pairs_;
  field_pairs_.clear();
  problem_.peer_factor = problem_.dynamic_factor = problem_.static_factor = problem_.limits_factor = 1.0;
  current_ = seed_;
  optimizer_.set(problem_, current_);
  guidance_.add_pairs(clearance_.regions(), optimizer_.nodes(), problem_.last_moving_node, request.head,
                      sides_, field_pairs_);
  int rebounds = 0;
  int failed_checks = 0;
  while (true) {
    if (result.stats.evaluations + planner_.run_evaluations > planner_.max_evaluations) return false;
    bool rebound = false;
    const OptimizerResult run = launch(rebounds < kMaxRebounds, rebound, result);
    current_ = optimizer_.solution();
    if (run.outcome == LbfgsOutcome::not_finite) return true;
    if (rebound) {
      ++rebounds;
      continue;
    }
    // The same check as for every other plan.
    const Trajectory trajectory = optimizer_.trajectory();
    const double until = optimizer_.nodes()[problem_.last_moving_node].time;
    last_report_ = clearance_.check(trajectory, {request.time, trajectory.end_time(), until, 1.0, &brake_});
    const LimitReport limits = check_limits(trajectory, robot_, drive_);
    if (last_report_.clear() && within_limits(limits, request.head)) {
      keep_best(request, run, kind, trajectory, result);
      return true;
    }
    if (failed_checks++ >= kUnsafeRetries || !answer(request)) return true;
  }
}

/// One L-BFGS run. Cut short when a node gets into a static obstacle for which there is no pair; pairs are
/// then added.
OptimizerResult FieldPlanner::launch(bool may_rebound, bool& rebound, PlanResult& result) {
  int evaluations = 0;
  StaticSearch search{search_, clearance_.map(), robot_.radius + clearance_.static_margin()};
  const auto watch = [&](const NodeSet& nodes) {
    if (!may_rebound || ++evaluations < kEarliestRebound) return LbfgsSignal::proceed;
    if (!GuidePairFinder::new_collision(clearance_, nodes, static_pairs_)) return LbfgsSignal::proceed;
    if (static_pairs_.size() + static_cast<std::size_t>(nodes.size()) > kPairCapacity)
      return LbfgsSignal::proceed;
    const auto outcome = finder_.find(clearance_, nodes, PathSearchRef{search}, static_pairs_);
    rebound = outcome == GuidePairFinder::Outcome::added;
    return rebound ? LbfgsSignal::cancel : LbfgsSignal::proceed;
  };
  const OptimizerResult run = optimizer_.optimise(problem_, current_, watch);
  ++result.stats.optimiser_calls;
  result.stats.inner_iterations += run.iterations;
  result.stats.evaluations += run.evaluations;
  return run;
}

bool FieldPlanner::answer(const PlanRequest& request) {
  constexpr double kHarder = 2.0;
  // The field's guide points are recomputed at the current nodes, on the chosen sides.
  guidance_.add_pairs(clearance_.regions(), optimizer_.nodes(), problem_.last_moving_node, request.head,
                      sides_, field_pairs_);
  switch (last_report_.kind) {
    case ConflictKind::none:
      problem_.limits_factor *= kHarder;
      return true;
    case ConflictKind::peer:
      problem_.peer_factor *= kHarder;
      return true;
    case ConflictKind::obstacle:
      problem_.peer_factor *= kHarder;
      problem_.dynamic_factor *= kHarder;
      return true;
    case ConflictKind::static_map: {
      problem_.static_factor *= kHarder;
      if (static_pairs_.size() + static_cast<std::size_t>(optimizer_.nodes().size()) > kPairCapacity)
        return true;
      StaticSearch search{search_, clearance_.map(), robot_.radius + clearance_.static_margin()};
      return finder_.find(clearance_, optimizer_.nodes(), PathSearchRef{search}, static_pairs_) !=
             GuidePairFinder::Outcome::blocked;
    }
  }
  return false;
}

bool FieldPlanner::within_limits(const LimitReport& limits, const FlatState& head) const {
  // An excess that the head has already (after a push) does not count against the plan.
  const double head_speed = head.velocity_world.norm() / robot_.max_speed;
  const double head_acceleration = head.acceleration_world.norm() / robot_.max_acceleration;
  return limits.speed <= std::max(1.0, head_speed) + kSpeedTolerance &&
         limits.acceleration <= std::max(1.0, head_acceleration) + kAccelerationTolerance;
}

void FieldPlanner::keep_best(const PlanRequest& request, const OptimizerResult& run, Candidate::Kind kind,
                             const Trajectory& trajectory, PlanResult& result) {
  const double cost = run.cost * side_discount(request.time);
  if (request.keep_candidates) result.candidates.push_back({kind, cost, 0.0, false, trajectory});
  if (best_.valid && best_.cost <= cost) return;
  best_.valid = true;
  best_.cost = cost;
  best_.trajectory = trajectory;
  best_.sides = sides_;
  best_.candidate = static_cast<int>(result.candidates.size()) - 1;
}

/// Below 1 when every obstacle is passed on the side remembered for it.
double FieldPlanner::side_discount(double time) const {
  bool remembered = false;
  for (std::size_t r = 0; r < sides_.size(); ++r) {
    if (!sides_[r].decided) continue;
    const int before = guidance_.remembered_side(clearance_.regions()[r].id, time);
    if (before == 0) continue;
    if (before != static_cast<int>(sides_[r].side)) return 1.0;
    remembered = true;
  }
  return remembered ? 1.0 - kSideBonus : 1.0;
}

void FieldPlanner::add_heading(const PlanRequest& request, Trajectory& trajectory) const {
  const HeadingProfile stop = stopping_heading(request.heading, request.time, robot_);
  if (!request.goal_heading) {
    trajectory.set_heading(stop);
    return;
  }
  trajectory.set_heading(fitted_heading(trajectory, request.heading, *request.goal_heading, robot_, drive_));
}

void FieldPlanner::conclude(const PlanRequest& request, PlanOutcome failure, PlanResult& result) {
  if (best_.valid) {
    result.outcome = PlanOutcome::success;
    result.action = PlanAction::follow;
    result.trajectory = best_.trajectory;
    add_heading(request, result.trajectory);
    for (std::size_t r = 0; r < best_.sides.size(); ++r) {
      if (!best_.sides[r].decided) continue;
      const int id = clearance_.regions()[r].id;
      guidance_.remember(id, best_.sides[r].side, request.time);
      if (result.blocking_track < 0) result.blocking_track = id;
    }
    if (best_.candidate >= 0) result.candidates[static_cast<std::size_t>(best_.candidate)].chosen = true;
  } else {
    result.outcome = failure;
    result.action = PlanAction::brake;
    result.trajectory = brake_;
    if (last_report_.kind == ConflictKind::peer) result.blocking_peer = last_report_.id;
    if (last_report_.kind == ConflictKind::obstacle) result.blocking_track = last_report_.id;
    if (request.keep_candidates)
      result.candidates.push_back({Candidate::Kind::brake, 0.0, 0.0, true, result.trajectory});
  }
}

}  // namespace spf
