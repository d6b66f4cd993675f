#include "sim/simulation.hpp"

#include <deque>
#include <utility>

#include "sim/agent_meter.hpp"
#include "sim/radio.hpp"
#include "sim/recorder.hpp"
#include "sim/world.hpp"

namespace spf::sim {

namespace {

/// What a robot did in a tick.
struct Thought {
  bool planned = false;
  bool controlled = false;
  double plan_seconds = 0.0;                               // of the call, with what it had to take in
  double control_seconds = 0.0;                            // likewise
  Eigen::Vector3d wheel_speeds = Eigen::Vector3d::Zero();  // [m/s] commanded
  std::optional<HeardMessage> told;
};

/// What stands between the world and one agent.
struct HostedRobot {
  AgentInput pose_input;                 // kept for its memory
  AgentInput world_input;                // likewise
  std::deque<Observation> observations;  // not yet given to the agent
  Observation spare_observation;
  Thought thought;             // of this tick
  double world_seconds = 0.0;  // taking in the world since the last plan
  double pose_seconds = 0.0;   // taking in poses since the last control tick
};

}  // namespace

struct Simulation::Implementation {
  Implementation(const Scenario& scenario, const AgentParameters& agent,
                 const SimulationOptions& given_options);

  // One tick, in the order of docs/protocol.md.
  void begin();
  void hear();
  void observe();
  void think();
  void end();

  // Of one robot, at the same time as the others: they change nothing but what is its own.
  void think(std::size_t robot);
  void plan(std::size_t robot, double started);
  void track(std::size_t robot);
  void deliver_observations(std::size_t robot);
  /// What came of it, one robot after the other.
  void conclude(std::size_t robot);
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

  std::vector<HostedRobot> hosted;
  std::size_t contacts_seen = 0;
  std::size_t hits_seen = 0;
  bool stopped_by_caller = false;
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
    agents.back().set_keep_candidates(options.record);
  }
  wheel_speeds.assign(count, Eigen::Vector3d::Zero());
  hosted.resize(count);
  last_control_us.assign(count, 0.0);
}

void Simulation::Implementation::begin() {
  world.begin_tick();
  if (world.step_due() && options.progress && !options.progress(now())) stopped_by_caller = true;
}

void Simulation::Implementation::hear() {
  radio.deliver(now(), world.robot_grid(), world.positions(),
                [this](int receiver, const HeardMessage& message) {
                  hosted[static_cast<std::size_t>(receiver)].world_input.messages.push_back(message);
                });
}

void Simulation::Implementation::observe() {
  for (std::size_t i = 0; i < agents.size(); ++i) {
    if (!world.robots()[i].active()) continue;
    const int robot = static_cast<int>(i);
    hosted[i].pose_input.poses.clear();
    hosted[i].pose_input.poses.push_back(world.measure_pose(robot));
    if (!world.observation_due()) continue;
    Observation observation = std::move(hosted[i].spare_observation);
    world.observe(robot, observation);
    hosted[i].observations.push_back(std::move(observation));
  }
}

void Simulation::Implementation::think() {
  const auto job = [this](std::size_t robot) {
    hosted[robot].thought = {};
    if (world.robots()[robot].active()) think(robot);
    hosted[robot].world_input.messages.clear();
  };
  if (options.for_each) {
    options.for_each(agents.size(), job);
  } else {
    for (std::size_t i = 0; i < agents.size(); ++i) job(i);
  }
  for (std::size_t i = 0; i < agents.size(); ++i)
    if (world.robots()[i].active()) conclude(i);
}

/// The two halves of a robot's step, timed apart: what planning has to take in, and what control has.
void Simulation::Implementation::think(std::size_t robot) {
  RobotAgent& agent = agents[robot];
  double started = clock();
  agent.receive(now(), hosted[robot].pose_input);
  hosted[robot].pose_seconds += clock() - started;

  started = clock();
  deliver_observations(robot);
  const bool plans = agent.plan_due(now());
  if (plans)
    plan(robot, started);
  else
    hosted[robot].world_seconds += clock() - started;
  if (agent.control_due(now())) track(robot);
}

/// Hands over what has been heard, and what was seen at least the computing delay ago: a plan that takes so
/// long is committed when it is ready, but knows no more than was known when it began.
void Simulation::Implementation::deliver_observations(std::size_t robot) {
  constexpr double kTimeRounding = 1e-9;  // [s]
  AgentInput& input = hosted[robot].world_input;
  std::deque<Observation>& waiting = hosted[robot].observations;
  const double seen_by = now() - world.scenario().simulation.trial.computing_delay + kTimeRounding;
  bool delivered = false;
  while (!waiting.empty() && waiting.front().time <= seen_by) {
    input.observation = std::move(waiting.front());
    waiting.pop_front();
    agents[robot].receive(now(), input);
    hosted[robot].spare_observation = std::move(*input.observation);
    input.observation.reset();
    input.messages.clear();
    delivered = true;
  }
  if (!delivered && !input.messages.empty()) agents[robot].receive(now(), input);
}

void Simulation::Implementation::plan(std::size_t robot, double started) {
  Thought& thought = hosted[robot].thought;
  const std::optional<TrajectoryMessage> told = agents[robot].plan(now());
  thought.planned = true;
  thought.plan_seconds = hosted[robot].world_seconds + clock() - started;
  hosted[robot].world_seconds = 0.0;
  if (told) thought.told = *told;
}

void Simulation::Implementation::track(std::size_t robot) {
  Thought& thought = hosted[robot].thought;
  const double started = clock();
  thought.wheel_speeds = agents[robot].track(now());
  thought.controlled = true;
  thought.control_seconds = hosted[robot].pose_seconds + clock() - started;
  hosted[robot].pose_seconds = 0.0;
}

void Simulation::Implementation::conclude(std::size_t robot) {
  const int id = static_cast<int>(robot);
  const RobotAgent& agent = agents[robot];
  const Thought& thought = hosted[robot].thought;
  if (thought.planned) {
    if (options.clock) plan_ms.push_back(static_cast<float>(1e3 * thought.plan_seconds));
    meter.planned(id, agent.last_plan());
    if (thought.told) radio.send(now(), *thought.told, world.positions()[robot]);
    for (TrialListener* listener : listeners) listener->planned(now(), agent, 1e3 * thought.plan_seconds);
  }
  if (thought.controlled) {
    world.command(id, thought.wheel_speeds);
    if (options.clock) {
      last_control_us[robot] = 1e6 * thought.control_seconds;
      control_us.push_back(static_cast<float>(last_control_us[robot]));
    }
  }
  meter.stood(id, agent.status(), world.pose_interval());
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
