#include "sim/world.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "spf/math/phase.hpp"

namespace spf::sim {
namespace {

const Eigen::Vector2d kNowhere{1e12, 1e12};  // [m] out of sight and out of the way
constexpr double kJoiningGap = 0.2;          // [m] around a robot that joins

/// Ticks between two events of a rate; at least one.
long ticks_between(double plant_rate, double rate) {
  return std::max(1L, std::lround(plant_rate / rate));
}

const Scenario& usable(const Scenario& scenario) {
  std::string reasons;
  for (const ScenarioProblem& problem : problems_of(scenario))
    reasons += (reasons.empty() ? "" : "; ") + to_text(problem);
  if (!reasons.empty()) throw std::invalid_argument(reasons);
  return scenario;
}

}  // namespace

World::World(const Scenario& scenario)
    : scenario_{usable(scenario)},
      plant_rate_{scenario.simulation.trial.plant_rate},
      ticks_{ticks_between(plant_rate_, 1.0 / DynamicObstacles::kStep),
             ticks_between(plant_rate_, scenario.simulation.pose_noise.rate),
             ticks_between(plant_rate_, scenario.simulation.sensing.rate)},
      time_limit_{time_limit_of(scenario)},
      grid_{std::max(1.0, scenario.simulation.sensing.range)},
      dynamic_obstacles_{scenario},
      sensing_{scenario},
      monitor_{scenario},
      meter_{scenario},
      life_{FleetLife{scenario}} {
  observation_due_.assign(scenario.robots.size(), 0);
  for (std::size_t i = 0; i < scenario.robots.size(); ++i) {
    const double own_tick = phase_of(static_cast<int>(i)) * static_cast<double>(ticks_.observation);
    // One period early: all observe at the start.
    next_observation_tick_.push_back(static_cast<long>(std::ceil(own_tick)) - ticks_.observation);
    const RobotTask& task = scenario.robots[i];
    RobotTruth truth;
    truth.pose = task.start;
    truth.motion = {task.start.position_world, task.start.position_world};
    truth.radius = scenario.robot_of(i).radius;
    truth.heading_from = task.start.heading;
    if (has_corners(scenario.robot_of(i)))
      truth.outline = std::make_shared<const Footprint>(scenario.robot_of(i));
    truth.gone = joins_later(scenario, i);
    robots_.push_back(truth);
    plants_.emplace_back(scenario.robot_of(i), PlantState{task.start, Eigen::Vector3d::Zero()});
    commands_.push_back(Drive{scenario.robot_of(i)}.standstill());
    placements_.push_back({task.start});
    positions_.push_back(truth.gone ? kNowhere : task.start.position_world);
  }
  grid_.assign(positions_);
}

void World::change(const Scenario& changed) {
  usable(changed);
  if (changed.robots.size() != scenario_.robots.size() || changed.moving.size() != scenario_.moving.size() ||
      changed.people.size() < scenario_.people.size())
    throw std::invalid_argument{"robots, moving discs and people of a running trial cannot be taken away"};
  dynamic_obstacles_.change(changed);
  sensing_.change_shapes(changed);
  monitor_.change_shapes(changed);
  scenario_ = changed;
}

/// Whoever joins waits until nobody is at its start.
bool World::possible(const FleetOrder& order) const {
  if (order.act != FleetAct::join) return true;
  const RobotTruth& truth = robots_[as_index(order.robot)];
  if (!truth.gone) return true;
  const Eigen::Vector2d& start = scenario_.robots[as_index(order.robot)].start.position_world;
  const auto clear = [&](const Eigen::Vector2d& position, double radius) {
    return (position - start).norm() > truth.radius + radius + kJoiningGap;
  };
  return std::all_of(robots_.begin(), robots_.end(),
                     [&](const RobotTruth& other) {
                       return other.gone || clear(other.pose.position_world, other.radius);
                     }) &&
         std::all_of(dynamic_obstacles_.all().begin(), dynamic_obstacles_.all().end(),
                     [&](const DynamicObstacle& other) { return clear(other.motion.from, other.radius); });
}

void World::obey(const FleetOrder& order) {
  const std::size_t robot = as_index(order.robot);
  RobotTruth& truth = robots_[robot];
  switch (order.act) {
    case FleetAct::goal:
    case FleetAct::cancel:
      truth.arrived = false;
      meter_.set_goal(robot, truth.pose.position_world,
                      order.act == FleetAct::goal ? std::optional<host::Goal>{order.goal} : std::nullopt);
      break;
    case FleetAct::pause:
    case FleetAct::stop:
    case FleetAct::resume:
    case FleetAct::release: {
      const bool stops = order.act == FleetAct::stop || order.act == FleetAct::release;
      (stops ? truth.stopped : truth.paused) = order.act == FleetAct::pause || order.act == FleetAct::stop;
      break;
    }
    case FleetAct::break_down:
      truth.broken = true;
      commands_[robot] = Drive{scenario_.robot_of(robot)}.standstill();
      break;
    case FleetAct::repair:
      truth.broken = truth.paused = truth.stopped = false;
      break;
    case FleetAct::leave:
      truth.gone = true;
      break;
    case FleetAct::join:
      if (!truth.gone) break;
      truth.gone = truth.broken = truth.paused = truth.stopped = false;
      truth.pose = scenario_.robots[robot].start;
      truth.motion = {truth.pose.position_world, truth.pose.position_world};
      truth.heading_from = truth.pose.heading;
      positions_[robot] = truth.pose.position_world;
      plants_[robot] =
          DriveDynamics{scenario_.robot_of(robot), PlantState{truth.pose, Eigen::Vector3d::Zero()}};
      commands_[robot] = Drive{scenario_.robot_of(robot)}.standstill();
      meter_.begin_anew(robot, truth.pose.position_world);
      break;
    case FleetAct::priority:
      break;
  }
}

void World::note_broken() {
  life_.broken.clear();
  for (std::size_t i = 0; i < robots_.size(); ++i)
    if (robots_[i].broken && !robots_[i].gone) life_.broken.push_back(static_cast<int>(i));
}

void World::begin_tick() {
  life_.orders.clear();
  if (pose_due()) {
    const auto happens = [this](const FleetOrder& order) {
      if (!possible(order)) return false;
      obey(order);
      return true;
    };
    life_.events.pass_on(time(), happens, life_.orders);
    if (!life_.orders.empty()) note_broken();
  }
  if (step_due()) {
    dynamic_obstacles_.advance(time(), robots_);
    meter_.digest(robots_, dynamic_obstacles_.all());
  }
  observation_due_.assign(robots_.size(), 0);
  if (!pose_due()) return;
  grid_.assign(positions_);
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    if (tick_ < next_observation_tick_[i]) continue;
    observation_due_[i] = 1;
    while (next_observation_tick_[i] <= tick_) next_observation_tick_[i] += ticks_.observation;
  }
}

