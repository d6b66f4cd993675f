// Uncertain moving obstacles: the paper's dynamic cost over guide points of the safety probability field (eq.
// 10-13). Frame: world.
#pragma once

#include <vector>

#include "spf/planning/costs/guide_pair.hpp"
#include "spf/planning/costs/node_set.hpp"

namespace spf {

/// C_dyn = sum over dangerous points of weight * max(0, (d_saf - (p - g) . n) / d_saf)^3 (eq. 10 with its
/// missing positive part, paper_notes 4; divided by d_saf^3, so that the weight is the cost of a point on the
/// ellipse). A sum over points as printed, not an integral over time. Guide points g and directions n are
/// constant within one run, also in the gradients (eq. 12-13, paper_notes 5), and the field does not move
/// with time.
struct FieldCost {
  double weight;           ///< [1] omega_dyn lambda_i of one point on the ellipse
  double safety_distance;  ///< [m] d_saf, wanted beyond the guide point

  void add(const std::vector<GuidePair>& pairs, NodeSet& nodes) const;
};

}  // namespace spf
