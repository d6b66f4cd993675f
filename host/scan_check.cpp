#include "host/scan_check.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "host/host_parameters.hpp"
#include "spf/math/angles.hpp"

namespace spf::host {
namespace {

constexpr double kLargest = 100.0;  // [m] of anything that is a robot or an obstacle

}  // namespace

bool sensible(const RangeScan& scan) {
  constexpr double kRounding = 1e-3;  // [rad]
  const std::size_t count = scan.ranges.size();
  if (count == 0 || count > kMostBeams) return false;
  const bool finite = std::isfinite(scan.angle_min) && std::isfinite(scan.angle_increment) &&
                      scan.max_range > 0.0 && scan.max_range <= kFarthest;
  constexpr double kLargestAngle = 4.0 * kPi;
  if (!finite || std::abs(scan.angle_min) > kLargestAngle || std::abs(scan.angle_increment) > kLargestAngle)
    return false;
  const double span = std::abs(scan.angle_increment) * static_cast<double>(count - 1);
  return span <= 2.0 * kPi + kRounding && (count == 1 || scan.angle_increment != 0.0);
}

bool sensible(const Pose2& sensor_in_body) {
  return sensor_in_body.position_world.lpNorm<Eigen::Infinity>() <= kLargest &&
         sensor_in_body.position_world.allFinite() && std::isfinite(sensor_in_body.heading);
}

bool blind(const RangeScan& scan) {
  const auto without = std::count_if(scan.ranges.begin(), scan.ranges.end(),
                                     [](double range) { return std::isnan(range) || range <= 0.0; });
  return 2 * static_cast<std::size_t>(without) > scan.ranges.size();
}

bool sensible(const Detection& detection) {
  constexpr double kFastest = 1000.0;  // [m/s]
  const auto within = [](double value, double limit) { return value >= 0.0 && value <= limit; };
  return within(detection.position_world.lpNorm<Eigen::Infinity>(), kFarthest) &&
         detection.position_world.allFinite() && within(detection.radius, kLargest) &&
         within(detection.position_sigma, kLargest) &&
         (!detection.velocity_world ||
          (detection.velocity_world->allFinite() && within(detection.velocity_world->norm(), kFastest)));
}

bool sensible(const std::vector<Detection>& detections) {
  constexpr std::size_t kMost = 10000;
  return detections.size() <= kMost &&
         std::all_of(detections.begin(), detections.end(),
                     [](const Detection& detection) { return sensible(detection); });
}

RangeScan seen_from_centre(const RangeScan& scan, const Pose2& sensor_in_body) {
  constexpr double kAtCentre = 1e-6;  // [m]
  RangeScan seen = scan;
  if (sensor_in_body.position_world.norm() < kAtCentre) {
    seen.angle_min = wrap_angle(scan.angle_min + sensor_in_body.heading);
    return seen;
  }
  const std::size_t count = scan.ranges.size();
  const double step = std::max(std::abs(scan.angle_increment), 2.0 * kPi / static_cast<double>(kMostBeams));
  const auto bins = static_cast<std::size_t>(std::max(1.0, std::round(2.0 * kPi / step)));
  seen.angle_min = -kPi;
  seen.angle_increment = 2.0 * kPi / static_cast<double>(bins);
  seen.max_range = scan.max_range + sensor_in_body.position_world.norm();
  seen.ranges.assign(bins, std::numeric_limits<double>::quiet_NaN());
  for (std::size_t i = 0; i < count; ++i) {
    const double range = scan.ranges[i];
    if (!(range > 0.0)) continue;
    const bool returned = range <= scan.max_range;
    const double angle =
        sensor_in_body.heading + scan.angle_min + scan.angle_increment * static_cast<double>(i);
    const Eigen::Vector2d end =
        sensor_in_body.position_world +
        std::min(range, scan.max_range) * Eigen::Vector2d{std::cos(angle), std::sin(angle)};
    const double turn = (std::atan2(end.y(), end.x()) + kPi) / seen.angle_increment;
    double& beam = seen.ranges[static_cast<std::size_t>(std::lround(turn)) % bins];
    const double reading = returned ? end.norm() : std::numeric_limits<double>::infinity();
    if (std::isnan(beam) || reading < beam) beam = reading;
  }
  return seen;
}

}  // namespace spf::host
