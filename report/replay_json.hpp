// A run as compact JSON for the page's own script (report/replay/10_data.js reads it).
// Lengths in mm, angles in mrad, times in ms, computing times in 0.1 us; series as IntegerColumn writes them.
#pragma once

#include <string>

#include "report/replay_data.hpp"

namespace spf {

/// ASCII text, free of '<', '>' and '&', hence safe inside an HTML script element. Plans are thinned to 4 mm,
/// other candidates to 1 cm. Throws as require_consistent() does.
[[nodiscard]] std::string replay_json(const ReplayData& data);

}  // namespace spf
