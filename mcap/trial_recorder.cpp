#include "mcap/trial_recorder.hpp"

#include <nlohmann/json.hpp>
#include <ros2_messages/diagnostic_msgs/DiagnosticArray.hpp>
#include <ros2_messages/geometry_msgs/PoseStamped.hpp>
#include <ros2_messages/nav_msgs/OccupancyGrid.hpp>
#include <ros2_messages/nav_msgs/Path.hpp>
#include <ros2_messages/sensor_msgs/LaserScan.hpp>
#include <ros2_messages/tf2_msgs/TFMessage.hpp>
#include <ros2_messages/visualization_msgs/MarkerArray.hpp>

#include "simulator/scene_shapes.hpp"
#include "simulator/world_messages.hpp"
#include "wire/display.hpp"
#include "wire/map.hpp"

namespace spf::mcap {
namespace {

using Stamp = simulator::Stamp<ros2::builtin_interfaces::Time>;

constexpr double kMapPeriod = 1.0;      // [s] at most so often
constexpr double kHealthPeriod = 0.5;   // [s]
constexpr double kTimeRounding = 1e-9;  // [s]
const std::string kFrame = "map";

std::string robot_topic(int robot, const char* name) {
  return "/" + simulator::robot_name(robot) + "/" + name;
}

ros2::diagnostic_msgs::DiagnosticStatus health_of(const std::string& name, const host::Health& health) {
  using Status = ros2::diagnostic_msgs::DiagnosticStatus;
  Status status;
  status.level = health.level == host::Level::ok     ? Status::OK
                 : health.level == host::Level::warn ? Status::WARN
                                                     : Status::ERROR;
  status.name = name;
  status.message = health.text;
  return status;
}

}  // namespace

TrialRecorder::TrialRecorder(const std::string& path, const sim::Scenario& scenario)
    : scenario_{scenario}, recording_{path}, robots_(scenario.robots.size()) {
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    const sim::RobotTask& task = scenario.robots[i];
    recording_.add(robot_topic(static_cast<int>(i), "goal_pose"), 0.0,
                   simulator::goal_of<ros2::geometry_msgs::PoseStamped>(
                       host::Goal{task.goal_world, task.goal_heading}, task.start.heading,
                       Stamp{kFrame, recording_.clock().time(0.0)}));
  }
}

void TrialRecorder::frame(const sim::TrialFrame& frame) {
  const Stamp stamp{kFrame, recording_.clock().time(frame.time)};
  ros2::tf2_msgs::TFMessage truth;
  truth.transforms = simulator::transforms_of<ros2::geometry_msgs::TransformStamped>(*frame.robots, stamp);
  recording_.add("/tf", frame.time, truth);
  simulator::Scene scene{&scenario_, frame.robots, frame.dynamic_obstacles, frame.share, {}};
  for (const host::RobotHost& host : *frame.hosts) scene.goals.push_back(host.planner().goal());
  ros2::builtin_interfaces::Duration until_gone;
  until_gone.nanosec = 500'000'000;
  recording_.add("/simulator/markers", frame.time,
                 simulator::markers_of<ros2::visualization_msgs::MarkerArray>(
                     simulator::shapes_of(scene), kFrame, stamp.time, until_gone));
  for (std::size_t i = 0; i < robots_.size(); ++i)
    if ((*frame.robots)[i].active())
      add_robot(frame.time, static_cast<int>(i), (*frame.hosts)[i], robots_[i]);
  if (frame.time + kTimeRounding < next_health_) return;
  next_health_ = frame.time + kHealthPeriod;
  add_health(frame);
}

void TrialRecorder::add_robot(double time, int number, const host::RobotHost& host, Robot& robot) {
  const RobotAgent* agent = host.planner().agent();
  if (agent == nullptr) return;
  const Pose2 here = host.localiser().belief().pose_world;
  const RecordClock& clock = recording_.clock();
  ros2::geometry_msgs::PoseStamped pose;
  simulator::put(Stamp{kFrame, clock.time(time)}, pose);
  wire::fill(here, pose.pose);
  recording_.add(robot_topic(number, "pose"), time, pose);
  recording_.add(robot_topic(number, "path"), time,
                 wire::path_of<ros2::nav_msgs::Path>(agent->committed(), time, clock, kFrame));
  recording_.add(robot_topic(number, "markers"), time,
                 wire::markers_of<ros2::visualization_msgs::MarkerArray>(*agent, here, time, clock, kFrame));
  add_map(time, number, agent->map(), robot);
}

