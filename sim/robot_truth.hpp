// Ground truth of one robot. Frame: world.
#pragma once

#include <memory>

#include "sim/body.hpp"
#include "sim/contact.hpp"
#include "spf/math/angles.hpp"
#include "spf/math/pose2.hpp"

namespace spf::sim {

struct RobotTruth {
  Pose2 pose;
  Eigen::Vector2d velocity_world = Eigen::Vector2d::Zero();  ///< [m/s]
  Motion motion;                                             ///< over the last tick
  double radius = 0.3;                                       ///< [m] of its disc, or of the one around it
  std::shared_ptr<const Footprint> outline;                  ///< of a robot with corners, null of a disc
  double heading_from = 0.0;                                 ///< [rad] where its last motion began
  bool arrived = false;                                      ///< has reached the goal that it was told last
  bool wrecked = false;                                      ///< disabled by a contact (AfterContact::wreck)
  bool gone = false;     ///< is not in the scene: has left it, or has not joined yet
  bool broken = false;   ///< stands silent until it is repaired
  bool paused = false;   ///< told to
  bool stopped = false;  ///< emergency stop

  /// Its motion over the last tick, of a robot with corners.
  [[nodiscard]] BodyMotion body() const {
    return {outline.get(), motion, heading_from, angle_difference(pose.heading, heading_from)};
  }
  /// Senses, drives and is present.
  [[nodiscard]] bool active() const { return !wrecked && !gone && !broken; }
};

}  // namespace spf::sim
