// What the robot believes about its surroundings: the map, tracked obstacles and peers, from what it senses
// and hears. Frame: world.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "spf/math/pose2.hpp"
#include "spf/perception/scan_perception.hpp"
#include "spf/team/agent_parameters.hpp"
#include "spf/world/observation.hpp"
#include "spf/world/obstacle_tracker.hpp"
#include "spf/world/occupancy_map.hpp"
#include "spf/world/peer_table.hpp"
#include "spf/world/world_snapshot.hpp"

namespace spf {

/// Ids of tracks that the robot has found in its own scans begin here.
inline constexpr int kScanTrackId = 1'000'000'000;

class Beliefs {
 public:
  /// `map` is the known static map (or an empty one of the right frame when the map is to be sensed).
  Beliefs(int robot_id, const AgentParameters& parameters, const OccupancyMap& map);

  MessageVerdict hear(const HeardMessage& message, double now) { return peer_table_.receive(message, now); }
  /// Takes in an observation, if it tells about the present (`timeliness`). Its scan enters the map where the
  /// robot's pose then is known.
  void observe(const Observation& observation, const std::optional<Pose2>& pose_world, double now);
  /// Another map of what is known; what was sensed is kept.
  void set_map(OccupancyMap map) {
    map.take_over_sensed(map_);
    map_ = std::move(map);
  }
  /// Of the robot, from the next snapshot on.
  void set_priority(int priority) { priority_ = priority; }
  /// Obstacles and peers as believed at a time [s], for the snapshots from now on.
  void refresh(double time);

  /// Peers (sorted) whose discs mask no scan returns. Replaces the ones named before.
  void set_distrusted(std::vector<int> robot_ids) { distrusted_ = std::move(robot_ids); }

  /// Holds until the next call that changes anything.
  [[nodiscard]] WorldSnapshot snapshot(double time) const {
    return {time, robot_id_, &map_, &tracks_, &peers(), priority_, sight_};
  }
  [[nodiscard]] const OccupancyMap& map() const { return map_; }
  [[nodiscard]] const std::vector<ObstacleTrack>& tracks() const { return tracks_; }
  [[nodiscard]] const std::vector<Peer>& peers() const { return peer_table_.last_peers(); }
  [[nodiscard]] std::uint64_t message_count(MessageVerdict verdict) const {
    return peer_table_.count(verdict);
  }

 private:
  void mask_dynamic_returns(double time);
  void bound_sight(const RangeScan& scan);
  void perceive(const Observation& observation, const Pose2& pose_world);
  void hand_over_tracks(double time);

  int robot_id_;
  int priority_;
  double robot_radius_;  // [m]
  double stale_time_;    // [s]
  double sight_range_;   // [m] as set
  Sight sight_;
  OccupancyMap map_;
  ObstacleTracker obstacle_tracker_;
  PerceptionParameters perception_parameters_;
  std::optional<ScanPerception> perception_;  // since the first scan
  Observation perceived_;                     // by it from the scan under way, kept for its memory
  std::vector<int> ended_;                    // likewise
  PeerTable peer_table_;
  std::vector<ObstacleTrack> tracks_;
  std::vector<int> distrusted_;
  std::vector<MaskedDisc> masked_;  // of the observation under way, kept for its memory
};

}  // namespace spf
