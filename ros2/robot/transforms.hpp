// Poses of frames in each other, kept for a while: what /tf and /tf_static tell.
#pragma once

#include <Eigen/Geometry>

#include <deque>
#include <map>
#include <optional>
#include <ros2_messages/geometry_msgs/TransformStamped.hpp>
#include <string>

#include "ros2/node/time.hpp"
#include "wire/converted.hpp"

namespace spf_ros2 {

/// A frame in another, in space.
struct SpacePose {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< [m]
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
};
[[nodiscard]] SpacePose operator*(const SpacePose& outer, const SpacePose& inner);
[[nodiscard]] SpacePose inverse(const SpacePose& pose);

class Transforms {
 public:
  /// For how long the past is kept [ns].
  static constexpr ros2::Nanoseconds kMemory = 10 * ros2::kSecond;
  /// Frames that are kept in mind; those of more are not heard.
  static constexpr std::size_t kMostFrames = 1000;

  /// False when it is refused: no numbers, no unit quaternion, a frame in itself, or one too many. Another
  /// parent than before, or a stamp that is more than kMemory before the last one, begins anew.
  bool add(const ros2::geometry_msgs::TransformStamped& transform, bool is_static);

  struct Found {
    SpacePose pose;
    ros2::Nanoseconds time = 0;  ///< that it is of
    bool never_changes = false;  ///< all on the way are static
  };
  /// The pose of `frame` in `in` at a time; when that is not known, or none is given, the newest that is.
  [[nodiscard]] spf::wire::Converted<Found> find(const std::string& frame, const std::string& in,
                                                 std::optional<ros2::Nanoseconds> time) const;

 private:
  struct Sample {
    ros2::Nanoseconds time;
    SpacePose pose;
  };
  struct Frame {
    std::string parent;
    bool is_static = false;
    std::deque<Sample> samples;  // by time
  };
  struct Chain;
  [[nodiscard]] Chain chain_of(const std::string& frame) const;

  std::map<std::string, Frame> frames_;
};

}  // namespace spf_ros2
