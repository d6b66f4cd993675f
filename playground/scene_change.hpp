// One change of a scene, as the page sends and links hold it:
//   {"do": "goal", "robot": 3, "at": [x, y]}      where a robot is to go
//   {"do": "robot", "robot": 3, "at": [x, y]}     where it begins, or is put while the scene runs
//   {"do": "moving", "id": 0, "at": [x, y]}       likewise a moving disc; while it runs a person too
//   {"do": "person", "at": [x, y], "to": [x, y]}  somebody who walks from here to there and back, avoiding
//   what is in the way
//   {"do": "crowd", "people": 10}                 so many of them, drawn by the scenario's seed
//   {"do": "wall", "from": [x, y], "to": [x, y]}
//   {"do": "pillar", "at": [x, y], "radius": r}
//   {"do": "risk", "seconds": s}                  the price of risk: travel time worth one certain contact
//   (space_time)
// Frame: world, SI.
#pragma once

#include <Eigen/Core>

#include <string>
#include <vector>

#include "sim/scenario.hpp"

namespace spf::playground {

struct SceneChange {
  enum class Kind { goal, robot, moving, person, crowd, wall, pillar, risk };
  Kind kind = Kind::goal;
  int index = 0;                                 ///< of the robot or the disc; of a crowd: how many people
  Eigen::Vector2d at = Eigen::Vector2d::Zero();  ///< [m] of a wall: from
  Eigen::Vector2d to = Eigen::Vector2d::Zero();  ///< [m]
  double number = 0.0;                           ///< [m] radius, or [s] price of risk
};

/// A change from its JSON text. Throws std::invalid_argument that names the key, its value and its limit.
[[nodiscard]] SceneChange scene_change(const std::string& text);

/// Applies a change to the beginning of a scene; a price of risk changes nothing there. Throws
/// std::invalid_argument, with all reasons, when the scene cannot be used with it; it is then as before.
void apply(const SceneChange& change, sim::Scenario& scenario);

}  // namespace spf::playground
