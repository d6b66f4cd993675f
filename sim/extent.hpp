// Frame: world.
#pragma once

#include "sim/scenario.hpp"

namespace spf::sim {

/// The box of a scene: its border, or its map, or what surrounds everything in it by some metres.
[[nodiscard]] Box extent_of(const Scenario& scenario);

}  // namespace spf::sim
