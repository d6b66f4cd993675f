// Reads the folders that `spf experiment` and `spf run` have written; parts of one campaign are merged.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/campaign.hpp"
#include "experiments/campaign_results.hpp"

namespace spf {

/// A picture in a folder of results.
struct StoredPicture {
  std::string name;  ///< of its file
  std::string svg;
};

struct CampaignParts {
  Campaign campaign;
  std::vector<std::filesystem::path> folders;
  std::vector<CellTrials> cells;
  std::vector<std::filesystem::path> scenarios;  ///< of each cell; empty when its file is missing
  std::vector<StoredPicture> pictures;           ///< by name
  std::vector<std::string> run_files;            ///< texts of run.json
};

/// One entry for each campaign name, in the order of the folders. Throws InputError when a folder contains no
/// trials, when parts do not belong together (a cell has other settings in another folder), or when they
/// contradict each other about the same trial.
[[nodiscard]] std::vector<CampaignParts> read_parts(const std::vector<std::filesystem::path>& folders);

}  // namespace spf
