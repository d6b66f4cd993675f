// Teammates, and obstacles that are predicted as discs (the baselines ES2 and ES2*): their motion over
// absolute time is taken as known. Frame: world.
#pragma once

#include <vector>

#include "spf/planning/costs/node_set.hpp"
#include "spf/planning/moving_disc.hpp"

namespace spf {

/// Values come from PlannerParameters; there are no defaults here.
struct PeerCost {
  double weight;     ///< [1/s] cost rate at contact
  double clearance;  ///< [m] wanted beyond contact

  /// With R the disc's contact distance, C = R + clearance and d the distance of the centres: P = weight *
  /// sum over discs of max(0, (C^2 - d^2) / (C^2 - R^2))^3, over the nodes 1 .. last_node. The discs move
  /// with absolute time, which the time gradients take into account.
  void add(const std::vector<MovingDisc>& discs, int last_node, NodeSet& nodes) const;
};

}  // namespace spf
