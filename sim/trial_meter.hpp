// Adds up the ground-truth figures of a trial while it runs (docs/protocol.md, Figures).
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

  /// To be called at `time` [s] after the robots have moved along their `motion`. Sets `arrived` of those
  /// that arrive.
  void moved(double time, std::vector<RobotTruth>& robots);
  /// Numbers of the robots that arrived in the last call of moved().
  [[nodiscard]] const std::vector<int>& arrivals() const { return arrivals_; }
  /// Adds all present positions to the digest.
  void digest(const std::vector<RobotTruth>& robots, const std::vector<DynamicObstacle>& dynamic_obstacles);

  /// Fills the figures into the result; the trial ended at `time` [s].
  void finish(double time, const std::vector<RobotTruth>& robots, const ContactMonitor& monitor,
              TrialResult& result);

 private:
  std::vector<RobotTask> tasks_;
  std::vector<double> fastest_;  // [s] by robot: rest to rest, straight, alone
  TrialParameters parameters_;
  std::vector<RobotResult> robots_;
  std::vector<int> arrivals_;
  std::uint64_t digest_ = 0;
};

}  // namespace spf::sim
