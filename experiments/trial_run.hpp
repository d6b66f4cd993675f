// Runs one trial of a cell and condenses it to its record. The program runs all trials by this function.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "experiments/campaign.hpp"
#include "experiments/trial_record.hpp"
#include "sim/recording.hpp"
#include "sim/trial_listener.hpp"

namespace spf {

struct TrialOptions {
  bool record = false;            ///< also record everything that a replay shows
  int threads = 1;                ///< for its robots; the result does not depend on it
  std::function<double()> clock;  ///< [s] steady, callable from any thread; none: nothing is timed
  /// Called every 0.1 simulated seconds with the time [s]; false stops the trial.
  std::function<bool(double)> progress;
  sim::TrialListener* listener = nullptr;  ///< told of what happens; must outlive the trial
};

struct FinishedTrial {
  TrialRecord record;
  std::shared_ptr<const sim::Recording> recording;  ///< null unless asked for
  bool stopped = false;                             ///< by `progress`, before the trial's own end
};

/// Runs a trial; recording does not change its result. Throws std::invalid_argument or std::runtime_error,
/// with the reason, when it cannot be run.
[[nodiscard]] FinishedTrial run_trial(const Cell& cell, int trial, const TrialOptions& options = {});

}  // namespace spf
