#include "host/driver_scan.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "spf/math/angles.hpp"

namespace spf::host {
namespace {

constexpr double kMostTilt = 0.2;       // [rad]
constexpr double kCutOff = 1.0 - 1e-4;  // [1] of the scanner's range, to the precision of messages
constexpr double kAtCentre = 1e-6;      // [m]
constexpr double kLeastSkew = 1e-3;     // [m], [rad] within a scan: less is none
constexpr double kLongestSweep = 1.0;   // [s] of a scan that is believed to have been made in one go

/// Where the end of a beam lies in the body as it was at the scan's beginning.
Eigen::Vector2d end_of_beam(const DriverScan& driver, const BodyMotion& motion, std::size_t index,
                            double length) {
  const double angle = driver.mount.in_body.heading + driver.scan.angle_min +
                       driver.scan.angle_increment * static_cast<double>(index);
  Eigen::Vector2d end =
      driver.mount.in_body.position_world + length * Eigen::Vector2d{std::cos(angle), std::sin(angle)};
  if (!(driver.duration > 0.0)) return end;
  const double time =
      driver.duration * static_cast<double>(index) / static_cast<double>(driver.scan.ranges.size());
  const Eigen::Rotation2Dd half_turn{0.5 * time * motion.yaw_rate};
  return half_turn * (half_turn * end + time * motion.velocity);
}

bool skewed(const DriverScan& driver, const BodyMotion& motion) {
  return driver.duration * motion.velocity.norm() > kLeastSkew ||
         driver.duration * std::abs(motion.yaw_rate) > kLeastSkew;
}

}  // namespace

std::optional<ScannerMount> planar_mount(const Eigen::Vector3d& position_body,
                                         const Eigen::Quaterniond& orientation) {
  const double norm = orientation.norm();
  if (!position_body.allFinite() || !(norm > 0.9 && norm < 1.1)) return std::nullopt;
  const Eigen::Matrix3d axes = orientation.normalized().toRotationMatrix();
  const double upright = axes(2, 2);
  if (std::abs(upright) < std::cos(kMostTilt)) return std::nullopt;
  ScannerMount mount;
  mount.in_body = {position_body.head<2>(), std::atan2(axes(1, 0), axes(0, 0))};
  mount.upside_down = upright < 0.0;
  return mount;
}

void make_plain(DriverScan& driver, NoReturn no_return) {
  RangeScan& scan = driver.scan;
  if (driver.mount.upside_down) {
    scan.angle_min = -scan.angle_min;
    scan.angle_increment = -scan.angle_increment;
    driver.mount.upside_down = false;
  }
  const bool zero_is_none = no_return == NoReturn::zero || no_return == NoReturn::any;
  const bool nan_is_none = no_return == NoReturn::nan || no_return == NoReturn::any;
  for (double& range : scan.ranges) {
    const bool nothing_there = range >= kCutOff * scan.max_range || (zero_is_none && range == 0.0) ||
                               (nan_is_none && std::isnan(range));
    if (nothing_there)
      range = std::numeric_limits<double>::infinity();
    else if (!(range >= driver.min_range && range > 0.0))
      range = std::numeric_limits<double>::quiet_NaN();
  }
}

RangeScan seen_from_centre(const DriverScan& plain, const BodyMotion& motion) {
  const RangeScan& scan = plain.scan;
  const Pose2& mount = plain.mount.in_body;
  const bool moves = plain.duration <= kLongestSweep && skewed(plain, motion);
  RangeScan seen = scan;
  if (mount.position_world.norm() < kAtCentre && !moves) {
    seen.angle_min = wrap_angle(scan.angle_min + mount.heading);
    return seen;
  }
  const std::size_t count = scan.ranges.size();
  const double step = std::max(std::abs(scan.angle_increment), 2.0 * kPi / static_cast<double>(kMostBeams));
  const auto bins = static_cast<std::size_t>(std::max(1.0, std::round(2.0 * kPi / step)));
  seen.angle_min = -kPi;
  seen.angle_increment = 2.0 * kPi / static_cast<double>(bins);
  seen.max_range = scan.max_range + mount.position_world.norm();
  seen.ranges.assign(bins, std::numeric_limits<double>::quiet_NaN());
  const BodyMotion counted = moves ? motion : BodyMotion{};
  for (std::size_t i = 0; i < count; ++i) {
    const double range = scan.ranges[i];
    if (!(range > 0.0)) continue;
    const bool returned = range <= scan.max_range;
    const Eigen::Vector2d end = end_of_beam(plain, counted, i, std::min(range, scan.max_range));
    const double turn = (std::atan2(end.y(), end.x()) + kPi) / seen.angle_increment;
    double& beam = seen.ranges[static_cast<std::size_t>(std::lround(turn)) % bins];
    const double reading = returned ? end.norm() : std::numeric_limits<double>::infinity();
    if (std::isnan(beam) || reading < beam) beam = reading;
  }
  return seen;
}

}  // namespace spf::host
