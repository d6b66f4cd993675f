#include "sim/contact_monitor.hpp"

#include <algorithm>
#include <limits>
#include <optional>

namespace spf::sim {
namespace {

constexpr double kStandingSpeed = 0.05;    // [m/s] (PED)
constexpr double kStandingTime = 1.0;      // [s] (PED)
constexpr double kForgivenDistance = 1.5;  // [m] centre to centre (PED)
constexpr double kPairMargin = 0.25;       // [m] that a robot may move before the near pairs are listed again

Motion part_of(const Motion& motion, double share_from, double share_to) {
  return {motion.at(share_from), motion.at(share_to)};
}

double length(const Motion& motion) {
  return (motion.to - motion.from).norm();
}

/// A disc, or a robot with corners within one, over a tick.
struct Moving {
  Motion motion;
  double radius;              // [m]
  const RobotTruth* corners;  // of a robot that has them

  [[nodiscard]] double reach() const { return corners != nullptr ? corners->body().reach() : length(motion); }
};

Moving moving(const RobotTruth& truth) {
  return {truth.motion, truth.radius, truth.outline ? &truth : nullptr};
}

double distance_at(double share, const Moving& a, const Moving& b) {
  if (a.corners == nullptr) return b.corners->body().at(share).distance_to(a.motion.at(share)) - a.radius;
  if (b.corners == nullptr) return a.corners->body().at(share).distance_to(b.motion.at(share)) - b.radius;
  return a.corners->body().at(share).distance_to(b.corners->body().at(share));
}

struct Encounter {
  double clearance;             // [m] the least of two outlines; of those with corners it may be less
  std::optional<double> touch;  // share of the tick at which they first do
};

Encounter meet(const Moving& a, const Moving& b) {
  const double sum = a.radius + b.radius;
  const double gap = swept_distance(a.motion, b.motion) - sum;
  if (gap >= 0.0) return {gap, std::nullopt};
  if (a.corners == nullptr && b.corners == nullptr)
    return {gap, first_within(a.motion, b.motion, sum).value_or(0.0)};
  const auto distance = [&](double share) { return distance_at(share, a, b); };
  return {std::min(distance(0.0), distance(1.0)), first_touch(a.reach() + b.reach(), distance)};
}

}  // namespace

ContactMonitor::ContactMonitor(const Scenario& scenario)
    : largest_radius_{scenario.largest_radius()},
      shapes_{scenario},
      free_(scenario.robots.size()),
      static_clearance_(scenario.robots.size(), kFarStatic),
      grid_{2.0 * scenario.largest_radius() + kNearPeer + 2.0 * kPairMargin},
      touching_static_(scenario.robots.size(), false),
      standing_time_(scenario.robots.size(), 0.0),
      dynamic_distance_{std::numeric_limits<double>::infinity()},
      dynamic_clearance_{dynamic_distance_},
      peer_clearance_{dynamic_distance_} {}

void ContactMonitor::check(const Tick& tick, const std::vector<RobotTruth>& robots,
                           const std::vector<DynamicObstacle>& dynamic_obstacles) {
  const auto first_new = static_cast<std::ptrdiff_t>(contacts_.size());
  forgive_newcomers(robots, dynamic_obstacles);
  note_standing(tick.dt, robots);
  for (std::size_t i = 0; i < robots.size(); ++i) {
    if (robots[i].gone) continue;
    check_dynamic_obstacles(tick, i, robots[i], dynamic_obstacles);
    if (!robots[i].wrecked) check_static(tick, i, robots[i]);
  }
  check_peers(tick, robots);
  std::stable_sort(contacts_.begin() + first_new, contacts_.end(),
                   [](const Contact& a, const Contact& b) { return a.time < b.time; });
}

Contact ContactMonitor::contact_of(const Tick& tick, double share, std::size_t robot,
                                   const RobotTruth& truth) const {
  Contact contact;
  contact.time = tick.time + share * tick.dt;
  contact.robot = static_cast<int>(robot);
  contact.position_world = truth.motion.at(share);
  contact.robot_speed = truth.velocity_world.norm();
  return contact;
}

void ContactMonitor::check_dynamic_obstacles(const Tick& tick, std::size_t robot, const RobotTruth& truth,
                                             const std::vector<DynamicObstacle>& dynamic_obstacles) {
  for (const DynamicObstacle& obstacle : dynamic_obstacles) {
    const Motion motion = part_of(obstacle.motion, tick.share_from, tick.share_to);
    const Encounter encounter = meet(moving(truth), {motion, obstacle.radius, nullptr});
    if (!truth.arrived && !truth.wrecked) {
      dynamic_distance_ = std::min(dynamic_distance_, swept_distance(truth.motion, motion));
      dynamic_clearance_ = std::min(dynamic_clearance_, encounter.clearance);
    }
    const std::pair<int, int> pair{static_cast<int>(robot), obstacle.id};
    if (!encounter.touch) {
      touching_obstacles_.erase(pair);
      continue;
    }
    if (truth.wrecked || (obstacle.person && forgiven_.count(pair) > 0)) continue;
    if (!touching_obstacles_.insert(pair).second) continue;
    Contact contact = contact_of(tick, *encounter.touch, robot, truth);
    contact.other = obstacle.id;
    contact.other_speed = length(obstacle.motion) / DynamicObstacles::kStep;
    contact.with = obstacle.person ? ContactWith::person : ContactWith::moving;
    const bool stood = standing_time_[robot] >= kStandingTime;
    (obstacle.person && stood ? hits_while_standing_ : contacts_).push_back(contact);
  }
}

/// If both ends of the motion lie in a free disc, all of it does. Otherwise it is checked exactly.
void ContactMonitor::check_static(const Tick& tick, std::size_t robot, const RobotTruth& truth) {
  const double wanted = truth.arrived ? 0.0 : std::max(static_clearance_[robot], 0.0);
  const double bound = std::min(free_[robot].bound(truth.motion.from), free_[robot].bound(truth.motion.to));
  if (bound > wanted) {
    touching_static_[robot] = false;
    return;
  }
  const double around = shapes_.clearance(truth.motion.to, truth.radius);
  free_[robot] = {truth.motion.to, around};
  double clearance = around;
  if (truth.outline && around < static_clearance_[robot])
    clearance = shapes_.clearance(truth.body().at(1.0), truth.motion.to, truth.radius);
  if (!truth.arrived) static_clearance_[robot] = std::min(static_clearance_[robot], clearance);
  if (around > length(truth.motion)) {
    touching_static_[robot] = false;
    return;
  }
  const std::optional<Contact> found =
      truth.outline ? shapes_.first_contact(truth.body()) : shapes_.first_contact(truth.motion, truth.radius);
  if (found && !touching_static_[robot]) {
    Contact contact = contact_of(tick, found->time, robot, truth);
    contact.with = found->with;
    contact.other = found->other;
    contacts_.push_back(contact);
  }
  touching_static_[robot] = found.has_value();
}

void ContactMonitor::check_peers(const Tick& tick, const std::vector<RobotTruth>& robots) {
  refresh_pairs(robots);
  for (const auto& [i, j] : pairs_) check_pair(tick, robots, i, j);
}

void ContactMonitor::refresh_pairs(const std::vector<RobotTruth>& robots) {
  bool fresh = centers_.size() == robots.size();
  for (std::size_t i = 0; fresh && i < robots.size(); ++i) {
    const double moved = std::max((robots[i].motion.from - centers_[i]).squaredNorm(),
                                  (robots[i].motion.to - centers_[i]).squaredNorm());
    fresh = moved <= kPairMargin * kPairMargin;
  }
  if (fresh) return;
  double longest = 0.0;  // of this tick's motions: a fast robot may leave the margin within one tick
  centers_.clear();
  for (const RobotTruth& truth : robots) {
    centers_.push_back(truth.motion.from);
    longest = std::max(longest, length(truth.motion));
  }
  grid_.assign(centers_);
  pairs_.clear();
  const double reach = 2.0 * largest_radius_ + kNearPeer + 2.0 * std::max(kPairMargin, longest);
  for (std::size_t i = 0; i < robots.size(); ++i)
    grid_.visit(centers_[i], reach, [&](int other) {
      const auto j = static_cast<std::size_t>(other);
      if (j > i && (centers_[j] - centers_[i]).norm() <= reach) pairs_.emplace_back(i, j);
    });
}

void ContactMonitor::check_pair(const Tick& tick, const std::vector<RobotTruth>& robots, std::size_t i,
                                std::size_t j) {
  if (robots[i].wrecked && robots[j].wrecked) return;
  if (robots[i].gone || robots[j].gone) return;
  const Encounter encounter = meet(moving(robots[i]), moving(robots[j]));
  if (!robots[i].arrived || !robots[j].arrived)
    peer_clearance_ = std::min(peer_clearance_, encounter.clearance);
  if (!encounter.touch || !touching_pairs_.insert({static_cast<int>(i), static_cast<int>(j)}).second) return;
  const std::size_t robot = robots[i].wrecked ? j : i;  // one that still moves
  const std::size_t other = robot == i ? j : i;
  Contact contact = contact_of(tick, *encounter.touch, robot, robots[robot]);
  contact.with = ContactWith::robot;
  contact.other = static_cast<int>(other);
  contact.other_speed = robots[other].velocity_world.norm();
  contacts_.push_back(contact);
}

void ContactMonitor::forgive_newcomers(const std::vector<RobotTruth>& robots,
                                       const std::vector<DynamicObstacle>& dynamic_obstacles) {
  bool people = false;
  for (const DynamicObstacle& obstacle : dynamic_obstacles) people = people || obstacle.appears;
  if (!people && people_present_.empty()) return;
  std::set<int> present;
  for (const DynamicObstacle& obstacle : dynamic_obstacles) {
    if (!obstacle.appears) continue;
    present.insert(obstacle.id);
    const bool is_new = people_present_.count(obstacle.id) == 0;
    for (std::size_t i = 0; i < robots.size(); ++i) {
      const bool near = (robots[i].motion.from - obstacle.motion.from).norm() < kForgivenDistance;
      const std::pair<int, int> pair{static_cast<int>(i), obstacle.id};
      if (is_new && near) forgiven_.insert(pair);
      if (!near) forgiven_.erase(pair);
    }
  }
  people_present_ = std::move(present);
}

void ContactMonitor::note_standing(double dt, const std::vector<RobotTruth>& robots) {
  for (std::size_t i = 0; i < robots.size(); ++i)
    standing_time_[i] = robots[i].velocity_world.norm() < kStandingSpeed ? standing_time_[i] + dt : 0.0;
}

}  // namespace spf::sim
