// Cost of the space-time field (our addition; docs/space_time.md): the probability of contact with moving
// obstacles and peers at the node's time, and with static surfaces by their distance. Frame: world.
//   P = price / exposure (sum_e w_e(t) Phi((R_e - d_e(t)) / sigma_e(t)) + Phi(-c / sigma_s)) [1/s] with d_e
//   the distance to the mean of disc e at time t, w_e its discount, weight and size factor, c the clearance
//   of the static map beyond what is wanted. Means and standard deviations are linear between the steps of
//   SpaceTimeRisk; the gradients are exact for that interpolation.
#pragma once

#include "spf/planning/costs/node_set.hpp"
#include "spf/planning/space_time/space_time_risk.hpp"

namespace spf {

struct SpaceTimeCost {
  const SpaceTimeRisk* risk = nullptr;
  const OccupancyMap* map = nullptr;
  double start_time = 0.0;         ///< [s] absolute time of step 0 of `risk`
  double price = 1e4;              ///< [1] of one certain contact, in units of the total cost
  double exposure = 0.5;           ///< [s] duration of a contact: turns a probability into a rate
  double wanted_clearance = 0.35;  ///< [m] robot's radius and static margin
  double static_sigma = 0.05;      ///< [m] softness of static surfaces

  void operator()(NodeSet& nodes) const;
};

}  // namespace spf
