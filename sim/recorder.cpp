#include "sim/recorder.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace spf::sim {
namespace {

constexpr double kPlanSampling = 0.1;        // [s]
constexpr double kCandidateSampling = 0.25;  // [s]
constexpr std::size_t kMaxCandidates = 8;    // shown of one plan: the chosen and the cheapest

std::vector<RecordedPoint> sampled(const Trajectory& trajectory, double from, double interval) {
  std::vector<RecordedPoint> points;
  if (trajectory.empty()) return points;
  const double begin = std::max(from, trajectory.start_time());
  const double span = std::max(trajectory.end_time() - begin, 0.0);
  const int steps = static_cast<int>(std::ceil(span / interval));
  for (int i = 0; i <= steps; ++i) {
    const double time = begin + (steps > 0 ? span * i / steps : 0.0);
    points.push_back({time, trajectory.position(time)});
  }
  return points;
}

std::vector<const Candidate*> shown_candidates(const std::vector<Candidate>& all) {
  std::vector<const Candidate*> shown;
  for (const Candidate& candidate : all) shown.push_back(&candidate);
  std::stable_sort(shown.begin(), shown.end(), [](const Candidate* a, const Candidate* b) {
    return a->chosen != b->chosen ? a->chosen : a->cost < b->cost;
  });
  if (shown.size() > kMaxCandidates) shown.resize(kMaxCandidates);
  return shown;
}

void take_nearer(RecordedClearance& clearance, double distance, int other) {
  if (distance < clearance.distance) clearance = {distance, other};
}

void measure_clearances(const TrialFrame& view, std::size_t robot, RecordedRobot& recorded) {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  const Eigen::Vector2d& position = recorded.pose.position_world;
  const RobotTruth& truth = (*view.robots)[robot];
  const double radius = truth.radius;
  recorded.to_dynamic = recorded.to_peer = {kNone, -1};
  for (const DynamicObstacle& obstacle : *view.dynamic_obstacles)
    take_nearer(recorded.to_dynamic,
                (obstacle.motion.at(view.share) - position).norm() - radius - obstacle.radius, obstacle.id);
  for (std::size_t j = 0; j < view.robots->size(); ++j) {
    const RobotTruth& other = (*view.robots)[j];
    if (j != robot)
      take_nearer(recorded.to_peer, (other.pose.position_world - position).norm() - (radius + other.radius),
                  static_cast<int>(j));
  }
  const double to_static = truth.outline ? view.shapes->clearance(truth.body().at(1.0), position, radius)
                                         : view.shapes->clearance(position, radius);
  recorded.to_static = {to_static, -1};
}

std::string reason_text(const AgentStatus& status) {
  std::string text = to_string(status.reason);
  if (status.blocking_id >= 0) text += " " + std::to_string(status.blocking_id);
  return text;
}

}  // namespace

Recorder::Recorder(const Scenario& scenario, const GridFrame& map_frame, const RecordLimit& limit)
    : limit_{limit},
      recording_{std::make_shared<Recording>()},
      last_reason_(scenario.robots.size(), StopCause::none),
      last_revision_(scenario.robots.size(), 0),
      cells_(scenario.robots.size()) {
  recording_->scenario = scenario;
  recording_->map_frame = map_frame;
}

std::shared_ptr<const Recording> Recorder::take_so_far() {
  auto next = std::make_shared<Recording>();
  next->scenario = recording_->scenario;
  next->map_frame = recording_->map_frame;
  return std::exchange(recording_, std::move(next));
}

void Recorder::frame(const TrialFrame& view) {
  const std::size_t records = recording_->frames.size() * view.robots->size();
  full_ = view.time >= limit_.always && records >= limit_.records;
  if (full_) return;
  RecordedFrame frame;
  frame.time = view.time;
  for (std::size_t i = 0; i < view.robots->size(); ++i) {
    const RobotTruth& truth = (*view.robots)[i];
    const RobotAgent& agent = (*view.hosts)[i].agent();
    RecordedRobot robot;
    robot.pose = truth.pose;
    robot.velocity_world = truth.velocity_world;
    robot.estimate = (*view.hosts)[i].localiser().belief();
    robot.wheel_speeds = (*view.wheel_speeds)[i];
    robot.wheel_commands = (*view.wheel_commands)[i];
    robot.status = agent.status();
    robot.wrecked = truth.wrecked;
    robot.broken = truth.broken;
    robot.gone = truth.gone;
    robot.control_us = (*view.control_us)[i];
    measure_clearances(view, i, robot);
    for (const ObstacleTrack& track : agent.tracks()) {
      const double ahead = std::max(view.time - track.time, 0.0);
      ObstacleState state = track.state;
      state.position_world += ahead * state.velocity_world;
      robot.tracks.push_back({track.id, state, track.position_sigma(ahead)});
    }
    note_status(view.time, static_cast<int>(i), robot.status, robot.pose.position_world);
    note_cells(view.time, static_cast<int>(i), agent.map());
    frame.robots.push_back(std::move(robot));
  }
  for (const DynamicObstacle& obstacle : *view.dynamic_obstacles)
    frame.dynamic_obstacles.push_back(
        {obstacle.id,
         obstacle.person,
         {obstacle.motion.at(view.share), obstacle.velocity_world, obstacle.radius}});
  recording_->frames.push_back(std::move(frame));
}

