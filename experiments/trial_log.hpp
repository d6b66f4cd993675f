// Reads trials.jsonl: the trials of an interrupted run, or the parts of a campaign.
#pragma once

#include <cstdint>
#include <filesystem>
#include <istream>
#include <string>
#include <vector>

#include "experiments/trial_record.hpp"

namespace spf {

struct TrialLog {
  std::vector<TrialRecord> records;    ///< in the order of the file
  std::vector<std::uintmax_t> starts;  ///< where the line of each record begins [byte]
  std::uintmax_t good_bytes = 0;       ///< of whole lines; the rest was cut off in writing
  bool torn = false;                   ///< there is something after them
};

/// Reads the trials of a file; an absent file has none. A last line that is the beginning of a trial and was
/// cut off (the program was killed, the machine went down) is left out; everything else that is no trial is
/// counted, and throws InputError with every such line, its key, value and limit.
[[nodiscard]] TrialLog read_trial_log(const std::filesystem::path& path);
/// The same from a stream; `name` stands for the file in messages.
[[nodiscard]] TrialLog read_trial_log(std::istream& file, const std::string& name);

}  // namespace spf
