#include "experiments/failure_cause.hpp"

#include "report/table.hpp"

namespace spf {
namespace {

constexpr double kStanding = 0.05;  // [m/s] slower counts as standing (docs/protocol.md)

}  // namespace

std::string to_text(const CauseRecord& cause) {
  std::string text = "robot " + std::to_string(cause.robot) + ": " +
                     (cause.stand_reason.empty() ? "unknown state" : cause.stand_reason);
  if (cause.blocking_id >= 0) text += " (" + std::to_string(cause.blocking_id) + ")";
  if (cause.last_plan.empty()) return text + ", no plan yet";
  return text + ", last plan " + cause.last_plan + " " + fixed(cause.plan_age, 2) + " s before";
}

std::string failure_kind(const TrialRecord& record) {
  if (record.succeeded()) return "";
  const std::string plan = record.cause && !record.cause->last_plan.empty()
                               ? ", last plan " + record.cause->last_plan
                               : std::string{};
  if (record.outcome == sim::TrialOutcome::collision && record.contact) {
    const bool stands = record.contact->robot_speed < kStanding;
    return "touched " + record.contact->with + (stands ? ", standing" : ", moving") + plan;
  }
  const std::string stood =
      record.cause && !record.cause->stand_reason.empty() ? ", " + record.cause->stand_reason : std::string{};
  return "not arrived in time" + stood + plan;
}

}  // namespace spf
