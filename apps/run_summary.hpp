// What `spf run` prints and writes about its trials, besides their records.
#pragma once

#include <string>
#include <vector>

#include "experiments/result_row.hpp"
#include "experiments/trial_record.hpp"
#include "study/scenario_file.hpp"

namespace spf {

/// Peak memory of the program so far [byte].
[[nodiscard]] double peak_memory();

/// The table on stdout: outcome, times, distances, computing, and the failed trials with their reasons.
/// `memory` [byte] is the peak memory; for a single trial it is also given per robot.
[[nodiscard]] std::string summary_text(const RunConfiguration& config, const std::vector<TrialRecord>& trials,
                                       double memory);

struct RunFacts {
  std::vector<std::string> command;  ///< words of the command line
  int first = 0;
  int trials = 1;  ///< asked for
  int finished = 0;
  int jobs = 1;
  double wall_time = 0.0;    ///< [s]
  double peak_memory = 0.0;  ///< [byte]
};

/// run.json: how these results were made.
[[nodiscard]] std::string run_json(const RunConfiguration& config, const RunFacts& facts);

/// The present time, as 2026-01-31T12:00:00Z.
[[nodiscard]] std::string today();

/// scenario.yaml: every key written out; running it again gives the same trials.
[[nodiscard]] std::string resolved_scenario(const RunConfiguration& config);

}  // namespace spf
