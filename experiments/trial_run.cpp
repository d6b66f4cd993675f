#include "experiments/trial_run.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "experiments/hexadecimal.hpp"
#include "experiments/trial_watch.hpp"
#include "parallel/worker_pool.hpp"
#include "report/table.hpp"
#include "sim/recording.hpp"
#include "sim/simulation.hpp"

namespace spf {
namespace {

double finite_or_unknown(double value) {
  return std::isfinite(value) ? value : kNotKnown;
}

ContactRecord contact_of(const sim::Contact& contact) {
  return {contact.time,           contact.robot,       enum_name(contact.with), contact.other,
          contact.position_world, contact.robot_speed, contact.other_speed};
}

std::string contact_text(const ContactRecord& contact) {
  std::string text = "robot " + std::to_string(contact.robot) + " (" + fixed(contact.robot_speed, 2) +
                     " m/s) touched " + contact.with;
  if (contact.other >= 0) text += " " + std::to_string(contact.other);
  if (contact.other_speed > 0.0) text += " (" + fixed(contact.other_speed, 2) + " m/s)";
  return text + " at " + fixed(contact.time, 2) + " s";
}

/// Robots that did not arrive, each with its longest stop cause.
std::string timeout_text(const sim::TrialResult& result) {
  std::string text;
  for (std::size_t i = 0; i < result.robots.size(); ++i) {
    const sim::RobotResult& robot = result.robots[i];
    if (robot.in_time || robot.excused) continue;
    text += (text.empty() ? "not arrived in time: robot " : "; robot ") + std::to_string(i);
    if (robot.arrived) {
      text += " (late, after " + fixed(robot.travel_time, 1) + " s)";
      continue;
    }
    const auto longest = std::max_element(robot.stood.begin(), robot.stood.end());
    if (*longest <= 0.0) continue;
    const StopCause reason = static_cast<StopCause>(longest - robot.stood.begin());
    text += " (" + std::string{to_string(reason)} + ", " + fixed(*longest, 1) + " s)";
  }
  return text.empty() ? "stopped before the end" : text;
}

/// What a robot did in a trial in which robots do more than go to one goal.
FleetRecord fleet_record(const sim::RobotResult& robot) {
  FleetRecord record;
  record.goals_reached = robot.life.goals_reached;
  record.present_time = robot.life.present_time;
  record.longest_stand = robot.life.longest_stand;
  record.excused = robot.excused;
  return record;
}

RobotRecord robot_record(const sim::RobotResult& robot, bool life) {
  RobotRecord record;
  if (life) record.fleet = fleet_record(robot);
  record.arrived = robot.arrived;
  record.path_length = robot.path_length;
  record.travel_time = robot.travel_time;
  record.path_length_ratio = finite_or_unknown(robot.path_length_ratio);
  record.travel_time_ratio = finite_or_unknown(robot.travel_time_ratio);
  record.plans = robot.plans;
  record.failed_plans = robot.failed_plans;
  record.optimiser_calls = robot.optimiser_calls;
  record.inner_iterations = robot.inner_iterations;
  record.guard_stops = robot.guard_stops;
  record.guard_held = robot.guard_held;
  return record;
}

CrossingRecord crossing_of(const sim::TrialResult& result) {
  CrossingRecord crossing;
  crossing.crossings = static_cast<int>(result.robots.size());
  crossing.contacts_moving = static_cast<int>(result.contacts.size());
  for (const sim::RobotResult& robot : result.robots) {
    crossing.crossings_ok += robot.in_time && !robot.touched ? 1 : 0;
    crossing.robot_minutes += robot.travel_time / 60.0;
  }
  return crossing;
}

/// The record of a trial, from its result and the figures of the watch; with those of fleets that have a
/// `life` (sim::has_life).
TrialRecord record_of(const Cell& cell, const sim::TrialResult& result, const TrialWatch& watch, bool life) {
  TrialRecord record;
  record.key = cell.key;
  record.key.trial = result.trial;
  record.setup = cell.setup;
  record.outcome = result.outcome;
  if (!result.contacts.empty()) record.contact = contact_of(result.contacts.front());
  record.contacts = static_cast<int>(result.contacts.size());
  record.hits_while_standing = static_cast<int>(result.hits_while_standing.size());
  if (cell.config.family.drawn == sim::Family::ped) record.crossing = crossing_of(result);
  record.sim_time = result.sim_seconds;
  record.dynamic_distance = finite_or_unknown(result.dynamic_distance);
  record.dynamic_clearance = finite_or_unknown(result.dynamic_clearance);
  for (const sim::RobotResult& robot : result.robots) record.robots.push_back(robot_record(robot, life));
  if (result.outcome == sim::TrialOutcome::collision && record.contact)
    record.failure = contact_text(*record.contact);
  if (result.outcome == sim::TrialOutcome::timeout) record.failure = timeout_text(result);
  record.cause = watch.cause_of(result);
  if (cell.config.simulation.trial.tracking ==
      sim::TrackingMode::full)  // otherwise there are no wheel speeds
    record.wheel_share = watch.largest_wheel_share();
  record.digest = hexadecimal(result.digest);
  record.plan_time = watch.plan_time();
  record.control_time = watch.control_time();
  record.new_plan_time = watch.new_plan_time();
  record.optimiser_time = watch.optimiser_time();
  record.wall_time = result.wall_seconds;
  return record;
}

/// Tells two listeners, the first of them first.
class BothListeners : public sim::TrialListener {
 public:
  BothListeners(sim::TrialListener& first, sim::TrialListener& second) : both_{&first, &second} {}

