// What planners need of the map's bindings.
#pragma once

#include "python/bind.hpp"
#include "spf/planning/cost_to_go.hpp"
#include "spf/world/occupancy_map.hpp"

namespace spf::python {

/// The guide itself; one without a goal to lead to throws std::invalid_argument.
[[nodiscard]] const CostToGo& ready(const CostToGo& guide);

}  // namespace spf::python
