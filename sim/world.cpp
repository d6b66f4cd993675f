#include "sim/world.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace spf::sim {
namespace {

const Eigen::Vector2d kNowhere{1e12, 1e12};  // [m] out of sight and out of the way

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
      step_ticks_{ticks_between(plant_rate_, 1.0 / DynamicObstacles::kStep)},
      pose_ticks_{ticks_between(plant_rate_, scenario.simulation.pose_noise.rate)},
      observation_ticks_{ticks_between(plant_rate_, scenario.simulation.sensing.rate)},
      time_limit_{time_limit_of(scenario)},
      grid_{std::max(1.0, scenario.simulation.sensing.range)},
      dynamic_obstacles_{scenario},
      sensing_{scenario},
      monitor_{scenario},
      meter_{scenario} {
  for (std::size_t i = 0; i < scenario.robots.size(); ++i) {
    const RobotTask& task = scenario.robots[i];
    RobotTruth truth;
    truth.pose = task.start;
    truth.motion = {task.start.position_world, task.start.position_world};
    truth.radius = scenario.robot_of(i).radius;
    robots_.push_back(truth);
    plants_.emplace_back(scenario.robot_of(i), PlantState{task.start, Eigen::Vector3d::Zero()});
    commands_.push_back(Drive{scenario.robot_of(i)}.standstill());
    placements_.push_back({task.start});
    positions_.push_back(task.start.position_world);
  }
  grid_.assign(positions_);
}

void World::begin_tick() {
  if (step_due()) {
    dynamic_obstacles_.advance(time(), robots_);
    meter_.digest(robots_, dynamic_obstacles_.all());
  }
  observation_due_ = false;
  if (!pose_due()) return;
  grid_.assign(positions_);
  observation_due_ = tick_ >= next_observation_tick_;
  while (next_observation_tick_ <= tick_) next_observation_tick_ += observation_ticks_;
}

PoseMeasurement World::measure_pose(int robot) {
  return sensing_.measure_pose(robot, time(), robots_[as_index(robot)].pose);
}

void World::observe(int robot, Observation& observation) {
  const Surroundings surroundings{time(), share(), &dynamic_obstacles_.all(), &positions_, &grid_};
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
  const bool ideal = scenario_.simulation.trial.tracking == TrackingMode::ideal;
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    RobotTruth& truth = robots_[i];
    truth.motion.from = truth.pose.position_world;
    if (!truth.active()) {
      truth.velocity_world.setZero();
    } else if (ideal) {
      truth.pose = placements_[i].pose_world;
      truth.velocity_world = placements_[i].velocity_world;
    } else {
      plants_[i].step(1.0 / plant_rate_, commands_[i]);
      truth.pose = plants_[i].state().pose_world;
      truth.velocity_world = plants_[i].state().twist_world.head<2>();
    }
    truth.motion.to = truth.pose.position_world;
    positions_[i] = truth.gone ? kNowhere : truth.pose.position_world;
    if (!truth.pose.position_world.allFinite())
      throw std::runtime_error{"robot " + std::to_string(i) + " left the number line at " +
                               std::to_string(next_time()) + " s"};
  }
}

void World::check() {
  const double dt = 1.0 / plant_rate_;
  const double share_from = share();
  monitor_.check({time(), dt, share_from, share_from + 1.0 / static_cast<double>(step_ticks_)}, robots_,
                 dynamic_obstacles_.all());
  const bool wrecks = scenario_.simulation.trial.after_contact == AfterContact::wreck;
  for (; contacts_seen_ < contacts().size(); ++contacts_seen_) {
    const Contact& contact = contacts()[contacts_seen_];
    if (!wrecks) continue;
    robots_[as_index(contact.robot)].wrecked = true;
    if (contact.with == ContactWith::robot) robots_[as_index(contact.other)].wrecked = true;
  }
  meter_.moved(time() + dt, robots_);
  if (scenario_.simulation.trial.after_arrival != AfterArrival::leave) return;
  for (const int robot : arrivals()) robots_[as_index(robot)].gone = true;
}

bool World::finished() const {
  if (time() >= time_limit_) return true;
  const bool ends = scenario_.simulation.trial.after_contact == AfterContact::end;
  if (ends && !contacts().empty()) return true;
  return std::all_of(robots_.begin(), robots_.end(),
                     [](const RobotTruth& truth) { return truth.arrived || truth.wrecked; });
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
  const bool all_in_time = std::all_of(result.robots.begin(), result.robots.end(),
                                       [](const RobotResult& robot) { return robot.in_time; });
  result.outcome = !result.contacts.empty() ? TrialOutcome::collision
                   : all_in_time            ? TrialOutcome::success
                                            : TrialOutcome::timeout;
  return result;
}

}  // namespace spf::sim
