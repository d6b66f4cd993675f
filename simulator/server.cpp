#include "simulator/server.hpp"

#include <array>
#include <cstdio>

#include "simulator/world_messages.hpp"

namespace spf::simulator {
namespace {

constexpr double kTruthPeriod = 0.02;   // [s]
constexpr double kOutcomePeriod = 1.0;  // [s]
constexpr double kTimeRounding = 1e-9;  // [s] sums of ticks are not exact

/// The same scene with a range sensor on every robot, whatever the robots are told of the map.
sim::Scenario with_scans(sim::Scenario scenario) {
  scenario.simulation.sensing.map = sim::MapKnowledge::sensed;
  return scenario;
}

std::vector<RobotParameters> robots_of(const sim::Scenario& scenario) {
  std::vector<RobotParameters> robots;
  for (std::size_t i = 0; i < scenario.robots.size(); ++i) robots.push_back(scenario.robot_of(i));
  return robots;
}

template <class... Values>
std::string text(const char* format, Values... values) {
  std::array<char, 200> line{};
  std::snprintf(line.data(), line.size(), format, values...);
  return line.data();
}

/// How far from its goal, and how fast, a robot is: " (0.12 m away, 0.00 m/s)".
std::string place(const sim::World& world, int robot) {
  const sim::RobotTruth& truth = world.robots()[static_cast<std::size_t>(robot)];
  const std::optional<host::Goal>& goal = world.goal(robot);
  if (!goal) return " (no goal)";
  return text(" (%.2f m away, %.2f m/s)", (goal->position_world - truth.pose.position_world).norm(),
              truth.velocity_world.norm());
}

}  // namespace

Server::Server(const Settings& settings)
    : settings_{settings},
      world_{with_scans(settings.scenario)},
      bases_{robots_of(settings.scenario), settings.control_period},
      pace_{settings.speed} {}

std::string Server::missing(const Outlet& outlet) const {
  std::string names;
  for (int i = 0; i < count(); ++i)
    if (!outlet.is_there(i)) names += (names.empty() ? "" : ", ") + robot_name(i);
  return names;
}

bool Server::wait_for_robots(Outlet& outlet) {
  constexpr double kSettle = 0.5;  // [s] for the rest of their connections
  constexpr double kReport = 5.0;  // [s]
  double complete_since = outlet.wall(), reported = complete_since - kReport;
  while (true) {
    outlet.clock(world_);  // nodes begin with the first one
    const std::string names = missing(outlet);
    const double now = outlet.wall();
    if (!names.empty()) {
      complete_since = now;
      if (now - reported >= kReport) {
        outlet.say("waiting for " + names);
        reported = now;
      }
    } else if (now - complete_since >= kSettle) {
      return true;
    }
    if (!outlet.serve_until(now + 0.1)) return false;
  }
}

int Server::run(Outlet& outlet) {
  world_.begin_tick();
  tell_poses(outlet);
  tell(outlet, &WorldListener::scene);
  tell_outcome(outlet);
  if (settings_.waits_for_robots && !wait_for_robots(outlet)) return settings_.quits_when_done ? 1 : 0;
  outlet.begin(world_);
  outlet.say(text("%d robots, %s trial %d, speed %g", count(), settings_.scenario.family.c_str(),
                  settings_.scenario.trial, settings_.speed));
  wall_.began = outlet.wall();
  pace_.start(world_.time(), wall_.began);
  while (!(end_ && settings_.quits_when_done) && tick(outlet)) {
  }
  wall_.ended = outlet.wall();
  if (!end_) return settings_.quits_when_done ? 1 : 0;
  return end_->outcome == sim::TrialOutcome::success ? 0 : 1;
}

/// The tick has begun. What is sensed goes out, commands come in, and the world moves on when it is time.
bool Server::tick(Outlet& outlet) {
  if (world_.pose_due()) {
    outlet.clock(world_);
    tell_orders(outlet);
    tell_poses(outlet);
  }
  tell_observations(outlet);
  if (world_.step_due()) tell(outlet, &WorldListener::scene);
  if (world_.time() + kTimeRounding >= next_outcome_) tell_outcome(outlet);
  const bool goes_on = outlet.serve_until(pace_.due(world_.next_time()));
  for (int i = 0; i < count(); ++i) world_.command(i, bases_.wheels(i, world_.time()));
  world_.end_tick();
  pace_.reached(world_.time(), outlet.wall());
  if (!end_ && world_.finished()) note_end(outlet);
  world_.begin_tick();
  return goes_on;
}

/// What people would tell the robots. Another priority is not told: nodes take theirs from their parameters.
void Server::tell_orders(Outlet& outlet) const {
  using sim::FleetAct;
  for (const sim::FleetOrder& order : world_.orders()) {
    const sim::RobotTruth& truth = world_.robots()[as_index(order.robot)];
    if (order.act == FleetAct::goal && settings_.publishes_goals)
      tell(outlet, &WorldListener::goal, order.robot, order.goal, truth.pose.heading);
    for (const FleetAct told :
         {FleetAct::cancel, FleetAct::pause, FleetAct::resume, FleetAct::stop, FleetAct::release})
      if (order.act == told) tell(outlet, &WorldListener::order, order);
  }
}

bool Server::dropped(FaultyTopic topic, int robot) const {
  for (const Fault& fault : settings_.faults)
    if (fault.topic == topic && fault.robot == robot && fault.from <= world_.time() &&
        world_.time() < fault.to)
      return true;
  return false;
}

void Server::tell_poses(Outlet& outlet) {
  for (int i = 0; i < count(); ++i) {
    if (!world_.robots()[as_index(i)].active()) continue;
    const PoseMeasurement measured = world_.measure_pose(i);
    if (!dropped(FaultyTopic::odom, i)) tell(outlet, &WorldListener::pose, i, measured.pose_world);
  }
  if (world_.time() + kTimeRounding < next_truth_) return;
  next_truth_ += kTruthPeriod;
  tell(outlet, &WorldListener::truth);
}

void Server::tell_observations(Outlet& outlet) {
  const bool reports = settings_.scenario.simulation.sensing.detections != sim::DetectionQuality::scan;
  for (int i = 0; i < count(); ++i) {
    if (!world_.observation_due(i) || !world_.robots()[as_index(i)].active()) continue;
    world_.observe(i, observation_);
    if (reports && !dropped(FaultyTopic::obstacles, i))
      tell(outlet, &WorldListener::obstacles, i, observation_.detections);
    if (!dropped(FaultyTopic::scan, i)) tell(outlet, &WorldListener::scan, i, *observation_.scan);
  }
}

void Server::tell_outcome(Outlet& outlet) {
  next_outcome_ = world_.time() + kOutcomePeriod;
  tell(outlet, &WorldListener::outcome, end_ ? *end_ : world_.result(), end_.has_value());
}

void Server::note_end(Outlet& outlet) {
  end_ = world_.result();
  tell(outlet, &WorldListener::outcome, *end_, true);
  tell(outlet, &WorldListener::scene);
  outlet.say(summary());
  if (settings_.quits_when_done) (void)outlet.serve_until(outlet.wall() + 0.5);  // the last messages leave
}

std::string Server::summary() const {
  const sim::TrialResult result = end_ ? *end_ : world_.result();
  std::size_t arrived = 0;
  for (const sim::RobotResult& robot : result.robots) arrived += robot.arrived ? 1U : 0U;
  std::string away;
  for (std::size_t i = 0; i < result.robots.size(); ++i)
    if (!result.robots[i].arrived)
      away += (away.empty() ? "" : ", ") + std::to_string(i) + place(world_, static_cast<int>(i));
  const std::size_t contacts = result.contacts.size();
  const std::string line =
      text("trial %d: %s after %.2f s, %zu of %zu robots at goal, %zu contact%s", settings_.scenario.trial,
           end_ ? to_string(end_->outcome) : "under way", result.sim_seconds, arrived, result.robots.size(),
           contacts, contacts == 1 ? "" : "s");
  if (contacts > 0) return line + ": " + contact_text(result.contacts.front());
  return away.empty() || !end_ ? line : line + ": not at their goals: robots " + away;
}

std::string Server::timing() const {
  std::string lines = text("simulated %.2f s in %.2f s; the clock was shifted %ld times, by %.3f s in all\n",
                           world_.time(), wall_.ended - wall_.began, pace_.shifts(), pace_.lost());
  for (int i = 0; i < count(); ++i) {
    const CommandRecord& record = bases_.record(i);
    lines += text("%s: %ld commands, %ld late, longest gap %.3f s, %ld beyond the wheels, %ld refused\n",
                  robot_name(i).c_str(), record.count, record.late, record.longest_gap, record.cut,
                  record.refused);
  }
  return lines;
}

}  // namespace spf::simulator