  void frame(const sim::TrialFrame& frame) override {
    for (auto* one : both_) one->frame(frame);
  }
  void thought(double time, int robot, const sim::RobotInput& input,
               const sim::RobotAction& action) override {
    for (auto* one : both_) one->thought(time, robot, input, action);
  }
  void planned(double time, const RobotAgent& agent, double plan_ms) override {
    for (auto* one : both_) one->planned(time, agent, plan_ms);
  }
  void controlled(double time, int robot, double control_us) override {
    for (auto* one : both_) one->controlled(time, robot, control_us);
  }
  void stopped(double time, const RobotAgent& agent) override {
    for (auto* one : both_) one->stopped(time, agent);
  }
  void contact(const sim::Contact& contact) override {
    for (auto* one : both_) one->contact(contact);
  }
  void hit_while_standing(const sim::Contact& contact) override {
    for (auto* one : both_) one->hit_while_standing(contact);
  }
  void ordered(double time, const sim::FleetOrder& order, const Eigen::Vector2d& position) override {
    for (auto* one : both_) one->ordered(time, order, position);
  }
  void arrived(double time, int robot, const Eigen::Vector2d& position) override {
    for (auto* one : both_) one->arrived(time, robot, position);
  }

 private:
  std::array<sim::TrialListener*, 2> both_;
};

}  // namespace

FinishedTrial run_trial(const Cell& cell, int trial, const TrialOptions& options) {
  FinishedTrial finished;
  const sim::Scenario scenario = make_trial(cell.config, trial);
  TrialWatch watch{scenario};
  sim::SimulationOptions simulation;
  simulation.record = options.record;
  simulation.clock = options.clock;
  simulation.listener = &watch;
  std::optional<BothListeners> both;
  if (options.listener != nullptr) simulation.listener = &both.emplace(watch, *options.listener);
  if (options.progress)
    simulation.progress = [&](double time) { return !(finished.stopped = !options.progress(time)); };
  WorkerPool robots{options.threads};
  if (options.threads > 1)
    simulation.for_each = [&robots](std::size_t count, const std::function<void(std::size_t)>& job) {
      robots.for_each(count, job);
    };
  sim::TrialResult result = sim::Simulation{scenario, agents_of(cell.config), simulation}.run();
  result.trial = trial;
  finished.record = record_of(cell, result, watch, has_life(scenario));
  finished.recording = result.recording;
  return finished;
}

}  // namespace spf
