#include "experiments/replay_export.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <utility>

#include "report/table.hpp"
#include "spf/field/probability_field.hpp"
#include "spf/robot/drive.hpp"
#include "spf/robot/footprint.hpp"

namespace spf {
namespace {

ReplayPoint point(const Eigen::Vector2d& position) {
  return {position.x(), position.y()};
}
ReplayPose pose(const Pose2& pose_world) {
  return {pose_world.position_world.x(), pose_world.position_world.y(), pose_world.heading};
}
/// A measured duration; without a clock it reads 0.
double measured(double duration) {
  return duration > 0.0 ? duration : kUnknown;
}

// ---- the scene
// -----------------------------------------------------------------------------------------------------

ReplayBox bounds_of(const sim::Recording& recording) {
  const sim::Scenario& scenario = recording.scenario;
  if (scenario.border) return {point(scenario.border->low), point(scenario.border->high)};
  if (scenario.map) {
    const host::CellExtent extent = host::extent_of(scenario.map->cells());
    return {point(extent.low_world), point(extent.high_world)};
  }
  Eigen::AlignedBox2d bounds;
  for (const sim::RobotTask& task : scenario.robots) {
    bounds.extend(task.start.position_world).extend(task.goal_world);
    for (const host::Goal& goal : task.next_goals) bounds.extend(goal.position_world);
  }
  for (const sim::RecordedGoal& told : recording.goals)
    if (told.goal) bounds.extend(told.goal->position_world);
  for (const sim::Box& box : scenario.boxes) bounds.extend(box.low).extend(box.high);
  for (const sim::Disc& disc : scenario.discs) bounds.extend(disc.center);
  for (const sim::Polygon& polygon : scenario.polygons)
    for (const Eigen::Vector2d& corner : polygon.corners) bounds.extend(corner);
  for (const sim::Segment& wall : scenario.walls) bounds.extend(wall.from).extend(wall.to);
  for (const sim::PersonTask& person : scenario.people)
    for (const Eigen::Vector2d& waypoint : person.waypoints) bounds.extend(waypoint);
  for (const ObstacleState& disc : scenario.moving) bounds.extend(disc.position_world);
  for (const sim::CrowdSample& sample : scenario.crowd) bounds.extend(sample.position_world);
  const Eigen::Vector2d margin = Eigen::Vector2d::Constant(1.0 + scenario.largest_radius());
  return {point(bounds.min() - margin), point(bounds.max() + margin)};
}

/// A thin wall as small boxes along it, since the page draws boxes alone.
void add_wall(std::vector<ReplayBox>& boxes, const sim::Segment& wall) {
  constexpr double kThickness = 0.03;  // [m] as drawn
  const Eigen::Vector2d span = wall.to - wall.from;
  const bool along_axis = span.x() == 0.0 || span.y() == 0.0;
  const int pieces = along_axis ? 1 : static_cast<int>(std::clamp(std::ceil(span.norm() / 0.1), 1.0, 500.0));
  const Eigen::Vector2d half = Eigen::Vector2d::Constant(0.5 * kThickness);
  for (int i = 0; i < pieces; ++i) {
    const Eigen::Vector2d from = wall.from + span * (static_cast<double>(i) / pieces);
    const Eigen::Vector2d to = wall.from + span * ((i + 1.0) / pieces);
    boxes.push_back({point(from.cwiseMin(to) - half), point(from.cwiseMax(to) + half)});
  }
}

/// The occupied cells, as few rectangles.
void add_map(ReplayData& data, const sim::StaticMap& map) {
  const host::CellMap cells = map.cells();
  const Eigen::Rotation2Dd turn{cells.origin_world.heading};
  const auto corner = [&](std::size_t column, std::size_t row) {
    const Eigen::Vector2d local =
        cells.resolution * Eigen::Vector2d{static_cast<double>(column), static_cast<double>(row)};
    return point(cells.origin_world.position_world + turn * local);
  };
  for (const host::CellBlock& block : host::occupied_blocks(cells))
    data.shapes.blocks.push_back(
        {corner(block.first_column, block.first_row), corner(block.end_column, block.first_row),
         corner(block.end_column, block.end_row), corner(block.first_column, block.end_row)});
}

void describe_scene(ReplayData& data, const sim::Recording& recording) {
  const sim::Scenario& scenario = recording.scenario;
  data.bounds = bounds_of(recording);
  for (const sim::Box& box : scenario.boxes) data.shapes.boxes.push_back({point(box.low), point(box.high)});
  for (const sim::Segment& wall : scenario.walls) add_wall(data.shapes.boxes, wall);
  for (const sim::Disc& disc : scenario.discs) data.shapes.discs.push_back({point(disc.center), disc.radius});
  for (const sim::Polygon& polygon : scenario.polygons) {
    std::vector<ReplayPoint>& corners = data.shapes.polygons.emplace_back();
    for (const Eigen::Vector2d& position : polygon.corners) corners.push_back(point(position));
  }
  if (scenario.map) add_map(data, *scenario.map);
}

// ---- what moves
// ----------------------------------------------------------------------------------------------------

ReplayObstacleFrame obstacle_frame(const ObstacleState& state, const RunConfiguration& config,
                                   double& threshold) {
  const ProbabilityField field{state, config.robot.radius, config.agent.field};
  threshold = field.threshold();
  const FieldEllipse outline = field.ellipse(threshold);
  return {point(state.position_world),
          point(state.velocity_world),
          {point(outline.center_world), outline.half_axes.x(), outline.half_axes.y(), outline.heading}};
}

/// Everybody who is there in any frame; where somebody is not there the position is unknown, hence not drawn.
void describe_dynamic_obstacles(ReplayData& data, const sim::Recording& recording,
                                const RunConfiguration& config) {
  const ReplayObstacleFrame absent{
      {kUnknown, kUnknown}, {kUnknown, kUnknown}, {{kUnknown, kUnknown}, 0.0, 0.0, 0.0}};
  std::map<int, ReplayObstacle> dynamic_obstacles;
  double threshold = data.field_threshold;
  for (std::size_t k = 0; k < recording.frames.size(); ++k)
    for (const sim::RecordedDynamicObstacle& obstacle : recording.frames[k].dynamic_obstacles) {
      ReplayObstacle& shown = dynamic_obstacles[obstacle.id];
      if (shown.frames.empty()) shown.frames.assign(recording.frames.size(), absent);
      shown.id = obstacle.id;
      shown.radius = obstacle.state.radius;
      shown.frames[k] = obstacle_frame(obstacle.state, config, threshold);
    }
  data.field_threshold = threshold;
  for (auto& [id, obstacle] : dynamic_obstacles) data.obstacles.push_back(std::move(obstacle));
}

// ---- robots
// --------------------------------------------------------------------------------------------------------

ReplayStateKind kind_of(const sim::RecordedRobot& robot) {
  if (robot.gone) return ReplayStateKind::arrived;
  if (robot.wrecked || robot.broken) return ReplayStateKind::trouble;
  switch (robot.status.reason) {
    case StopCause::none:
      return robot.status.state == PeerState::braking ? ReplayStateKind::braking : ReplayStateKind::moving;
    case StopCause::arrived:
      return ReplayStateKind::arrived;
    case StopCause::no_goal:
    case StopCause::obstacle_ahead:
    case StopCause::peer_ahead:
    case StopCause::paused:
    case StopCause::in_the_way:
      return ReplayStateKind::waiting;
    default:  // a fault of the planner, or one that its host's watchdog found
      return ReplayStateKind::trouble;
  }
}

std::string state_text(const sim::RecordedRobot& robot) {
  if (robot.gone) return "not in the scene";
  if (robot.wrecked) return "wrecked";
  if (robot.broken) return "broken down";
  std::string text = to_string(robot.status.reason);
  if (robot.status.blocking_id >= 0) text += " " + std::to_string(robot.status.blocking_id);
  if (robot.status.reason != StopCause::none && robot.status.state == PeerState::braking)
    text += " (braking)";
  return text;
}

ReplayClearance clearance(const sim::RecordedClearance& recorded) {
  return {std::isfinite(recorded.distance) ? recorded.distance : kUnknown, recorded.other};
}

ReplayRobotFrame robot_frame(ReplayData& data, const sim::RecordedRobot& robot) {
  ReplayRobotFrame frame;
  frame.state = state_index(data, state_text(robot), kind_of(robot));
  frame.pose = {kUnknown, kUnknown, kUnknown};
  if (robot.gone) return frame;
  frame.pose = pose(robot.pose);
  if (robot.estimate.valid) {
    frame.estimate = pose(robot.estimate.pose_world);
    const double variance = robot.estimate.position_sigma * robot.estimate.position_sigma;
    frame.estimate_covariance = {variance, 0.0, variance};
  }
  for (Eigen::Index wheel = 0; wheel < robot.wheel_speeds.size(); ++wheel)
    frame.wheel_speeds[static_cast<std::size_t>(wheel)] = robot.wheel_speeds[wheel];
  frame.to_obstacle = clearance(robot.to_dynamic);
  frame.to_peer = clearance(robot.to_peer);
  frame.to_static = clearance(robot.to_static);
  frame.control_time = measured(1e-6 * robot.control_us);
  for (const sim::RecordedTrack& track : robot.tracks)
    frame.tracks.push_back(
        {track.id, track.state.position_world.x(), track.state.position_world.y(), track.sigma});
  return frame;
}

std::vector<ReplayTimedPoint> timed_points(const std::vector<sim::RecordedPoint>& points) {
  std::vector<ReplayTimedPoint> timed;
  timed.reserve(points.size());
  for (const sim::RecordedPoint& recorded : points)
    timed.push_back({recorded.time, recorded.position_world.x(), recorded.position_world.y()});
  return timed;
}

const char* label_of(Candidate::Kind kind) {
  switch (kind) {
    case Candidate::Kind::previous:
      return "the plan before";
    case Candidate::Kind::side_a:
      return "this side";
    case Candidate::Kind::side_b:
      return "the other side";
    case Candidate::Kind::primitive:
      return "primitive";
    case Candidate::Kind::optimised:
      return "optimised";
    case Candidate::Kind::brake:
      return "brake";
  }
  return "?";
}

ReplayPlan plan_of(const sim::RecordedPlan& recorded) {
  ReplayPlan plan;
  plan.time = recorded.time;
  plan.points = timed_points(recorded.points);
  plan.outcome = recorded.stop == StopCause::none ? to_string(recorded.outcome) : to_string(recorded.stop);
  plan.planning_time = measured(1e-3 * recorded.plan_ms);
  plan.evaluations = recorded.stats.evaluations + recorded.stats.primitives;
  for (const sim::RecordedCandidate& other : recorded.candidates) {
    ReplayCandidate candidate;
    candidate.label = label_of(other.kind);
    for (const sim::RecordedPoint& sample : other.points)
      candidate.points.push_back(point(sample.position_world));
    candidate.chosen = other.chosen;
    candidate.cost = other.cost;
    candidate.risk = other.risk;
    plan.candidates.push_back(std::move(candidate));
  }
  return plan;
}

ReplayCellUpdate cells_of(const sim::RecordedCells& recorded) {
  ReplayCellUpdate update;
  update.time = recorded.time;
  for (const Eigen::Vector2i& cell : recorded.added) update.added.push_back({cell.x(), cell.y()});
  for (const Eigen::Vector2i& cell : recorded.removed) update.removed.push_back({cell.x(), cell.y()});
  return update;
}

void describe_robots(ReplayData& data, const sim::Recording& recording) {
  const sim::Scenario& scenario = recording.scenario;
  const Eigen::Vector2d half_cell = Eigen::Vector2d::Constant(0.5 * recording.map_frame.resolution);
  for (std::size_t i = 0; i < scenario.robots.size(); ++i) {
    ReplayRobot robot;
    robot.id = static_cast<int>(i);
    const RobotParameters& parameters = scenario.robot_of(i);
    robot.radius = parameters.radius;
    const Footprint outline{parameters};
    for (const Eigen::Vector2d& corner : outline.corners()) robot.corners.push_back(point(corner));
    robot.goal = point(scenario.robots[i].goal_world);
    robot.wheels = static_cast<std::size_t>(Drive{parameters}.rims());
    robot.wheel_speed_limit = parameters.max_wheel_speed;
    robot.sensing_range = scenario.simulation.sensing.range;
    robot.cell_size = recording.map_frame.resolution;
    robot.cell_origin = point(recording.map_frame.origin_world - half_cell);  // a cell is centred on its node
    for (const sim::RecordedFrame& frame : recording.frames)
      robot.frames.push_back(robot_frame(data, frame.robots[i]));
    data.robots.push_back(std::move(robot));
  }
  for (const sim::RecordedPlan& plan : recording.plans)
    data.robots[static_cast<std::size_t>(plan.robot)].plans.push_back(plan_of(plan));
  for (const sim::RecordedGoal& goal : recording.goals)
    data.robots[static_cast<std::size_t>(goal.robot)].goals.push_back(
        {goal.time, goal.goal ? point(goal.goal->position_world) : ReplayPoint{kUnknown, kUnknown}});
  for (const sim::RecordedCells& cells : recording.cells)
    data.robots[static_cast<std::size_t>(cells.robot)].cells.push_back(cells_of(cells));
}

// ---- what happened
// -------------------------------------------------------------------------------------------------

/// What a robot was told, or befell it, as one reads it of the robot.
std::string order_text(const std::string& act) {
  using Act = sim::FleetAct;
  constexpr std::array<std::pair<Act, const char*>, 11> kTexts{{{Act::goal, "has another goal"},
                                                                {Act::cancel, "has no goal any more"},
                                                                {Act::pause, "is told to pause"},
                                                                {Act::resume, "is told to go on"},
                                                                {Act::stop, "emergency stop"},
                                                                {Act::release, "is released from the stop"},
                                                                {Act::break_down, "breaks down"},
                                                                {Act::repair, "is repaired"},
                                                                {Act::leave, "is taken away"},
                                                                {Act::join, "joins"},
                                                                {Act::priority, "has another priority"}}};
  for (const auto& [one, text] : kTexts)
    if (act == enum_name(one)) return text;
  return act;
}

ReplayEvent event_of(const sim::RecordedEvent& recorded) {
  ReplayEvent event;
  event.time = recorded.time;
  event.robot = recorded.robot;
  event.text = recorded.text;
  event.position = point(recorded.position_world);
  switch (recorded.kind) {
    case sim::RecordedEvent::Kind::contact:
      event.kind = ReplayEventKind::contact;
      event.other = recorded.text;
      event.text = "touched " + recorded.text;
      break;
    case sim::RecordedEvent::Kind::hit_while_standing:
      event.kind = ReplayEventKind::note;
      event.text = "was run into while standing, by " + recorded.text;
      break;
    case sim::RecordedEvent::Kind::stop:
      event.kind = ReplayEventKind::stop;
      break;
    case sim::RecordedEvent::Kind::go:
      event.kind = ReplayEventKind::note;
      event.text = "goes on";
      break;
    case sim::RecordedEvent::Kind::order:
      event.kind = ReplayEventKind::note;
      event.text = order_text(recorded.text);
      break;
    case sim::RecordedEvent::Kind::arrival:
      event.kind = ReplayEventKind::arrival;
      event.text = "at its goal";
      break;
  }
  return event;
}

void describe_outcome(ReplayData& data, const TrialRecord& record) {
  const TrialKey& key = record.key;
  data.title = key.family + ", " + key.method + ", trial " + std::to_string(key.trial);
  data.family = key.family;
  data.method = key.method;
  data.noise = key.noise;
  data.tracking = key.tracking;
  data.level = key.level;
  data.seed = key.seed;
  data.trial = key.trial;
  data.outcome = enum_name(record.outcome);
  data.success = record.succeeded();
  int arrived = 0;
  for (const RobotRecord& robot : record.robots) arrived += robot.arrived ? 1 : 0;
  data.summary = {{"robots at goal", std::to_string(arrived) + " of " + std::to_string(record.robots.size())},
                  {"simulated", fixed(record.sim_time, 1) + " s"},
                  {"nearest moving obstacle", fixed(record.dynamic_clearance, 2) + " m clear"},
                  {"planning, median", fixed(1e3 * record.plan_time.percentile(0.5), 3) + " ms"},
                  {"control, median", fixed(1e6 * record.control_time.percentile(0.5), 1) + " us"}};
  if (!record.failure.empty()) data.summary.insert(data.summary.begin(), {"failed", record.failure});
}

}  // namespace

ReplayData replay_data(const RunConfiguration& config, const FinishedTrial& trial) {
  const sim::Recording& recording = *trial.recording;
  ReplayData data;
  data.states.clear();
  data.frame_interval = recording.frame_interval;
  describe_outcome(data, trial.record);
  describe_scene(data, recording);
  describe_dynamic_obstacles(data, recording, config);
  describe_robots(data, recording);
  const double recorded = static_cast<double>(recording.frames.size()) * recording.frame_interval;
  if (trial.record.sim_time > recorded + recording.frame_interval)
    data.summary.insert(data.summary.begin(), {"recorded", "the first " + fixed(recorded, 0) + " s"});
  for (const sim::RecordedEvent& event : recording.events) data.events.push_back(event_of(event));
  std::stable_sort(data.events.begin(), data.events.end(),
                   [](const ReplayEvent& a, const ReplayEvent& b) { return a.time < b.time; });
  return data;
}

}  // namespace spf
