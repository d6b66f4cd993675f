#include "spf/team/beliefs.hpp"

#include <algorithm>

#include "spf/team/schedule.hpp"

namespace spf {

Beliefs::Beliefs(int robot_id, const AgentParameters& parameters, const OccupancyMap& map)
    : robot_id_{robot_id},
      priority_{parameters.team.priority},
      robot_radius_{parameters.robot.radius},
      stale_time_{parameters.team.stale_time},
      map_{map},
      obstacle_tracker_{parameters.obstacles},
      peer_table_{robot_id, parameters.peers} {}

void Beliefs::observe(const Observation& observation, const std::optional<Pose2>& pose_world, double now) {
  if (timeliness(observation.time, now, stale_time_) != Timeliness::timely) return;
  obstacle_tracker_.update(observation);
  if (!observation.scan || !pose_world) return;
  mask_dynamic_returns(observation.time);
  map_.integrate(*observation.scan, *pose_world, masked_);
}

void Beliefs::mask_dynamic_returns(double time) {
  // Returns from what is tracked or has told its place are not static; a little more than the disc itself,
  // since both places are uncertain.
  const double slack = 0.5 * robot_radius_;
  masked_.clear();
  for (const ObstacleTrack& track : obstacle_tracker_.tracks()) {
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
