// The simulator's line segments. Frame: world [m].
#pragma once

#include "spf/math/segment.hpp"

namespace spf::sim {

/// A thin wall, a face of something solid, or a seam between two fields of view.
using Segment = LineSegment;

}  // namespace spf::sim
