// Planar poses (geometry_msgs/Pose): z, roll and pitch are left out.
#pragma once

#include <Eigen/Geometry>

#include <cmath>

#include "spf/math/angles.hpp"
#include "spf/math/pose2.hpp"
#include "wire/converted.hpp"

namespace spf::wire {

template <class Point>
void fill(const Eigen::Vector2d& position, Point& message) {
  message.x = position.x();
  message.y = position.y();
}

template <class Pose>
[[nodiscard]] Converted<Pose2> read_pose(const Pose& pose) {
  const auto& q = pose.orientation;
  const double norm = std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w);
  if (!(std::isfinite(pose.position.x) && std::isfinite(pose.position.y)))
    return Converted<Pose2>::refused("its position is not finite");
  if (!(norm > 0.9 && norm < 1.1)) return Converted<Pose2>::refused("its orientation is no unit quaternion");
  const double heading =
      std::atan2(2.0 * (q.w * q.z + q.x * q.y), q.w * q.w + q.x * q.x - q.y * q.y - q.z * q.z);
  return {Pose2{{pose.position.x, pose.position.y}, wrap_angle(heading)}, {}};
}

template <class Pose>
void fill(const Pose2& pose, Pose& message) {
  fill(pose.position_world, message.position);
  message.orientation.z = std::sin(0.5 * pose.heading);
  message.orientation.w = std::cos(0.5 * pose.heading);
}

/// A position in `frame`, as one in the frame that `frame` is given in.
[[nodiscard]] inline Eigen::Vector2d moved(const Pose2& frame, const Eigen::Vector2d& position) {
  return frame.position_world + Eigen::Rotation2D<double>{frame.heading} * position;
}

[[nodiscard]] inline Pose2 compose(const Pose2& outer, const Pose2& inner) {
  return {moved(outer, inner.position_world), wrap_angle(outer.heading + inner.heading)};
}

}  // namespace spf::wire
