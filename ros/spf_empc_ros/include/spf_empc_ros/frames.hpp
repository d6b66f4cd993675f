// Places of frames in each other, from tf, in the plane.
#pragma once

#include <geometry_msgs/Pose.h>
#include <ros/time.h>
#include <std_msgs/Header.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/transform_listener.h>

#include <string>

#include "spf_empc_ros/conversions.hpp"

namespace spf_empc_ros {

class Frames {
 public:
  /// Listens to /tf and /tf_static on a thread of its own.
  Frames() : listener_{buffer_} {}

  /// The place of `frame` in `in` at a time, or the newest known when that time is not known yet; never
  /// waits.
  [[nodiscard]] Converted<spf::Pose2> place(const std::string& frame, const std::string& in,
                                            const ros::Time& time) const;

  /// The pose of a message with its header, as one in `in`.
  [[nodiscard]] Converted<spf::Pose2> pose(const std_msgs::Header& header, const geometry_msgs::Pose& pose,
                                           const std::string& in) const;

 private:
  tf2_ros::Buffer buffer_;
  tf2_ros::TransformListener listener_;
};

}  // namespace spf_empc_ros
