#include "spf_empc_ros/perception_node.hpp"

#include <ros/console.h>
#include <spf_empc_msgs/Observation.h>

#include "host/contradictions.hpp"
#include "spf_empc_ros/conversions.hpp"
#include "spf_empc_ros/transport.hpp"

namespace spf_empc_ros {
namespace {

constexpr double kReportPeriod = 0.1;  // [s] what changes is said so soon
}  // namespace

PerceptionNode::PerceptionNode(ros::NodeHandle node, const RobotConfig& config, const ros::Time& start)
    : node_{std::move(node)},
      config_{config},
      clock_{start},
      host_{config.agent, config.file.host},
      frames_{config.agent.team.stale_time},
      diagnostics_{node_, config_, "perception", clock_} {
  observation_ = node_.advertise<spf_empc_msgs::Observation>("observation", 10);
  subscribers_ = {node_.subscribe("scan", 2, &PerceptionNode::on_scan, this, no_delay()),
                  node_.subscribe("obstacles", 5, &PerceptionNode::on_obstacles, this, no_delay()),
                  node_.subscribe("wheel_speeds", 5, &PerceptionNode::on_wheels, this, no_delay())};
  timer_ = node_.createTimer(ros::Duration{kReportPeriod}, [this](const ros::TimerEvent&) { report(); });
}

void PerceptionNode::refuse(const char* what, const std::string& why, bool harmless) {
  refusals_.note(what, why, now(), harmless);
  ROS_WARN_THROTTLE(1.0, "%s", refusals_.last().c_str());
}

void PerceptionNode::on_scan(const sensor_msgs::LaserScan::ConstPtr& scan) {
  const Converted<geometry_msgs::Pose> scanner =
      frames_.pose_in_space(scan->header.frame_id, config_.base_frame, scan->header.stamp);
  if (!scanner) return refuse("scan", scanner.refusal);
  Converted<spf::host::DriverScan> driver = driver_scan(*scan, *scanner);
  if (!driver) return refuse("scan", driver.refusal);
  check_sight(driver->scan.max_range);
  publish(host_.add_scan(clock_.seconds(scan->header.stamp), std::move(*driver.value), now()), "scan");
}

void PerceptionNode::on_wheels(const spf_empc_msgs::WheelSpeeds::ConstPtr& wheels) {
  const Converted<spf::DriveInput> speeds = from_message(*wheels, host_.drive_inputs());
  if (!speeds) return refuse("wheel_speeds", speeds.refusal);
  host_.applied(clock_.seconds(wheels->header.stamp), *speeds);
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
      frames_.planar_pose(tracks->header.frame_id, config_.frame, tracks->header.stamp);
  if (!frame) return refuse("obstacles", frame.refusal);
  const Converted<std::vector<spf::Detection>> seen = from_message(*tracks, *frame);
  if (!seen) return refuse("obstacles", seen.refusal);
  publish(host_.add_detections(clock_.seconds(tracks->header.stamp), *seen, now()), "obstacles");
}

void PerceptionNode::publish(const std::optional<spf::host::SensedWorld>& sensed, const char* what) {
  if (!sensed)
    return refuse(what, host_.last_refusal(), host_.last_verdict() == spf::host::ObservationVerdict::late);
  observation_.publish(to_message(*sensed, clock_, config_.frame));
}

void PerceptionNode::report() {
  const ros::Time time = ros::Time::now();
  const double seconds = clock_.seconds(time);
  spf::host::Health health = host_.health(seconds);
  refusals_.add_to(health, seconds);
  if (!diagnostics_.due(time, health)) return;
  Diagnostics::Values values{{"scan age", age_text(host_.scan_age(seconds))},
                             {"beams without a reading", std::to_string(host_.blind_share())},
                             {"obstacles age", age_text(host_.detections_age(seconds))},
                             {"refused", std::to_string(refusals_.count())}};
  if (!refusals_.last().empty()) values.emplace_back("last refusal", refusals_.last());
  diagnostics_.report(time, health, values);
}

}  // namespace spf_empc_ros
