// Scenes in which robots come from both sides to a passage that one of them at a time gets through
// (docs/protocol.md). Frame: world.
#pragma once

#include "sim/families.hpp"
#include "spf/math/random_stream.hpp"

namespace spf::sim {

/// DOORS with more than one robot: a wall with one door between two rooms, half of the robots in each, with
/// goals in the other. False when they find no positions.
[[nodiscard]] bool draw_busy_door(RandomStream& random, const LayoutParameters& layout, Scenario& scenario);

/// CORRIDOR: a corridor of one lane between two such rooms.
[[nodiscard]] bool draw_corridor(RandomStream& random, const LayoutParameters& layout, Scenario& scenario);

}  // namespace spf::sim
