#include "sim/agent_meter.hpp"

namespace spf::sim {

void AgentMeter::planned(int robot, const PlanResult& plan) {
  RobotResult& result = robots_[static_cast<std::size_t>(robot)];
  ++result.plans;
  if (!succeeded(plan.outcome)) ++result.failed_plans;
  result.optimiser_calls += plan.stats.optimiser_calls;
  result.inner_iterations += plan.stats.inner_iterations;
}

void AgentMeter::stood(int robot, const AgentStatus& status, double duration) {
  if (status.reason == StopCause::none || status.reason == StopCause::arrived) return;
  robots_[static_cast<std::size_t>(robot)].stood[static_cast<std::size_t>(status.reason)] += duration;
}

void AgentMeter::finish(TrialResult& result) const {
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    const RobotResult& from = robots_[i];
    RobotResult& to = result.robots[i];
    to.plans = from.plans;
    to.failed_plans = from.failed_plans;
    to.optimiser_calls = from.optimiser_calls;
    to.inner_iterations = from.inner_iterations;
    to.stood = from.stood;
  }
}

}  // namespace spf::sim
