#include "experiments/trial_watch.hpp"

#include <algorithm>

namespace spf {

TrialWatch::TrialWatch(const sim::Scenario& scenario) : robots_(scenario.robots.size()) {
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    robots_[i].rims = Drive{scenario.robot_of(i)}.rims();
    robots_[i].wheel_limit = scenario.robot_of(i).max_wheel_speed;
  }
}

void TrialWatch::frame(const sim::TrialFrame& frame) {
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    robots_[i].status = (*frame.hosts)[i].agent().status();
    for (const DriveInput* input : {&(*frame.wheel_speeds)[i], &(*frame.wheel_commands)[i]}) {
      const double fastest = input->head(robots_[i].rims).lpNorm<Eigen::Infinity>();
      largest_wheel_share_ = std::max(largest_wheel_share_, fastest / robots_[i].wheel_limit);
    }
  }
}

void TrialWatch::planned(double time, const RobotAgent& agent, double plan_ms) {
  const PlanResult& plan = agent.last_plan();
  Robot& robot = robots_[static_cast<std::size_t>(agent.robot_id())];
  robot.plan = plan.outcome;
  robot.plan_time = time;
  if (!(plan_ms > 0.0)) return;
  plan_time_.add(1e-3 * plan_ms);
  if (plan.stats.optimiser_calls + plan.stats.primitives == 0) return;
  new_plan_time_.add(1e-3 * plan_ms);
  if (plan.stats.optimiser_calls > 0) optimiser_time_.add(1e-3 * plan_ms / plan.stats.optimiser_calls);
}

void TrialWatch::controlled(double /*time*/, int /*robot*/, double control_us) {
  if (control_us > 0.0) control_time_.add(1e-6 * control_us);
}

void TrialWatch::contact(const sim::Contact& contact) {
  if (!of_first_contact_) of_first_contact_ = cause(contact.robot, contact.time);
}

std::optional<CauseRecord> TrialWatch::cause_of(const sim::TrialResult& result) const {
  if (result.outcome == sim::TrialOutcome::success) return std::nullopt;
  if (result.outcome == sim::TrialOutcome::collision) return of_first_contact_;
  for (std::size_t i = 0; i < result.robots.size(); ++i)
    if (!result.robots[i].in_time && !result.robots[i].excused)
      return cause(static_cast<int>(i), result.sim_seconds);
  return std::nullopt;
}

CauseRecord TrialWatch::cause(int robot, double time) const {
  const Robot& known = robots_[static_cast<std::size_t>(robot)];
  CauseRecord cause;
  cause.robot = robot;
  if (known.plan) {
    cause.last_plan = to_string(*known.plan);
    cause.plan_age = std::max(0.0, time - known.plan_time);
  }
  if (known.status) {
    cause.stand_reason = known.status->reason == StopCause::none ? "moving" : to_string(known.status->reason);
    cause.blocking_id = known.status->blocking_id;
  }
  return cause;
}

}  // namespace spf
