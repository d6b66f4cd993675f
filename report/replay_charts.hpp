// The charts of the replay page: wheel speeds, clearances and computing times of every robot.
#pragma once

#include <string>

#include "report/replay_data.hpp"

namespace spf {

/// HTML: a template element for every robot, in their order, with three charts (chart_svg.hpp) over the time
/// of the run: wheels, clearances, computing. The data must be consistent.
[[nodiscard]] std::string replay_charts(const ReplayData& data);

}  // namespace spf
