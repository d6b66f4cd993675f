#include "spf_empc_ros/conversions.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

#include "host/cell_map.hpp"
#include "message_parts.hpp"
#include "spf/math/angles.hpp"

namespace spf_empc_ros {
namespace {

Eigen::Vector2d moved(const spf::Pose2& frame, const Eigen::Vector2d& position) {
  return frame.position_world + Eigen::Rotation2D<double>{frame.heading} * position;
}

}  // namespace

std::string plain_frame(const std::string& frame) {
  return !frame.empty() && frame.front() == '/' ? frame.substr(1) : frame;
}

// ---- poses ------------------------------------------------------------------------------------------------

Converted<spf::Pose2> from_message(const geometry_msgs::Pose& pose) {
  using Result = Converted<spf::Pose2>;
  const geometry_msgs::Quaternion& q = pose.orientation;
  const double norm = std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w);
  if (!(std::isfinite(pose.position.x) && std::isfinite(pose.position.y)))
    return Result::refused("its position is not finite");
  if (!(norm > 0.9 && norm < 1.1)) return Result::refused("its orientation is no unit quaternion");
  const double heading =
      std::atan2(2.0 * (q.w * q.z + q.x * q.y), q.w * q.w + q.x * q.x - q.y * q.y - q.z * q.z);
  return {spf::Pose2{{pose.position.x, pose.position.y}, spf::wrap_angle(heading)}, {}};
}

geometry_msgs::Pose to_message(const spf::Pose2& pose) {
  geometry_msgs::Pose message;
  message.position = point_of(pose.position_world);
  message.orientation.z = std::sin(0.5 * pose.heading);
  message.orientation.w = std::cos(0.5 * pose.heading);
  return message;
}

spf::Pose2 compose(const spf::Pose2& outer, const spf::Pose2& inner) {
  return {moved(outer, inner.position_world), spf::wrap_angle(outer.heading + inner.heading)};
}

// ---- scans and obstacles ----------------------------------------------------------------------------------

Converted<spf::RangeScan> from_message(const sensor_msgs::LaserScan& scan) {
  using Result = Converted<spf::RangeScan>;
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
  spf::RangeScan result;
  result.angle_min = scan.angle_min;
  result.angle_increment = scan.angle_increment;
  result.max_range = scan.range_max;
  result.ranges.assign(scan.ranges.begin(), scan.ranges.end());
  return {std::move(result), {}};
}

Converted<spf::host::DriverScan> driver_scan(const sensor_msgs::LaserScan& scan,
                                             const geometry_msgs::Pose& scanner_in_body) {
  using Result = Converted<spf::host::DriverScan>;
  Converted<spf::RangeScan> readings = from_message(scan);
  if (!readings) return Result::refused(readings.refusal);
  const geometry_msgs::Point& at = scanner_in_body.position;
  const geometry_msgs::Quaternion& q = scanner_in_body.orientation;
  const std::optional<spf::host::ScannerMount> mount =
      spf::host::planar_mount({at.x, at.y, at.z}, Eigen::Quaterniond{q.w, q.x, q.y, q.z});
  if (!mount) return Result::refused("its scanner is not mounted level: neither upright nor upside down");
  spf::host::DriverScan driver;
  driver.scan = std::move(*readings.value);
  driver.min_range = scan.range_min;
  driver.duration = static_cast<double>(scan.time_increment) * static_cast<double>(scan.ranges.size());
  driver.mount = *mount;
  return {std::move(driver), {}};
}

sensor_msgs::LaserScan to_message(const spf::RangeScan& scan) {
  sensor_msgs::LaserScan message;
  const double beams = static_cast<double>(scan.ranges.size());
  message.angle_min = static_cast<float>(scan.angle_min);
  message.angle_increment = static_cast<float>(scan.angle_increment);
  message.angle_max = static_cast<float>(scan.angle_min + scan.angle_increment * std::max(0.0, beams - 1.0));
  message.range_max = static_cast<float>(scan.max_range);
  for (const double range : scan.ranges) message.ranges.push_back(static_cast<float>(range));
  return message;
}

