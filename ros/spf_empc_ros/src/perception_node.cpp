#include "spf_empc_ros/perception_node.hpp"

#include <ros/console.h>
#include <spf_empc_msgs/Observation.h>

#include "host/contradictions.hpp"
#include "spf_empc_ros/conversions.hpp"

namespace spf_empc_ros {
namespace {

const ros::TransportHints kNoDelay = ros::TransportHints().tcpNoDelay();

}  // namespace

PerceptionNode::PerceptionNode(ros::NodeHandle node, const RobotConfig& config, const ros::Time& start)
    : node_{std::move(node)},
      config_{config},
      clock_{start},
      host_{config.agent, config.file.host},
      diagnostics_{node_, config.robot_id, "perception"},
      base_frame_{"robot" + std::to_string(config.robot_id) + "/base_link"} {
  observation_ = node_.advertise<spf_empc_msgs::Observation>("observation", 10);
  subscribers_ = {node_.subscribe("scan", 2, &PerceptionNode::on_scan, this, kNoDelay),
                  node_.subscribe("obstacles", 5, &PerceptionNode::on_obstacles, this, kNoDelay)};
  timer_ = node_.createTimer(ros::Duration{1.0}, [this](const ros::TimerEvent&) { report(); });
}

void PerceptionNode::refuse(const char* what, const std::string& why) {
  ++refused_;
  last_refusal_ = std::string{what} + ": " + why;
  ROS_WARN_THROTTLE(1.0, "%s", last_refusal_.c_str());
}

void PerceptionNode::on_scan(const sensor_msgs::LaserScan::ConstPtr& scan) {
  const Converted<spf::RangeScan> ranges = from_message(*scan);
  if (!ranges) return refuse("scan", ranges.refusal);
  check_sight(ranges->max_range);
  const Converted<spf::Pose2> sensor = frames_.place(scan->header.frame_id, base_frame_, ros::Time{});
  if (!sensor) return refuse("scan", sensor.refusal);
  publish(host_.add_scan(clock_.seconds(scan->header.stamp), *ranges, *sensor, now()), "scan");
}

/// What the file of the robot does not say: how far its scanner reaches. Looked at once.
void PerceptionNode::check_sight(double range) {
  if (sight_checked_) return;
  sight_checked_ = true;
  spf::host::OperatingConditions conditions;
  conditions.sensing_range = range;
  for (const spf::host::Contradiction& found : contradictions(config_.agent, config_.file.host, conditions))
    if (found.key == "sensing.range")
      ROS_WARN("the range of the scanner, %s, %s", found.value.c_str(), found.sentence.c_str());
}

void PerceptionNode::on_obstacles(const spf_empc_msgs::ObstacleTracks::ConstPtr& tracks) {
  const Converted<spf::Pose2> frame =
      frames_.place(tracks->header.frame_id, config_.frame, tracks->header.stamp);
  if (!frame) return refuse("obstacles", frame.refusal);
  const Converted<std::vector<spf::Detection>> seen = from_message(*tracks, *frame);
  if (!seen) return refuse("obstacles", seen.refusal);
  publish(host_.add_detections(clock_.seconds(tracks->header.stamp), *seen, now()), "obstacles");
}

void PerceptionNode::publish(const std::optional<spf::host::SensedWorld>& sensed, const char* what) {
  if (!sensed) return refuse(what, to_string(host_.last_verdict()));
  observation_.publish(to_message(*sensed, clock_, config_.frame));
}

void PerceptionNode::report() {
  const ros::Time time = ros::Time::now();
  const double seconds = clock_.seconds(time);
  const double stale = config_.agent.team.stale_time;
  const spf::host::HostParameters& relied = config_.file.host;
  std::string message = "sensing";
  if (relied.relies_on_obstacles && host_.detections_age(seconds) > stale) message = "no report of obstacles";
  if (relied.relies_on_scan && host_.scan_age(seconds) > stale) message = "no scan";
  Diagnostics::Values values{{"scan age", age_text(host_.scan_age(seconds))},
                             {"obstacles age", age_text(host_.detections_age(seconds))},
                             {"refused", std::to_string(refused_)}};
  if (!last_refusal_.empty()) values.emplace_back("last refusal", last_refusal_);
  diagnostics_.report(time, message == "sensing" ? Health::ok : Health::missing, message, values);
}

}  // namespace spf_empc_ros
