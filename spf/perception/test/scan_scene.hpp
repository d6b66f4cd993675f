// Scans of discs and walls for the tests of this room: every beam against every shape, nothing clever.
#pragma once

#include <cmath>
#include <limits>
#include <vector>

#include "spf/math/angles.hpp"
#include "spf/math/plane.hpp"
#include "spf/math/random_stream.hpp"
#include "spf/perception/sensor_sweep.hpp"

namespace spf {

struct SceneDisc {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();
  double radius = 0.3;
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();
};
struct SceneWall {
  Eigen::Vector2d from, to;
};

/// Positions of discs are those at time 0.
struct ScanScene {
  std::vector<SceneDisc> discs;
  std::vector<SceneWall> walls;
  double range_sigma = 0.02;
  double max_range = 8.0;
  int beams = 720;
  double field_of_view = 2.0 * kPi;

  [[nodiscard]] double cast(const BeamRay& ray, double time) const {
    double nearest = std::numeric_limits<double>::infinity();
    for (const SceneDisc& disc : discs) {
      const Eigen::Vector2d offset = disc.centre + time * disc.velocity - ray.origin_world;
      const double along = offset.dot(ray.direction_world);
      const double beside = cross(ray.direction_world, offset);
      const double half = disc.radius * disc.radius - beside * beside;
      if (half < 0.0 || along < 0.0) continue;
      nearest = std::min(nearest, along - std::sqrt(half));
    }
    for (const SceneWall& wall : walls) {
      const Eigen::Vector2d from = wall.from - ray.origin_world;
      const Eigen::Vector2d along = wall.to - wall.from;
      const double denominator = cross(ray.direction_world, along);
      if (denominator == 0.0) continue;
      const double distance = cross(from, along) / denominator;
      const double share = cross(from, ray.direction_world) / denominator;
      if (distance > 0.0 && share >= 0.0 && share <= 1.0) nearest = std::min(nearest, distance);
    }
    return nearest <= max_range ? nearest : std::numeric_limits<double>::infinity();
  }

  /// Fills the scan of a sweep whose other fields are set.
  void scan(SensorSweep& sweep, RangeScan& ranges, RandomStream& noise) const {
    ranges.angle_min = -0.5 * field_of_view;
    ranges.angle_increment = field_of_view / beams;
    ranges.max_range = max_range;
    ranges.ranges.assign(static_cast<std::size_t>(beams), 0.0);
    sweep.scan = &ranges;
    for (int beam = 0; beam < beams; ++beam) {
      const double range = cast(sweep.ray(beam), sweep.time_of(beam));
      ranges.ranges[static_cast<std::size_t>(beam)] = range + range_sigma * noise.normal();
    }
  }
};

}  // namespace spf
