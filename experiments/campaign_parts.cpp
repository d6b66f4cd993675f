#include "experiments/campaign_parts.hpp"

#include <algorithm>
#include <array>
#include <map>

#include "config/input_problem.hpp"
#include "experiments/results_folder.hpp"
#include "experiments/trial_log.hpp"

namespace spf {
namespace {

namespace fs = std::filesystem;

struct Folder {
  fs::path path;
  Campaign campaign;
  std::vector<TrialRecord> records;
};

Folder read_folder(const fs::path& path) {
  std::error_code error;
  const fs::path log = path / "trials.jsonl";
  if (!fs::exists(log, error)) throw InputError{{path.string(), 0, 0}, "holds no results (trials.jsonl)"};
  Folder folder;
  folder.path = path;
  folder.records = read_trial_log(log).records;
  if (folder.records.empty()) throw InputError{{log.string(), 0, 0}, "holds no trial"};
  if (fs::exists(path / "campaign.yaml", error)) {
    folder.campaign = read_campaign_header((path / "campaign.yaml").string());
  } else {  // of `spf run`
    folder.campaign.name = folder.records.front().key.family;
    folder.campaign.title = "Trials of spf run";
  }
  return folder;
}

void add_pictures(const fs::path& folder, std::vector<StoredPicture>& pictures) {
  std::error_code error;
  for (fs::directory_iterator entry{folder / "pictures", error}, end; !error && entry != end;
       entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    const bool known = std::any_of(pictures.begin(), pictures.end(),
                                   [&name](const StoredPicture& other) { return other.name == name; });
    if (!known && entry->path().extension() == ".svg")
      pictures.push_back({name, text_of_file(entry->path())});
  }
  std::sort(pictures.begin(), pictures.end(),
            [](const StoredPicture& a, const StoredPicture& b) { return a.name < b.name; });
}

/// Trials of the parts of one campaign, each once.
class Merger {
 public:
  void add(const Folder& folder) {
    for (const TrialRecord& record : folder.records) {
      TrialKey cell = record.key;
      cell.trial = 0;
      const std::string name = cell_file_name(cell) + "#" + std::to_string(cell.seed);
      const auto [known, is_new] = setups_.emplace(name, Origin{record.setup, folder.path});
      if (!is_new && known->second.what != record.setup)
        throw InputError{
            {folder.path.string(), 0, 0},
            "has other settings for " + cell_text(record.key) + " than " + known->second.folder.string()};
      const auto [trial, is_first] =
          trials_.emplace(name + "#" + std::to_string(record.key.trial), Kept{merged_.size(), folder.path});
      if (is_first)
        merged_.push_back(record);
      else if (!same_result(merged_[trial->second.index], record))
        throw InputError{{folder.path.string(), 0, 0},
                         "tells trial " + std::to_string(record.key.trial) + " of " + cell_text(record.key) +
                             " otherwise than " + trial->second.folder.string() +
                             "; they come from different versions of the program"};
    }
  }
  [[nodiscard]] std::vector<TrialRecord> take() { return std::move(merged_); }

 private:
  struct Origin {
    std::string what;
    fs::path folder;
  };
  struct Kept {
    std::size_t index;  ///< into merged_
    fs::path folder;
  };
  std::map<std::string, Origin> setups_;
  std::map<std::string, Kept> trials_;
  std::vector<TrialRecord> merged_;
};

/// Index of a value in a list; the list's size when it is not contained.
template <class List, class Name>
std::size_t index_in(const List& list, const std::string& value, Name name) {
  std::size_t i = 0;
  while (i < list.size() && name(list[i]) != value) ++i;
  return i;
}

/// Sort key of a cell in its campaign's table; parts may contain the cells in any order.
std::array<std::size_t, 6> rank_of(const Campaign& campaign, const TrialKey& key) {
  const auto enumerator = [](auto value) { return std::string{enum_name(value)}; };
  const auto named = [](const auto& entry) { return entry.name; };
  std::size_t method = index_in(campaign.methods, key.method, [](const std::string& name) { return name; });
  if (method == campaign.methods.size()) method += index_in(campaign.variants, key.method, named);
  std::size_t scene = index_in(campaign.families, key.family, enumerator);
  if (scene == campaign.families.size())
    scene += index_in(campaign.scenarios, key.family,
                      [](const std::string& file) { return fs::path{file}.stem().string(); });
  const std::size_t level = static_cast<std::size_t>(
      std::find(campaign.levels.begin(), campaign.levels.end(), key.level) - campaign.levels.begin());
  return {index_in(campaign.conditions, key.condition, named),
          scene,
          index_in(campaign.noise, key.noise, enumerator),
          level,
          key.tracking == "full" ? 0U : 1U,
          method};
}

void sort_cells(const Campaign& campaign, std::vector<CellTrials>& cells) {
  std::stable_sort(cells.begin(), cells.end(), [&](const CellTrials& a, const CellTrials& b) {
    return rank_of(campaign, a.front().key) < rank_of(campaign, b.front().key);
  });
}

fs::path scenario_of(const std::vector<fs::path>& folders, const TrialKey& key) {
  std::error_code error;
  for (const fs::path& folder : folders)
    for (const fs::path& file : {folder / "cells" / cell_file_name(key), folder / "scenario.yaml"})
      if (fs::exists(file, error)) return file;
  return {};
}

}  // namespace

std::vector<CampaignParts> read_parts(const std::vector<fs::path>& folders) {
  std::vector<CampaignParts> all;
  std::vector<Merger> mergers;
  for (const fs::path& path : folders) {
    const Folder folder = read_folder(path);
    std::size_t i = 0;
    while (i < all.size() && all[i].campaign.name != folder.campaign.name) ++i;
    if (i == all.size()) {
      all.emplace_back().campaign = folder.campaign;
      mergers.emplace_back();
    }
    all[i].folders.push_back(path);
    all[i].run_files.push_back(text_of_file(path / "run.json"));
    add_pictures(path, all[i].pictures);
    mergers[i].add(folder);
  }
  for (std::size_t i = 0; i < all.size(); ++i) {
    all[i].cells = by_cell(mergers[i].take());
    sort_cells(all[i].campaign, all[i].cells);
    for (const CellTrials& cell : all[i].cells)
      all[i].scenarios.push_back(scenario_of(all[i].folders, cell.front().key));
  }
  return all;
}

}  // namespace spf
