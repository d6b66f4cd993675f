#include "sim/simulation.hpp"

#include <deque>
#include <utility>

#include "sim/agent_meter.hpp"
#include "sim/radio.hpp"
#include "sim/recorder.hpp"
#include "sim/world.hpp"

namespace spf::sim {

struct Simulation::Implementation {
  Implementation(const Scenario& scenario, const AgentParameters& agent,
                 const SimulationOptions& given_options);

  // One tick, in the order of docs/protocol.md.
  void begin();
  void hear();
  void observe();
  void think();
  void end();

  void think(std::size_t robot);
  void plan(std::size_t robot, double started);
  void track(std::size_t robot);
  void deliver_observations(std::size_t robot);
  void place_ideally();
  void tell_frame();
  void tell_events();
  [[nodiscard]] TrialResult result();

  [[nodiscard]] double now() const { return world.time(); }
  [[nodiscard]] double clock() const { return options.clock ? options.clock() : 0.0; }
  [[nodiscard]] bool ideal() const {
    return world.scenario().simulation.trial.tracking == TrackingMode::ideal;
  }

  SimulationOptions options;
  World world;
  std::vector<RobotAgent> agents;
  OmniKinematics kinematics;
  std::vector<Eigen::Vector3d> wheel_speeds;  // [m/s] true; filled for listeners
  Radio radio;
  AgentMeter meter;
  std::unique_ptr<Recorder> recorder;
  std::vector<TrialListener*> listeners;  // the recorder among them

  // Inputs of the agents, kept for their memory.
  std::vector<AgentInput> pose_inputs;
  std::vector<AgentInput> world_inputs;
  std::vector<std::deque<Observation>> observations;  // not yet given to the agent
  std::vector<Observation> spare_observations;