void Recorder::planned(double time, const RobotAgent& agent, double plan_ms) {
  if (full_) return;
  const PlanResult& result = agent.last_plan();
  RecordedPlan plan;
  plan.time = time;
  plan.robot = agent.robot_id();
  plan.outcome = result.outcome;
  plan.risk = result.risk;
  plan.stats = result.stats;
  plan.plan_ms = plan_ms;
  plan.points = sampled(agent.committed(), time, kPlanSampling);
  for (const Candidate* candidate : shown_candidates(result.candidates))
    plan.candidates.push_back({candidate->kind, candidate->cost, candidate->risk, candidate->chosen,
                               sampled(candidate->trajectory, time, kCandidateSampling)});
  recording_->plans.push_back(std::move(plan));
}

void Recorder::stopped(double time, const RobotAgent& agent) {
  if (full_) return;
  RecordedPlan plan;
  plan.time = time;
  plan.robot = agent.robot_id();
  plan.stop = agent.stop_cause();
  plan.points = sampled(agent.committed(), time, kPlanSampling);
  recording_->plans.push_back(std::move(plan));
}

void Recorder::contact(const Contact& contact) {
  note_contact(contact, RecordedEvent::Kind::contact);
}

void Recorder::hit_while_standing(const Contact& contact) {
  note_contact(contact, RecordedEvent::Kind::hit_while_standing);
}

void Recorder::note_contact(const Contact& contact, RecordedEvent::Kind kind) {
  if (full_) return;
  std::string text = enum_name(contact.with);
  if (contact.other >= 0) text += " " + std::to_string(contact.other);
  recording_->events.push_back(
      {contact.time, contact.robot, kind, text, contact.other, contact.position_world});
}

void Recorder::arrived(double time, int robot, const Eigen::Vector2d& position_world) {
  if (full_) return;
  recording_->events.push_back({time, robot, RecordedEvent::Kind::arrival, "arrived", -1, position_world});
}

void Recorder::ordered(double time, const FleetOrder& order, const Eigen::Vector2d& position_world) {
  if (full_) return;
  recording_->events.push_back(
      {time, order.robot, RecordedEvent::Kind::order, enum_name(order.act), -1, position_world});
  if (order.act == FleetAct::goal)
    recording_->goals.push_back({time, order.robot, order.goal});
  else if (order.act == FleetAct::cancel)
    recording_->goals.push_back({time, order.robot, std::nullopt});
}

void Recorder::note_status(double time, int robot, const AgentStatus& status,
                           const Eigen::Vector2d& position_world) {
  StopCause& last = last_reason_[static_cast<std::size_t>(robot)];
  if (status.reason == last) return;
  last = status.reason;
  if (status.reason == StopCause::arrived) return;  // taken from the ground truth: arrival()
  const bool goes = status.reason == StopCause::none;
  recording_->events.push_back({time, robot, goes ? RecordedEvent::Kind::go : RecordedEvent::Kind::stop,
                                reason_text(status), status.blocking_id, position_world});
}

void Recorder::note_cells(double time, int robot, const OccupancyMap& map) {
  const auto index = static_cast<std::size_t>(robot);
  if (recording_->scenario.simulation.sensing.map == MapKnowledge::known) return;
  if (map.revision() == last_revision_[index]) return;
  last_revision_[index] = map.revision();
  RecordedCells update;
  update.time = time;
  update.robot = robot;
  const auto width = static_cast<std::uint64_t>(map.frame().width);
  std::unordered_set<std::uint64_t> occupied;
  for (const Eigen::Vector2d& point : map.occupied_points()) {
    const Eigen::Vector2i node = map.nearest_node(point);
    const std::uint64_t key =
        static_cast<std::uint64_t>(node.y()) * width + static_cast<std::uint64_t>(node.x());
    if (!occupied.insert(key).second) continue;
    if (cells_[index].erase(key) == 0) update.added.push_back(node);
  }
  for (const std::uint64_t key : cells_[index])  // what is left is no longer occupied
    update.removed.emplace_back(static_cast<int>(key % width), static_cast<int>(key / width));
  std::sort(update.removed.begin(), update.removed.end(),
            [](const Eigen::Vector2i& a, const Eigen::Vector2i& b) {
              return a.y() != b.y() ? a.y() < b.y() : a.x() < b.x();
            });
  cells_[index] = std::move(occupied);
  if (!update.added.empty() || !update.removed.empty()) recording_->cells.push_back(std::move(update));
}

}  // namespace spf::sim
