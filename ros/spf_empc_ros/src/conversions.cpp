#include "spf_empc_ros/conversions.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

#include "host/cell_map.hpp"
#include "spf/math/angles.hpp"

namespace spf_empc_ros {
namespace {

using spf::Trajectory;
using spf::TrajectoryMessage;

constexpr std::size_t kCoefficients = 12;  // of a piece: x0..x5, y0..y5

std::string sizes(const char* what, std::size_t is, std::size_t must) {
  return std::string{what} + " has " + std::to_string(is) + " entries, not " + std::to_string(must);
}

/// The parts that must be numbers before anything is made of them.
std::string bad_pieces(const spf_empc_msgs::Trajectory& message) {
  const std::size_t count = message.durations.size();
  if (count == 0) return "durations is empty";
  if (count > static_cast<std::size_t>(Trajectory::kMaxPieces))
    return "durations has " + std::to_string(count) + " entries, more than " +
           std::to_string(Trajectory::kMaxPieces);
  if (message.coefficients.size() != kCoefficients * count)
    return sizes("coefficients", message.coefficients.size(), kCoefficients * count);
  for (const double duration : message.durations)
    if (!(std::isfinite(duration) && duration > 0.0)) return "a duration is not above 0";
  for (const double coefficient : message.coefficients)
    if (!std::isfinite(coefficient)) return "a coefficient is not finite";
  return {};
}

Trajectory trajectory_of(const spf_empc_msgs::Trajectory& message, const ClockEdge& clock) {
  Trajectory trajectory{clock.seconds(message.start)};
  for (std::size_t i = 0; i < message.durations.size(); ++i) {
    spf::QuinticPiece piece;
    piece.duration = message.durations[i];
    for (std::size_t k = 0; k < kCoefficients; ++k)
      piece.coefficients(static_cast<Eigen::Index>(k % 6), static_cast<Eigen::Index>(k / 6)) =
          message.coefficients[kCoefficients * i + k];
    trajectory.append(piece);
  }
  return trajectory;
}

std::optional<spf::HeadingProfile> heading_of(const spf_empc_msgs::Trajectory& message,
                                              const ClockEdge& clock) {
  spf::HeadingPhases phases;
  phases.start_time = clock.seconds(message.heading_start);
  phases.initial_heading = message.heading_initial;
  phases.target_heading = message.heading_target;
  phases.initial_rate = message.yaw_rate_initial;
  phases.cruise_rate = message.yaw_rate_cruise;
  phases.ramp_in = message.heading_phases[0];
  phases.cruise = message.heading_phases[1];
  phases.ramp_out = message.heading_phases[2];
  return spf::HeadingProfile::from_phases(phases);
}

void fill_heading(const spf::HeadingPhases& phases, const ClockEdge& clock,
                  spf_empc_msgs::Trajectory& message) {
  message.heading_start = clock.time(phases.start_time);
  message.heading_initial = phases.initial_heading;
  message.heading_target = phases.target_heading;
  message.yaw_rate_initial = phases.initial_rate;
  message.yaw_rate_cruise = phases.cruise_rate;
  message.heading_phases[0] = phases.ramp_in;
  message.heading_phases[1] = phases.cruise;
  message.heading_phases[2] = phases.ramp_out;
}

geometry_msgs::Point point_of(const Eigen::Vector2d& position) {
  geometry_msgs::Point point;
  point.x = position.x();
  point.y = position.y();
  return point;
}

void fill_claim(const std::optional<spf::PassageClaim>& claim, const ClockEdge& clock,
                spf_empc_msgs::Trajectory& message) {
  message.claimed = claim ? 1 : 0;
  if (!claim) return;
  message.claim_inside = claim->inside ? 1 : 0;
  message.claim_waits = claim->waits ? 1 : 0;
  message.claim_since = clock.time(claim->since);
  message.claim_entry = point_of(claim->entry_world);
  message.claim_exit = point_of(claim->exit_world);
}

std::optional<spf::PassageClaim> claim_of(const spf_empc_msgs::Trajectory& message, const ClockEdge& clock) {
  if (message.claimed == 0) return std::nullopt;
  const auto position = [](const geometry_msgs::Point& point) { return Eigen::Vector2d{point.x, point.y}; };
  return spf::PassageClaim{position(message.claim_entry), position(message.claim_exit),
                           clock.seconds(message.claim_since), message.claim_inside != 0,
                           message.claim_waits != 0};
}

Eigen::Vector2d moved(const spf::Pose2& frame, const Eigen::Vector2d& position) {
  return frame.position_world + Eigen::Rotation2D<double>{frame.heading} * position;
}

bool frames_differ(const std::string& is, const std::string& must, std::string& refusal) {
  if (plain_frame(is) == plain_frame(must)) return false;
  refusal = "its frame is '" + is + "', the fleet's is '" + must + "'";
  return true;
}

}  // namespace

std::string plain_frame(const std::string& frame) {
  return !frame.empty() && frame.front() == '/' ? frame.substr(1) : frame;
}

// ---- trajectories -----------------------------------------------------------------------------------------

spf_empc_msgs::Trajectory to_message(const StampedTrajectory& stamped, const ClockEdge& clock,
                                     const std::string& frame) {
  const TrajectoryMessage& from = stamped.message;
  spf_empc_msgs::Trajectory message;
  message.header.stamp = clock.time(from.sent_time);
  message.header.frame_id = frame;
  message.robot_id = static_cast<std::uint32_t>(from.robot_id);
  message.sequence = from.sequence;
  message.priority = static_cast<std::uint32_t>(from.priority);
  message.state = static_cast<std::uint8_t>(from.state);
  message.expiry = clock.time(from.expiry_time);
  message.radius = from.radius;
  message.position_sigma = from.position_sigma;
  fill_claim(from.claim, clock, message);
  if (stamped.observed) message.observed = clock.time(*stamped.observed);
  message.start = clock.time(from.trajectory.start_time());
  for (int i = 0; i < from.trajectory.piece_count(); ++i) {
    const spf::QuinticPiece& piece = from.trajectory.piece(i);
    message.durations.push_back(piece.duration);
    for (const double coefficient : piece.coefficients.reshaped())
      message.coefficients.push_back(coefficient);
  }
  fill_heading(from.trajectory.heading().phases(), clock, message);
  return message;
}

Converted<StampedTrajectory> from_message(const spf_empc_msgs::Trajectory& message, const ClockEdge& clock,
                                          const std::string& frame) {
  using Result = Converted<StampedTrajectory>;
  std::string refusal;
  if (frames_differ(message.header.frame_id, frame, refusal)) return Result::refused(refusal);
  if (message.robot_id > static_cast<std::uint32_t>(std::numeric_limits<int>::max()))
    return Result::refused("robot_id is too large");
  if (message.priority > static_cast<std::uint32_t>(std::numeric_limits<int>::max()))
    return Result::refused("priority is too large");
  if (message.state > spf_empc_msgs::Trajectory::ARRIVED)
    return Result::refused("state is none that is known");
  if (!(message.radius > 0.0 && std::isfinite(message.radius)))
    return Result::refused("radius is not above 0");
  if (!(message.position_sigma >= 0.0 && std::isfinite(message.position_sigma)))
    return Result::refused("position_sigma is negative or not finite");
  const std::optional<spf::PassageClaim> claim = claim_of(message, clock);
  if (claim && !spf::believable(*claim)) return Result::refused("its claim to a passage is not finite");
  if (std::string why = bad_pieces(message); !why.empty()) return Result::refused(std::move(why));
  const std::optional<spf::HeadingProfile> heading = heading_of(message, clock);
  if (!heading) return Result::refused("its heading does not turn to its target");

  StampedTrajectory stamped;
  TrajectoryMessage& to = stamped.message;
  to.robot_id = static_cast<int>(message.robot_id);
  to.priority = static_cast<int>(message.priority);
  to.sequence = message.sequence;
  to.sent_time = clock.seconds(message.header.stamp);
  to.expiry_time = clock.seconds(message.expiry);
  to.radius = message.radius;
  to.position_sigma = message.position_sigma;
  to.claim = claim;
  to.state = static_cast<spf::PeerState>(message.state);
  to.trajectory = trajectory_of(message, clock);
  to.trajectory.set_heading(*heading);
  if (!message.observed.isZero()) stamped.observed = clock.seconds(message.observed);
  return {stamped, {}};
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