PoseMeasurement World::measure_pose(int robot) {
  return sensing_.measure_pose(robot, time(), robots_[as_index(robot)].pose);
}

void World::observe(int robot, Observation& observation) {
  const Surroundings surroundings{time(),        share(), &dynamic_obstacles_.all(), &positions_, &grid_,
                                  &life_.broken, &robots_};
  sensing_.observe(robot, robots_[as_index(robot)].pose, surroundings, observation);
}

void World::place(int robot, const Pose2& pose_world, const Eigen::Vector2d& velocity_world) {
  placements_[as_index(robot)] = {pose_world, velocity_world};
}

void World::end_tick() {
  move();
  check();
  ++tick_;
}

void World::move() {
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    move(i);
    if (!robots_[i].pose.position_world.allFinite())
      throw std::runtime_error{"robot " + std::to_string(i) + " left the number line at " +
                               std::to_string(next_time()) + " s"};
  }
}

void World::move(std::size_t robot) {
  RobotTruth& truth = robots_[robot];
  truth.motion.from = truth.pose.position_world;
  truth.heading_from = truth.pose.heading;
  const bool ideal = scenario_.simulation.trial.tracking == TrackingMode::ideal;
  if (truth.wrecked || truth.gone || (truth.broken && ideal)) {
    truth.velocity_world.setZero();
  } else if (ideal) {
    truth.pose = placements_[robot].pose_world;
    truth.velocity_world = placements_[robot].velocity_world;
  } else {
    plants_[robot].step(1.0 / plant_rate_, commands_[robot]);
    truth.pose = plants_[robot].state().pose_world;
    truth.velocity_world = plants_[robot].state().twist_world.head<2>();
  }
  truth.motion.to = truth.pose.position_world;
  positions_[robot] = truth.gone ? kNowhere : truth.pose.position_world;
}

void World::check() {
  const double dt = 1.0 / plant_rate_;
  const double share_from = share();
  monitor_.check({time(), dt, share_from, share_from + 1.0 / static_cast<double>(ticks_.step)}, robots_,
                 dynamic_obstacles_.all());
  const bool wrecks = scenario_.simulation.trial.after_contact == AfterContact::wreck;
  for (; contacts_seen_ < contacts().size(); ++contacts_seen_) {
    const Contact& contact = contacts()[contacts_seen_];
    if (!wrecks) continue;
    robots_[as_index(contact.robot)].wrecked = true;
    if (contact.with == ContactWith::robot) robots_[as_index(contact.other)].wrecked = true;
  }
  meter_.moved(time() + dt, robots_);
  const bool leaves = scenario_.simulation.trial.after_arrival == AfterArrival::leave;
  for (const int robot : arrivals()) {
    const std::size_t i = as_index(robot);
    life_.events.reached_goal(time() + dt, i, meter_.goals_reached(i), positions_[i], meter_.goals());
    robots_[i].gone = leaves && !life_.events.goal_to_come(i);
  }
}

bool World::finished() const {
  if (time() >= time_limit_) return true;
  const bool ends = scenario_.simulation.trial.after_contact == AfterContact::end;
  if (ends && !contacts().empty()) return true;
  if (life_.events.goes_on()) return false;
  for (std::size_t i = 0; i < robots_.size(); ++i)
    if (!robots_[i].arrived && !robots_[i].wrecked && !meter_.excused(i, robots_[i])) return false;
  return true;
}

TrialResult World::result() const {
  TrialResult result;
  result.trial = scenario_.trial;
  TrialMeter meter = meter_;
  meter.digest(robots_, dynamic_obstacles_.all());
  meter.finish(time(), robots_, monitor_, result);
  result.contacts = contacts();
  const bool ends = scenario_.simulation.trial.after_contact == AfterContact::end;
  if (ends && result.contacts.size() > 1) result.contacts.resize(1);
  result.hits_while_standing = hits_while_standing();
  for (const Contact& contact : result.contacts) {
    result.robots[as_index(contact.robot)].touched = true;
    if (contact.with == ContactWith::robot) result.robots[as_index(contact.other)].touched = true;
  }
  const bool all_in_time =
      std::all_of(result.robots.begin(), result.robots.end(),
                  [](const RobotResult& robot) { return robot.in_time || robot.excused; });
  result.outcome = !result.contacts.empty() ? TrialOutcome::collision
                   : all_in_time            ? TrialOutcome::success
                                            : TrialOutcome::timeout;
  return result;
}

}  // namespace spf::sim
