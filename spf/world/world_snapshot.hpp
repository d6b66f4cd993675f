// What one robot believes about its surroundings at one instant; the planner's only view of the world.
#pragma once

#include <limits>
#include <vector>

#include "spf/math/angles.hpp"
#include "spf/world/obstacle_track.hpp"
#include "spf/world/occupancy_map.hpp"
#include "spf/world/peer.hpp"

namespace spf {

/// What the robot cannot know, since it does not see that far.
struct Sight {
  double range = std::numeric_limits<double>::infinity();  ///< [m] up to which it sees whatever moves
  double unseen_speed = 0.0;  ///< [m/s] of what may come from beyond; 0 = nothing does
  double reaction = 0.2;      ///< [s] from what is seen to a robot that brakes
  double view_centre = 0.0;   ///< [rad] of what the scanner sees, from the body's x axis
  double view_half = kPi;     ///< [rad] it sees to either side of that; pi: all round
};

/// A view: the agent owns what it points to and keeps it unchanged during planning.
struct WorldSnapshot {
  double time = 0.0;                  ///< [s]
  int robot_id = 0;                   ///< the robot whose belief this is
  const OccupancyMap* map = nullptr;  ///< never null when planning
  const std::vector<ObstacleTrack>* tracks = nullptr;
  const std::vector<Peer>* peers = nullptr;  ///< sorted by robot_id, without the robot itself
  int priority = 0;                          ///< of the robot itself
  Sight sight{};

  [[nodiscard]] Rank rank() const { return {priority, robot_id}; }
};

/// Whether a peer makes way for the robot of a snapshot: it moves, is heard, and does not go first.
[[nodiscard]] inline bool yields(const Peer& peer, const WorldSnapshot& world) {
  return peer.state == PeerState::moving && !peer.expired && !goes_first(peer.rank(), world.rank());
}

}  // namespace spf
