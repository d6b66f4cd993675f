// A measured pose on its way to planner or tracker, which take it alike.
#pragma once

#include <optional>
#include <ros2_messages/nav_msgs/Odometry.hpp>
#include <string>

#include "host/localiser.hpp"
#include "ros2/robot/clock_edge.hpp"
#include "ros2/robot/frames.hpp"

namespace spf_ros2 {

struct PoseRefusal {
  std::string why;
  bool harmless = false;  ///< it came late, which says nothing against the next
};

/// Hands a pose to `half` of a robot (host::SplitPlanner, SplitTracker), in the fleet's `frame`; why it is
/// refused, if it is. `now` [s] is asked for when it has been placed.
template <class Half, class Now>
std::optional<PoseRefusal> take_pose(const ros2::nav_msgs::Odometry& odometry, const Frames& frames,
                                     const ClockEdge& clock, const std::string& frame, Half& half,
                                     const Now& now) {
  const Converted<PlacedPose> placed = frames.pose_of_any_age(odometry.header, odometry.pose.pose, frame);
  if (!placed) {
    half.localiser().count_refused_pose();
    return PoseRefusal{placed.refusal};
  }
  const double time = clock.seconds(odometry.header.stamp);
  const spf::host::PoseVerdict verdict = half.add_pose({time, placed->pose}, now());
  if (!believed(verdict)) return PoseRefusal{to_string(verdict), verdict == spf::host::PoseVerdict::late};
  if (!placed->by_itself) half.localiser().placed_by_transform_of(time - placed->age);
  return std::nullopt;
}

}  // namespace spf_ros2
