// What a robot senses: scans (sensor_msgs/LaserScan), obstacles that others track, observations, and what its
// wheels are told (spf_empc_msgs).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "host/driver_scan.hpp"
#include "host/planner_host.hpp"
#include "spf/robot/drive.hpp"
#include "spf/world/obstacle_track.hpp"
#include "wire/pose.hpp"

namespace spf::wire {

// ---- scans

/// Readings as they come.
template <class LaserScan>
[[nodiscard]] Converted<RangeScan> read_scan(const LaserScan& scan) {
  using Result = Converted<RangeScan>;
  const std::size_t count = scan.ranges.size();
  if (count == 0) return Result::refused("ranges is empty");
  const double expected =
      (static_cast<double>(scan.angle_max) - scan.angle_min) / static_cast<double>(scan.angle_increment) +
      1.0;
  // Drivers differ by one on whether the last angle is a beam's.
  if (count > 1 && !(std::abs(expected - static_cast<double>(count)) <= 1.5))
    return Result::refused("ranges has " + std::to_string(count) + " entries, its angles give " +
                           std::to_string(std::lround(std::clamp(expected, -1.0, 1e9))));
  if (!(std::isfinite(scan.range_max) && scan.range_max > 0.0F && scan.range_min >= 0.0F))
    return Result::refused("range_min or range_max is not a range");
  RangeScan result;
  result.angle_min = scan.angle_min;
  result.angle_increment = scan.angle_increment;
  result.max_range = scan.range_max;
  result.ranges.assign(scan.ranges.begin(), scan.ranges.end());
  return {std::move(result), {}};
}

/// With the pose of its frame in the body's, in space.
template <class LaserScan, class Pose>
[[nodiscard]] Converted<host::DriverScan> read_driver_scan(const LaserScan& scan,
                                                           const Pose& scanner_in_body) {
  using Result = Converted<host::DriverScan>;
  Converted<RangeScan> readings = read_scan(scan);
  if (!readings) return Result::refused(readings.refusal);
  const auto& at = scanner_in_body.position;
  const auto& q = scanner_in_body.orientation;
  const std::optional<host::ScannerMount> mount =
      host::planar_mount({at.x, at.y, at.z}, Eigen::Quaterniond{q.w, q.x, q.y, q.z});
  if (!mount) return Result::refused("its scanner is not mounted level: neither upright nor upside down");
  host::DriverScan driver;
  driver.scan = std::move(*readings.value);
  driver.min_range = scan.range_min;
  driver.duration = static_cast<double>(scan.time_increment) * static_cast<double>(scan.ranges.size());
  driver.mount = *mount;
  return {std::move(driver), {}};
}

template <class LaserScan>
void fill(const RangeScan& scan, LaserScan& message) {
  const double beams = static_cast<double>(scan.ranges.size());
  message.angle_min = static_cast<float>(scan.angle_min);
  message.angle_increment = static_cast<float>(scan.angle_increment);
  message.angle_max = static_cast<float>(scan.angle_min + scan.angle_increment * std::max(0.0, beams - 1.0));
  message.range_max = static_cast<float>(scan.max_range);
  for (const double range : scan.ranges) message.ranges.push_back(static_cast<float>(range));
}

// ---- obstacles

/// Moved by `fleet_from_message`, the pose of the message's frame in the fleet's.
template <class ObstacleTracks>
[[nodiscard]] Converted<std::vector<Detection>> read_tracks(const ObstacleTracks& tracks,
                                                            const Pose2& fleet_from_message) {
  using Result = Converted<std::vector<Detection>>;
  std::vector<Detection> detections;
  detections.reserve(tracks.tracks.size());
  for (const auto& track : tracks.tracks) {
    const auto covariance = [&values = track.covariance](std::size_t row, std::size_t column) {
      return values[4 * row + column];
    };
    Detection detection;
    detection.id = track.id;
    detection.position_world = moved(fleet_from_message, {track.position.x, track.position.y});
    detection.radius = track.radius;
    const double variance = std::max(covariance(0, 0), covariance(1, 1));
    if (!(variance >= 0.0 && std::isfinite(variance)))
      return Result::refused("obstacle " + std::to_string(track.id) + " has a covariance that is none");
    detection.position_sigma = std::sqrt(variance);
    if (covariance(2, 2) >= 0.0 && covariance(3, 3) >= 0.0)
      detection.velocity_world = Eigen::Rotation2D<double>{fleet_from_message.heading} *
                                 Eigen::Vector2d{track.velocity.x, track.velocity.y};
    detections.push_back(detection);
  }
  return {std::move(detections), {}};
}

template <class ObstacleTracks, class Clock>
void fill(const std::vector<ObstacleTrack>& tracks, const Clock& clock, ObstacleTracks& message) {
  if (!tracks.empty()) message.header.stamp = clock.time(tracks.front().time);
  for (const ObstacleTrack& track : tracks) {
    auto& to = message.tracks.emplace_back();
    to.id = track.id;
    fill(track.state.position_world, to.position);
    fill(track.state.velocity_world, to.velocity);
    to.radius = track.state.radius;
    for (const std::size_t axis : {std::size_t{0}, std::size_t{1}}) {
      to.covariance[5 * axis] = track.position_variance;
      to.covariance[5 * axis + 10] = track.velocity_variance;
      to.covariance[5 * axis + 2] = track.cross_covariance;
      to.covariance[5 * axis + 8] = track.cross_covariance;
    }
  }
}

// ---- observations

template <class Observation, class Clock>
void fill(const host::SensedWorld& sensed, const Clock& clock, Observation& message) {
  message.header.stamp = clock.time(sensed.observation.time);
  message.has_detections = sensed.has_detections;
  for (const Detection& detection : sensed.observation.detections) {
    auto& to = message.detections.emplace_back();
    to.id = detection.id;
    fill(detection.position_world, to.position);
    to.has_velocity = detection.velocity_world.has_value();
    if (detection.velocity_world) fill(*detection.velocity_world, to.velocity);
    to.radius = detection.radius;
    to.position_sigma = detection.position_sigma;
  }
  message.has_scan = sensed.observation.scan.has_value();
  if (!sensed.observation.scan) return;
  fill(*sensed.observation.scan, message.scan);
  message.scan.header.stamp = message.header.stamp;
}

template <class Observation, class Clock>
[[nodiscard]] Converted<host::SensedWorld> read_observation(const Observation& message, const Clock& clock,
                                                            const std::string& frame) {
  using Result = Converted<host::SensedWorld>;
  std::string refusal;
  if (frames_differ(message.header.frame_id, frame, refusal)) return Result::refused(refusal);
  host::SensedWorld sensed;
  sensed.has_detections = message.has_detections;
  sensed.observation.time = clock.seconds(message.header.stamp);
  for (const auto& from : message.detections) {
    Detection detection;
    detection.id = from.id;
    detection.position_world = {from.position.x, from.position.y};
    if (from.has_velocity) detection.velocity_world = Eigen::Vector2d{from.velocity.x, from.velocity.y};
    detection.radius = from.radius;
    detection.position_sigma = from.position_sigma;
    sensed.observation.detections.push_back(detection);
  }
  if (message.has_scan) {
    Converted<RangeScan> scan = read_scan(message.scan);
    if (!scan) return Result::refused("its scan's " + scan.refusal);
    sensed.observation.scan = std::move(*scan.value);
  }
  return {std::move(sensed), {}};
}

// ---- what the wheels are told: rim speeds [m/s], wheel 1 first

template <class WheelSpeeds>
void fill(const DriveInput& wheel_speeds, double limit, WheelSpeeds& message) {
  message.speeds.assign(wheel_speeds.begin(), wheel_speeds.end());
  message.limit = limit;
}

/// Refused unless there is one for each of the drive's `inputs`.
template <class WheelSpeeds>
[[nodiscard]] Converted<DriveInput> read_wheels(const WheelSpeeds& message, int inputs) {
  using Result = Converted<DriveInput>;
  if (message.speeds.size() != static_cast<std::size_t>(inputs))
    return Result::refused("speeds has " + std::to_string(message.speeds.size()) + " entries, not " +
                           std::to_string(inputs));
  const DriveInput speeds = Eigen::Map<const Eigen::VectorXd>(message.speeds.data(), inputs);
  if (!speeds.allFinite()) return Result::refused("a speed is not finite");
  return {speeds, {}};
}

}  // namespace spf::wire
