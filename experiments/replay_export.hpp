// A recorded trial as the plain data that the replay page draws.
#pragma once

#include "experiments/trial_run.hpp"
#include "report/replay_data.hpp"

namespace spf {

/// Requires a trial that was recorded by run_trial with the same config.
[[nodiscard]] ReplayData replay_data(const RunConfiguration& config, const FinishedTrial& trial);

/// The replay page of a trial of earlier results, which is run again for it.
struct ReplayPage {
  std::string html;
  bool went_another_way = false;  ///< than the record tells
};
/// None when `stop` ended the trial. `clock` as in TrialOptions. Throws as run_trial does.
[[nodiscard]] std::optional<ReplayPage> replay_page(const Cell& cell, const TrialRecord& record,
                                                    const std::function<double()>& clock,
                                                    const std::function<bool()>& stop);

}  // namespace spf
