// trials.jsonl: refused by InputError, or read to records that can be condensed and write themselves.
#include <sstream>

#include "config/input_problem.hpp"
#include "experiments/campaign_results.hpp"
#include "experiments/trial_log.hpp"
#include "fuzz/fuzz_input.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace spf;
  std::istringstream file{fuzz::text_of(data, size)};
  try {
    const TrialLog log = read_trial_log(file, "fuzz.jsonl");
    fuzz::require(log.good_bytes <= size, "no more is read than there is");
    for (const TrialRecord& record : log.records) {
      const TrialRecord again = trial_record_from_json(to_json_line(record), "again.jsonl", 1);
      fuzz::require(same_result(record, again), "a record reads back as it was written");
    }
    const std::vector<CellTrials> cells = by_cell(log.records);
    for (const ResultRow& row : rows_of(cells)) {
      fuzz::require(row.success + row.timeout + row.collision == row.trials, "every trial has an outcome");
      static_cast<void>(to_json_line(row) + to_csv_line(row));
    }
    for (const PairedRow& pair : pairs_of(cells)) static_cast<void>(to_json_line(pair));
  } catch (const InputError&) {
  }
  return 0;
}
