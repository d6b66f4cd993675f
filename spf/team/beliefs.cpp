#include "spf/team/beliefs.hpp"

#include <algorithm>
#include <cmath>

#include "spf/math/angles.hpp"
#include "spf/team/schedule.hpp"

namespace spf {

Beliefs::Beliefs(int robot_id, const AgentParameters& parameters, const OccupancyMap& map)
    : robot_id_{robot_id},
      priority_{parameters.team.priority},
      robot_radius_{parameters.robot.radius},
      stale_time_{parameters.team.stale_time},
      sight_range_{parameters.sight.range},
      sight_{parameters.sight.range, parameters.sight.unseen_speed, 2.0 * parameters.team.plan_period},
      map_{map},
      obstacle_tracker_{parameters.obstacles},
      perception_parameters_{parameters.perception},
      peer_table_{robot_id, parameters.peers} {}

void Beliefs::observe(const Observation& observation, const std::optional<Pose2>& pose_world, double now) {
  if (timeliness(observation.time, now, stale_time_) != Timeliness::timely) return;
  obstacle_tracker_.update(observation);
  if (!observation.scan || !pose_world) return;
  mask_dynamic_returns(observation.time);
  if (perception_parameters_.enabled && !perception_parameters_.moving_alone) bound_sight(*observation.scan);
  if (perception_parameters_.enabled)
    perceive(observation, *pose_world);
  else if (perception_parameters_.map_scans)
    map_.integrate(*observation.scan, *pose_world, masked_);
}

/// What scans alone show is seen as far as the sensor reaches and its beams are no farther apart than a pair
/// of legs is wide, and to the sides that it looks to.
void Beliefs::bound_sight(const RangeScan& scan) {
  constexpr double kLegs = 0.2;  // [m]
  const double increment = std::max(std::abs(scan.angle_increment), 1e-9);
  sight_.range = std::min({sight_range_, scan.max_range, kLegs / increment});
  // Beams that are missing at one place, two of them, are no blind side.
  const double beams = static_cast<double>(scan.ranges.size());
  const bool all_round = (beams + 2.0) * increment >= 2.0 * kPi;
  sight_.view_half = all_round ? kPi : 0.5 * (beams - 1.0) * increment;
  sight_.view_centre =
      all_round ? 0.0 : wrap_angle(scan.angle_min + 0.5 * (beams - 1.0) * scan.angle_increment);
}

/// Returns that neither the map, tracks of other detectors nor peers mask are tracked; static ones enter the
/// map.
void Beliefs::perceive(const Observation& observation, const Pose2& pose_world) {
  if (!perception_) perception_.emplace(perception_parameters_);
  SensorSweep sweep;
  sweep.scan = &*observation.scan;
  sweep.time = observation.time;
  sweep.pose_world = pose_world;
  const bool perceived = perception_->update(sweep, map_, masked_);
  if (perceived) hand_over_tracks(observation.time);
  if (perception_parameters_.map_scans)
    map_.integrate(*observation.scan, pose_world, masked_, perceived ? &perception_->kept_out() : nullptr);
}

void Beliefs::hand_over_tracks(double time) {
  perceived_.time = time;
  perception_->detections(time, perceived_.detections);
  for (Detection& detection : perceived_.detections) detection.id += kScanTrackId;
  ended_.assign(perception_->ended().begin(), perception_->ended().end());
  for (int& id : ended_) id += kScanTrackId;
  obstacle_tracker_.update(perceived_);
  obstacle_tracker_.forget(ended_);
}

void Beliefs::mask_dynamic_returns(double time) {
  // Returns from what is tracked or has told its position are not static; a little more than the disc itself,
  // since both positions are uncertain.
  const double slack = 0.5 * robot_radius_;
  masked_.clear();
  for (const ObstacleTrack& track : obstacle_tracker_.tracks()) {
    if (track.id >= kScanTrackId) break;  // sorted; found in scans: must not mask itself
    const Eigen::Vector2d now = track.state.position_world + (time - track.time) * track.state.velocity_world;
    masked_.push_back(
        {now, track.state.radius + slack + 2.0 * track.position_sigma(std::max(0.0, time - track.time))});
  }
  for (const Peer& peer : peers()) {
    if (std::binary_search(distrusted_.begin(), distrusted_.end(), peer.robot_id)) continue;
    masked_.push_back({peer.position(time), peer.radius + peer.growth + slack + 2.0 * peer.position_sigma});
  }
}

void Beliefs::refresh(double time) {
  tracks_ = obstacle_tracker_.tracks();
  static_cast<void>(peer_table_.peers(time));
}

}  // namespace spf
