// Runs the trials of a study and condenses each to its record.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "experiments/trial_record.hpp"
#include "sim/trial_result.hpp"
#include "study/scenario_file.hpp"

namespace spf {

[[nodiscard]] TrialKey key_of(const Study& study, int trial);

/// What is kept of a trial's result.
[[nodiscard]] TrialRecord record_of(const Study& study, const sim::TrialResult& result);

struct StudyRequest {
  int first = 0;  ///< number of the first trial
  int trials = 1;
  int jobs = 1;                   ///< threads; 0 = as many as the machine has
  std::function<double()> clock;  ///< [s] steady, callable from any thread; none: nothing is timed
  /// Asked often, on any thread, when there is a clock; true ends the run at once and drops the trials under
  /// way.
  std::function<bool()> stop;
  /// Called after each trial, by one thread at a time, in the order in which trials end; false ends the run.
  std::function<bool(const TrialRecord&, int done)> progress;
};

/// Records of the trials that ran, by trial; the same for any number of threads, timings aside. Throws
/// std::invalid_argument or std::runtime_error, with the reason, when a trial cannot be run.
[[nodiscard]] std::vector<TrialRecord> run_study(const Study& study, const StudyRequest& request);

struct RecordedTrial {
  TrialRecord record;
  std::shared_ptr<const sim::Recording> recording;  ///< null unless asked for
  bool stopped = false;                             ///< by `progress`, before the trial's own end
};

struct SingleRequest {
  int trial = 0;
  bool record = false;            ///< keep everything that a replay shows
  std::function<double()> clock;  ///< as in StudyRequest
  /// Called every 0.1 simulated seconds with the time [s]; false ends the trial.
  std::function<bool(double)> progress;
};

/// Runs one trial, which goes the same way as in run_study, recorded or not.
[[nodiscard]] RecordedTrial run_single(const Study& study, const SingleRequest& request);

}  // namespace spf
