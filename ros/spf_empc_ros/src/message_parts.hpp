// Parts that several messages share.
#pragma once

#include <Eigen/Core>

#include <string>

#include "spf_empc_ros/conversions.hpp"

namespace spf_empc_ros {

inline geometry_msgs::Point point_of(const Eigen::Vector2d& position) {
  geometry_msgs::Point point;
  point.x = position.x();
  point.y = position.y();
  return point;
}

/// Of two names; then the refusal says so.
inline bool frames_differ(const std::string& is, const std::string& must, std::string& refusal) {
  if (plain_frame(is) == plain_frame(must)) return false;
  refusal = "its frame is '" + is + "', the fleet's is '" + must + "'";
  return true;
}

}  // namespace spf_empc_ros
