// The trials of one run of the program. With a folder, each trial is on disk as soon as it ends, and no other
// process writes there meanwhile; in memory only what rows and tables need of it is kept.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "config/input_problem.hpp"
#include "experiments/campaign.hpp"
#include "experiments/results_folder.hpp"
#include "experiments/trial_record.hpp"

namespace spf {

class TrialStore {
 public:
  /// In memory alone. The plan must outlive the store.
  explicit TrialStore(const CampaignPlan& plan) : plan_{plan} {}
  /// In the folder's trials.jsonl. Earlier results are removed, or their trials taken over, each once. Throws
  /// OutputError when the folder cannot be written or another run is writing it, InputError when an earlier
  /// trial is not part of the plan, or has contradicting records.
  TrialStore(const CampaignPlan& plan, std::filesystem::path folder, EarlierResults earlier);

  /// The folder, null without one.
  [[nodiscard]] const ResultsFolder* folder() const { return folder_ ? &*folder_ : nullptr; }
  /// Whether the earlier results ended in half a line.
  [[nodiscard]] bool torn() const { return torn_; }
  [[nodiscard]] bool has(int cell, int trial) const { return known_.count({cell, trial}) > 0; }
  [[nodiscard]] std::size_t size() const { return known_.size(); }

  /// Adds a trial of the plan. Throws OutputError when it cannot be written; the trials before it are kept.
  void add(TrialRecord record);

  /// Sorts all trials by cell and trial, the order of the table, on disk too. The first record of a cell then
  /// has the timings of all its trials together.
  [[nodiscard]] std::vector<TrialRecord> finish();

 private:
  struct Kept {
    TrialRecord record;  // timings aside
    std::uintmax_t line = 0;
  };
  struct Timings {
    DurationHistogram plan, control, new_plan, optimiser;
  };
  void refuse_contradiction(int cell, const TrialRecord& record, const SourceLocation& location) const;
  void keep(int cell, TrialRecord record, std::uintmax_t line);

  const CampaignPlan& plan_;
  std::optional<ResultsFolder> folder_;
  std::optional<LineFile> lines_;
  bool torn_ = false;
  std::map<std::pair<int, int>, Kept> known_;  // by cell and trial
  std::map<int, Timings> timings_;             // by cell
};

}  // namespace spf
