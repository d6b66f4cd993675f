// Poses of messages in other frames, by tf. Whoever asks learns how old the answer is: a transform that is
// published no more is not valid for ever.
#pragma once

#include <ros2_messages/geometry_msgs/Pose.hpp>
#include <ros2_messages/std_msgs/Header.hpp>
#include <string>

#include "ros2/node/node.hpp"
#include "ros2/robot/transforms.hpp"
#include "wire/pose.hpp"

namespace spf_ros2 {

using spf::wire::Converted;

/// A pose that a transform has moved into another frame.
struct PlacedPose {
  spf::Pose2 pose;
  double age = 0.0;        ///< [s] between the time asked for and the one that the transform is known of
  bool by_itself = false;  ///< the frames are the same, or their transform never changes
};
[[nodiscard]] Converted<PlacedPose> placed_pose(const Transforms& transforms,
                                                const ros2::std_msgs::Header& header,
                                                const ros2::geometry_msgs::Pose& pose, const std::string& in);

class Frames {
 public:
  /// Listens to /tf and /tf_static. A transform that is farther than `oldest` [s] from the time asked for is
  /// refused.
  Frames(ros2::Node& node, double oldest);
  Frames(const Frames&) = delete;
  Frames& operator=(const Frames&) = delete;

  /// The pose of a message's frame in `in`, in space and in the plane.
  [[nodiscard]] Converted<ros2::geometry_msgs::Pose> pose_in_space(const ros2::std_msgs::Header& header,
                                                                   const std::string& in) const;
  [[nodiscard]] Converted<spf::Pose2> planar_pose(const ros2::std_msgs::Header& header,
                                                  const std::string& in) const;
  /// The pose of a message with its header, as one in `in`. Without a stamp it is of now.
  [[nodiscard]] Converted<spf::Pose2> pose(const ros2::std_msgs::Header& header,
                                           const ros2::geometry_msgs::Pose& pose,
                                           const std::string& in) const;
  /// Likewise, however old the transform is: whoever follows odometry has to watch its age.
  [[nodiscard]] Converted<PlacedPose> pose_of_any_age(const ros2::std_msgs::Header& header,
                                                      const ros2::geometry_msgs::Pose& pose,
                                                      const std::string& in) const {
    return placed_pose(transforms_, header, pose, in);
  }

 private:
  ros2::Node& node_;
  double oldest_;  // [s]
  Transforms transforms_;
};

}  // namespace spf_ros2
