// A made-up run for the tests: robots on crossing curves, one moving obstacle, one contact, two candidates a
// plan. Nothing here is a result of the planner.
#pragma once

#include "report/replay_data.hpp"

namespace spf {

struct SampleReplayRequest {
  int robots = 3;
  double duration = 24.0;        ///< [s]
  double replan_interval = 0.5;  ///< [s]
};

[[nodiscard]] ReplayData sample_replay(const SampleReplayRequest& request = {});

}  // namespace spf
