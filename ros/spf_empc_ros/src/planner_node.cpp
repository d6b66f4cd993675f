#include "spf_empc_ros/planner_node.hpp"

#include <nav_msgs/Path.h>
#include <ros/console.h>
#include <spf_empc_msgs/RobotStatus.h>
#include <visualization_msgs/MarkerArray.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "config/parameter_text.hpp"
#include "spf_empc_ros/conversions.hpp"
#include "spf_empc_ros/display.hpp"
#include "spf_empc_ros/transport.hpp"

namespace spf_empc_ros {
namespace {

constexpr double kStepPeriod = 0.01;    // [s] as fast as poses come
constexpr double kPicturePeriod = 0.2;  // [s]
constexpr double kGridPeriod = 1.0;     // [s]
constexpr double kStatusPeriod = 0.5;   // [s] while there is no agent
bool same_cells(const nav_msgs::OccupancyGrid& one, const nav_msgs::OccupancyGrid& other) {
  return one.header.frame_id == other.header.frame_id && one.info.resolution == other.info.resolution &&
         one.info.width == other.info.width && one.info.height == other.info.height &&
         one.info.origin == other.info.origin && one.data == other.data;
}

ros::NodeHandle private_part_of(const ros::NodeHandle& node) {
  ros::NodeHandle own{"~"};
  own.setCallbackQueue(node.getCallbackQueue());
  return own;
}

/// Numbers messages so that a later process begins higher: hundredths of a second of ROS time.
std::uint32_t first_sequence(const ros::Time& start) {
  return start.sec * 100U + start.nsec / 10000000U;
}

}  // namespace

PlannerNode::PlannerNode(ros::NodeHandle node, const RobotConfig& config, const ros::Time& start)
    : node_{std::move(node)},
      config_{config},
      clock_{start},
      host_{config.robot_id, config.agent, config.file.host, first_sequence(start)},
      frames_{config.agent.team.stale_time},
      diagnostics_{node_, config_, "planner", clock_},
      switch_{node_,
              [this](bool paused, bool stop) {
                host_.planner().set_switches({stop, paused});
              }},
      own_{private_part_of(node_)},
      store_{own_},
      goals_{node_,
             own_,
             config,
             host_,
             frames_,
             store_,
             [this](const char* what, const std::string& why) { refuse(what, why); }},
      reconfigure_{own_, config.file, store_,
                   [this](const RunTimeSettings& settings) { reconfigure(settings); },
                   [this](const char* what, const std::string& why) { refuse(what, why); }} {
  if (!config_.waits_for_map) host_.planner().go_without_map();
  trajectory_ = node_.advertise<spf_empc_msgs::Trajectory>("trajectory", 10);
  broadcast_ = node_.advertise<spf_empc_msgs::Trajectory>("/swarm/trajectories", 50);
  status_ = node_.advertise<spf_empc_msgs::RobotStatus>("status", 10);
  pictures_.path = node_.advertise<nav_msgs::Path>("path", 2);
  pictures_.markers = node_.advertise<visualization_msgs::MarkerArray>("markers", 2);
  pictures_.grid = node_.advertise<nav_msgs::OccupancyGrid>("grid", 1, true);
  pictures_.tracks = node_.advertise<spf_empc_msgs::ObstacleTracks>("tracks", 5);
  subscribers_ = {node_.subscribe("odom", 50, &PlannerNode::on_pose, this, no_delay()),
                  node_.subscribe("wheel_speeds", 20, &PlannerNode::on_wheels, this, no_delay()),
                  node_.subscribe("observation", 10, &PlannerNode::on_observation, this, no_delay()),
                  node_.subscribe("/swarm/trajectories", 200, &PlannerNode::on_peer, this, no_delay()),
                  node_.subscribe("/map", 1, &PlannerNode::on_map, this)};
  timer_ = node_.createTimer(ros::Duration{kStepPeriod}, [this](const ros::TimerEvent&) { step(); });
}

void PlannerNode::refuse(const char* what, const std::string& why, bool harmless) {
  refusals_.note(what, why, now(), harmless);
  ROS_WARN_THROTTLE(1.0, "%s", refusals_.last().c_str());
}

// ---- in ---------------------------------------------------------------------------------------------------

void PlannerNode::on_pose(const nav_msgs::Odometry::ConstPtr& odometry) {
  const Converted<PlacedPose> placed =
      frames_.pose_of_any_age(odometry->header, odometry->pose.pose, config_.frame);
  if (!placed) {
    host_.localiser().count_refused_pose();
    return refuse("odom", placed.refusal);
  }
  const double time = clock_.seconds(odometry->header.stamp);
  const spf::host::PoseVerdict verdict = host_.add_pose({time, placed->pose}, now());
  if (!believed(verdict)) return refuse("odom", to_string(verdict), verdict == spf::host::PoseVerdict::late);
  if (!placed->by_itself) host_.localiser().placed_by_transform_of(time - placed->age);
}

void PlannerNode::on_wheels(const spf_empc_msgs::WheelSpeeds::ConstPtr& wheels) {
  const Converted<spf::DriveInput> speeds = from_message(*wheels, host_.drive_inputs());
  const bool usable = speeds && wheels->guard <= spf_empc_msgs::WheelSpeeds::STOPS &&
                      host_.add_command(clock_.seconds(wheels->header.stamp), *speeds, now(),
                                        static_cast<spf::host::GuardAction>(wheels->guard));
  if (usable) return;
  host_.planner().count_refused_input();
  refuse("wheel_speeds", speeds ? "not of the present, or out of range" : speeds.refusal);
}

void PlannerNode::on_observation(const spf_empc_msgs::Observation::ConstPtr& observation) {
  const Converted<spf::host::SensedWorld> sensed = from_message(*observation, clock_, config_.frame);
  if (!sensed) {
    host_.planner().count_refused_input();
    return refuse("observation", sensed.refusal);
  }
  const spf::host::ObservationVerdict verdict = host_.add_observation(*sensed, now());
  if (verdict != spf::host::ObservationVerdict::accepted)
    refuse("observation", to_string(verdict), verdict == spf::host::ObservationVerdict::late);
  if (host_.plan_due(now())) step();  // rather than when the timer comes next
}

/// What is wrong with a peer stands in the diagnostics under its number.
void PlannerNode::on_peer(const ros::MessageEvent<spf_empc_msgs::Trajectory const>& event) {
  using spf::host::PeerFault;
  const spf_empc_msgs::Trajectory& message = *event.getConstMessage();
  const int number = static_cast<int>(std::min<std::uint32_t>(message.robot_id, INT32_MAX));
  const Converted<StampedTrajectory> received = from_message(message, clock_, config_.frame);
  if (!received) {
    const bool elsewhere = plain_frame(message.header.frame_id) != config_.frame;
    host_.planner().refuse_message(number, elsewhere ? PeerFault::frame : PeerFault::malformed,
                                   received.refusal, now());
    return refuse("/swarm/trajectories", received.refusal, true);
  }
  const spf::MessageVerdict verdict = host_.add_message(received->message, now());
  if (verdict == spf::MessageVerdict::malformed) refuse("/swarm/trajectories", "out of range", true);
  if (number == config_.robot_id && verdict != spf::MessageVerdict::own)
    host_.planner().complain(number, PeerFault::same_number,
                             "another robot has this number: " + event.getPublisherName(), now());
}

void PlannerNode::on_map(const nav_msgs::OccupancyGrid::ConstPtr& map) {
  if (!config_.waits_for_map) return;
  if (given_map_ && same_cells(*given_map_, *map)) return;  // told again
  Converted<spf::OccupancyMap> known = from_message(*map, config_.frame, config_.file.host);
  if (!known) {
    host_.planner().count_refused_input();
    return refuse("/map", known.refusal);
  }
  given_map_ = map;
  pictures_.shown_revision.reset();
  host_.planner().set_map(std::move(*known.value));
}

void PlannerNode::reconfigure(const RunTimeSettings& settings) {
  const spf::AgentParameters agent = spf::agent_parameters(settings.file);
  host_.planner().reconfigure(agent);
  goals_.reconfigure(agent, settings.file.host);
  switch_.pause_by_parameter(settings.paused);
}

// ---- out --------------------------------------------------------------------------------------------------

void PlannerNode::step() {
  const ros::WallTime begun = ros::WallTime::now();
  const ros::Time time = ros::Time::now();
  const double seconds = clock_.seconds(time);
  const spf::host::PlannerOutput& output = host_.step(seconds);
  const double plan_ms = 1e3 * (ros::WallTime::now() - begun).toSec();
  goals_.step(seconds);
  if (output.planned) publish_plan(output);
  const bool back = next_status_ > seconds + kStatusPeriod;  // the clock has jumped
  if (output.planned || seconds >= next_status_ || back) {
    next_status_ = seconds + kStatusPeriod;
    publish_status(time, output.asked_planner ? plan_ms : 0.0);
    report(time);
  }
  if (seconds >= pictures_.next || pictures_.next > seconds + kPicturePeriod) {
    pictures_.next = seconds + kPicturePeriod;
    publish_pictures(seconds);
  }
  if (seconds >= pictures_.next_grid || pictures_.next_grid > seconds + kGridPeriod) {
    pictures_.next_grid = seconds + kGridPeriod;
    publish_grid(time);
  }
}

void PlannerNode::publish_plan(const spf::host::PlannerOutput& output) {
  const std::optional<double> observed =
      std::isfinite(output.observed) ? std::optional<double>{output.observed} : std::nullopt;
  trajectory_.publish(to_message(StampedTrajectory{output.plan, observed}, clock_, config_.frame));
  if (pictures_.tracks.getNumSubscribers() > 0)
    pictures_.tracks.publish(to_message(host_.planner().agent()->tracks(), clock_, config_.frame));
  if (output.broadcast)
    broadcast_.publish(to_message(StampedTrajectory{*output.broadcast, observed}, clock_, config_.frame));
}

void PlannerNode::publish_status(const ros::Time& now, double plan_ms) {
  const spf::host::PlannerStatus status = host_.planner().status();
  const spf::host::PlannerCounts counts = host_.planner().counts();
  spf_empc_msgs::RobotStatus message;
  message.header.stamp = now;
  message.header.frame_id = config_.frame;
  message.robot_id = static_cast<std::uint32_t>(config_.robot_id);
  message.state = static_cast<std::uint8_t>(status.state);
  message.reason = status.reason;
  message.blocking_id = status.blocking_id;
  message.has_goal = host_.planner().goal().has_value();
  if (host_.planner().goal()) {
    message.goal.x = host_.planner().goal()->position_world.x();
    message.goal.y = host_.planner().goal()->position_world.y();
  }
  if (host_.planner().agent() != nullptr)
    message.outcome = spf::to_string(host_.planner().agent()->last_plan().outcome);
  message.goal_outcome = to_string(goals_.outcome());
  message.max_speed = host_.planner().parameters().robot.max_speed;
  message.plan_ms = plan_ms;
  message.plans = counts.plans;
  message.messages_accepted = counts.messages_accepted;
  message.messages_malformed = counts.messages_malformed;
  message.messages_old = counts.messages_old;
  message.inputs_refused = counts.inputs_refused + host_.localiser().poses_refused();
  message.clock_jumps = host_.clock_jumps();
  status_.publish(message);
}

void PlannerNode::publish_pictures(double now) {
  if (host_.planner().agent() == nullptr) return;
  if (pictures_.path.getNumSubscribers() > 0)
    pictures_.path.publish(path_message(host_.planner().agent()->committed(), now, clock_, config_.frame));
  if (pictures_.markers.getNumSubscribers() > 0)
    pictures_.markers.publish(marker_message(*host_.planner().agent(), host_.localiser().belief().pose_world,
                                             now, clock_, config_.frame));
}

/// The map that is planned with, to somebody who looks, when it has changed.
void PlannerNode::publish_grid(const ros::Time& now) {
  const spf::OccupancyMap* map = host_.planner().map();
  if (map == nullptr || pictures_.grid.getNumSubscribers() == 0 ||
      pictures_.shown_revision == map->revision())
    return;
  pictures_.shown_revision = map->revision();
  nav_msgs::OccupancyGrid grid = to_message(*map, config_.frame);
  grid.header.stamp = now;
  pictures_.grid.publish(grid);
}

void PlannerNode::report(const ros::Time& now) {
  const double seconds = clock_.seconds(now);
  const spf::host::PlannerHost& planner = host_.planner();
  spf::host::Health health = planner.health(seconds);
  if (given_up(goals_.outcome()) &&
      planner.fault().empty()) {  // that stays on show until there is another goal
    if (health.level == spf::host::Level::ok) health.text.clear();
    worsen(health, spf::host::Level::warn, std::string{"gave up: "} + to_string(goals_.outcome()));
  }
  refusals_.add_to(health, seconds);
  if (!diagnostics_.due(now, health)) return;
  const spf::host::Localiser& localiser = host_.localiser();
  Diagnostics::Values values{
      {"goal", to_string(goals_.outcome())},
      {"max speed", spf::to_text(planner.parameters().robot.max_speed) + " m/s"},
      {"plans", std::to_string(planner.counts().plans)},
      {"inputs refused", std::to_string(planner.counts().inputs_refused)},
      {"poses refused", std::to_string(localiser.poses_refused())},
      {"localisation age", age_text(localiser.localisation_age(seconds))},
      {"command age", age_text(localiser.command_age(seconds))},
      {"messages malformed", std::to_string(planner.counts().messages_malformed)},
      {"messages of too many peers", std::to_string(planner.counts().messages_crowded)},
      {"clock jumps", std::to_string(host_.clock_jumps())}};
  if (planner.agent() != nullptr)
    values.emplace_back("tracks", std::to_string(planner.agent()->tracks().size()));
  const int blocking_id = planner.status().blocking_id;
  if (blocking_id >= 0) values.emplace_back("blocking_id", std::to_string(blocking_id));
  if (!refusals_.last().empty()) values.emplace_back("last refusal", refusals_.last());
  diagnostics_.report(now, health, values);
}

}  // namespace spf_empc_ros
