#include "spf/perception/disc_visibility.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "spf/math/plane.hpp"
#include "spf/math/segment.hpp"

namespace spf {
namespace {

constexpr double kInnerPart = 0.67;  // of the radius: beams there hit it even if its position is a little off
constexpr long kMostBeamsLookedAt = 32;

void look_along(const SensorSweep& sweep, int beam, const Eigen::Vector2d& centre_world, double radius,
                double tolerance, DiscVisibility& seen) {
  const BeamRay ray = sweep.ray(beam);
  const Eigen::Vector2d offset = centre_world - ray.origin_world;
  const double along = offset.dot(ray.direction_world);
  const double beside = cross(ray.direction_world, offset);
  const double half_chord = std::sqrt(std::max(radius * radius - beside * beside, 0.0));
  const double range = sweep.scan->ranges[static_cast<std::size_t>(beam)];
  switch (beam_end(*sweep.scan, beam)) {
    case BeamEnd::unknown:
      ++seen.unknown;
      break;
    case BeamEnd::open:
      ++(along + half_chord < sweep.scan->max_range ? seen.through : seen.unknown);
      break;
    case BeamEnd::hit:
      if (range < along - half_chord - tolerance) {
        ++seen.blocked;
      } else if (range > along + half_chord + tolerance) {
        ++seen.through;
      } else {
        ++seen.on;
      }
      break;
  }
}

}  // namespace

DiscVisibility look_at_disc(const SensorSweep& sweep, const Eigen::Vector2d& centre_world, double radius,
                            double tolerance) {
  DiscVisibility seen;
  const double middle = sweep.beam_towards(centre_world);
  const BeamRay ray = sweep.ray(middle);
  const double distance = (centre_world - ray.origin_world).norm();
  if (!std::isfinite(middle) || distance - radius > sweep.scan->max_range) {
    seen.unknown = 1;
    return seen;
  }
  const double reach = std::min(kInnerPart * radius / std::max(distance, 1e-9), 1.0);
  const double half_span = std::asin(reach) / std::abs(sweep.scan->angle_increment);
  long low = std::lround(middle - half_span);
  long high = std::lround(middle + half_span);
  if (high - low >= sweep.beams()) {
    low = 0;
    high = sweep.beams() - 1;
  }
  const long stride = (high - low) / kMostBeamsLookedAt + 1;
  for (long number = low; number <= high; number += stride) {
    const int beam = sweep.wrapped(number);
    if (beam < 0) {
      ++seen.unknown;
    } else {
      look_along(sweep, beam, centre_world, radius, tolerance, seen);
    }
  }
  return seen;
}

bool vacated(const SensorSweep& sweep, const Eigen::Vector2d& point_world, double tolerance) {
  const double towards = sweep.beam_towards(point_world);
  if (!std::isfinite(towards)) return false;
  std::array<Eigen::Vector2d, 2> ends;
  int hits = 0;
  for (const long number : {std::lround(std::floor(towards)), std::lround(std::floor(towards)) + 1}) {
    const int beam = sweep.wrapped(number);
    if (beam < 0) return false;
    const BeamRay ray = sweep.ray(beam);
    const double distance = (point_world - ray.origin_world).norm();
    const double range = sweep.scan->ranges[static_cast<std::size_t>(beam)];
    switch (beam_end(*sweep.scan, beam)) {
      case BeamEnd::unknown:
        return false;
      case BeamEnd::open:
        if (distance + tolerance > sweep.scan->max_range) return false;
        break;
      case BeamEnd::hit:
        if (range < distance + tolerance) return false;
        ends[static_cast<std::size_t>(hits++)] = ray.origin_world + range * ray.direction_world;
        break;
    }
  }
  if (hits < 2) return true;
  return distance_to_segment(point_world, {ends[0], ends[1]}) > tolerance;
}

}  // namespace spf
