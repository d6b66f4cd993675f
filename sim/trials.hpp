// Many trials on several threads. Every trial is a world of its own, so the results are the same bits for any
// number of threads, and come in the order of the trials.
#pragma once

#include <functional>
#include <vector>

#include "sim/simulation.hpp"

namespace spf::sim {

struct TrialsRequest {
  /// Makes the scenario of a trial; called on any thread, so it must not share what it changes.
  std::function<Scenario(int trial)> scenario;
  AgentParameters agent;
  int first = 0;
  int count = 1;
  int jobs = 1;         ///< threads; 0 = as many as the machine has
  bool record = false;  ///< keep every trial's recording (large)
  std::function<double()>
      clock;  ///< seconds of a steady clock, callable from any thread; none = nothing is measured
  /// Called after each trial, by one thread at a time, in the order in which trials end; false stops the
  /// rest.
  std::function<bool(const TrialResult&, int done)> progress;
};

/// Results of the trials that ran, by trial. When trials throw, the exception of the earliest of them is
/// thrown again after all threads have ended.
[[nodiscard]] std::vector<TrialResult> run_trials(const TrialsRequest& request);

}  // namespace spf::sim