Converted<std::vector<spf::Detection>> from_message(const spf_empc_msgs::ObstacleTracks& tracks,
                                                    const spf::Pose2& fleet_from_message) {
  using Result = Converted<std::vector<spf::Detection>>;
  std::vector<spf::Detection> detections;
  detections.reserve(tracks.tracks.size());
  for (const spf_empc_msgs::ObstacleTrack& track : tracks.tracks) {
    const auto covariance = [&](int row, int column) {
      return track.covariance[static_cast<std::size_t>(4 * row + column)];
    };
    spf::Detection detection;
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

spf_empc_msgs::ObstacleTracks to_message(const std::vector<spf::ObstacleTrack>& tracks,
                                         const ClockEdge& clock, const std::string& frame) {
  spf_empc_msgs::ObstacleTracks message;
  message.header.frame_id = frame;
  if (!tracks.empty()) message.header.stamp = clock.time(tracks.front().time);
  for (const spf::ObstacleTrack& track : tracks) {
    spf_empc_msgs::ObstacleTrack to;
    to.id = track.id;
    to.position = point_of(track.state.position_world);
    to.velocity.x = track.state.velocity_world.x();
    to.velocity.y = track.state.velocity_world.y();
    to.radius = track.state.radius;
    for (const std::size_t axis : {std::size_t{0}, std::size_t{1}}) {
      to.covariance[5 * axis] = track.position_variance;
      to.covariance[5 * axis + 10] = track.velocity_variance;
      to.covariance[5 * axis + 2] = track.cross_covariance;
      to.covariance[5 * axis + 8] = track.cross_covariance;
    }
    message.tracks.push_back(to);
  }
  return message;
}

spf_empc_msgs::Observation to_message(const spf::host::SensedWorld& sensed, const ClockEdge& clock,
                                      const std::string& frame) {
  spf_empc_msgs::Observation message;
  message.header.stamp = clock.time(sensed.observation.time);
  message.header.frame_id = frame;
  message.has_detections = sensed.has_detections;
  for (const spf::Detection& detection : sensed.observation.detections) {
    spf_empc_msgs::Detection to;
    to.id = detection.id;
    to.position = point_of(detection.position_world);
    to.has_velocity = detection.velocity_world.has_value();
    if (detection.velocity_world) {
      to.velocity.x = detection.velocity_world->x();
      to.velocity.y = detection.velocity_world->y();
    }
    to.radius = detection.radius;
    to.position_sigma = detection.position_sigma;
    message.detections.push_back(to);
  }
  message.has_scan = sensed.observation.scan.has_value();
  if (sensed.observation.scan) {
    message.scan = to_message(*sensed.observation.scan);
    message.scan.header.stamp = message.header.stamp;
  }
  return message;
}

Converted<spf::host::SensedWorld> from_message(const spf_empc_msgs::Observation& message,
                                               const ClockEdge& clock, const std::string& frame) {
  using Result = Converted<spf::host::SensedWorld>;
  std::string refusal;
  if (frames_differ(message.header.frame_id, frame, refusal)) return Result::refused(refusal);
  spf::host::SensedWorld sensed;
  sensed.has_detections = message.has_detections;
  sensed.observation.time = clock.seconds(message.header.stamp);
  for (const spf_empc_msgs::Detection& from : message.detections) {
    spf::Detection detection;
    detection.id = from.id;
    detection.position_world = {from.position.x, from.position.y};
    if (from.has_velocity) detection.velocity_world = Eigen::Vector2d{from.velocity.x, from.velocity.y};
    detection.radius = from.radius;
    detection.position_sigma = from.position_sigma;
    sensed.observation.detections.push_back(detection);
  }
  if (message.has_scan) {
    Converted<spf::RangeScan> scan = from_message(message.scan);
    if (!scan) return Result::refused("its scan's " + scan.refusal);
    sensed.observation.scan = std::move(*scan.value);
  }
  return {std::move(sensed), {}};
}

// ---- maps -------------------------------------------------------------------------------------------------

Converted<spf::OccupancyMap> from_message(const nav_msgs::OccupancyGrid& grid, const std::string& frame,
                                          const spf::host::HostParameters& host) {
  using Result = Converted<spf::OccupancyMap>;
  std::string refusal;
  if (frames_differ(grid.header.frame_id, frame, refusal)) return Result::refused(refusal);
  const Converted<spf::Pose2> origin = from_message(grid.info.origin);
  if (!origin) return Result::refused("its origin: " + origin.refusal);
  const spf::host::CellMap cells{*origin, grid.info.resolution, grid.info.width, grid.info.height,
                                 &grid.data};
  try {
    return {spf::host::map_of_cells(cells, host), {}};
  } catch (const std::exception& error) {
    return Result::refused(error.what());
  }
}

nav_msgs::OccupancyGrid to_message(const spf::OccupancyMap& map, const std::string& frame) {
  const spf::GridFrame& nodes = map.frame();
  nav_msgs::OccupancyGrid grid;
  grid.header.frame_id = frame;
  grid.info.resolution = static_cast<float>(nodes.resolution);
  grid.info.width = static_cast<std::uint32_t>(nodes.width);
  grid.info.height = static_cast<std::uint32_t>(nodes.height);
  // A cell surrounds its node.
  grid.info.origin =
      to_message(spf::Pose2{nodes.origin_world - Eigen::Vector2d::Constant(0.5 * nodes.resolution), 0.0});
  grid.data.reserve(static_cast<std::size_t>(nodes.width) * static_cast<std::size_t>(nodes.height));
  for (int j = 0; j < nodes.height; ++j)
    for (int i = 0; i < nodes.width; ++i)
      grid.data.push_back(map.node_distance(i, j) <= 0.5 * nodes.resolution ? 100 : 0);
  return grid;
}

}  // namespace spf_empc_ros
