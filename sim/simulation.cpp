#include "sim/simulation.hpp"

#include <algorithm>
#include <cstdint>
#include <deque>
#include <string>
#include <utility>

#include "sim/agent_meter.hpp"
#include "sim/crew.hpp"
#include "sim/fleet_order.hpp"
#include "sim/radio.hpp"
#include "sim/recorder.hpp"
#include "sim/world.hpp"

namespace spf::sim {
struct Simulation::Implementation {
  /// What stands between the world and one robot.
  struct Desk {
    RobotInput input;                       // of this tick
    std::deque<host::SensedWorld> waiting;  // not yet given to the robot
    std::vector<host::SensedWorld> spare;   // kept for its memory
    RobotAction action;                     // of this tick
    std::optional<HeardMessage> told;       // likewise
    double plan_seconds = 0.0;              // of the call, with what it had to take in
    double control_seconds = 0.0;           // likewise
    double world_seconds = 0.0;             // taking in the world since the last plan
    double pose_seconds = 0.0;              // taking in poses since the last control tick
  };

  Implementation(const Scenario& scenario, const std::vector<AgentParameters>& agents,
                 const SimulationOptions& given_options);

  // One tick, in the order of docs/protocol.md.
  void begin();
  void begin_afresh(std::size_t robot);
  void hear();
  void observe();
  void think();
  void end();

  // Of one robot, at the same time as the others: they change nothing but what is its own.
  void think(std::size_t robot);
  void plan(std::size_t robot, double started);
  void control(std::size_t robot);
  void deliver(std::size_t robot);
  /// What came of it, one robot after the other.
  void conclude(std::size_t robot);
  void place_ideally();
  void tell_frame();
  void tell_events();
  [[nodiscard]] TrialResult result() const;

  [[nodiscard]] double now() const { return world.time(); }
  [[nodiscard]] double clock() const { return options.clock ? options.clock() : 0.0; }
  [[nodiscard]] bool ideal() const {
    return world.scenario().simulation.trial.tracking == TrackingMode::ideal;
  }

  SimulationOptions options;
  World world;
  OccupancyMap map;         // that robots begin with
  std::vector<Crew> crews;  // by kind
  std::vector<host::RobotHost> robots;
  std::vector<int> put_elsewhere;        // robots, until they have joined
  std::vector<Drive> drives;             // by robot
  std::vector<DriveInput> wheel_speeds;  // true; filled for listeners
  Radio radio;
  AgentMeter meter;
  std::unique_ptr<Recorder> recorder;
  std::vector<TrialListener*> listeners;  // the recorder among them

  std::vector<Desk> desks;
  std::vector<std::uint32_t> begun;  // number of the first message, by robot
  std::size_t contacts_seen = 0;
  std::size_t hits_seen = 0;
  bool stopped_by_caller = false;
  std::vector<double> last_control_us;  // by robot
};

Simulation::Implementation::Implementation(const Scenario& scenario,
                                           const std::vector<AgentParameters>& agents,
                                           const SimulationOptions& given_options)
    : options{given_options},
      world{scenario},
      map{robot_map(scenario)},
      crews{crews_of(scenario, agents)},
      radio{scenario},
      meter{scenario.robots.size()} {
  if (options.record) recorder = std::make_unique<Recorder>(scenario, map.frame(), options.record_limit);
  for (TrialListener* listener : {options.listener, static_cast<TrialListener*>(recorder.get())})
    if (listener != nullptr) listeners.push_back(listener);
  const std::size_t count = scenario.robots.size();
  const host::Motion motion = ideal() ? host::Motion::as_planned : host::Motion::by_wheels;
  robots.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const RobotTask& task = scenario.robots[i];
    const Crew& crew = crews[scenario.fleet.empty() ? 0 : task.kind];
    robots.emplace_back(static_cast<int>(i), crew.agent, crew.host, motion);
    robots.back().planner().set_keep_candidates(options.record);
    robots.back().planner().set_goal({task.goal_world, task.goal_heading});
    robots.back().start(map, task.start, 0.0);
    drives.emplace_back(scenario.robot_of(i));
    wheel_speeds.push_back(drives.back().standstill());
  }
  desks.resize(count);
  begun.assign(count, 0);
  last_control_us.assign(count, 0.0);
}

void Simulation::Implementation::begin() {
  world.begin_tick();
  for (const FleetOrder& order : world.orders()) {
    const auto put = std::find(put_elsewhere.begin(), put_elsewhere.end(), order.robot);
    if (order.act == FleetAct::join && put != put_elsewhere.end()) {
      begin_afresh(as_index(order.robot));
      put_elsewhere.erase(put);
    }
    obey(order, world, map, robots[as_index(order.robot)]);
    for (TrialListener* listener : listeners)
      listener->ordered(now(), order, world.positions()[as_index(order.robot)]);
  }
  if (world.step_due() && options.progress && !options.progress(now())) stopped_by_caller = true;
}

