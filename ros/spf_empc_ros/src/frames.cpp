#include "spf_empc_ros/frames.hpp"

#include <geometry_msgs/TransformStamped.h>
#include <tf2/exceptions.h>

namespace spf_empc_ros {

Converted<spf::Pose2> Frames::place(const std::string& frame, const std::string& in,
                                    const ros::Time& time) const {
  const std::string from = plain_frame(frame);
  const std::string to = plain_frame(in);
  if (from == to) return {spf::Pose2{}, {}};
  if (from.empty()) return Converted<spf::Pose2>::refused("it has no frame_id");
  try {
    const ros::Time when = buffer_.canTransform(to, from, time) ? time : ros::Time{};
    const geometry_msgs::TransformStamped found = buffer_.lookupTransform(to, from, when);
    geometry_msgs::Pose pose;
    pose.position.x = found.transform.translation.x;
    pose.position.y = found.transform.translation.y;
    pose.orientation = found.transform.rotation;
    return from_message(pose);
  } catch (const tf2::TransformException& error) {
    return Converted<spf::Pose2>::refused(error.what());
  }
}

Converted<spf::Pose2> Frames::pose(const std_msgs::Header& header, const geometry_msgs::Pose& pose,
                                   const std::string& in) const {
  const Converted<spf::Pose2> inner = from_message(pose);
  if (!inner) return inner;
  const Converted<spf::Pose2> outer = place(header.frame_id, in, header.stamp);
  if (!outer) return outer;
  return {compose(*outer, *inner), {}};
}

}  // namespace spf_empc_ros
