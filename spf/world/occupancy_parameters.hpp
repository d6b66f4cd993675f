// How range returns become occupied cells (log odds per cell; probabilities as in the base planner ES2).
#pragma once

namespace spf {

/// No settings.
struct OccupancyParameters {
  double hit_probability = 0.65;     ///< [1] a return in a cell argues for "occupied" with this weight
  double miss_probability = 0.35;    ///< [1] a beam through a cell argues for "free"
  double lowest_probability = 0.12;  ///< [1] belief is kept above, so that new obstacles are believed soon
  double highest_probability =
      0.90;  ///< [1] belief is kept below, so that vanished obstacles are let go soon
  double occupied_probability = 0.80;  ///< [1] from here on a cell is an obstacle
};

}  // namespace spf
