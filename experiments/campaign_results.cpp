#include "experiments/campaign_results.hpp"

#include <algorithm>
#include <map>
#include <tuple>

namespace spf {
namespace {

auto scene_of(const TrialKey& key) {
  return std::tie(key.family, key.noise, key.level, key.tracking, key.condition, key.seed);
}

}  // namespace

std::vector<CellTrials> by_cell(std::vector<TrialRecord> records) {
  using Name =
      std::tuple<std::string, std::string, std::string, double, std::string, std::string, std::uint64_t>;
  std::map<Name, std::size_t> index;
  std::vector<CellTrials> cells;
  for (TrialRecord& record : records) {
    const TrialKey& key = record.key;
    const Name name{key.family, key.method, key.noise, key.level, key.tracking, key.condition, key.seed};
    const auto [entry, is_new] = index.emplace(name, cells.size());
    if (is_new) cells.emplace_back();
    cells[entry->second].push_back(std::move(record));
  }
  for (CellTrials& cell : cells)
    std::stable_sort(cell.begin(), cell.end(),
                     [](const TrialRecord& a, const TrialRecord& b) { return a.key.trial < b.key.trial; });
  return cells;
}

std::vector<ResultRow> rows_of(const std::vector<CellTrials>& cells) {
  std::vector<ResultRow> rows;
  for (const CellTrials& cell : cells) rows.push_back(result_row(cell));
  return rows;
}

std::vector<PairedRow> pairs_of(const std::vector<CellTrials>& cells) {
  std::vector<PairedRow> pairs;
  for (std::size_t a = 0; a < cells.size(); ++a)
    for (std::size_t b = a + 1; b < cells.size(); ++b) {
      if (scene_of(cells[a].front().key) != scene_of(cells[b].front().key)) continue;
      PairedRow pair = paired_row(cells[a], cells[b]);
      if (pair.trials > 0) pairs.push_back(std::move(pair));
    }
  return pairs;
}

}  // namespace spf
