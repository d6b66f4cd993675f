#include "sim/sensing.hpp"

#include <algorithm>
#include <cmath>

#include "sim/geometry.hpp"
#include "spf/math/angles.hpp"
#include "spf/math/index.hpp"

namespace spf::sim {
namespace {

constexpr double kSeamDuration = 0.5;  // [s] in which the jump at a seam decays (linearly)

}  // namespace

Sensing::Sensing(const Scenario& scenario)
    : parameters_{scenario.simulation.sensing},
      pose_noise_{scenario.simulation.pose_noise},
      seams_{scenario.seams},
      largest_radius_{scenario.largest_radius()},
      range_sensor_{scenario},
      observations_(scenario.robots.size(), 0) {
  for (std::uint64_t robot = 0; robot < scenario.robots.size(); ++robot) {
    radii_.push_back(scenario.robot_of(robot).radius);
    pose_channels_.push_back({RandomStream{stream_seed(scenario, StreamRole::pose, robot)},
                              RandomStream{stream_seed(scenario, StreamRole::seam, robot)}});
    detection_seeds_.push_back(stream_seed(scenario, StreamRole::detection, robot));
    scan_noise_.emplace_back(stream_seed(scenario, StreamRole::scan, robot));
  }
}

PoseMeasurement Sensing::measure_pose(int robot, double time, const Pose2& true_pose_world) {
  PoseChannel& channel = pose_channels_[static_cast<std::size_t>(robot)];
  PoseMeasurement measurement{time, true_pose_world};
  const Eigen::Vector2d position_noise = channel.noise.normal2();
  const double heading_noise = channel.noise.normal();
  measurement.pose_world.position_world += pose_noise_.position_sigma * position_noise +
                                           seam_offset(channel, time, true_pose_world.position_world);
  measurement.pose_world.heading =
      wrap_angle(true_pose_world.heading + pose_noise_.heading_sigma * heading_noise);
  return measurement;
}

Eigen::Vector2d Sensing::seam_offset(PoseChannel& channel, double time, const Eigen::Vector2d& position) {
  if (seams_.empty()) return Eigen::Vector2d::Zero();
  const auto remaining = [&] {
    const double age = time - channel.jump_time;
    return age < kSeamDuration ? 1.0 - age / kSeamDuration : 0.0;
  };
  const Segment path{channel.started ? channel.last_position : position, position};
  for (const Segment& seam : seams_) {
    if (path.from == path.to || !segments_cross(path, seam)) continue;
    const Eigen::Vector2d left_over = channel.jump * remaining();
    channel.jump = left_over + pose_noise_.seam_sigma * channel.seam_noise.normal2();
    channel.jump_time = time;
  }
  channel.started = true;
  channel.last_position = position;
  return channel.jump * remaining();
}

void Sensing::observe(int robot, const Pose2& true_pose_world, const Surroundings& surroundings,
                      Observation& observation) {
  observation.time = surroundings.time;
  observation.detections.clear();
  const bool scans = parameters_.detections == DetectionQuality::scan;
  const bool scans_needed = scans || parameters_.map == MapKnowledge::sensed;
  const bool broken = surroundings.broken != nullptr && !surroundings.broken->empty();
  if (scans_needed || broken || !surroundings.dynamic_obstacles->empty() ||
      parameters_.peer_detection_range > 0.0)
    gather_bodies(robot, true_pose_world.position_world, surroundings);
  if (!scans) detect_all(robot, true_pose_world.position_world, surroundings, observation);
  if (scans_needed) {
    if (!observation.scan) observation.scan.emplace();
    scan(robot, true_pose_world, *observation.scan);
  } else {
    observation.scan.reset();
  }
  ++observations_[static_cast<std::size_t>(robot)];
}

/// Its noise is drawn from (robot, obstacle, number of the observation) alone, so that it does not depend on
/// what else is or was in range.
Detection Sensing::detect(int robot, int id, const Eigen::Vector2d& position, const Eigen::Vector2d& velocity,
                          double radius) const {
  Detection detection;
  detection.id = id;
  detection.radius = radius;
  detection.position_world = position;
  if (parameters_.detections == DetectionQuality::exact) {
    detection.velocity_world = velocity;
    return detection;
  }
  const auto index = static_cast<std::size_t>(robot);
  RandomStream noise{mix(mix(detection_seeds_[index], static_cast<std::uint64_t>(id)), observations_[index])};
  detection.position_world += parameters_.position_sigma * noise.normal2();
  detection.position_sigma = parameters_.position_sigma;
  return detection;
}

void Sensing::detect_all(int robot, const Eigen::Vector2d& from, const Surroundings& surroundings,
                         Observation& observation) {
  for (const DynamicObstacle& obstacle : *surroundings.dynamic_obstacles) {
    const Eigen::Vector2d position = obstacle.motion.at(surroundings.share);
    if ((position - from).norm() > parameters_.range) continue;
    if (!range_sensor_.sees(from, {position, obstacle.radius}, bodies_)) continue;
    observation.detections.push_back(
        detect(robot, obstacle.id, position, obstacle.velocity_world, obstacle.radius));
  }
  const std::vector<int> none;
  const std::vector<int>& broken = surroundings.broken != nullptr ? *surroundings.broken : none;
  for (const int peer : broken)
    if (peer != robot && ((*surroundings.robots)[as_index(peer)] - from).norm() <= parameters_.range)
      detect_peer(robot, peer, from, surroundings, observation);
  const double reach = parameters_.peer_detection_range;
  if (reach <= 0.0) return;
  const auto first_peer = static_cast<std::ptrdiff_t>(observation.detections.size());
  surroundings.robot_grid->visit(from, reach, [&](int peer) {
    const double gap = ((*surroundings.robots)[as_index(peer)] - from).norm();
    if (peer == robot || gap > reach || std::binary_search(broken.begin(), broken.end(), peer)) return;
    detect_peer(robot, peer, from, surroundings, observation);
  });
  std::sort(observation.detections.begin() + first_peer, observation.detections.end(),
            [](const Detection& a, const Detection& b) { return a.id < b.id; });
}

/// As something of unknown intent.
void Sensing::detect_peer(int robot, int peer, const Eigen::Vector2d& from, const Surroundings& surroundings,
                          Observation& observation) {
  const Eigen::Vector2d& position = (*surroundings.robots)[as_index(peer)];
  const double radius = radii_[as_index(peer)];
  if (!range_sensor_.sees(from, {position, radius}, bodies_)) return;
  Detection detection = detect(robot, kPeerDetectionId + peer, position, Eigen::Vector2d::Zero(), radius);
  detection.velocity_world.reset();  // detected, not broadcast: the tracker has to estimate it
  observation.detections.push_back(detection);
}

/// What moves and stands in the way of sight: nobody sees through bodies.
void Sensing::gather_bodies(int robot, const Eigen::Vector2d& from, const Surroundings& surroundings) {
  bodies_.clear();
  for (const DynamicObstacle& obstacle : *surroundings.dynamic_obstacles)
    bodies_.push_back({obstacle.motion.at(surroundings.share), obstacle.radius});
  if (parameters_.peers_block_beams)
    surroundings.robot_grid->visit(from, parameters_.range + largest_radius_, [&](int peer) {
      const auto index = static_cast<std::size_t>(peer);
      if (peer == robot) return;
      bodies_.push_back({(*surroundings.robots)[index], radii_[index]});
      if (surroundings.bodies == nullptr) return;
      bodies_.back().outline = (*surroundings.bodies)[index].outline.get();
      bodies_.back().heading = (*surroundings.bodies)[index].pose.heading;
    });
}

void Sensing::scan(int robot, const Pose2& true_pose_world, RangeScan& scan) {
  range_sensor_.sweep(true_pose_world, bodies_, scan);
  RandomStream& noise = scan_noise_[static_cast<std::size_t>(robot)];
  if (parameters_.range_sigma <= 0.0) return;
  for (double& range : scan.ranges) {
    const double error = parameters_.range_sigma * noise.normal();  // drawn for every beam, returned or not
    range = std::max(range + error, 1e-3);                          // infinity stays infinity
  }
}

}  // namespace spf::sim
