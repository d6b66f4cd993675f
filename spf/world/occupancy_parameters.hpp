// How range returns become occupied cells (log odds per cell; probabilities as in the base planner ES2).
#pragma once

#include "spf/math/parameters.hpp"

namespace spf {

struct OccupancyParameters {
  double hit_probability = 0.65;     ///< [1] a return in a cell argues for "occupied" with this weight
  double miss_probability = 0.35;    ///< [1] a beam through a cell argues for "free"
  double lowest_probability = 0.12;  ///< [1] belief is kept above, so that new obstacles are believed soon
  double highest_probability =
      0.90;  ///< [1] belief is kept below, so that vanished obstacles are let go soon
  double occupied_probability = 0.80;  ///< [1] from here on a cell is an obstacle

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit("hit_probability", self.hit_probability, "1", Range{0.51, 0.99},
          "belief after one return in an unknown cell (ES2)");
    visit("miss_probability", self.miss_probability, "1", Range{0.01, 0.49},
          "belief after one beam through an unknown cell (ES2)");
    visit("lowest_probability", self.lowest_probability, "1", Range{0.01, 0.49},
          "lower bound of belief (ES2)");
    visit("highest_probability", self.highest_probability, "1", Range{0.51, 0.99},
          "upper bound of belief (ES2); not below occupied_probability");
    visit("occupied_probability", self.occupied_probability, "1", Range{0.51, 0.99},
          "belief from which a cell is an obstacle (ES2)");
  }
};

}  // namespace spf
