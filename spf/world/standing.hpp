// What stands: people, things and peers that have not moved for some time. Who plans a path decides
// whether to go round them or to wait, and how near to them to go. Frame: world.
#pragma once

#include <Eigen/Core>

#include <vector>

#include "spf/world/world_snapshot.hpp"

namespace spf {

/// Something that stands, as a way round it is weighed against waiting.
struct StandingDisc {
  Eigen::Vector2d position_world = Eigen::Vector2d::Zero();  ///< [m] centre
  double radius = 0.0;                                       ///< [m]
  double wait = 0.0;  ///< [s] expected until it goes: as long again as it has stood, within bounds
  int id = -1;        ///< of the track or the peer
  bool is_peer = false;
};

inline constexpr std::size_t kMostStanding = 16;  ///< that a guide looks at

/// Fills `discs` with what stands; peers that say that they have arrived at once, others after a while.
/// `discs` is kept for its memory.
void find_standing(const WorldSnapshot& world, std::vector<StandingDisc>& discs);

/// Leaves the nearest kMostStanding.
void keep_nearest(const Eigen::Vector2d& here_world, std::vector<StandingDisc>& discs);

/// Whether a disc is among others, at about the same position.
[[nodiscard]] bool known(const std::vector<StandingDisc>& discs, const StandingDisc& disc);

/// Whether a path would be weighed anew: something came, went, moved, or has stood much longer.
[[nodiscard]] bool differ(const std::vector<StandingDisc>& before, const std::vector<StandingDisc>& now);

}  // namespace spf
