// Ground truth of one robot. Frame: world.
#pragma once

#include "sim/contact.hpp"
#include "spf/math/pose2.hpp"

namespace spf::sim {

struct RobotTruth {
  Pose2 pose;
  Eigen::Vector2d velocity_world = Eigen::Vector2d::Zero();  ///< [m/s]
  Motion motion;                                             ///< over the last tick
  double radius = 0.3;                                       ///< [m]
  bool arrived = false;                                      ///< has reached its goal once
  bool wrecked = false;                                      ///< disabled by a contact (AfterContact::wreck)
  bool gone = false;                                         ///< has left the scene (AfterArrival::leave)

  /// Senses, drives and is present.
  [[nodiscard]] bool active() const { return !wrecked && !gone; }
};

}  // namespace spf::sim
