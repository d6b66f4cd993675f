// Why a trial failed, in words: what the robot was about.
#pragma once

#include <string>

#include "experiments/trial_record.hpp"

namespace spf {

/// "its last plan: unsafe, 0.4 s before; it stood: obstacle ahead 2"
[[nodiscard]] std::string to_text(const CauseRecord& cause);

/// One of few kinds of failure, for counting: "touched a disc, moving, last plan unsafe".
[[nodiscard]] std::string failure_kind(const TrialRecord& record);

}  // namespace spf
