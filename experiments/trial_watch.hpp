// Listens to a running trial and keeps those parts of its record that the result does not contain: what the
// robots were doing, how long planning took, and how near the wheels came to their limit. A few numbers per
// robot, however long the trial runs.
#pragma once

#include <optional>
#include <vector>

#include "experiments/trial_record.hpp"
#include "sim/scenario.hpp"
#include "sim/trial_listener.hpp"
#include "sim/trial_result.hpp"

namespace spf {

class TrialWatch : public sim::TrialListener {
 public:
  explicit TrialWatch(const sim::Scenario& scenario);

  void frame(const sim::TrialFrame& frame) override;
  void planned(double time, const RobotAgent& agent, double plan_ms) override;
  void controlled(double time, int robot, double control_us) override;
  void contact(const sim::Contact& contact) override;

  /// What the robot that made the first contact was doing, or else the first that has not arrived at the end.
  /// None after a success.
  [[nodiscard]] std::optional<CauseRecord> cause_of(const sim::TrialResult& result) const;
  /// Of any wheel, true or commanded, as a share of its robot's limit.
  [[nodiscard]] double largest_wheel_share() const { return largest_wheel_share_; }
  /// [s] of each planning call with what it had to take in; empty without a clock.
  [[nodiscard]] const DurationHistogram& plan_time() const { return plan_time_; }
  /// [s] of each control tick with the poses since the last; likewise.
  [[nodiscard]] const DurationHistogram& control_time() const { return control_time_; }
  /// [s] of the planning calls that searched for a new plan: most calls only find that the plan is still
  /// valid.
  [[nodiscard]] const DurationHistogram& new_plan_time() const { return new_plan_time_; }
  /// [s] of each optimiser call: the time of such a planning call divided by its number of optimiser calls.
  [[nodiscard]] const DurationHistogram& optimiser_time() const { return optimiser_time_; }

 private:
  struct Robot {
    int rims = 0;              // of its drive's inputs
    double wheel_limit = 1.0;  // [m/s]
    std::optional<PlanOutcome> plan;
    double plan_time = 0.0;  // [s]
    std::optional<AgentStatus> status;
  };
  [[nodiscard]] CauseRecord cause(int robot, double time) const;

  std::vector<Robot> robots_;
  std::optional<CauseRecord> of_first_contact_;
  double largest_wheel_share_ = 0.0;
  DurationHistogram plan_time_, control_time_, new_plan_time_, optimiser_time_;
};

}  // namespace spf
