#include "spf_empc_ros/frames.hpp"

#include <geometry_msgs/TransformStamped.h>
#include <tf2/exceptions.h>

#include <cmath>
#include <cstdio>

namespace spf_empc_ros {
namespace {

std::string too_far(const std::string& frame, const std::string& in, double age) {
  char seconds[32];
  std::snprintf(seconds, sizeof seconds, "%.2f s", age);
  return "the newest transform from '" + plain_frame(frame) + "' to '" + plain_frame(in) + "' is " + seconds +
         " from its stamp";
}

}  // namespace

Converted<Placement> placement(const tf2::BufferCore& transforms, const std::string& frame,
                               const std::string& in, const ros::Time& time) {
  const std::string from = plain_frame(frame);
  const std::string to = plain_frame(in);
  Placement result;
  result.pose.orientation.w = 1.0;
  result.by_itself = from == to;
  if (result.by_itself) return {result, {}};
  if (from.empty()) return Converted<Placement>::refused("it has no frame_id");
  try {
    const bool known = !time.isZero() && transforms.canTransform(to, from, time);
    const geometry_msgs::TransformStamped newest = transforms.lookupTransform(to, from, ros::Time{});
    result.by_itself = newest.header.stamp.isZero();  // all on the way are static
    const geometry_msgs::TransformStamped found = known ? transforms.lookupTransform(to, from, time) : newest;
    if (!known && !result.by_itself && !time.isZero())
      // Not by ros::Duration, which throws where stamps are more than 68 years apart.
      result.age = std::abs(time.toSec() - newest.header.stamp.toSec());
    result.pose.position.x = found.transform.translation.x;
    result.pose.position.y = found.transform.translation.y;
    result.pose.position.z = found.transform.translation.z;
    result.pose.orientation = found.transform.rotation;
    return {result, {}};
  } catch (const tf2::TransformException& error) {
    return Converted<Placement>::refused(error.what());
  }
}

Converted<PlacedPose> placed_pose(const tf2::BufferCore& transforms, const std_msgs::Header& header,
                                  const geometry_msgs::Pose& pose, const std::string& in) {
  using Result = Converted<PlacedPose>;
  const Converted<spf::Pose2> inner = from_message(pose);
  if (!inner) return Result::refused(inner.refusal);
  const Converted<Placement> found = placement(transforms, header.frame_id, in, header.stamp);
  if (!found) return Result::refused(found.refusal);
  const Converted<spf::Pose2> outer = from_message(found->pose);
  if (!outer) return Result::refused(outer.refusal);
  return {PlacedPose{compose(*outer, *inner), found->age, found->by_itself}, {}};
}

Converted<geometry_msgs::Pose> Frames::pose_in_space(const std::string& frame, const std::string& in,
                                                     const ros::Time& time) const {
  using Result = Converted<geometry_msgs::Pose>;
  const Converted<Placement> found = placement(buffer_, frame, in, time);
  if (!found) return Result::refused(found.refusal);
  if (found->age > oldest_) return Result::refused(too_far(frame, in, found->age));
  return {found->pose, {}};
}

Converted<spf::Pose2> Frames::planar_pose(const std::string& frame, const std::string& in,
                                          const ros::Time& time) const {
  const Converted<geometry_msgs::Pose> found = pose_in_space(frame, in, time);
  if (!found) return Converted<spf::Pose2>::refused(found.refusal);
  return from_message(*found);
}

Converted<spf::Pose2> Frames::pose(const std_msgs::Header& header, const geometry_msgs::Pose& pose,
                                   const std::string& in) const {
  std_msgs::Header dated = header;
  if (dated.stamp.isZero()) dated.stamp = ros::Time::now();
  const Converted<PlacedPose> found = placed_pose(buffer_, dated, pose, in);
  if (!found) return Converted<spf::Pose2>::refused(found.refusal);
  if (found->age > oldest_) return Converted<spf::Pose2>::refused(too_far(header.frame_id, in, found->age));
  return {found->pose, {}};
}

}  // namespace spf_empc_ros
