#include "spf/planning/costs/field_cost.hpp"

namespace spf {

void FieldCost::add(const std::vector<GuidePair>& pairs, NodeSet& nodes) const {
  if (weight <= 0.0) return;
  for (const GuidePair& pair : pairs) {
    if (pair.node >= nodes.size()) continue;
    const double lack =
        (safety_distance - signed_distance(pair, nodes[pair.node].position)) / safety_distance;
    if (lack <= 0.0) continue;
    NodePenalty& penalty = nodes.penalty(pair.node);
    penalty.point_cost += weight * lack * lack * lack;
    penalty.point_wrt_position -= (3.0 * weight * lack * lack / safety_distance) * pair.normal;  // eq. 12
  }
}

}  // namespace spf
