#include "experiments/study_run.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <utility>

#include "report/table.hpp"
#include "sim/simulation.hpp"
#include "sim/trials.hpp"

namespace spf {
namespace {

std::string hexadecimal(std::uint64_t value) {
  std::array<char, 16> digits;
  const std::to_chars_result end = std::to_chars(digits.data(), digits.data() + digits.size(), value, 16);
  const std::string text{digits.data(), end.ptr};
  return std::string(16 - text.size(), '0') + text;
}

double finite_or_unknown(double value) {
  return std::isfinite(value) ? value : kNotKnown;
}

ContactRecord contact_of(const sim::Contact& contact) {
  return {contact.time,           contact.robot,       to_string(contact.with), contact.other,
          contact.position_world, contact.robot_speed, contact.other_speed};
}

std::string contact_text(const ContactRecord& contact) {
  std::string text = "robot " + std::to_string(contact.robot) + " (" + fixed(contact.robot_speed, 2) +
                     " m/s) touched " + contact.with;
  if (contact.other >= 0) text += " " + std::to_string(contact.other);
  if (contact.other_speed > 0.0) text += " (" + fixed(contact.other_speed, 2) + " m/s)";
  return text + " at " + fixed(contact.time, 2) + " s";
}

/// Robots that did not arrive, each with what it stood for longest.
std::string overtime_text(const sim::TrialResult& result) {
  std::string text;
  for (std::size_t i = 0; i < result.robots.size(); ++i) {
    const sim::RobotResult& robot = result.robots[i];
    if (robot.in_time) continue;
    text += (text.empty() ? "not home in time: robot " : "; robot ") + std::to_string(i);
    if (robot.arrived) {
      text += " (late, after " + fixed(robot.travel_time, 1) + " s)";
      continue;
    }
    const auto longest = std::max_element(robot.stood.begin(), robot.stood.end());
    if (*longest <= 0.0) continue;
    const StandReason reason = static_cast<StandReason>(longest - robot.stood.begin());
    text += " (" + std::string{to_string(reason)} + ", " + fixed(*longest, 1) + " s)";
  }
  return text.empty() ? "stopped before the end" : text;
}

/// Ends trials under way from inside; run_study alone throws and catches it.
struct Stopped {};

/// A clock that ends the trial which reads it, once told to stop: the simulator reads it at every step.
std::function<double()> stopping_clock(const StudyRequest& request) {
  if (!request.clock || !request.stop) return request.clock;
  return [&request] {
    if (request.stop()) throw Stopped{};
    return request.clock();
  };
}

RobotRecord robot_record(const sim::RobotResult& robot) {
  RobotRecord record;
  record.arrived = robot.arrived;
  record.path_length = robot.path_length;
  record.travel_time = robot.travel_time;
  record.path_length_ratio = finite_or_unknown(robot.path_length_ratio);
  record.travel_time_ratio = finite_or_unknown(robot.travel_time_ratio);
  record.plans = robot.plans;
  record.failed_plans = robot.failed_plans;
  record.optimiser_calls = robot.optimiser_calls;
  record.inner_iterations = robot.inner_iterations;
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

}  // namespace

TrialKey key_of(const Study& study, int trial) {
  const sim::SimulationParameters& simulation = study.simulation;
  return {enum_name(study.family),
          enum_name(study.method),
          enum_name(simulation.noise.model),
          simulation.noise.level,
          enum_name(simulation.trial.tracking),
          study.seed,
          trial,
          ""};
}

TrialRecord record_of(const Study& study, const sim::TrialResult& result) {
  TrialRecord record;
  record.key = key_of(study, result.trial);
  record.outcome = to_string(result.outcome);
  if (!result.contacts.empty()) record.contact = contact_of(result.contacts.front());
  record.contacts = static_cast<int>(result.contacts.size());
  record.hits_while_standing = static_cast<int>(result.hits_while_standing.size());
  if (study.recording) record.crossing = crossing_of(result);
  record.sim_time = result.sim_seconds;
  record.dynamic_distance = finite_or_unknown(result.dynamic_distance);
  record.dynamic_clearance = finite_or_unknown(result.dynamic_clearance);
  for (const sim::RobotResult& robot : result.robots) record.robots.push_back(robot_record(robot));
  if (result.outcome == sim::TrialOutcome::collision && record.contact)
    record.failure = contact_text(*record.contact);
  if (result.outcome == sim::TrialOutcome::overtime) record.failure = overtime_text(result);
  record.digest = hexadecimal(result.digest);
  for (const float duration : result.plan_ms) record.plan_time.add(1e-3 * static_cast<double>(duration));
  for (const float duration : result.control_us)
    record.control_time.add(1e-6 * static_cast<double>(duration));
  record.wall_time = result.wall_seconds;
  return record;
}

std::vector<TrialRecord> run_study(const Study& study, const StudyRequest& request) {
  std::vector<TrialRecord> records;
  sim::TrialsRequest trials;
  trials.scenario = [&study](int trial) { return make_trial(study, trial); };
  trials.agent = agent_parameters(study);
  trials.first = request.first;
  trials.count = request.trials;
  trials.jobs = request.jobs;
  trials.clock = stopping_clock(request);
  trials.progress = [&](const sim::TrialResult& result, int done) {
    records.push_back(record_of(study, result));
    return !request.progress || request.progress(records.back(), done);
  };
  try {
    static_cast<void>(sim::run_trials(trials));
  } catch (const Stopped&) {
    // What has ended is in `records`.
  }
  std::sort(records.begin(), records.end(),
            [](const TrialRecord& a, const TrialRecord& b) { return a.key.trial < b.key.trial; });
  return records;
}

RecordedTrial run_single(const Study& study, const SingleRequest& request) {
  RecordedTrial trial;
  sim::SimulationOptions options;
  options.record = request.record;
  options.clock = request.clock;
  options.progress = [&](double time) {
    trial.stopped = request.progress && !request.progress(time);
    return !trial.stopped;
  };
  AgentParameters agent = agent_parameters(study);
  agent.team.keep_candidates = agent.team.keep_candidates || request.record;
  sim::TrialResult result = sim::Simulation{make_trial(study, request.trial), agent, options}.run();
  result.trial = request.trial;
  trial.record = record_of(study, result);
  trial.recording = result.recording;
  return trial;
}

}  // namespace spf
