// A disc with known motion over absolute time: a teammate's broadcast trajectory, or an obstacle that moves
// on at constant velocity or is taken as standing. Shared by the peer cost and the clearance check. Frame:
// world.
#pragma once

#include <Eigen/Core>

#include "spf/trajectory/trajectory.hpp"

namespace spf {

struct MovingDisc {
  int id = -1;
  bool is_peer = false;
  double radius = 0.0;                     ///< [m] distance of the centres at contact
  double speed_bound = 0.0;                ///< [m/s] upper bound of its speed
  const Trajectory* trajectory = nullptr;  ///< the motion; null: a straight line at constant velocity
  double time = 0.0;                       ///< [s] instant of position_world (straight line)
  Eigen::Vector2d position_world = Eigen::Vector2d::Zero();  ///< [m]
  Eigen::Vector2d velocity_world = Eigen::Vector2d::Zero();  ///< [m/s]
};

/// Upper bound of the speed along a trajectory [m/s]: the control polygon of each velocity polynomial, a
/// cheap hull.
[[nodiscard]] double speed_bound(const Trajectory& trajectory);

/// Position and velocity at absolute times; cheap when the times ascend. Keeps a reference to the disc.
class DiscCursor {
 public:
  explicit DiscCursor(const MovingDisc& disc);
  void move_to(double time);
  [[nodiscard]] const Eigen::Vector2d& position() const { return position_; }
  [[nodiscard]] const Eigen::Vector2d& velocity() const { return velocity_; }

 private:
  const MovingDisc& disc_;
  int piece_ = 0;
  double piece_start_ = 0.0;  // [s]
  Eigen::Vector2d position_ = Eigen::Vector2d::Zero();
  Eigen::Vector2d velocity_ = Eigen::Vector2d::Zero();
};

}  // namespace spf
