#include "ros2/robot/frames.hpp"

#include <cmath>
#include <cstdio>
#include <ros2_messages/tf2_msgs/TFMessage.hpp>

namespace spf_ros2 {
namespace {

using ros2::geometry_msgs::Pose;
using ros2::std_msgs::Header;
using spf::wire::plain_frame;

/// Where a frame is in another.
struct Placement {
  Pose pose;
  double age = 0.0;  // [s] as of PlacedPose
  bool by_itself = false;
};

Converted<Placement> placement(const Transforms& transforms, const Header& header, const std::string& in) {
  Placement result;
  result.by_itself = plain_frame(header.frame_id) == plain_frame(in);
  if (result.by_itself) return {result, {}};
  if (plain_frame(header.frame_id).empty()) return Converted<Placement>::refused("it has no frame_id");
  const ros2::Nanoseconds time = ros2::nanoseconds_of(header.stamp);
  const auto found = transforms.find(header.frame_id, in, time != 0 ? std::optional{time} : std::nullopt);
  if (!found) return Converted<Placement>::refused(found.refusal);
  result.by_itself = found->never_changes;
  if (!result.by_itself && time != 0) result.age = 1e-9 * std::abs(static_cast<double>(time - found->time));
  result.pose.position.x = found->pose.position.x();
  result.pose.position.y = found->pose.position.y();
  result.pose.position.z = found->pose.position.z();
  result.pose.orientation.x = found->pose.orientation.x();
  result.pose.orientation.y = found->pose.orientation.y();
  result.pose.orientation.z = found->pose.orientation.z();
  result.pose.orientation.w = found->pose.orientation.w();
  return {result, {}};
}

std::string too_far(const std::string& frame, const std::string& in, double age) {
  char seconds[32];
  std::snprintf(seconds, sizeof seconds, "%.2f s", age);
  return "the newest transform from '" + plain_frame(frame) + "' to '" + plain_frame(in) + "' is " + seconds +
         " from its stamp";
}

}  // namespace

Converted<PlacedPose> placed_pose(const Transforms& transforms, const Header& header, const Pose& pose,
                                  const std::string& in) {
  using Result = Converted<PlacedPose>;
  const Converted<spf::Pose2> inner = spf::wire::read_pose(pose);
  if (!inner) return Result::refused(inner.refusal);
  const Converted<Placement> found = placement(transforms, header, in);
  if (!found) return Result::refused(found.refusal);
  const Converted<spf::Pose2> outer = spf::wire::read_pose(found->pose);
  if (!outer) return Result::refused(outer.refusal);
  return {PlacedPose{spf::wire::compose(*outer, *inner), found->age, found->by_itself}, {}};
}

Frames::Frames(ros2::Node& node, double oldest) : node_{node}, oldest_{oldest} {
  const auto hear = [this](bool is_static) {
    return [this, is_static](const ros2::tf2_msgs::TFMessage& message) {
      for (const auto& transform : message.transforms)
        if (!transforms_.add(transform, is_static))
          node_.log().warn_now_and_then("tf: the transform of '" + transform.child_frame_id + "' in '" +
                                        transform.header.frame_id + "' is none");
    };
  };
  node.subscribe<ros2::tf2_msgs::TFMessage>("/tf", ros2::Qos::keep_last(100), hear(false));
  node.subscribe<ros2::tf2_msgs::TFMessage>("/tf_static", ros2::Qos::latched(100), hear(true));
}

Converted<Pose> Frames::pose_in_space(const Header& header, const std::string& in) const {
  const Converted<Placement> found = placement(transforms_, header, in);
  if (!found) return Converted<Pose>::refused(found.refusal);
  if (found->age > oldest_) return Converted<Pose>::refused(too_far(header.frame_id, in, found->age));
  return {found->pose, {}};
}

Converted<spf::Pose2> Frames::planar_pose(const Header& header, const std::string& in) const {
  const Converted<Pose> found = pose_in_space(header, in);
  if (!found) return Converted<spf::Pose2>::refused(found.refusal);
  return spf::wire::read_pose(*found);
}

Converted<spf::Pose2> Frames::pose(const Header& header, const Pose& pose, const std::string& in) const {
  Header dated = header;
  if (ros2::nanoseconds_of(dated.stamp) == 0) dated.stamp = node_.clock().stamp();
  const Converted<PlacedPose> found = placed_pose(transforms_, dated, pose, in);
  if (!found) return Converted<spf::Pose2>::refused(found.refusal);
  if (found->age > oldest_) return Converted<spf::Pose2>::refused(too_far(header.frame_id, in, found->age));
  return {found->pose, {}};
}

}  // namespace spf_ros2
