// A scan with the pose and motion of its sensor: every beam as a ray of its own time (de-skewing). Frame:
// world.
#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <vector>

#include "spf/math/pose2.hpp"
#include "spf/world/observation.hpp"

namespace spf {

/// Origin and unit direction of one beam.
struct BeamRay {
  Eigen::Vector2d origin_world = Eigen::Vector2d::Zero();
  Eigen::Vector2d direction_world = Eigen::Vector2d::UnitX();
};

/// Valid as long as its scan. Beam i of n is taken at time + duration * i / n.
struct SensorSweep {
  const RangeScan* scan = nullptr;
  double time = 0.0;                                         ///< [s] of the first beam
  Pose2 pose_world;                                          ///< of the sensor at `time`
  double duration = 0.0;                                     ///< [s] 0 = all beams at once
  Eigen::Vector2d velocity_world = Eigen::Vector2d::Zero();  ///< [m/s] of the sensor
  double yaw_rate = 0.0;                                     ///< [rad/s]

  [[nodiscard]] int beams() const { return static_cast<int>(scan->ranges.size()); }
  /// Beams need not be whole numbers.
  [[nodiscard]] double time_of(double beam) const { return time + duration * beam / beams(); }
  [[nodiscard]] BeamRay ray(double beam) const;
  /// The fractional beam number that points to a position; in [-0.5, beams - 0.5) for a full circle, outside
  /// of the beams' numbers where none points there.
  [[nodiscard]] double beam_towards(const Eigen::Vector2d& position_world) const;
  /// Full circle: the first beam is the neighbour of the last.
  [[nodiscard]] bool closed() const;
  /// ... and both are taken at the same time.
  [[nodiscard]] bool seamless() const { return closed() && !(duration > 0.0); }
  /// The beam of a number that may lie beyond the ends of a full circle; -1 where there is none.
  [[nodiscard]] int wrapped(long beam) const;
  /// All numbers are finite and of a believable size, and there are at most kMostBeams.
  [[nodiscard]] bool well_formed() const;
};

/// Nearer returns are invalid [m].
inline constexpr double kLeastRange = 1e-3;

/// How a beam ends.
enum class BeamEnd : std::uint8_t {
  unknown,  ///< NaN or too near: invalid
  open,     ///< no return up to the sensor's range
  hit,      ///< a return
};
[[nodiscard]] BeamEnd beam_end(const RangeScan& scan, int beam);

/// One return of a sweep.
struct ScanReturn {
  int beam = 0;
  double range = 0.0;                                        ///< [m]
  Eigen::Vector2d position_world = Eigen::Vector2d::Zero();  ///< [m]
};

/// All returns of a well-formed sweep in the order of its beams, into `returns`, whose memory is reused.
void collect_returns(const SensorSweep& sweep, std::vector<ScanReturn>& returns);

}  // namespace spf
