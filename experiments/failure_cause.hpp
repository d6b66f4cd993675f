// Why a trial failed, as far as its recording tells: what the robot was about.
#pragma once

#include <optional>
#include <string>

#include "experiments/trial_record.hpp"
#include "sim/trial_result.hpp"

namespace spf {

/// Of the robot that made the first contact, or of the first that is not home. None after a success, or
/// without a recording.
[[nodiscard]] std::optional<CauseRecord> cause_of(const sim::TrialResult& result);

/// "its last plan: unsafe, 0.4 s before; it stood: obstacle ahead 2"
[[nodiscard]] std::string to_text(const CauseRecord& cause);

/// One of few kinds of failure, for counting: "touched a disc, moving, last plan unsafe".
[[nodiscard]] std::string failure_kind(const TrialRecord& record);

}  // namespace spf
