#include "sim/simulation.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <stdexcept>

#include "sim/contact_monitor.hpp"
#include "sim/movers.hpp"
#include "sim/radio.hpp"
#include "sim/recorder.hpp"
#include "sim/sensing.hpp"
#include "sim/trial_meter.hpp"
#include "spf/robot/omni_dynamics.hpp"

namespace spf::sim {
namespace {

const Eigen::Vector2d kNowhere{1e12, 1e12};  // [m] neither seen nor in anybody's way

/// Ticks between two events of a rate; at least one.
long ticks_between(double plant_rate, double rate) {
  return std::max(1L, std::lround(plant_rate / rate));
}

const Scenario& usable(const Scenario& scenario) {
  std::string reasons;
  for (const ScenarioProblem& problem : problems_of(scenario))
    reasons += (reasons.empty() ? "" : "; ") + problem.where + ": " + problem.what;
  if (!reasons.empty()) throw std::invalid_argument(reasons);
  return scenario;
}

}  // namespace

struct Simulation::Implementation {
  Implementation(const Scenario& given, const AgentParameters& agent, const SimulationOptions& given_options);

  // One tick, in the order of the protocol.
  void begin_step();
  void hear();
  void observe();
  void think();
  void move();
  void check();
  [[nodiscard]] bool finished();

  void think(std::size_t robot);
  void plan(std::size_t robot, double started);
  void track(std::size_t robot);
  void deliver_observations(std::size_t robot);
  void move_ideal(std::size_t robot, double to);
  void move_plant(std::size_t robot);
  void wreck(const Contact& contact);
  void record_frame();
  [[nodiscard]] TrialResult result();

  [[nodiscard]] double now() const { return static_cast<double>(tick) / plant_rate; }
  [[nodiscard]] double clock() const { return options.clock ? options.clock() : 0.0; }
  [[nodiscard]] bool ideal() const { return scenario.simulation.trial.tracking == TrackingMode::ideal; }
  [[nodiscard]] double share_at(long of_tick) const {
    return static_cast<double>(of_tick % step_ticks) / static_cast<double>(step_ticks);
  }

  Scenario scenario;
  SimulationOptions options;
  double plant_rate;  // [Hz]
  long step_ticks;    // of the movers
  long pose_ticks;
  long observation_ticks;
  double time_limit;  // [s]

  long tick = 0;
  long next_observation_tick = 0;  // on the first pose tick from here
  std::vector<RobotTruth> robots;
  std::vector<RobotAgent> agents;
  std::vector<OmniDynamics> plants;
  OmniKinematics kinematics;
  std::vector<Eigen::Vector3d> wheel_commands;  // [m/s]
  std::vector<Eigen::Vector3d> wheel_speeds;    // [m/s] true; filled for recordings
  Movers movers;
  Sensing sensing;
  Radio radio;
  ContactMonitor monitor;
  TrialMeter meter;
  std::unique_ptr<Recorder> recorder;

  // Inputs of the agents, kept for their memory.
  std::vector<AgentInput> pose_inputs;
  std::vector<AgentInput> world_inputs;
  std::vector<std::deque<Observation>> observations;  // not yet given to the agent
  std::vector<Observation> spare_observations;
  std::vector<Eigen::Vector2d> positions;
  UniformGrid grid;

