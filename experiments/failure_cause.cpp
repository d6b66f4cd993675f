#include "experiments/failure_cause.hpp"

#include <algorithm>
#include <cmath>

#include "report/table.hpp"
#include "sim/simulation.hpp"

namespace spf {
namespace {

constexpr double kStanding = 0.05;  // [m/s] slower stands (docs/protocol.md)

int robot_in_question(const sim::TrialResult& result) {
  if (result.outcome == sim::TrialOutcome::collision && !result.contacts.empty())
    return result.contacts.front().robot;
  for (std::size_t i = 0; i < result.robots.size(); ++i)
    if (!result.robots[i].in_time) return static_cast<int>(i);
  return -1;
}

std::string standing_text(const StandReason reason) {
  return reason == StandReason::none ? "moving" : to_string(reason);
}

}  // namespace

std::optional<CauseRecord> cause_of(const sim::TrialResult& result) {
  if (result.outcome == sim::TrialOutcome::success || !result.recording) return std::nullopt;
  CauseRecord cause;
  cause.robot = robot_in_question(result);
  if (cause.robot < 0) return std::nullopt;
  const bool touched = result.outcome == sim::TrialOutcome::collision && !result.contacts.empty();
  const double time = touched ? result.contacts.front().time : result.sim_seconds;
  for (const sim::RecordedPlan& plan : result.recording->plans) {
    if (plan.robot != cause.robot || plan.time > time) continue;
    cause.last_plan = to_string(plan.outcome);
    cause.plan_age = std::max(0.0, time - plan.time);
  }
  const sim::RecordedFrame* last = nullptr;
  for (const sim::RecordedFrame& frame : result.recording->frames)
    if (frame.time <= time) last = &frame;
  if (last == nullptr) return cause;
  const AgentStatus& status = last->robots[static_cast<std::size_t>(cause.robot)].status;
  cause.stand_reason = standing_text(status.reason);
  cause.culprit = status.culprit;
  return cause;
}

std::string to_text(const CauseRecord& cause) {
  std::string text = "robot " + std::to_string(cause.robot) + ": " +
                     (cause.stand_reason.empty() ? "unknown state" : cause.stand_reason);
  if (cause.culprit >= 0) text += " (" + std::to_string(cause.culprit) + ")";
  if (cause.last_plan.empty()) return text + ", no plan yet";
  return text + ", last plan " + cause.last_plan + " " + fixed(cause.plan_age, 2) + " s before";
}

std::string failure_kind(const TrialRecord& record) {
  if (record.outcome == "success") return "";
  const std::string plan = record.cause && !record.cause->last_plan.empty()
                               ? ", last plan " + record.cause->last_plan
                               : std::string{};
  if (record.outcome == "collision" && record.contact) {
    const bool stands = record.contact->robot_speed < kStanding;
    return "touched " + record.contact->with + (stands ? ", standing" : ", moving") + plan;
  }
  const std::string stood =
      record.cause && !record.cause->stand_reason.empty() ? ", " + record.cause->stand_reason : std::string{};
  return "not home in time" + stood + plan;
}

}  // namespace spf
