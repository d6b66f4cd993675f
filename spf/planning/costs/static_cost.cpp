#include "spf/planning/costs/static_cost.hpp"

#include <cmath>

namespace spf {

void StaticCost::add(const std::vector<GuidePair>& pairs, NodeSet& nodes) const {
  if (hard_weight <= 0.0 && soft_weight <= 0.0) return;
  const double scale = kSoftScale * soft_clearance;
  for (const GuidePair& pair : pairs) {
    if (pair.node >= nodes.size()) continue;
    NodePenalty& penalty = nodes.penalty(pair.node);
    const double distance = signed_distance(pair, nodes[pair.node].position);
    const double hard = (hard_clearance - distance) / hard_clearance;
    if (hard > 0.0) {
      penalty.integrand += hard_weight * hard * hard * hard;
      penalty.wrt_position -= (3.0 * hard_weight * hard * hard / hard_clearance) * pair.normal;
    }
    const double soft = (soft_clearance - distance) / scale;
    if (soft > 0.0) {
      const double root = std::sqrt(1.0 + soft * soft);
      penalty.integrand += soft_weight * kSoftScale * (root - 1.0);
      penalty.wrt_position -= (soft_weight * soft / (soft_clearance * root)) * pair.normal;
    }
  }
}

}  // namespace spf
