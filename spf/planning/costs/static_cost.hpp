// Static obstacles: half planes found by a path search (es2 guide pairs). Frame: world.
#pragma once

#include <vector>

#include "spf/planning/costs/guide_pair.hpp"
#include "spf/planning/costs/node_set.hpp"

namespace spf {

/// Values come from PlannerParameters; there are no defaults here.
struct StaticCost {
  double hard_weight;     ///< [1/s] cost rate on the edge (signed distance 0)
  double soft_weight;     ///< [1/s] approximate cost rate on the edge
  double hard_clearance;  ///< [m] wanted beyond the edge
  double soft_clearance;  ///< [m] comfortable beyond the edge

  /// With e = clearance - signed distance and r = kSoftScale soft_clearance, where positive:
  /// P = hard_weight (e_hard / hard_clearance)^3 + soft_weight (r / soft_clearance) (sqrt(1 + (e_soft / r)^2)
  /// - 1).
  void add(const std::vector<GuidePair>& pairs, NodeSet& nodes) const;

  /// [1] of soft_clearance: the soft part is quadratic below and linear above this excess (pseudo-Huber).
  static constexpr double kSoftScale = 1.0 / 6.0;
};

}  // namespace spf
