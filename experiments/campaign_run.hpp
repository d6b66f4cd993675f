// Runs a list of trials of a campaign, all cells on one pool of threads, so that no thread waits for one slow
// cell.
#pragma once

#include <functional>
#include <vector>

#include "experiments/campaign.hpp"
#include "experiments/trial_record.hpp"

namespace spf {

/// Part `index` of `count` equal parts; index counts from 1.
struct Shard {
  int index = 1;
  int count = 1;
};

struct CampaignTrial {
  int cell = 0;  ///< index into CampaignPlan::cells
  int trial = 0;
};

/// The trials of a shard, trial by trial and within each cell by cell, so that an early stop leaves all cells
/// with equally many trials. Every trial is in exactly one of the `count` shards, and every cell is spread
/// evenly over them if there are enough trials.
[[nodiscard]] std::vector<CampaignTrial> trials_of(const CampaignPlan& plan, Shard shard = {});

struct CampaignRequest {
  std::vector<CampaignTrial> trials;
  int jobs = 1;                   ///< threads
  std::function<double()> clock;  ///< [s] steady, callable from any thread; none: nothing is timed
  std::function<bool()> stop;     ///< polled often, on any thread; true aborts the running trials
  /// Called after each trial, by one thread at a time, in the order in which they end. An exception ends the
  /// run and is rethrown by run_campaign.
  std::function<void(TrialRecord)> finished;
};

/// Runs the trials. Apart from timings, the records are the same for any number of threads. Throws
/// std::runtime_error, naming cell and trial, when a trial cannot be run.
void run_campaign(const CampaignPlan& plan, const CampaignRequest& request);

/// Index of the cell of a record; -1 when the plan has no such cell.
[[nodiscard]] int cell_index(const CampaignPlan& plan, const TrialRecord& record);

}  // namespace spf
