// The risk of a plan, computed alike for every method: how likely it is to touch what moves. It says what a
// plan is worth; by what methods choose among plans is their own affair. Frame: world.
#pragma once

#include "spf/planning/planner.hpp"

namespace spf {

/// [s] from the time of the request: so far a risk looks ahead.
inline constexpr double kRiskHorizon = 3.0;

/// Probability that a Gaussian of standard deviation sigma > 0 at distance d is within R:
/// Phi((R - d) / sigma) erf(R / (sigma sqrt 2)). It falls again when sigma is large compared with R. [m]
[[nodiscard]] double overlap_probability(double distance, double radius, double sigma);

/// Probability, in [0, 1], that a robot that follows a trajectory, and rests at its end, touches something
/// that moves within kRiskHorizon: 1 - prod_i (1 - p_i), where p_i is the largest overlap_probability of
/// robot and i at any step of 0.1 s, without margins. Predictions are those of the common check (PlanJudge):
/// obstacles move on at constant velocity, peers as they announce, and peers that yield do not count. The
/// standard deviation is that of the track at that time, or of the peer's position, together with the robot's
/// own (PlanRequest::position_sigma). Static surfaces are no part of it. `radius` is the robot's [m].
/// Requires usable(request).
[[nodiscard]] double contact_risk(const Trajectory& trajectory, const PlanRequest& request, double radius);

/// Sets the risk of a result and of its candidates; a request that is not usable() leaves them 0.
void set_risk(const PlanRequest& request, double radius, PlanResult& result);

}  // namespace spf
