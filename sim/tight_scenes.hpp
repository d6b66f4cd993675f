// Scenes in which one robot has to find the passages that it fits through (docs/protocol.md). Frame: world.
#pragma once

#include "sim/families.hpp"
#include "spf/math/random_stream.hpp"

namespace spf::sim {

/// Throws NoRoom when CLUTTER is to have other than one robot, or CLUTTER, DOORS or CORRIDOR one that is
/// wider than what they promise to leave open.
void require_robots_that_fit(const FamilySetup& setup);

/// CLUTTER: pillars between two walls, on a lattice filled by a cellular automaton. False when no way through
/// is as wide as the layout wants.
[[nodiscard]] bool draw_clutter(RandomStream& random, const LayoutParameters& layout, Scenario& scenario);

/// DOORS: a wall with one door across the way.
[[nodiscard]] bool draw_doors(RandomStream& random, const LayoutParameters& layout, Scenario& scenario);

}  // namespace spf::sim
