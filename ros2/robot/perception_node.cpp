#include "ros2/robot/perception_node.hpp"

#include <utility>

#include "host/contradictions.hpp"
#include "ros2/robot/topics.hpp"
#include "wire/sensing.hpp"

namespace spf_ros2 {
namespace {

using ros2::sensor_msgs::LaserScan;
using ros2::spf_empc_msgs::Observation;
using ros2::spf_empc_msgs::ObstacleTracks;
using ros2::spf_empc_msgs::WheelSpeeds;

constexpr double kReportPeriod = 0.1;  // [s] what changes is said so soon

}  // namespace

PerceptionNode::PerceptionNode(ros2::Node& node, const RobotConfig& config, ros2::Nanoseconds start)
    : node_{node},
      config_{config},
      clock_{start},
      host_{config.agent, config.file.host},
      frames_{node, config.agent.team.stale_time},
      diagnostics_{node, config_, "perception", clock_},
      observation_{node.advertise<Observation>("observation")} {
  node.subscribe<LaserScan>("scan", kScans, [this](const LaserScan& scan) { on_scan(scan); });
  node.subscribe<ObstacleTracks>("obstacles", kScans,
                                 [this](const ObstacleTracks& tracks) { on_obstacles(tracks); });
  node.subscribe<WheelSpeeds>("wheel_speeds", ros2::Qos::keep_last(5),
                              [this](const WheelSpeeds& wheels) { on_wheels(wheels); });
  node.every(kReportPeriod, [this] { report(); });
}

void PerceptionNode::refuse(const char* what, const std::string& why, bool harmless) {
  refusals_.note(what, why, now(), harmless);
  node_.log().warn_now_and_then(refusals_.last());
}

void PerceptionNode::on_scan(const LaserScan& scan) {
  const auto scanner = frames_.pose_in_space(scan.header, config_.base_frame);
  if (!scanner) return refuse("scan", scanner.refusal);
  Converted<spf::host::DriverScan> driver = spf::wire::read_driver_scan(scan, *scanner);
  if (!driver) return refuse("scan", driver.refusal);
  check_sight(driver->scan.max_range);
  publish(host_.add_scan(clock_.seconds(scan.header.stamp), std::move(*driver.value), now()), "scan");
}

void PerceptionNode::on_wheels(const WheelSpeeds& wheels) {
  const Converted<spf::DriveInput> speeds = spf::wire::read_wheels(wheels, host_.drive_inputs());
  if (!speeds) return refuse("wheel_speeds", speeds.refusal);
  host_.applied(clock_.seconds(wheels.header.stamp), *speeds);
}

/// What the file of the robot does not say: how far its scanner reaches. Looked at once.
void PerceptionNode::check_sight(double range) {
  if (sight_checked_) return;
  sight_checked_ = true;
  spf::host::OperatingConditions conditions;
  conditions.sensing_range = range;
  for (const spf::host::Contradiction& found : contradictions(config_.agent, config_.file.host, conditions))
    if (found.key == "sensing.range")
      node_.log().warn("the range of the scanner, " + found.value + ", " + found.sentence);
}

void PerceptionNode::on_obstacles(const ObstacleTracks& tracks) {
  const Converted<spf::Pose2> frame = frames_.planar_pose(tracks.header, config_.frame);
  if (!frame) return refuse("obstacles", frame.refusal);
  const Converted<std::vector<spf::Detection>> seen = spf::wire::read_tracks(tracks, *frame);
  if (!seen) return refuse("obstacles", seen.refusal);
  publish(host_.add_detections(clock_.seconds(tracks.header.stamp), *seen, now()), "obstacles");
}

void PerceptionNode::publish(const std::optional<spf::host::SensedWorld>& sensed, const char* what) {
  if (!sensed)
    return refuse(what, host_.last_refusal(), host_.last_verdict() == spf::host::ObservationVerdict::late);
  Observation message;
  spf::wire::fill(*sensed, clock_, message);
  message.header.frame_id = config_.frame;
  observation_.publish(message);
}

void PerceptionNode::report() {
  const double seconds = now();
  spf::host::Health health = host_.health(seconds);
  refusals_.add_to(health, seconds);
  if (!diagnostics_.due(health)) return;
  Diagnostics::Values values{{"scan age", age_text(host_.scan_age(seconds))},
                             {"beams without a reading", std::to_string(host_.blind_share())},
                             {"obstacles age", age_text(host_.detections_age(seconds))},
                             {"refused", std::to_string(refusals_.count())}};
  if (!refusals_.last().empty()) values.emplace_back("last refusal", refusals_.last());
  diagnostics_.report(health, values);
}

}  // namespace spf_ros2
