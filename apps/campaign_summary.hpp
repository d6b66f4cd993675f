// What `spf experiment` and `spf report` print and write about the trials of campaigns.
#pragma once

#include <string>
#include <vector>

#include "experiments/campaign.hpp"
#include "experiments/campaign_results.hpp"
#include "experiments/campaign_run.hpp"

namespace spf {

/// The table on stdout: one line for each cell.
[[nodiscard]] std::string campaign_table(const std::vector<ResultRow>& rows);

/// Every row and every paired comparison, one JSON object a line.
[[nodiscard]] std::string json_lines(const std::vector<ResultRow>& rows, const std::vector<PairedRow>& pairs);
/// The rows as CSV, with the condition as their last column.
[[nodiscard]] std::string csv_text(const std::vector<ResultRow>& rows);

struct CampaignFacts {
  std::vector<std::string> command;  ///< words of the command line
  Shard shard;
  int jobs = 1;
  std::size_t asked = 0;     ///< trials of this shard
  std::size_t finished = 0;  ///< of them, earlier runs included
  double wall_time = 0.0;    ///< [s] of this run
};

/// run.json: how these results were made. `earlier` is the text of the run that this one continued, or empty;
/// its commits are kept.
[[nodiscard]] std::string campaign_json(const Campaign& campaign, const CampaignFacts& facts,
                                        const std::string& earlier);

/// Commits named by a run.json, the latest last; empty when there are none.
[[nodiscard]] std::vector<std::string> commits_of(const std::string& run_json);

}  // namespace spf
