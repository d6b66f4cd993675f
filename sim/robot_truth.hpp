// Where a robot really is. Frame: world.
#pragma once

#include "sim/contact.hpp"
#include "spf/math/pose2.hpp"

namespace spf::sim {

struct RobotTruth {
  Pose2 pose;
  Eigen::Vector2d velocity_world = Eigen::Vector2d::Zero();  ///< [m/s]
  Motion motion;                                             ///< over the last tick
  bool arrived = false;                                      ///< has been at its goal once
  bool wrecked = false;                                      ///< stands after a contact (AfterContact::wreck)
  bool gone = false;                                         ///< has left the place (AfterArrival::leave)

  /// Senses, drives and is there.
  [[nodiscard]] bool active() const { return !wrecked && !gone; }
};

}  // namespace spf::sim