  std::size_t contacts_seen = 0;
  std::size_t hits_seen = 0;
  bool stopped_by_caller = false;
  std::vector<double> world_seconds;    // taking in the world since the last plan, by robot
  std::vector<double> pose_seconds;     // taking in poses since the last control tick, by robot
  std::vector<double> last_control_us;  // by robot
  std::vector<float> plan_ms;
  std::vector<float> control_us;
};

Simulation::Implementation::Implementation(const Scenario& given, const AgentParameters& agent,
                                           const SimulationOptions& given_options)
    : scenario{usable(given)},
      options{given_options},
      plant_rate{scenario.simulation.trial.plant_rate},
      step_ticks{ticks_between(plant_rate, 1.0 / Movers::kStep)},
      pose_ticks{ticks_between(plant_rate, scenario.simulation.pose_noise.rate)},
      observation_ticks{ticks_between(plant_rate, scenario.simulation.sensing.rate)},
      time_limit{time_limit_of(scenario)},
      kinematics{scenario.robot},
      movers{scenario},
      sensing{scenario},
      radio{scenario},
      monitor{scenario},
      meter{scenario},
      grid{std::max(1.0, scenario.simulation.sensing.range)} {
  AgentParameters parameters = agent_parameters_for(scenario, agent);
  parameters.team.keep_candidates = parameters.team.keep_candidates || options.record;
  const OccupancyMap map = robot_map(scenario, parameters.occupancy);
  if (options.record) recorder = std::make_unique<Recorder>(scenario, map.frame());
  const std::size_t count = scenario.robots.size();
  for (std::size_t i = 0; i < count; ++i) {
    const RobotTask& task = scenario.robots[i];
    RobotTruth truth;
    truth.pose = task.start;
    truth.motion = {task.start.position_world, task.start.position_world};
    robots.push_back(truth);
    agents.emplace_back(static_cast<int>(i), parameters, map, task.start, 0.0);
    agents.back().set_goal(task.goal_world, task.goal_heading);
    plants.emplace_back(scenario.robot, PlantState{task.start, Eigen::Vector3d::Zero()});
    positions.push_back(task.start.position_world);
  }
  grid.assign(positions);
  wheel_commands.assign(count, Eigen::Vector3d::Zero());
  wheel_speeds = wheel_commands;
  pose_inputs.resize(count);
  world_inputs.resize(count);
  observations.resize(count);
  spare_observations.resize(count);
  world_seconds.assign(count, 0.0);
  pose_seconds.assign(count, 0.0);
  last_control_us.assign(count, 0.0);
}

void Simulation::Implementation::begin_step() {
  if (tick % step_ticks != 0) return;
  movers.advance(now());
  meter.digest(robots, movers.all());
  if (options.progress && !options.progress(now())) stopped_by_caller = true;
}

void Simulation::Implementation::hear() {
  grid.assign(positions);
  radio.deliver(now(), grid, positions, [this](int receiver, const TrajectoryMessage& message) {
    world_inputs[static_cast<std::size_t>(receiver)].messages.push_back(message);
  });
}

void Simulation::Implementation::observe() {
  const bool observation_due = tick >= next_observation_tick;
  while (next_observation_tick <= tick) next_observation_tick += observation_ticks;
  const Surroundings surroundings{now(), share_at(tick), &movers.all(), &positions, &grid};
  for (std::size_t i = 0; i < robots.size(); ++i) {
    if (robots[i].wrecked || robots[i].gone) continue;
    const int robot = static_cast<int>(i);
    pose_inputs[i].poses.clear();
    pose_inputs[i].poses.push_back(sensing.measure_pose(robot, now(), robots[i].pose));
    if (!observation_due) continue;
    Observation observation = std::move(spare_observations[i]);
    sensing.observe(robot, robots[i].pose, surroundings, observation);
    observations[i].push_back(std::move(observation));
  }
}

void Simulation::Implementation::think() {
  for (std::size_t i = 0; i < robots.size(); ++i) {
    if (!robots[i].wrecked && !robots[i].gone) think(i);
    world_inputs[i].messages.clear();
  }
}

/// The two halves of a robot's step, timed apart: what planning has to take in, and what control has.
void Simulation::Implementation::think(std::size_t robot) {
  RobotAgent& agent = agents[robot];
  double started = clock();
  agent.receive(now(), pose_inputs[robot]);
  pose_seconds[robot] += clock() - started;

  started = clock();
  deliver_observations(robot);
  const bool plans = agent.plan_due(now());
  if (plans)
    plan(robot, started);
  else
    world_seconds[robot] += clock() - started;
  if (agent.control_due(now())) track(robot);
  meter.stood(static_cast<int>(robot), agent.status(), static_cast<double>(pose_ticks) / plant_rate);
}

/// Hands over what has been heard, and what was seen at least the computing delay ago: a plan that takes so
/// long is committed when it is ready, but knows no more than was known when it began.
void Simulation::Implementation::deliver_observations(std::size_t robot) {
  constexpr double kTimeRounding = 1e-9;  // [s]
  AgentInput& input = world_inputs[robot];
  std::deque<Observation>& waiting = observations[robot];
  const double seen_by = now() - scenario.simulation.trial.computing_delay + kTimeRounding;
  bool delivered = false;
  while (!waiting.empty() && waiting.front().time <= seen_by) {
    input.observation = std::move(waiting.front());
    waiting.pop_front();
    agents[robot].receive(now(), input);
    spare_observations[robot] = std::move(*input.observation);
    input.observation.reset();
    input.messages.clear();
    delivered = true;
  }
  if (!delivered && !input.messages.empty()) agents[robot].receive(now(), input);
}

void Simulation::Implementation::plan(std::size_t robot, double started) {
  RobotAgent& agent = agents[robot];
  const std::optional<TrajectoryMessage> told = agent.plan(now());
  const double seconds = world_seconds[robot] + clock() - started;
  world_seconds[robot] = 0.0;
  if (options.clock) plan_ms.push_back(static_cast<float>(1e3 * seconds));
  meter.planned(static_cast<int>(robot), agent.last_plan());
  if (told) radio.send(now(), *told, robots[robot].pose.position_world);
  if (recorder) recorder->plan(now(), agent, 1e3 * seconds);
}

void Simulation::Implementation::track(std::size_t robot) {
  const double started = clock();
  wheel_commands[robot] = agents[robot].track(now());
  if (!options.clock) return;
  last_control_us[robot] = 1e6 * (pose_seconds[robot] + clock() - started);
  pose_seconds[robot] = 0.0;
  control_us.push_back(static_cast<float>(last_control_us[robot]));
}

void Simulation::Implementation::move() {
  const double to = static_cast<double>(tick + 1) / plant_rate;
  for (std::size_t i = 0; i < robots.size(); ++i) {
    RobotTruth& truth = robots[i];
    truth.motion.from = truth.pose.position_world;
    if (truth.wrecked || truth.gone)
      truth.velocity_world.setZero();
    else if (ideal())
      move_ideal(i, to);
    else
      move_plant(i);
    truth.motion.to = truth.pose.position_world;
    positions[i] = truth.gone ? kNowhere : truth.pose.position_world;
    if (!truth.pose.position_world.allFinite())
      throw std::runtime_error{"robot " + std::to_string(i) + " left the number line at " +
                               std::to_string(to) + " s"};
  }
}

void Simulation::Implementation::move_ideal(std::size_t robot, double to) {
  const Trajectory& plan = agents[robot].committed();
  const FlatState state = plan.state(to);
  robots[robot].pose = {state.position_world, plan.heading().state(to).heading};
  robots[robot].velocity_world = state.velocity_world;
}

void Simulation::Implementation::move_plant(std::size_t robot) {
  plants[robot].step(1.0 / plant_rate, wheel_commands[robot]);
  robots[robot].pose = plants[robot].state().pose_world;
  robots[robot].velocity_world = plants[robot].state().twist_world.head<2>();
}

void Simulation::Implementation::check() {
  const double dt = 1.0 / plant_rate;
  const double share_from = share_at(tick);
  monitor.check({now(), dt, share_from, share_from + 1.0 / static_cast<double>(step_ticks)}, robots,
                movers.all());
  for (; contacts_seen < monitor.contacts().size(); ++contacts_seen) wreck(monitor.contacts()[contacts_seen]);
  for (; hits_seen < monitor.hits_while_standing().size(); ++hits_seen)
    if (recorder)
      recorder->contact(monitor.hits_while_standing()[hits_seen], RecordedEvent::Kind::hit_while_standing);
  const bool leave = scenario.simulation.trial.after_arrival == AfterArrival::leave;
  for (const int robot : meter.moved(now() + dt, robots)) {
    RobotTruth& truth = robots[static_cast<std::size_t>(robot)];
    truth.gone = leave;
    if (recorder) recorder->arrival(now() + dt, robot, truth.pose.position_world);
  }
}

void Simulation::Implementation::wreck(const Contact& contact) {
  if (recorder) recorder->contact(contact, RecordedEvent::Kind::contact);
  if (scenario.simulation.trial.after_contact != AfterContact::wreck) return;
  robots[static_cast<std::size_t>(contact.robot)].wrecked = true;
  if (contact.with == ContactWith::robot) robots[static_cast<std::size_t>(contact.other)].wrecked = true;
}

bool Simulation::Implementation::finished() {
  if (stopped_by_caller || now() >= time_limit) return true;
  const bool ends = scenario.simulation.trial.after_contact == AfterContact::end;
  if (ends && !monitor.contacts().empty()) return true;
  return std::all_of(robots.begin(), robots.end(),
                     [](const RobotTruth& truth) { return truth.arrived || truth.wrecked; });
}

void Simulation::Implementation::record_frame() {
  if (!recorder) return;
  for (std::size_t i = 0; i < robots.size(); ++i) {
    if (ideal()) {
      const double yaw_rate = agents[i].committed().heading().state(now()).yaw_rate;
      const Eigen::Vector3d twist{robots[i].velocity_world.x(), robots[i].velocity_world.y(), yaw_rate};
      wheel_speeds[i] = kinematics.wheel_speeds_from_world(twist, robots[i].pose.heading);
    } else {
      wheel_speeds[i] = plants[i].wheel_speeds();
    }
  }
  recorder->frame({now(), share_at(tick), &robots, &movers.all(), &agents, &wheel_speeds, &wheel_commands,
                   &last_control_us, &monitor.shapes()});
}

TrialResult Simulation::Implementation::result() {
  TrialResult result;
  result.trial = scenario.trial;
  meter.digest(robots, movers.all());
  meter.finish(now(), robots, monitor, result);
  result.contacts = monitor.contacts();
  const bool ends = scenario.simulation.trial.after_contact == AfterContact::end;
  if (ends && result.contacts.size() > 1) result.contacts.resize(1);
  result.hits_while_standing = monitor.hits_while_standing();
  for (const Contact& contact : result.contacts) {
    result.robots[static_cast<std::size_t>(contact.robot)].touched = true;
    if (contact.with == ContactWith::robot)
      result.robots[static_cast<std::size_t>(contact.other)].touched = true;
  }
  const bool all_in_time = std::all_of(result.robots.begin(), result.robots.end(),
                                       [](const RobotResult& robot) { return robot.in_time; });
  result.outcome = !result.contacts.empty() ? TrialOutcome::collision
                   : all_in_time            ? TrialOutcome::success
                                            : TrialOutcome::overtime;
  result.plan_ms = std::move(plan_ms);
  result.control_us = std::move(control_us);
  result.messages = radio.messages_sent();
  if (recorder) result.recording = recorder->take();
  return result;
}

Simulation::Simulation(const Scenario& scenario, const AgentParameters& agent,
                       const SimulationOptions& options)
    : implementation_{std::make_unique<Implementation>(scenario, agent, options)} {}
Simulation::~Simulation() = default;

TrialResult Simulation::run() {
  Implementation& self = *implementation_;
  const double started = self.clock();
  while (!self.finished()) {
    self.begin_step();
    if (self.tick % self.pose_ticks == 0) {
      self.hear();
      self.observe();
      self.think();
    }
    if (self.tick % self.step_ticks == 0) self.record_frame();
    self.move();
    self.check();
    ++self.tick;
  }
  TrialResult result = self.result();
  result.wall_seconds = self.clock() - started;
  return result;
}

}  // namespace spf::sim
