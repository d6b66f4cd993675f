#include "spf/planning/costs/peer_cost.hpp"

#include <algorithm>

namespace spf {

void PeerCost::add(const std::vector<MovingDisc>& discs, int last_node, NodeSet& nodes) const {
  if (weight <= 0.0) return;
  const int end = std::min(last_node + 1, nodes.size());
  for (const MovingDisc& disc : discs) {
    const double outer = disc.radius + clearance;
    const double outer_squared = outer * outer;
    const double scale = 1.0 / (outer_squared - disc.radius * disc.radius);
    DiscCursor cursor{disc};
    for (int k = 1; k < end; ++k) {
      const NodeSample& node = nodes[k];
      cursor.move_to(node.time);  // nodes come in the order of time
      const Eigen::Vector2d offset = node.position - cursor.position();
      const double excess = (outer_squared - offset.squaredNorm()) * scale;
      if (excess <= 0.0) continue;
      NodePenalty& penalty = nodes.penalty(k);
      penalty.integrand += weight * excess * excess * excess;
      const Eigen::Vector2d gradient = (-6.0 * weight * excess * excess * scale) * offset;
      penalty.wrt_position += gradient;
      penalty.wrt_time -= gradient.dot(cursor.velocity());
    }
  }
}

}  // namespace spf
