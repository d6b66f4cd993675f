// What tests run: all trials of one config.
#pragma once

#include <utility>
#include <vector>

#include "experiments/campaign_run.hpp"
#include "experiments/trial_store.hpp"

namespace spf {

/// Records by trial.
inline std::vector<TrialRecord> run_configuration(const RunConfiguration& config, int first, int trials,
                                                  CampaignRequest request = {}) {
  const CampaignPlan plan = single_cell(config, first, trials);
  TrialStore store{plan};
  request.trials = trials_of(plan);
  const auto previous = request.finished;
  request.finished = [&](TrialRecord record) {
    store.add(record);
    if (previous) previous(std::move(record));
  };
  run_campaign(plan, request);
  return store.finish();
}

}  // namespace spf
