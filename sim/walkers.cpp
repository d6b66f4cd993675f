#include "sim/walkers.hpp"

#include <algorithm>
#include <cmath>

#include "spf/math/random_stream.hpp"

namespace spf::sim {
namespace {

constexpr double kArrival = 0.3;       // [m] from a waypoint, at which a reacting person turns to the next
constexpr double kWallStrength = 5.0;  // [m/s^2] at a touched wall, and
constexpr double kWallRange = 0.15;    // [m] the distance over which it falls to 1/e
constexpr double kWallReach = 1.0;     // [m] walls farther off do not matter

/// Times a path is walked along its waypoints and, where it leads back, along them again.
std::size_t legs_of(const PersonTask& task) {
  const std::size_t count = task.waypoints.size();
  if (count < 2) return 0;
  if (task.at_last == AtLastWaypoint::loop) return count;
  return task.at_last == AtLastWaypoint::back ? 2 * (count - 1) : count - 1;
}

double length_of_path(const PersonTask& task) {
  double length = 0.0;
  for (std::size_t i = 1; i < task.waypoints.size(); ++i)
    length += (task.waypoints[i] - task.waypoints[i - 1]).norm();
  if (task.at_last == AtLastWaypoint::back) return 2.0 * length;
  if (task.at_last == AtLastWaypoint::loop) length += (task.waypoints.front() - task.waypoints.back()).norm();
  return length;
}

}  // namespace

Walkers::Walkers(const Scenario& scenario) : shapes_{scenario} {
  for (std::size_t i = 0; i < scenario.people.size(); ++i) add(scenario, i);
}

void Walkers::add(const Scenario& scenario, std::size_t index) {
  Person person;
  person.task = scenario.people[index];
  person.body.position = person.task.waypoints.front();
  person.next = 1;
  person.done = person.task.waypoints.size() < 2;
  if (person.task.anywhere) choose_start(scenario, index, person);
  person.motion = {person.body.position, person.body.position};
  people_.push_back(std::move(person));
}

void Walkers::place(std::size_t person, const Eigen::Vector2d& position_world) {
  if (person < people_.size()) people_[person].body.position = position_world;
}

void Walkers::change(const Scenario& scenario) {
  shapes_ = StaticShapes{scenario};
  for (std::size_t i = 0; i < people_.size(); ++i)
    if (people_[i].task.waypoints.size() == scenario.people[i].waypoints.size())
      people_[i].task.waypoints = scenario.people[i].waypoints;
  for (std::size_t i = people_.size(); i < scenario.people.size(); ++i) add(scenario, i);
}

/// Anywhere on the path, but not beside a robot: then it is drawn again.
void Walkers::choose_start(const Scenario& scenario, std::size_t index, Person& person) const {
  constexpr double kStartGap = 0.7;  // [m] between the bodies
  constexpr int kMostDraws = 100;
  RandomStream random{stream_seed(scenario, StreamRole::people, index)};
  const Person at_first = person;
  for (int draw = 0; draw < kMostDraws; ++draw) {
    person = at_first;
    follow_path(person, random.uniform() * length_of_path(person.task));
    bool near = false;
    for (std::size_t robot = 0; robot < scenario.robots.size(); ++robot) {
      const double wanted = kStartGap + scenario.robot_of(robot).radius + person.task.radius;
      near = near || (scenario.robots[robot].start.position_world - person.body.position).norm() < wanted;
    }
    if (!near) return;
  }
}

void Walkers::pass_waypoint(Person& person) const {
  const std::size_t last = person.task.waypoints.size() - 1;
  if (person.task.at_last == AtLastWaypoint::back) {
    if (person.next == last) person.backwards = true;
    if (person.next == 0) person.backwards = false;
    person.next = person.backwards ? person.next - 1 : person.next + 1;
  } else if (person.next < last) {
    ++person.next;
  } else if (person.task.at_last == AtLastWaypoint::loop) {
    person.next = 0;
  } else {
    person.done = true;
  }
}

/// Along the straight line, through as many waypoints as the distance takes it.
void Walkers::follow_path(Person& person, double distance) const {
  // Waypoints at one position take no distance: nobody passes more of them in one step than there are.
  for (std::size_t passed = 0; !person.done && passed <= legs_of(person.task); ++passed) {
    const Eigen::Vector2d& target = person.task.waypoints[person.next];
    const Eigen::Vector2d leg = target - person.body.position;
    const double length = leg.norm();
    if (length > distance) {
      person.body.position += leg * (distance / length);
      return;
    }
    distance -= length;
    person.body.position = target;
    pass_waypoint(person);
  }
}

Eigen::Vector2d Walkers::wanted_velocity(Person& person) const {
  const auto reached = [&] {
    return (person.task.waypoints[person.next] - person.body.position).norm() < kArrival;
  };
  if (!person.done && reached()) pass_waypoint(person);
  const Eigen::Vector2d& target =
      person.done ? person.task.waypoints.back() : person.task.waypoints[person.next];
  const Eigen::Vector2d leg = target - person.body.position;
  const double length = leg.norm();
  // Who stays where the path ends comes back when pushed away, without haste.
  const double speed = person.done ? std::min(person.task.speed, length) : person.task.speed;
  return length > 1e-9 ? Eigen::Vector2d{leg * (speed / length)} : Eigen::Vector2d::Zero();
}

/// Unit vector away from what is near, by differences of the clearance.
Eigen::Vector2d Walkers::away_from_surfaces(const Eigen::Vector2d& position) const {
  constexpr double kDifference = 1e-3;  // [m]
  const Eigen::Vector2d dx{kDifference, 0.0};
  const Eigen::Vector2d dy{0.0, kDifference};
  const auto at = [&](const Eigen::Vector2d& probe) { return shapes_.clearance(probe, 0.0, kWallReach); };
  const Eigen::Vector2d slope{at(position + dx) - at(position - dx), at(position + dy) - at(position - dy)};
  const double size = slope.norm();
  return size > 0.0 ? Eigen::Vector2d{slope / size} : Eigen::Vector2d::Zero();
}

Eigen::Vector2d Walkers::acceleration_of(const Person& person, const Eigen::Vector2d& wanted,
                                         const std::vector<RoundBody>& others) const {
  const Body& body = person.body;
  Eigen::Vector2d acceleration = (wanted - body.velocity) / kWalkerRelaxation;
  for (const Person& other : people_)
    if (&other != &person)
      acceleration += avoidance(body, other.body, person.task.radius + other.task.radius, person.done);
  for (const RoundBody& other : others)
    acceleration += avoidance(body, other, person.task.radius + other.radius, person.done);
  const double gap = shapes_.clearance(body.position, person.task.radius, kWallReach);
  if (gap < kWallReach)
    acceleration +=
        kWallStrength * std::exp(-std::max(gap, 0.0) / kWallRange) * away_from_surfaces(body.position);
  return within_strength(acceleration);
}

/// A step may end in a wall; it is shortened to where it touches.
void Walkers::keep_out_of_walls(Person& person) const {
  constexpr double kKept = 1e-3;  // [m] so that the next step does not begin with a contact
  const std::optional<Contact> contact = shapes_.first_contact(person.motion, person.task.radius);
  if (!contact) return;
  const double length = (person.motion.to - person.motion.from).norm();
  const double share = length > 0.0 ? std::max(contact->time - kKept / length, 0.0) : 0.0;
  person.motion.to = person.motion.at(share);
  const Eigen::Vector2d away = away_from_surfaces(person.motion.to);
  person.body.position = person.motion.to;
  person.body.velocity -= std::min(person.body.velocity.dot(away), 0.0) * away;
}

void Walkers::advance(const std::vector<RoundBody>& others) {
  std::vector<Eigen::Vector2d> accelerations(people_.size(), Eigen::Vector2d::Zero());
  for (std::size_t i = 0; i < people_.size(); ++i)
    if (people_[i].task.behaviour == PersonBehaviour::reacting)
      accelerations[i] = acceleration_of(people_[i], wanted_velocity(people_[i]), others);
  for (std::size_t i = 0; i < people_.size(); ++i) {
    Person& person = people_[i];
    person.motion.from = person.body.position;
    if (person.task.behaviour == PersonBehaviour::fixed) {
      follow_path(person, person.task.speed * kStep);
      person.motion.to = person.body.position;
      person.body.velocity = (person.motion.to - person.motion.from) / kStep;
      continue;
    }
    sim::advance(person.body, accelerations[i], person.task.speed, kStep);
    person.motion.to = person.body.position;
    keep_out_of_walls(person);
  }
}

std::string blocked_path(const PersonTask& task, const StaticShapes& shapes) {
  const std::size_t count = task.waypoints.size();
  const std::size_t legs = task.at_last == AtLastWaypoint::loop ? count : count - 1;
  for (std::size_t i = 0; i < std::max<std::size_t>(legs, 1); ++i) {
    const std::size_t next = (i + 1) % count;
    const auto contact = shapes.first_contact({task.waypoints[i], task.waypoints[next]}, task.radius);
    if (!contact) continue;
    std::string other = enum_name(contact->with);
    if (contact->other >= 0) other += " " + std::to_string(contact->other);
    return "must leave a path: from waypoint " + std::to_string(i) + " to " + std::to_string(next) +
           " a person of this radius meets " + other;
  }
  return "";
}

}  // namespace spf::sim