/// What a robot knew of itself does not hold where it was put: its computer starts as after it was switched
/// off.
void Simulation::Implementation::begin_afresh(std::size_t robot) {
  const Scenario& scenario = world.scenario();
  const Crew& crew = crews[scenario.fleet.empty() ? 0 : scenario.robots[robot].kind];
  constexpr std::uint32_t kMessagesOfALife = 1'000'000;  // peers believe what has a higher number
  begun[robot] += kMessagesOfALife;
  host::RobotHost fresh{static_cast<int>(robot), crew.agent, crew.host,
                        ideal() ? host::Motion::as_planned : host::Motion::by_wheels, begun[robot]};
  fresh.planner().set_keep_candidates(options.record);
  if (const std::optional<host::Goal>& goal = world.goal(static_cast<int>(robot)))
    fresh.planner().set_goal(*goal);
  robots[robot] = std::move(fresh);
  desks[robot] = {};
}

void Simulation::Implementation::hear() {
  radio.deliver(now(), world.robot_grid(), world.positions(),
                [this](int receiver, const HeardMessage& message) {
                  desks[static_cast<std::size_t>(receiver)].input.messages.push_back(message);
                });
}

void Simulation::Implementation::observe() {
  for (std::size_t i = 0; i < desks.size(); ++i) {
    if (!world.robots()[i].active()) continue;
    Desk& desk = desks[i];
    const int robot = static_cast<int>(i);
    desk.input.pose = world.measure_pose(robot);
    if (!world.observation_due(robot)) continue;
    host::SensedWorld sensed;
    if (!desk.spare.empty()) {
      sensed = std::move(desk.spare.back());
      desk.spare.pop_back();
    }
    sensed.has_detections = true;
    world.observe(robot, sensed.observation);
    desk.waiting.push_back(std::move(sensed));
  }
}

void Simulation::Implementation::think() {
  const auto job = [this](std::size_t robot) {
    desks[robot].action = {};
    desks[robot].told.reset();
    if (world.robots()[robot].active()) think(robot);
  };
  if (options.for_each) {
    options.for_each(robots.size(), job);
  } else {
    for (std::size_t i = 0; i < robots.size(); ++i) job(i);
  }
  for (std::size_t i = 0; i < robots.size(); ++i) {
    if (world.robots()[i].active()) conclude(i);
    RobotInput& input = desks[i].input;
    input.messages.clear();
    if (!world.robots()[i].active()) desks[i].waiting.clear();
    for (host::SensedWorld& seen : input.seen) desks[i].spare.push_back(std::move(seen));
    input.seen.clear();
  }
}

/// The two halves of a robot's step, timed apart: what planning has to take in, and what control has.
void Simulation::Implementation::think(std::size_t robot) {
  Desk& desk = desks[robot];
  double started = clock();
  robots[robot].add_pose(desk.input.pose, now());
  desk.pose_seconds += clock() - started;

  started = clock();
  deliver(robot);
  plan(robot, started);
  if (robots[robot].control_due(now())) control(robot);
}

/// Hands over what has been heard, and what was seen at least the computing delay ago: a plan that takes so
/// long is committed when it is ready, but knows no more than was known when it began.
void Simulation::Implementation::deliver(std::size_t robot) {
  constexpr double kTimeRounding = 1e-9;  // [s]
  Desk& desk = desks[robot];
  for (const HeardMessage& message : desk.input.messages) robots[robot].add_message(message, now());
  const double seen_by = now() - world.scenario().simulation.trial.computing_delay + kTimeRounding;
  while (!desk.waiting.empty() && desk.waiting.front().observation.time <= seen_by) {
    desk.input.seen.push_back(std::move(desk.waiting.front()));
    desk.waiting.pop_front();
    robots[robot].add_observation(desk.input.seen.back(), now());
  }
}

void Simulation::Implementation::plan(std::size_t robot, double started) {
  Desk& desk = desks[robot];
  const host::PlannerOutput& output = robots[robot].plan(now());
  desk.world_seconds += clock() - started;
  if (!output.planned) return;
  desk.action.planned = true;
  desk.action.asked_planner = output.asked_planner;
  desk.plan_seconds = std::exchange(desk.world_seconds, 0.0);
  desk.told = output.broadcast;
}

void Simulation::Implementation::control(std::size_t robot) {
  Desk& desk = desks[robot];
  const double started = clock();
  desk.action.wheel_speeds = robots[robot].control(now()).wheel_speeds;
  desk.action.controlled = true;
  desk.control_seconds = std::exchange(desk.pose_seconds, 0.0) + clock() - started;
}

