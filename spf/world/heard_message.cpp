#include "spf/world/heard_message.hpp"

#include <algorithm>
#include <cmath>

#include "spf/math/believable.hpp"

namespace spf {
namespace {

/// Whether position, velocity and acceleration stay believable all along a piece, by bounds in which no terms
/// cancel.
bool usable(const QuinticPiece& piece) {
  if (!believable(piece.duration) || !(piece.duration > 0.0) || !believable(piece.coefficients)) return false;
  double position = 0.0, velocity = 0.0, acceleration = 0.0;
  for (int k = 5; k >= 0; --k) {
    const double size = piece.coefficients.row(k).cwiseAbs().maxCoeff();
    position = position * piece.duration + size;
    if (k >= 1) velocity = velocity * piece.duration + k * size;
    if (k >= 2) acceleration = acceleration * piece.duration + k * (k - 1) * size;
  }
  return believable(position) && believable(velocity) && believable(acceleration);
}

bool usable(const HeadingProfile& heading) {
  const HeadingPhases phases = heading.phases();
  return std::isfinite(phases.start_time) && believable(phases.initial_heading) &&
         believable(phases.initial_rate) && believable(phases.cruise_rate) &&
         believable(heading.turn_duration());
}

/// From its start to its end, at any time that may be queried.
bool usable(const Trajectory& trajectory) {
  if (!std::isfinite(trajectory.start_time()) || !usable(trajectory.heading())) return false;
  for (int k = 0; k < trajectory.piece_count(); ++k) {
    if (!usable(trajectory.piece(k))) return false;
  }
  if (!trajectory.steered()) return true;
  for (int k = 0; k <= trajectory.piece_count(); ++k) {
    const HeadingState& knot = trajectory.heading_knot(k);
    if (!believable(knot.heading) || !believable(knot.yaw_rate)) return false;
  }
  return true;
}

}  // namespace

HeardMessage::HeardMessage(const TrajectoryMessage& message)
    : message_{message}, usable_{!message.trajectory.empty() && spf::usable(message.trajectory)} {}

}  // namespace spf
