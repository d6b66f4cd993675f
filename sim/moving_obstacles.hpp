// The moving discs of a trial (docs/protocol.md): every 0.1 s each draws its noise, moves, and is reflected
// at the border and the static shapes; within a step it moves linearly. They do not react to robots. Frame:
// world.
#pragma once

#include <vector>

#include "sim/outlines.hpp"
#include "sim/scenario.hpp"
#include "spf/math/random_stream.hpp"

namespace spf::sim {

class MovingObstacles {
 public:
  static constexpr double kStep = 0.1;  ///< [s]

  explicit MovingObstacles(const Scenario& scenario);

  /// Draws the next step: where the discs will be kStep after now(). Always two velocity and two position
  /// normals for disc 0, 1, 2, ...
  void advance();

  /// From now on among these static shapes and this border.
  void change_shapes(const Scenario& scenario);
  /// Puts a disc elsewhere [m], where it goes on with its velocity.
  void place(std::size_t index, const Eigen::Vector2d& position);

  /// At the start of the current step. In *white* the velocity is the nominal one.
  [[nodiscard]] const std::vector<ObstacleState>& now() const { return now_; }
  /// At its end.
  [[nodiscard]] const std::vector<ObstacleState>& next() const { return next_; }
  /// Position of disc `index` at a share in [0, 1] of the current step [m].
  [[nodiscard]] Eigen::Vector2d position(std::size_t index, double share) const {
    return now_[index].position_world + share * (next_[index].position_world - now_[index].position_world);
  }
  /// Velocity of the motion within the current step [m/s].
  [[nodiscard]] Eigen::Vector2d velocity(std::size_t index) const {
    return (next_[index].position_world - now_[index].position_world) / kStep;
  }

 private:
  std::optional<Box> border_;
  std::vector<Box> boxes_;
  std::vector<Disc> discs_;
  std::vector<Segment> walls_;
  Outlines outlines_;
  ObstacleNoiseParameters noise_;
  RandomStream random_;
  std::vector<ObstacleState> now_;
  std::vector<ObstacleState> next_;
};

}  // namespace spf::sim
