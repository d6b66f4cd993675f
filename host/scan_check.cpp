#include "host/scan_check.hpp"

#include <algorithm>
#include <cmath>

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

double blind_share(const RangeScan& scan) {
  if (scan.ranges.empty()) return 1.0;
  const auto without = std::count_if(scan.ranges.begin(), scan.ranges.end(),
                                     [](double range) { return std::isnan(range) || range <= 0.0; });
  return static_cast<double>(without) / static_cast<double>(scan.ranges.size());
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

}  // namespace spf::host