void TrialRecorder::add_map(double time, int number, const OccupancyMap& map, Robot& robot) {
  if (robot.map_shown && (map.revision() == robot.map_revision || time + kTimeRounding < robot.next_map))
    return;
  robot = {map.revision(), time + kMapPeriod, true};
  ros2::nav_msgs::OccupancyGrid grid;
  simulator::put(Stamp{kFrame, recording_.clock().time(time)}, grid);
  wire::fill(map, grid);
  recording_.add(robot_topic(number, "grid"), time, grid);
}

void TrialRecorder::add_health(const sim::TrialFrame& frame) {
  ros2::diagnostic_msgs::DiagnosticArray array;
  array.header.stamp = recording_.clock().time(frame.time);
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    if (!(*frame.robots)[i].active()) continue;
    const host::RobotHost& host = (*frame.hosts)[i];
    const std::string name = simulator::robot_name(static_cast<int>(i));
    array.status.push_back(health_of(name + ": planner", host.planner().health(frame.time)));
    array.status.push_back(health_of(name + ": tracker", host.tracker().health()));
  }
  recording_.add("/diagnostics", frame.time, array);
}

void TrialRecorder::thought(double time, int robot, const sim::RobotInput& input, const sim::RobotAction&) {
  for (const host::SensedWorld& seen : input.seen)
    if (seen.observation.scan)
      recording_.add(robot_topic(robot, "scan"), time,
                     simulator::scan_of<ros2::sensor_msgs::LaserScan>(
                         *seen.observation.scan, scenario_.simulation.sensing.rate, robot,
                         recording_.clock().time(seen.observation.time)));
}

void TrialRecorder::planned(double time, const RobotAgent& agent, double plan_ms) {
  const PlanResult& plan = agent.last_plan();
  recording_.add_json(robot_topic(agent.robot_id(), "plan"), "spf.Plan", time,
                      {{"time", time},
                       {"outcome", to_string(plan.outcome)},
                       {"risk", plan.risk},
                       {"plan_ms", plan_ms},
                       {"optimiser_calls", plan.stats.optimiser_calls},
                       {"inner_iterations", plan.stats.inner_iterations},
                       {"evaluations", plan.stats.evaluations},
                       {"primitives", plan.stats.primitives},
                       {"blocking_track", plan.blocking_track},
                       {"blocking_peer", plan.blocking_peer}});
}

void TrialRecorder::controlled(double time, int robot, double control_us) {
  recording_.add_json(robot_topic(robot, "control"), "spf.Control", time,
                      {{"time", time}, {"control_us", control_us}});
}

void TrialRecorder::stopped(double time, const RobotAgent& agent) {
  recording_.add_json(robot_topic(agent.robot_id(), "plan"), "spf.Plan", time,
                      {{"time", time}, {"stop", to_string(agent.stop_cause())}});
}

void TrialRecorder::add_event(double time, int robot, const std::string& kind, const std::string& text) {
  recording_.add_json("/events", "spf.Event", time,
                      {{"time", time}, {"robot", robot}, {"kind", kind}, {"text", text}});
}

void TrialRecorder::contact(const sim::Contact& contact) {
  add_event(contact.time, contact.robot, "contact", simulator::contact_text(contact));
}

void TrialRecorder::hit_while_standing(const sim::Contact& contact) {
  add_event(contact.time, contact.robot, "hit_while_standing", simulator::contact_text(contact));
}

void TrialRecorder::arrived(double time, int robot, const Eigen::Vector2d&) {
  add_event(time, robot, "arrival", "robot " + std::to_string(robot) + " has arrived");
}

void TrialRecorder::ordered(double time, const sim::FleetOrder& order, const Eigen::Vector2d&) {
  add_event(time, order.robot, "order", enum_name(order.act));
  if (order.act != sim::FleetAct::goal) return;
  recording_.add(robot_topic(order.robot, "goal_pose"), time,
                 simulator::goal_of<ros2::geometry_msgs::PoseStamped>(
                     order.goal, 0.0, Stamp{kFrame, recording_.clock().time(time)}));
}

}  // namespace spf::mcap
