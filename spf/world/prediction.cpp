#include "spf/world/prediction.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace spf {
namespace {

struct Motion {
  Eigen::Vector2d position;
  Eigen::Vector2d velocity;
};

/// Pushes a centre out of the static surface and turns the inward part of its velocity outwards.
void reflect(Motion& motion, double clearance, const OccupancyMap& map) {
  const double depth = clearance - map.distance(motion.position);
  if (depth <= 0.0) return;
  const Eigen::Vector2d slope = map.distance_gradient(motion.position);
  const double steepness = slope.norm();
  if (steepness < 1e-6) return;  // the middle of a shape, or truncated: the direction outwards is not known
  const Eigen::Vector2d outward = slope / steepness;
  motion.position += depth / std::max(steepness, 0.5) * outward;
  const double inward_speed = -motion.velocity.dot(outward);
  if (inward_speed > 0.0) motion.velocity += 2.0 * inward_speed * outward;
}

}  // namespace

ObstaclePrediction::ObstaclePrediction(const ObstacleTrack& track, double horizon, double step,
                                       const OccupancyMap* map)
    : track_{track} {
  assert(step > 0.0 && horizon >= 0.0);
  step_ = std::max(step, horizon / (kCapacity - 1));
  // The small number keeps rounding from adding a step.
  count_ = std::clamp(static_cast<int>(std::ceil(horizon / step_ - 1e-9)) + 1, 1, kCapacity);

  // An obstacle that touches a surface already must not bounce off it at once (people lean on walls; maps
  // have noise).
  const double clearance =
      map ? std::min(track.state.radius, map->distance(track.state.position_world)) : track.state.radius;
  Motion motion{track.state.position_world, track.state.velocity_world};
  for (int k = 0; k < count_; ++k) {
    const auto at = static_cast<std::size_t>(k);
    position_[at] = motion.position;
    motion.position += step_ * motion.velocity;
    if (map) reflect(motion, clearance, *map);
    velocity_[at] = (motion.position - position_[at]) / step_;
  }
}

int ObstaclePrediction::sample_before(double ahead) const {
  if (!(ahead > 0.0)) return 0;
  const double steps = ahead / step_;
  return steps >= count_ - 1 ? count_ - 1 : static_cast<int>(steps);
}

Eigen::Vector2d ObstaclePrediction::position(double ahead) const {
  const int k = sample_before(ahead);
  const auto at = static_cast<std::size_t>(k);
  return position_[at] + (std::max(ahead, 0.0) - k * step_) * velocity_[at];
}

Eigen::Vector2d ObstaclePrediction::velocity(double ahead) const {
  return velocity_[static_cast<std::size_t>(sample_before(ahead))];
}

}  // namespace spf
