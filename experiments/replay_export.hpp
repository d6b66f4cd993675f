// A recorded trial as the plain data that the replay page draws.
#pragma once

#include "experiments/study_run.hpp"
#include "report/replay_data.hpp"

namespace spf {

/// Requires a trial recorded by run_single with the same study.
[[nodiscard]] ReplayData replay_data(const Study& study, const RecordedTrial& trial);

}  // namespace spf
