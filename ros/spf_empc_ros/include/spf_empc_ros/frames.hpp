// Poses of frames in each other, from tf. Whoever asks learns how old the answer is: a transform that is
// published no more is not valid for ever.
#pragma once

#include <geometry_msgs/Pose.h>
#include <ros/time.h>
#include <std_msgs/Header.h>
#include <tf2/buffer_core.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/transform_listener.h>

#include <string>

#include "spf_empc_ros/conversions.hpp"

namespace spf_empc_ros {

/// Where a frame is in another.
struct Placement {
  geometry_msgs::Pose pose;
  double age = 0.0;        ///< [s] between the time asked for and the one that it is known of
  bool by_itself = false;  ///< the frames are the same, or their transform never changes
};

/// At a time, or the newest known when that time is not; never waits.
[[nodiscard]] Converted<Placement> placement(const tf2::BufferCore& transforms, const std::string& frame,
                                             const std::string& in, const ros::Time& time);

/// A pose that a transform has moved into another frame.
struct PlacedPose {
  spf::Pose2 pose;
  double age = 0.0;        ///< [s] as of Placement
  bool by_itself = false;  ///< likewise
};
[[nodiscard]] Converted<PlacedPose> placed_pose(const tf2::BufferCore& transforms,
                                                const std_msgs::Header& header,
                                                const geometry_msgs::Pose& pose, const std::string& in);

class Frames {
 public:
  /// Listens to /tf and /tf_static on a thread of its own. A transform that is farther than `oldest` [s] from
  /// the time asked for is refused.
  explicit Frames(double oldest) : oldest_{oldest}, listener_{buffer_} {}

  /// The pose of `frame` in `in`, in space and in the plane.
  [[nodiscard]] Converted<geometry_msgs::Pose> pose_in_space(const std::string& frame, const std::string& in,
                                                             const ros::Time& time) const;
  [[nodiscard]] Converted<spf::Pose2> planar_pose(const std::string& frame, const std::string& in,
                                                  const ros::Time& time) const;
  /// The pose of a message with its header, as one in `in`. Without a stamp it is of now.
  [[nodiscard]] Converted<spf::Pose2> pose(const std_msgs::Header& header, const geometry_msgs::Pose& pose,
                                           const std::string& in) const;
  /// Likewise, however old the transform is: whoever follows odometry has to watch its age.
  [[nodiscard]] Converted<PlacedPose> pose_of_any_age(const std_msgs::Header& header,
                                                      const geometry_msgs::Pose& pose,
                                                      const std::string& in) const {
    return placed_pose(buffer_, header, pose, in);
  }

 private:
  double oldest_;  // [s]
  tf2_ros::Buffer buffer_;
  tf2_ros::TransformListener listener_;
};

}  // namespace spf_empc_ros
