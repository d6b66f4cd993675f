// A scan as a driver gives it, of a scanner mounted anyhow, and as the planner wants it: one of the robot's
// centre, all beams at once.
#pragma once

#include <Eigen/Geometry>

#include <optional>

#include "host/host_parameters.hpp"
#include "spf/math/pose2.hpp"
#include "spf/world/observation.hpp"

namespace spf::host {

/// Where a planar scanner is on the robot.
struct ScannerMount {
  Pose2 in_body;             ///< position, and where its x axis points
  bool upside_down = false;  ///< beams run the other way round
};

/// The mount of a scanner at this position [m] in the body, turned like this. Nothing for a scanner whose
/// plane is tilted by more than 0.2 rad: its ranges are none of the plane that the robot moves in.
[[nodiscard]] std::optional<ScannerMount> planar_mount(const Eigen::Vector3d& position_body,
                                                       const Eigen::Quaterniond& orientation);

/// How the robot moves while a scan is made: constant, in the body frame.
struct BodyMotion {
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();  ///< [m/s]
  double yaw_rate = 0.0;                               ///< [rad/s]
};

struct DriverScan {
  RangeScan scan;          ///< in the scanner's own frame, every reading as it came
  double min_range = 0.0;  ///< [m] nearer readings are none: the robot itself
  double duration = 0.0;   ///< [s] from the first beam to the end of the last; 0: all at once
  ScannerMount mount;
};

/// Makes it one of an upright scanner at the same position, whose every reading is a range, infinite (nothing
/// there), or NaN (no reading). A range as long as the scanner's own is one that it was cut off at.
void make_plain(DriverScan& driver, NoReturn no_return);

/// A plain scan as one at the robot's centre would have made it, all at once at the first beam's time. Every
/// reading goes to the beam that points at it, the nearest wins, and where no reading points the beam has
/// none (NaN).
[[nodiscard]] RangeScan seen_from_centre(const DriverScan& plain, const BodyMotion& motion = {});

}  // namespace spf::host
