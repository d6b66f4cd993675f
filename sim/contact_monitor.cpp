#include "sim/contact_monitor.hpp"

#include <algorithm>
#include <limits>

namespace spf::sim {
namespace {

constexpr double kStandingSpeed = 0.05;    // [m/s] (PED)
constexpr double kStandingTime = 1.0;      // [s] (PED)
constexpr double kForgivenDistance = 1.5;  // [m] centre to centre (PED)

Motion part_of(const Motion& motion, double share_from, double share_to) {
  return {motion.at(share_from), motion.at(share_to)};
}

double length(const Motion& motion) {
  return (motion.to - motion.from).norm();
}

}  // namespace

ContactMonitor::ContactMonitor(const Scenario& scenario)
    : robot_radius_{scenario.robot.radius},
      shapes_{scenario},
      centers_(scenario.robots.size()),
      grid_{2.0 * scenario.robot.radius + kNearPeer},
      standing_time_(scenario.robots.size(), 0.0),
      dynamic_distance_{std::numeric_limits<double>::infinity()},
      dynamic_clearance_{dynamic_distance_},
      peer_clearance_{dynamic_distance_} {}

void ContactMonitor::check(const Tick& tick, const std::vector<RobotTruth>& robots,
                           const std::vector<Mover>& movers) {
  const auto first_new = static_cast<std::ptrdiff_t>(contacts_.size());
  forgive_newcomers(robots, movers);
  note_standing(tick.dt, robots);
  for (std::size_t i = 0; i < robots.size(); ++i) {
    check_movers(tick, i, robots[i], movers);
    if (robots[i].wrecked) continue;
    if (const std::optional<Contact> found = shapes_.first_contact(robots[i].motion, robot_radius_)) {
      Contact contact = contact_of(tick, found->time, i, robots[i]);
      contact.with = found->with;
      contact.other = found->other;
      contacts_.push_back(contact);
    }
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

void ContactMonitor::check_movers(const Tick& tick, std::size_t robot, const RobotTruth& truth,
                                  const std::vector<Mover>& movers) {
  for (const Mover& mover : movers) {
    const Motion motion = part_of(mover.motion, tick.share_from, tick.share_to);
    const double sum = robot_radius_ + mover.radius;
    const double distance = swept_distance(truth.motion, motion);
    if (!truth.arrived && !truth.wrecked) {
      dynamic_distance_ = std::min(dynamic_distance_, distance);
      dynamic_clearance_ = std::min(dynamic_clearance_, distance - sum);
    }
    const std::pair<int, int> pair{static_cast<int>(robot), mover.id};
    if (distance >= sum) {
      if (mover.person) being_hit_.erase(pair);
      continue;
    }
    if (truth.wrecked || (mover.person && forgiven_.count(pair) > 0)) continue;
    Contact contact = contact_of(tick, first_within(truth.motion, motion, sum).value_or(0.0), robot, truth);
    contact.other = mover.id;
    contact.other_speed = length(mover.motion) / Movers::kStep;
    contact.with = mover.person ? ContactWith::person : ContactWith::disc;
    if (mover.person)
      touch_person(robot, mover, contact);
    else
      contacts_.push_back(contact);
  }
}

void ContactMonitor::touch_person(std::size_t robot, const Mover& mover, const Contact& contact) {
  if (!being_hit_.insert({static_cast<int>(robot), mover.id}).second) return;
  const bool stood = standing_time_[robot] >= kStandingTime;
  (stood ? hits_while_standing_ : contacts_).push_back(contact);
}

void ContactMonitor::check_peers(const Tick& tick, const std::vector<RobotTruth>& robots) {
  double longest = 0.0;
  for (std::size_t i = 0; i < robots.size(); ++i) {
    centers_[i] = robots[i].motion.from;
    longest = std::max(longest, length(robots[i].motion));
  }
  grid_.assign(centers_);
  const double sum = 2.0 * robot_radius_;
  for (std::size_t i = 0; i < robots.size(); ++i)
    grid_.visit(centers_[i], sum + kNearPeer + 2.0 * longest, [&](int other) {
      const auto j = static_cast<std::size_t>(other);
      if (j <= i || (robots[i].wrecked && robots[j].wrecked)) return;
      const double distance = swept_distance(robots[i].motion, robots[j].motion);
      if (!robots[i].arrived || !robots[j].arrived)
        peer_clearance_ = std::min(peer_clearance_, distance - sum);
      const std::pair<int, int> pair{static_cast<int>(i), other};
      if (distance >= sum || wrecked_pairs_.count(pair) > 0) return;
      wrecked_pairs_.insert(pair);
      const double share = first_within(robots[i].motion, robots[j].motion, sum).value_or(0.0);
      const bool i_alive = !robots[i].wrecked;  // the one that can still be to blame
      const std::size_t robot = i_alive ? i : j;
      Contact contact = contact_of(tick, share, robot, robots[robot]);
      contact.with = ContactWith::robot;
      contact.other = static_cast<int>(i_alive ? j : i);
      contact.other_speed = robots[i_alive ? j : i].velocity_world.norm();
      contacts_.push_back(contact);
    });
}

void ContactMonitor::forgive_newcomers(const std::vector<RobotTruth>& robots,
                                       const std::vector<Mover>& movers) {
  bool people = false;
  for (const Mover& mover : movers) people = people || mover.person;
  if (!people && people_present_.empty()) return;
  std::set<int> present;
  for (const Mover& mover : movers) {
    if (!mover.person) continue;
    present.insert(mover.id);
    const bool is_new = people_present_.count(mover.id) == 0;
    for (std::size_t i = 0; i < robots.size(); ++i) {
      const bool near = (robots[i].motion.from - mover.motion.from).norm() < kForgivenDistance;
      const std::pair<int, int> pair{static_cast<int>(i), mover.id};
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
