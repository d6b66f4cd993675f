// What a robot's sensors hand to its agent. The host (simulator or ROS node) fills these.
#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <optional>
#include <vector>

#include "spf/math/pose2.hpp"

namespace spf {

/// The robot's own pose as measured, with the time of the measurement.
struct PoseMeasurement {
  double time = 0.0;  ///< [s]
  Pose2 pose_world;
};

/// One moving obstacle as reported by a detector or an outside tracker.
struct Detection {
  int id = 0;                                                ///< stable identity assigned by the detector
  Eigen::Vector2d position_world = Eigen::Vector2d::Zero();  ///< [m]
  std::optional<Eigen::Vector2d> velocity_world;             ///< [m/s] when the detector reports it
  double radius = 0.3;                                       ///< [m]
  double position_sigma = 0.0;                               ///< [m] standard deviation per axis, 0 = exact
};

/// Largest accepted number of beams of one sweep: more than any scanner has.
inline constexpr std::size_t kMostBeams = 100'000;

/// One sweep of a planar range sensor at the robot's centre. Beam i points at angle_min + i * angle_increment
/// in the body frame. A beam without a return reads infinity.
struct RangeScan {
  double angle_min = 0.0;        ///< [rad]
  double angle_increment = 0.0;  ///< [rad]
  double max_range = 8.0;        ///< [m]
  std::vector<double> ranges;    ///< [m]
};

/// Everything sensed about the surroundings at one instant.
struct Observation {
  double time = 0.0;  ///< [s]
  std::vector<Detection> detections;
  std::optional<RangeScan> scan;
};

}  // namespace spf