void Simulation::Implementation::conclude(std::size_t robot) {
  const int id = static_cast<int>(robot);
  const RobotAgent& agent = robots[robot].agent();
  const Desk& desk = desks[robot];
  for (TrialListener* listener : listeners) listener->thought(now(), id, desk.input, desk.action);
  if (desk.action.asked_planner) {
    meter.planned(id, agent.last_plan());
    for (TrialListener* listener : listeners) listener->planned(now(), agent, 1e3 * desk.plan_seconds);
  } else if (desk.action.planned) {
    for (TrialListener* listener : listeners) listener->stopped(now(), agent);
  }
  if (desk.told) radio.send(now(), *desk.told, world.positions()[robot]);
  if (desk.action.controlled) {
    world.command(id, desk.action.wheel_speeds);
    if (options.clock) last_control_us[robot] = 1e6 * desk.control_seconds;
    for (TrialListener* listener : listeners) listener->controlled(now(), id, last_control_us[robot]);
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
  for (std::size_t i = 0; i < robots.size(); ++i) {
    if (!world.robots()[i].active()) continue;
    const Trajectory& plan = robots[i].agent().committed();
    const FlatState state = plan.state(to);
    world.place(static_cast<int>(i), {state.position_world, plan.heading_state(to).heading},
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
  const std::vector<RobotTruth>& truth = world.robots();
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (ideal()) {
      const double yaw_rate = robots[i].agent().committed().heading_state(now()).yaw_rate;
      const Eigen::Vector3d twist{truth[i].velocity_world.x(), truth[i].velocity_world.y(), yaw_rate};
      wheel_speeds[i] = drives[i].input_from_world(twist, truth[i].pose.heading);
    } else {
      wheel_speeds[i] = world.plant(static_cast<int>(i)).input();
    }
  }
  const TrialFrame frame{now(),
                         world.share(),
                         &truth,
                         &world.dynamic_obstacles(),
                         &robots,
                         &wheel_speeds,
                         &world.commands(),
                         &last_control_us,
                         &world.shapes()};
  for (TrialListener* listener : listeners) listener->frame(frame);
}

TrialResult Simulation::Implementation::result() const {
  TrialResult result = world.result();
  meter.finish(result);
  for (std::size_t i = 0; i < robots.size(); ++i) {
    const host::ScanGuard* guard = robots[i].tracker().guard();
    if (guard == nullptr) continue;
    result.robots[i].guard_stops = static_cast<int>(guard->counts().stops);
    result.robots[i].guard_held = guard->counts().held_time;
  }
  result.messages = radio.messages_sent();
  return result;
}

Simulation::Simulation(const Scenario& scenario, const std::vector<AgentParameters>& agents,
                       const SimulationOptions& options)
    : implementation_{std::make_unique<Implementation>(scenario, agents, options)} {}
Simulation::Simulation(const Scenario& scenario, const AgentParameters& agent,
                       const SimulationOptions& options)
    : Simulation{scenario, std::vector<AgentParameters>{agent}, options} {}
Simulation::~Simulation() = default;

TrialResult Simulation::run() {
  Implementation& self = *implementation_;
  const double started = self.clock();
  while (!finished()) tick();
  TrialResult result = self.result();
  if (self.recorder) result.recording = self.recorder->take();
  result.wall_seconds = self.clock() - started;
  return result;
}

void Simulation::tick() {
  Implementation& self = *implementation_;
  self.begin();
  if (self.world.pose_due()) {
    self.hear();
    self.observe();
    self.think();
  }
  if (self.world.step_due()) self.tell_frame();
  self.end();
}

bool Simulation::finished() const {
  return implementation_->stopped_by_caller || implementation_->world.finished();
}

TrialResult Simulation::result() const {
  return implementation_->result();
}

World& Simulation::world() {
  return implementation_->world;
}

void Simulation::change(const Scenario& changed) {
  Implementation& self = *implementation_;
  self.world.change(changed);
  if (self.recorder) self.recorder->change(changed);
  self.map = robot_map(changed);
  for (host::RobotHost& robot : self.robots) robot.planner().set_map(self.map);
}

void Simulation::put(int robot, const Pose2& pose_world) {
  Implementation& self = *implementation_;
  const std::optional<host::Goal> goal = self.world.goal(robot);
  self.world.set_start(robot, pose_world);
  self.put_elsewhere.push_back(robot);
  self.world.tell({robot, FleetAct::leave, {}, 0});
  self.world.tell({robot, FleetAct::join, {}, 0});
  if (goal) self.world.tell({robot, FleetAct::goal, *goal, 0});
}

void Simulation::reconfigure(const std::vector<AgentParameters>& agents) {
  Implementation& self = *implementation_;
  const Scenario& scenario = self.world.scenario();
  self.crews = crews_of(scenario, agents);
  for (std::size_t i = 0; i < self.robots.size(); ++i)
    self.robots[i].planner().reconfigure(
        self.crews[scenario.fleet.empty() ? 0 : scenario.robots[i].kind].agent);
}

std::shared_ptr<const Recording> Simulation::take_recording() {
  return implementation_->recorder->take_so_far();
}

}  // namespace spf::sim
