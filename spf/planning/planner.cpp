#include "spf/planning/planner.hpp"

namespace spf {

const char* to_string(PlanOutcome outcome) {
  switch (outcome) {
    case PlanOutcome::success:
      return "success";
    case PlanOutcome::goal_reached:
      return "goal reached";
    case PlanOutcome::no_path:
      return "no path";
    case PlanOutcome::unsafe:
      return "unsafe";
    case PlanOutcome::deadline:
      return "deadline";
    case PlanOutcome::invalid_request:
      return "invalid request";
  }
  return "?";
}

}  // namespace spf
