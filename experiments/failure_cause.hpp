// The cause of a trial's failure in words: what the robot was doing.
#pragma once

#include <string>

#include "experiments/trial_record.hpp"

namespace spf {

/// "its last plan: unsafe, 0.4 s before; it stood: obstacle ahead 2"
[[nodiscard]] std::string to_text(const CauseRecord& cause);

/// A coarse kind of failure, for counting: "touched a disc, moving, last plan unsafe".
[[nodiscard]] std::string failure_kind(const TrialRecord& record);

}  // namespace spf
