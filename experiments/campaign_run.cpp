#include "experiments/campaign_run.hpp"

#include <algorithm>
#include <new>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "experiments/trial_run.hpp"
#include "parallel/worker_pool.hpp"

namespace spf {
namespace {

/// The record of a trial; none when it was stopped.
std::optional<TrialRecord> record_of(const Cell& cell, int trial, int threads,
                                     const CampaignRequest& request) {
  if (request.stop && request.stop()) return std::nullopt;
  TrialOptions options;
  options.threads = threads;
  options.clock = request.clock;
  if (request.stop) options.progress = [&request](double) { return !request.stop(); };
  try {
    FinishedTrial finished = run_trial(cell, trial, options);
    if (finished.stopped) return std::nullopt;
    return std::move(finished.record);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    throw std::runtime_error{"trial " + std::to_string(trial) + " of " + cell_text(cell.key) + ": " +
                             error.what()};
  }
}

}  // namespace

std::vector<CampaignTrial> trials_of(const CampaignPlan& plan, Shard shard) {
  std::vector<CampaignTrial> trials;
  const auto cells = static_cast<std::int64_t>(plan.cells.size());
  // Few shards: every cell is dealt out over all of them. More shards than trials: trials are dealt out one
  // by one, so that all shards are equally long.
  const bool few = shard.count <= plan.campaign.trials;
  for (std::int64_t k = 0; k < plan.campaign.trials; ++k)
    for (std::int64_t cell = 0; cell < cells; ++cell)
      if ((few ? k + cell : k * cells + cell) % shard.count == shard.index - 1)
        trials.push_back({static_cast<int>(cell), plan.campaign.first + static_cast<int>(k)});
  return trials;
}

void run_campaign(const CampaignPlan& plan, const CampaignRequest& request) {
  const std::vector<CampaignTrial>& trials = request.trials;
  const int trials_at_once = static_cast<int>(std::min<std::size_t>(trials.size(), 1024));
  WorkerPool pool{std::min(request.jobs, trials_at_once)};
  const int threads = std::max(request.jobs / pool.threads(), 1);  // of each trial: more jobs than trials
  pool.collect(
      trials.size(),
      [&](std::size_t i) {
        const Cell& cell = plan.cells[static_cast<std::size_t>(trials[i].cell)];
        return record_of(cell, trials[i].trial, threads, request);
      },
      [&](std::size_t, TrialRecord record) {
        if (request.finished) request.finished(std::move(record));
        return true;
      });
}

int cell_index(const CampaignPlan& plan, const TrialRecord& record) {
  for (std::size_t i = 0; i < plan.cells.size(); ++i)
    if (same_cell(plan.cells[i].key, record.key) && plan.cells[i].setup == record.setup)
      return static_cast<int>(i);
  return -1;
}

}  // namespace spf
