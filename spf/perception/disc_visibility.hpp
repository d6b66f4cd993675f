// Ray checks against a sweep: is a disc visible, hidden or gone? Frame: world.
#pragma once

#include <Eigen/Core>

#include "spf/perception/sensor_sweep.hpp"

namespace spf {

/// Counts of the beams towards a disc.
struct DiscVisibility {
  int through = 0;  ///< end behind the disc or have no return: it is not there
  int on = 0;       ///< end on the disc
  int blocked = 0;  ///< end in front of it
  int unknown = 0;  ///< invalid beams, or the disc is out of the sensor's range or field of view

  [[nodiscard]] int all() const { return through + on + blocked + unknown; }
};

/// Looks along the beams through the inner two thirds of the disc, at most 32 of them. `tolerance` [m] is how
/// far in front of and behind the disc a return may lie and still belong to it.
[[nodiscard]] DiscVisibility look_at_disc(const SensorSweep& sweep, const Eigen::Vector2d& centre_world,
                                          double radius, double tolerance);

/// Whether a former surface point is free now: both beams beside it end behind it, and the surface that
/// runs between their ends passes farther from it than `tolerance` [m].
[[nodiscard]] bool vacated(const SensorSweep& sweep, const Eigen::Vector2d& point_world, double tolerance);

}  // namespace spf
