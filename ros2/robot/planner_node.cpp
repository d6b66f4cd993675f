#include "ros2/robot/planner_node.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <utility>

#include "config/parameter_text.hpp"
#include "ros2/robot/pose_input.hpp"
#include "ros2/robot/topics.hpp"
#include "wire/display.hpp"
#include "wire/map.hpp"
#include "wire/sensing.hpp"
#include "wire/trajectory.hpp"

namespace spf_ros2 {
namespace {

using ros2::nav_msgs::OccupancyGrid;
using ros2::nav_msgs::Odometry;
using ros2::spf_empc_msgs::Observation;
using ros2::spf_empc_msgs::ObstacleTracks;
using ros2::spf_empc_msgs::RobotStatus;
using ros2::spf_empc_msgs::Trajectory;
using ros2::spf_empc_msgs::WheelSpeeds;
using ros2::visualization_msgs::MarkerArray;

constexpr double kStepPeriod = 0.01;    // [s] as fast as poses come
constexpr double kPicturePeriod = 0.2;  // [s]
constexpr double kGridPeriod = 1.0;     // [s]
constexpr double kStatusPeriod = 0.5;   // [s] while there is no agent

/// Numbers messages so that a later process begins higher: hundredths of a second of ROS time, on a circle.
std::uint32_t first_sequence(ros2::Nanoseconds start) {
  return static_cast<std::uint32_t>(start / (ros2::kSecond / 100));
}

/// Something that is shown every `period` [s]; also when the clock has jumped back.
bool is_due(double now, double period, double& next) {
  if (now < next && next <= now + period) return false;
  next = now + period;
  return true;
}

}  // namespace

PlannerNode::PlannerNode(ros2::Node& node, const RobotConfig& config, ros2::Nanoseconds start)
    : node_{node},
      config_{config},
      clock_{start},
      host_{config.robot_id, config.agent, config.file.host, first_sequence(start)},
      frames_{node, config.agent.team.stale_time},
      diagnostics_{node, config_, "planner", clock_},
      switches_{node,
                [this](bool paused, bool stop) {
                  host_.planner().set_switches({stop, paused});
                }},
      goals_{node, config, host_, frames_,
             [this](const char* what, const std::string& why) { refuse(what, why); }},
      trajectory_{node.advertise<Trajectory>("trajectory")},
      broadcast_{node.advertise<Trajectory>("/swarm/trajectories", kFleet)},
      status_{node.advertise<RobotStatus>("status")},
      run_time_{node, config.file, [this](const RunTimeSettings& settings) { reconfigure(settings); }} {
  if (!config_.waits_for_map) host_.planner().go_without_map();
  pictures_.path = node.advertise<ros2::nav_msgs::Path>("path", ros2::Qos::keep_last(2));
  pictures_.markers = node.advertise<MarkerArray>("markers", ros2::Qos::keep_last(2));
  pictures_.grid = node.advertise<OccupancyGrid>("grid", kMaps);
  pictures_.tracks = node.advertise<ObstacleTracks>("tracks", ros2::Qos::keep_last(5));
  listen();
  node.every(kStepPeriod, [this] { step(); });
}

void PlannerNode::listen() {
  node_.subscribe<Odometry>("odom", kPoses, [this](const Odometry& odometry) { on_pose(odometry); });
  node_.subscribe<WheelSpeeds>("wheel_speeds", ros2::Qos::keep_last(20),
                               [this](const WheelSpeeds& wheels) { on_wheels(wheels); });
  node_.subscribe<Observation>("observation", ros2::Qos::keep_last(10),
                               [this](const Observation& observation) { on_observation(observation); });
  node_.subscribe<Trajectory>("/swarm/trajectories", kPeers,
                              [this](const Trajectory& message) { on_peer(message); });
  node_.subscribe<OccupancyGrid>("/map", kMaps, [this](const OccupancyGrid& map) { on_map(map); });
  node_.subscribe<ros2::nav2_msgs::SpeedLimit>("speed_limit", ros2::Qos::keep_last(10),
                                               [this](const auto& limit) { on_speed_limit(limit); });
}

void PlannerNode::refuse(const char* what, const std::string& why, bool harmless) {
  refusals_.note(what, why, now(), harmless);
  node_.log().warn_now_and_then(refusals_.last());
}

// ---- in

void PlannerNode::on_pose(const Odometry& odometry) {
  const std::optional<PoseRefusal> refusal =
      take_pose(odometry, frames_, clock_, config_.frame, host_, [this] { return now(); });
  if (refusal) refuse("odom", refusal->why, refusal->harmless);
}

void PlannerNode::on_wheels(const WheelSpeeds& wheels) {
  const Converted<spf::DriveInput> speeds = spf::wire::read_wheels(wheels, host_.drive_inputs());
  const bool usable = speeds && wheels.guard <= WheelSpeeds::STOPS &&
                      host_.add_command(clock_.seconds(wheels.header.stamp), *speeds, now(),
                                        static_cast<spf::host::GuardAction>(wheels.guard));
  if (usable) return;
  host_.planner().count_refused_input();
  refuse("wheel_speeds", speeds ? "not of the present, or out of range" : speeds.refusal);
}

void PlannerNode::on_observation(const Observation& observation) {
  const Converted<spf::host::SensedWorld> sensed =
      spf::wire::read_observation(observation, clock_, config_.frame);
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
void PlannerNode::on_peer(const Trajectory& message) {
  using spf::host::PeerFault;
  const int number = static_cast<int>(std::min<std::uint32_t>(message.robot_id, INT32_MAX));
  const Converted<spf::wire::StampedTrajectory> received =
      spf::wire::read_trajectory(message, clock_, config_.frame);
  if (!received) {
    const bool elsewhere = spf::wire::plain_frame(message.header.frame_id) != config_.frame;
    host_.planner().refuse_message(number, elsewhere ? PeerFault::frame : PeerFault::malformed,
                                   received.refusal, now());
    return refuse("/swarm/trajectories", received.refusal, true);
  }
  const spf::MessageVerdict verdict = host_.add_message(received->message, now());
  if (verdict == spf::MessageVerdict::malformed) refuse("/swarm/trajectories", "out of range", true);
  if (number == config_.robot_id && verdict != spf::MessageVerdict::own)
    host_.planner().complain(number, PeerFault::same_number, "another robot has this number", now());
}

void PlannerNode::on_map(const OccupancyGrid& map) {
  if (!config_.waits_for_map) return;
  if (given_map_ && spf::wire::same_cells(*given_map_, map)) return;  // told again
  Converted<spf::OccupancyMap> known = spf::wire::read_map(map, config_.frame, config_.file.host);
  if (!known) {
    host_.planner().count_refused_input();
    return refuse("/map", known.refusal);
  }
  given_map_ = map;
  pictures_.shown_revision.reset();
  host_.planner().set_map(std::move(*known.value));
}

/// As Nav2's filters tell it: m/s or % of the robot's own, 0 for none. The parameter of that name changes.
void PlannerNode::on_speed_limit(const ros2::nav2_msgs::SpeedLimit& limit) {
  const double own = config_.agent.robot.max_speed;
  if (!(limit.speed_limit >= 0.0)) return refuse("speed_limit", "it is negative or not a number");
  const double wanted = limit.percentage ? 0.01 * limit.speed_limit * own : limit.speed_limit;
  const double limited = wanted == 0.0 ? own : std::min(wanted, own);
  const std::string fault = node_.parameters().set({{"speed_limit", limited}});
  if (!fault.empty()) refuse("speed_limit", fault);
}

void PlannerNode::reconfigure(const RunTimeSettings& settings) {
  const spf::AgentParameters agent = spf::agent_parameters(settings.file);
  host_.planner().reconfigure(agent);
  goals_.reconfigure(agent, settings.file.host);
  switches_.pause_by_parameter(settings.paused);
}

// ---- out

void PlannerNode::step() {
  const auto begun = std::chrono::steady_clock::now();
  const double seconds = now();
  const spf::host::PlannerOutput& output = host_.step(seconds);
  const std::chrono::duration<double> planning = std::chrono::steady_clock::now() - begun;
  goals_.step(seconds);
  if (output.planned) publish_plan(output);
  if (output.planned) next_status_ = seconds;
  if (is_due(seconds, kStatusPeriod, next_status_)) {
    publish_status(output.asked_planner ? 1e3 * planning.count() : 0.0);
    report();
  }
  if (is_due(seconds, kPicturePeriod, pictures_.next)) publish_pictures(seconds);
  if (is_due(seconds, kGridPeriod, pictures_.next_grid)) publish_grid();
}

void PlannerNode::publish_plan(const spf::host::PlannerOutput& output) {
  const std::optional<double> observed =
      std::isfinite(output.observed) ? std::optional<double>{output.observed} : std::nullopt;
  Trajectory plan;
  spf::wire::fill(spf::wire::StampedTrajectory{output.plan, observed}, clock_, config_.frame, plan);
  trajectory_.publish(plan);
  if (pictures_.tracks.subscribers() > 0) {
    ObstacleTracks tracks;
    tracks.header.frame_id = config_.frame;
    spf::wire::fill(host_.planner().agent()->tracks(), clock_, tracks);
    pictures_.tracks.publish(tracks);
  }
  if (!output.broadcast) return;
  Trajectory told;
  spf::wire::fill(spf::wire::StampedTrajectory{*output.broadcast, observed}, clock_, config_.frame, told);
  broadcast_.publish(told);
}

void PlannerNode::publish_status(double plan_ms) {
  const spf::host::PlannerHost& planner = host_.planner();
  const spf::host::PlannerStatus status = planner.status();
  const spf::host::PlannerCounts counts = planner.counts();
  RobotStatus message;
  message.header.stamp = node_.clock().stamp();
  message.header.frame_id = config_.frame;
  message.robot_id = static_cast<std::uint32_t>(config_.robot_id);
  message.state = static_cast<std::uint8_t>(status.state);
  message.reason = status.reason;
  message.blocking_id = status.blocking_id;
  message.has_goal = planner.goal().has_value();
  if (planner.goal()) spf::wire::fill(planner.goal()->position_world, message.goal);
  if (planner.agent() != nullptr) message.outcome = spf::to_string(planner.agent()->last_plan().outcome);
  message.goal_outcome = to_string(goals_.outcome());
  message.max_speed = planner.parameters().robot.max_speed;
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
  const spf::RobotAgent* agent = host_.planner().agent();
  if (agent == nullptr) return;
  if (pictures_.path.subscribers() > 0)
    pictures_.path.publish(
        spf::wire::path_of<ros2::nav_msgs::Path>(agent->committed(), now, clock_, config_.frame));
  if (pictures_.markers.subscribers() > 0)
    pictures_.markers.publish(spf::wire::markers_of<MarkerArray>(
        *agent, host_.localiser().belief().pose_world, now, clock_, config_.frame));
}

/// The map that is planned with, to somebody who looks, when it has changed.
void PlannerNode::publish_grid() {
  const spf::OccupancyMap* map = host_.planner().map();
  if (map == nullptr || pictures_.grid.subscribers() == 0 || pictures_.shown_revision == map->revision())
    return;
  pictures_.shown_revision = map->revision();
  OccupancyGrid grid;
  spf::wire::fill(*map, grid);
  grid.header.frame_id = config_.frame;
  grid.header.stamp = node_.clock().stamp();
  pictures_.grid.publish(grid);
}

void PlannerNode::report() {
  const double seconds = now();
  spf::host::Health health = host_.planner().health(seconds);
  if (given_up(goals_.outcome()) && host_.planner().fault().empty()) {  // on show until there is another goal
    if (health.level == spf::host::Level::ok) health.text.clear();
    worsen(health, spf::host::Level::warn, std::string{"gave up: "} + to_string(goals_.outcome()));
  }
  refusals_.add_to(health, seconds);
  if (diagnostics_.due(health)) diagnostics_.report(health, values(seconds));
}

Diagnostics::Values PlannerNode::values(double now) const {
  const spf::host::PlannerHost& planner = host_.planner();
  const spf::host::Localiser& localiser = host_.localiser();
  const spf::host::PlannerCounts counts = planner.counts();
  Diagnostics::Values values{{"goal", to_string(goals_.outcome())},
                             {"max speed", spf::to_text(planner.parameters().robot.max_speed) + " m/s"},
                             {"plans", std::to_string(counts.plans)},
                             {"inputs refused", std::to_string(counts.inputs_refused)},
                             {"poses refused", std::to_string(localiser.poses_refused())},
                             {"localisation age", age_text(localiser.localisation_age(now))},
                             {"command age", age_text(localiser.command_age(now))},
                             {"messages malformed", std::to_string(counts.messages_malformed)},
                             {"messages of too many peers", std::to_string(counts.messages_crowded)},
                             {"clock jumps", std::to_string(host_.clock_jumps())}};
  if (planner.agent() != nullptr)
    values.emplace_back("tracks", std::to_string(planner.agent()->tracks().size()));
  if (const int id = planner.status().blocking_id; id >= 0)
    values.emplace_back("blocking_id", std::to_string(id));
  if (!refusals_.last().empty()) values.emplace_back("last refusal", refusals_.last());
  return values;
}

}  // namespace spf_ros2
