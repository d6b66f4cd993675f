#include "host/plan_check.hpp"

#include <cmath>

#include "host/host_parameters.hpp"

namespace spf::host {
namespace {

/// Bound of the coefficients, so that no intermediate result of what follows overflows.
bool measured(const QuinticPiece& piece) {
  return piece.coefficients.allFinite() && piece.coefficients.cwiseAbs().maxCoeff() <= 1e9 &&
         std::isfinite(piece.duration) && piece.duration > 0.0;
}

}  // namespace

bool drivable(const Trajectory& trajectory, const PlanLimits& limits) {
  constexpr double kJoint = 0.1;  // [m] pieces of honest plans join to rounding
  if (trajectory.empty() || !std::isfinite(trajectory.start_time())) return false;
  if (!std::isfinite(trajectory.duration()) || trajectory.duration() > limits.longest) return false;
  const HeadingState heading = trajectory.heading_state(trajectory.start_time());
  if (!std::isfinite(heading.heading) || !std::isfinite(heading.yaw_rate)) return false;
  for (int i = 0; i < trajectory.piece_count(); ++i) {
    const QuinticPiece& piece = trajectory.piece(i);
    if (!measured(piece) || piece.duration > limits.longest) return false;
    for (const double local_time : {0.0, piece.duration})
      if (!(piece.position(local_time).lpNorm<Eigen::Infinity>() <= kFarthest)) return false;
    if (i > 0) {
      const QuinticPiece& before = trajectory.piece(i - 1);
      if (!((piece.position(0.0) - before.position(before.duration)).norm() <= kJoint)) return false;
    }
  }
  return trajectory.max_speed() <= limits.fastest;
}

}  // namespace spf::host
