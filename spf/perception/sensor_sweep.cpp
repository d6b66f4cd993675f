#include "spf/perception/sensor_sweep.hpp"

#include <cmath>

#include "spf/math/angles.hpp"
#include "spf/math/believable.hpp"

namespace spf {

BeamRay SensorSweep::ray(double beam) const {
  const double late = duration * beam / beams();
  const double angle = pose_world.heading + yaw_rate * late + scan->angle_min + beam * scan->angle_increment;
  return {pose_world.position_world + late * velocity_world, {std::cos(angle), std::sin(angle)}};
}

double SensorSweep::beam_towards(const Eigen::Vector2d& position_world) const {
  const double middle = 0.5 * (beams() - 1);
  const double half_span = 0.5 * beams() * scan->angle_increment;
  // Fixed-point iteration: the beam determines its time, and the time the pose it starts from.
  double beam = middle;
  for (int look = 0; look < 3; ++look) {
    const double late = duration * beam / beams();
    const Eigen::Vector2d offset = position_world - pose_world.position_world - late * velocity_world;
    const double ahead = pose_world.heading + yaw_rate * late + scan->angle_min + half_span;
    beam = middle + 0.5 + angle_difference(std::atan2(offset.y(), offset.x()), ahead) / scan->angle_increment;
  }
  return beam;
}

bool SensorSweep::closed() const {
  return beams() >= 3 && (beams() + 0.5) * std::abs(scan->angle_increment) >= 2.0 * kPi;
}

int SensorSweep::wrapped(long beam) const {
  const long count = beams();
  if (0 <= beam && beam < count) return static_cast<int>(beam);
  return closed() ? static_cast<int>(((beam % count) + count) % count) : -1;
}

bool SensorSweep::well_formed() const {
  const bool numbers = believable(time) && believable(pose_world.position_world) &&
                       believable(pose_world.heading) && believable(velocity_world) && believable(yaw_rate) &&
                       believable(duration) && believable(scan->angle_min) &&
                       believable(scan->angle_increment);
  return numbers && duration >= 0.0 && std::abs(scan->angle_increment) > 1e-6 && scan->max_range > 0.0 &&
         scan->ranges.size() <= kMostBeams &&
         beams() * std::abs(scan->angle_increment) < 2.0 * kPi + 2.0 * std::abs(scan->angle_increment);
}

BeamEnd beam_end(const RangeScan& scan, int beam) {
  const double range = scan.ranges[static_cast<std::size_t>(beam)];
  if (!(range > kLeastRange)) return BeamEnd::unknown;
  return range <= scan.max_range && believable(range) ? BeamEnd::hit : BeamEnd::open;
}

void collect_returns(const SensorSweep& sweep, std::vector<ScanReturn>& returns) {
  returns.clear();
  for (int beam = 0; beam < sweep.beams(); ++beam) {
    if (beam_end(*sweep.scan, beam) != BeamEnd::hit) continue;
    const double range = sweep.scan->ranges[static_cast<std::size_t>(beam)];
    const BeamRay ray = sweep.ray(beam);
    returns.push_back({beam, range, ray.origin_world + range * ray.direction_world});
  }
}

}  // namespace spf
