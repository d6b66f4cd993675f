// Reading trials.jsonl back: the trials that an interrupted run has left, or the parts of a campaign.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "experiments/trial_record.hpp"

namespace spf {

struct TrialLog {
  std::vector<TrialRecord> records;    ///< in the order of the file
  std::vector<std::uintmax_t> starts;  ///< where the line of each record begins [byte]
  std::uintmax_t good_bytes = 0;       ///< of whole lines; what follows was cut off in writing
  bool torn = false;                   ///< there is something behind them
};

/// Reads the trials of a file; an absent file has none. A last line that is not whole (the program was
/// killed, the machine went down) is left out; anything else that is no trial throws InputError with file and
/// line.
[[nodiscard]] TrialLog read_trial_log(const std::filesystem::path& path);

}  // namespace spf
