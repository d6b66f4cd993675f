// Even and short spacing of the nodes (es2's "squared variance"). Frame: world.
#pragma once

#include "spf/planning/costs/node_set.hpp"

namespace spf {

struct SpacingCost {
  double weight;   ///< [1]
  double spacing;  ///< [m] distance of neighbouring nodes at which the mean cost is `weight`

  /// C = weight * mean over neighbours of (|p_{k+1} - p_k| / spacing)^4. A sum over points, not a time
  /// integral.
  void add(NodeSet& nodes) const;
};

}  // namespace spf
