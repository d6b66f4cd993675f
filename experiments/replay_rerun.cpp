#include "experiments/replay_export.hpp"
#include "report/replay_page.hpp"

namespace spf {

std::optional<ReplayPage> replay_page(const Cell& cell, const TrialRecord& record,
                                      const std::function<double()>& clock,
                                      const std::function<bool()>& stop) {
  TrialOptions options;
  options.record = true;
  options.clock = clock;
  options.progress = [&stop](double) { return !stop(); };
  const FinishedTrial trial = run_trial(cell, record.key.trial, options);
  if (trial.stopped) return std::nullopt;
  return ReplayPage{render_replay(replay_data(cell.config, trial)), trial.record.digest != record.digest};
}

}  // namespace spf
