#include "spf/planning/costs/spacing_cost.hpp"

namespace spf {

void SpacingCost::add(NodeSet& nodes) const {
  if (weight <= 0.0 || nodes.size() < 2) return;
  const double square = spacing * spacing;
  const double factor = weight / ((nodes.size() - 1) * square * square);
  for (int k = 0; k + 1 < nodes.size(); ++k) {
    const Eigen::Vector2d gap = nodes[k + 1].position - nodes[k].position;
    const double squared = gap.squaredNorm();
    const Eigen::Vector2d gradient = (4.0 * factor * squared) * gap;
    nodes.penalty(k).point_cost += factor * squared * squared;
    nodes.penalty(k).point_wrt_position -= gradient;
    nodes.penalty(k + 1).point_wrt_position += gradient;
  }
}

}  // namespace spf