  std::size_t contacts_seen = 0;
  std::size_t hits_seen = 0;
  bool stopped_by_caller = false;
  std::vector<double> world_seconds;    // taking in the world since the last plan, by robot
  std::vector<double> pose_seconds;     // taking in poses since the last control tick, by robot
  std::vector<double> last_control_us;  // by robot
  std::vector<float> plan_ms;
  std::vector<float> control_us;
};

Simulation::Implementation::Implementation(const Scenario& scenario, const AgentParameters& agent,
                                           const SimulationOptions& given_options)
    : options{given_options},
      world{scenario},
      kinematics{scenario.robot},
      radio{scenario},
      meter{scenario.robots.size()} {
  AgentParameters parameters = agent_parameters_for(scenario, agent);
  parameters.team.keep_candidates = parameters.team.keep_candidates || options.record;
  const OccupancyMap map = robot_map(scenario, parameters.occupancy);
  if (options.record) recorder = std::make_unique<Recorder>(scenario, map.frame());
  for (TrialListener* listener : {options.listener, static_cast<TrialListener*>(recorder.get())})
    if (listener != nullptr) listeners.push_back(listener);
  const std::size_t count = scenario.robots.size();
  const StateSource source = ideal() ? StateSource::as_planned : StateSource::measured;
  for (std::size_t i = 0; i < count; ++i) {
    const RobotTask& task = scenario.robots[i];
    agents.emplace_back(static_cast<int>(i), parameters, map, task.start, 0.0, source);
    agents.back().set_goal(task.goal_world, task.goal_heading);
  }
  wheel_speeds.assign(count, Eigen::Vector3d::Zero());
  pose_inputs.resize(count);
  world_inputs.resize(count);
  observations.resize(count);
  spare_observations.resize(count);
  world_seconds.assign(count, 0.0);
  pose_seconds.assign(count, 0.0);
  last_control_us.assign(count, 0.0);
}

void Simulation::Implementation::begin() {
  world.begin_tick();
  if (world.step_due() && options.progress && !options.progress(now())) stopped_by_caller = true;
}

void Simulation::Implementation::hear() {
  radio.deliver(now(), world.robot_grid(), world.positions(),
                [this](int receiver, const TrajectoryMessage& message) {
                  world_inputs[static_cast<std::size_t>(receiver)].messages.push_back(message);
                });
}

void Simulation::Implementation::observe() {
  for (std::size_t i = 0; i < agents.size(); ++i) {
    if (!world.robots()[i].active()) continue;
    const int robot = static_cast<int>(i);
    pose_inputs[i].poses.clear();
    pose_inputs[i].poses.push_back(world.measure_pose(robot));
    if (!world.observation_due()) continue;
    Observation observation = std::move(spare_observations[i]);
    world.observe(robot, observation);
    observations[i].push_back(std::move(observation));
  }
}

void Simulation::Implementation::think() {
  for (std::size_t i = 0; i < agents.size(); ++i) {
    if (world.robots()[i].active()) think(i);
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
  meter.stood(static_cast<int>(robot), agent.status(), world.pose_interval());
}

/// Hands over what has been heard, and what was seen at least the computing delay ago: a plan that takes so
/// long is committed when it is ready, but knows no more than was known when it began.
void Simulation::Implementation::deliver_observations(std::size_t robot) {
  constexpr double kTimeRounding = 1e-9;  // [s]
  AgentInput& input = world_inputs[robot];
  std::deque<Observation>& waiting = observations[robot];
  const double seen_by = now() - world.scenario().simulation.trial.computing_delay + kTimeRounding;
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
  if (told) radio.send(now(), *told, world.positions()[robot]);
  for (TrialListener* listener : listeners) listener->planned(now(), agent, 1e3 * seconds);
}

void Simulation::Implementation::track(std::size_t robot) {
  const double started = clock();
  world.command(static_cast<int>(robot), agents[robot].track(now()));
  if (!options.clock) return;
  last_control_us[robot] = 1e6 * (pose_seconds[robot] + clock() - started);
  pose_seconds[robot] = 0.0;
  control_us.push_back(static_cast<float>(last_control_us[robot]));
}

void Simulation::Implementation::end() {
  if (ideal()) place_ideally();
  world.end_tick();
  tell_events();
}

/// Every robot will be at its trajectory's point when the tick ends.
void Simulation::Implementation::place_ideally() {
  const double to = world.next_time();
  for (std::size_t i = 0; i < agents.size(); ++i) {
    if (!world.robots()[i].active()) continue;
    const Trajectory& plan = agents[i].committed();
    const FlatState state = plan.state(to);
    world.place(static_cast<int>(i), {state.position_world, plan.heading().state(to).heading},
                state.velocity_world);
  }
}

void Simulation::Implementation::tell_events() {
  const std::size_t contacts_before = std::exchange(contacts_seen, world.contacts().size());
  const std::size_t hits_before = std::exchange(hits_seen, world.hits_while_standing().size());
  for (TrialListener* listener : listeners) {
    for (std::size_t i = contacts_before; i < contacts_seen; ++i) listener->contact(world.contacts()[i]);
    for (std::size_t i = hits_before; i < hits_seen; ++i)
      listener->hit_while_standing(world.hits_while_standing()[i]);
    for (const int robot : world.arrivals())
      listener->arrived(now(), robot, world.positions()[static_cast<std::size_t>(robot)]);
  }
}

void Simulation::Implementation::tell_frame() {
  if (listeners.empty()) return;
  const std::vector<RobotTruth>& robots = world.robots();
  for (std::size_t i = 0; i < robots.size(); ++i) {
    if (ideal()) {
      const double yaw_rate = agents[i].committed().heading().state(now()).yaw_rate;
      const Eigen::Vector3d twist{robots[i].velocity_world.x(), robots[i].velocity_world.y(), yaw_rate};
      wheel_speeds[i] = kinematics.wheel_speeds_from_world(twist, robots[i].pose.heading);
    } else {
      wheel_speeds[i] = world.plant(static_cast<int>(i)).wheel_speeds();
    }
  }
  const TrialFrame frame{now(),         world.share(),     &robots,          &world.movers(), &agents,
                         &wheel_speeds, &world.commands(), &last_control_us, &world.shapes()};
  for (TrialListener* listener : listeners) listener->frame(frame);
}

TrialResult Simulation::Implementation::result() {
  TrialResult result = world.result();
  meter.finish(result);
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
  while (!self.stopped_by_caller && !self.world.finished()) {
    self.begin();
    if (self.world.pose_due()) {
      self.hear();
      self.observe();
      self.think();
    }
    if (self.world.step_due()) self.tell_frame();
    self.end();
  }
  TrialResult result = self.result();
  result.wall_seconds = self.clock() - started;
  return result;
}

}  // namespace spf::sim
