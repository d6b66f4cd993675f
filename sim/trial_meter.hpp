// Adds up the figures of a trial while it runs (docs/protocol.md, Figures): those of the truth.
#pragma once

#include <vector>

#include "sim/contact_monitor.hpp"
#include "sim/dynamic_obstacles.hpp"
#include "sim/robot_truth.hpp"
#include "sim/trial_result.hpp"

namespace spf::sim {

class TrialMeter {
 public:
  explicit TrialMeter(const Scenario& scenario);

  /// The robots have moved along their `motion` and it is now `time` [s]. Sets `arrived` of those that
  /// arrive.
  void moved(double time, std::vector<RobotTruth>& robots);
  /// Numbers of the robots that arrived in the last call of moved().
  [[nodiscard]] const std::vector<int>& arrivals() const { return arrivals_; }
  /// All positions now, into the digest.
  void digest(const std::vector<RobotTruth>& robots, const std::vector<DynamicObstacle>& dynamic_obstacles);

  /// Fills what was metered into the result; the trial ended at `time` [s].
  void finish(double time, const std::vector<RobotTruth>& robots, const ContactMonitor& monitor,
              TrialResult& result);

 private:
  std::vector<RobotTask> tasks_;
  RobotParameters robot_;
  TrialParameters parameters_;
  std::vector<RobotResult> robots_;
  std::vector<int> arrivals_;
  std::uint64_t digest_ = 0;
};

}  // namespace spf::sim
