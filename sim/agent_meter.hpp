// Adds up the figures of the agents in a trial while it runs (docs/protocol.md, Figures).
#pragma once

#include <vector>

#include "sim/trial_result.hpp"
#include "spf/planning/planner.hpp"
#include "spf/team/agent_status.hpp"

namespace spf::sim {

/// What the agents did: the planning effort and the stop times of a RobotResult.
class AgentMeter {
 public:
  explicit AgentMeter(std::size_t robots) : robots_(robots) {}

  /// A call of a robot's planner ended.
  void planned(int robot, const PlanResult& plan);
  /// The robot has had this status for `duration` [s].
  void stood(int robot, const AgentStatus& status, double duration);
  /// Adds the figures to a result that holds the ground truth of the same robots.
  void finish(TrialResult& result) const;

 private:
  std::vector<RobotResult> robots_;  // only the fields that are metered here
};

}  // namespace spf::sim
