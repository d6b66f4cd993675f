#include "experiments/trial_store.hpp"

#include <fstream>
#include <string>

#include "config/input_problem.hpp"
#include "experiments/campaign_run.hpp"
#include "experiments/trial_log.hpp"

namespace spf {
namespace {

/// Moves the durations of one histogram into another.
void pour(DurationHistogram& from, DurationHistogram& into) {
  into.merge(from);
  from = {};
}

}  // namespace

TrialStore::TrialStore(const CampaignPlan& plan, std::filesystem::path folder, EarlierResults earlier)
    : plan_{plan}, folder_{std::move(folder)} {
  const std::filesystem::path path = folder_->file("trials.jsonl");
  lines_.emplace(path);  // locked from here on, so that no other process writes while it is read
  if (earlier == EarlierResults::remove) {
    lines_->cut(0);
    folder_->remove_earlier_results();
    return;
  }
  TrialLog log = read_trial_log(path);
  torn_ = log.torn;
  if (torn_) lines_->cut(log.good_bytes);
  for (std::size_t i = 0; i < log.records.size(); ++i) {
    const int cell = cell_index(plan_, log.records[i]);
    if (cell < 0)
      throw InputError{{path.string(), static_cast<int>(i) + 1, 0},
                       "is a trial of " + cell_text(log.records[i].key) +
                           ", which is not in this campaign or has other settings; choose another --out"};
    refuse_contradiction(cell, log.records[i], {path.string(), static_cast<int>(i) + 1, 0});
    keep(cell, std::move(log.records[i]), log.starts[i]);
  }
}

/// A repeated record is no problem, a different one is.
void TrialStore::refuse_contradiction(int cell, const TrialRecord& record,
                                      const SourceLocation& location) const {
  const auto known = known_.find({cell, record.key.trial});
  if (known == known_.end() || same_result(known->second.record, record)) return;
  throw InputError{location, "tells trial " + std::to_string(record.key.trial) + " of " +
                                 cell_text(record.key) +
                                 " otherwise than a line before; choose another --out"};
}

void TrialStore::add(TrialRecord record) {
  const std::uintmax_t line = lines_ ? lines_->append(to_json_line(record)) : 0;
  const int cell = cell_index(plan_, record);
  keep(cell, std::move(record), line);
}

void TrialStore::keep(int cell, TrialRecord record, std::uintmax_t line) {
  const auto [entry, is_new] = known_.try_emplace({cell, record.key.trial});
  if (!is_new) return;
  Timings& timings = timings_[cell];
  pour(record.plan_time, timings.plan);
  pour(record.control_time, timings.control);
  pour(record.new_plan_time, timings.new_plan);
  pour(record.optimiser_time, timings.optimiser);
  entry->second = {std::move(record), line};
}

std::vector<TrialRecord> TrialStore::finish() {
  if (folder_) {
    std::ifstream lines{folder_->file("trials.jsonl"), std::ios::binary};
    auto next = known_.cbegin();
    folder_->write("trials.jsonl", [&]() -> std::string {
      if (next == known_.cend()) return "";
      std::string line;
      lines.seekg(static_cast<std::streamoff>(next->second.line));
      if (!std::getline(lines, line))
        throw OutputError{folder_->file("trials.jsonl").string() + ": cannot be read back"};
      ++next;
      return line + "\n";
    });
  }
  std::vector<TrialRecord> records;
  records.reserve(known_.size());
  for (auto& [name, kept] : known_) {
    TrialRecord record = std::move(kept.record);
    const auto timings = timings_.find(name.first);
    if (timings != timings_.end()) {  // the first of its cell
      record.plan_time = std::move(timings->second.plan);
      record.control_time = std::move(timings->second.control);
      record.new_plan_time = std::move(timings->second.new_plan);
      record.optimiser_time = std::move(timings->second.optimiser);
      timings_.erase(timings);
    }
    records.push_back(std::move(record));
  }
  return records;
}

}  // namespace spf
