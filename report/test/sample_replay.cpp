#include "report/test/sample_replay.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <string>

namespace spf {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kRadius = 0.3;         // [m]
constexpr double kStartDistance = 8.0;  // [m] from the middle
constexpr ReplayBox kBoxA{{-6.0, 2.0}, {-4.4, 3.6}};
constexpr ReplayBox kBoxB{{3.0, -6.5}, {4.5, -5.0}};

/// A repeatable wiggle in [-1, 1] that stands in for noise.
double wiggle(double t, int k) {
  return 0.6 * std::sin(7.3 * t + 1.7 * k) + 0.4 * std::sin(17.9 * t + 0.6 * k);
}

/// Smooth share of the path, 0 at the start and 1 at the end.
double progress(double t, double duration) {
  const double s = std::clamp(t / duration, 0.0, 1.0);
  return s * s * s * (10.0 + s * (6.0 * s - 15.0));
}

struct Course {
  double angle;     // [rad] of the start
  double bulge;     // [m] sideways at half way
  double duration;  // [s]

  [[nodiscard]] ReplayPoint at(double t) const {
    const double along = kStartDistance * (1.0 - 2.0 * progress(t, duration));
    const double aside = bulge * std::sin(kPi * progress(t, duration));
    return {along * std::cos(angle) - aside * std::sin(angle),
            along * std::sin(angle) + aside * std::cos(angle)};
  }
  [[nodiscard]] ReplayPoint velocity(double t) const {
    const ReplayPoint before = at(t - 0.01);
    const ReplayPoint after = at(t + 0.01);
    return {(after.x - before.x) / 0.02, (after.y - before.y) / 0.02};
  }
};

double gap_to_box(const ReplayPoint& p, const ReplayBox& box) {
  const double dx = std::max({box.low.x - p.x, 0.0, p.x - box.high.x});
  const double dy = std::max({box.low.y - p.y, 0.0, p.y - box.high.y});
  return std::hypot(dx, dy);
}

ReplayPoint obstacle_at(double t) {
  return {-7.0 + 0.7 * t, 1.5 + 0.8 * std::sin(0.5 * t)};
}

ReplayObstacle sample_obstacle(std::size_t frames, double interval) {
  ReplayObstacle obstacle;
  obstacle.id = 0;
  obstacle.radius = 0.4;
  for (std::size_t k = 0; k < frames; ++k) {
    const double t = interval * static_cast<double>(k);
    const ReplayPoint velocity{0.7, 0.4 * std::cos(0.5 * t)};
    const ReplayPoint p = obstacle_at(t);
    const double speed = std::hypot(velocity.x, velocity.y);
    const double r = obstacle.radius + kRadius;
    ReplayEllipse field{{p.x + 0.5 * velocity.x, p.y + 0.5 * velocity.y},
                        1.1 * (r + 0.5 * speed),
                        1.1 * r,
                        std::atan2(velocity.y, velocity.x)};
    obstacle.frames.push_back({p, velocity, field});
  }
  return obstacle;
}

ReplayPlan sample_plan(const Course& course, double time, int robot) {
  ReplayPlan plan;
  plan.time = time;
  for (double t = time; t <= time + 4.0; t += 0.1) {
    const ReplayPoint p = course.at(t);
    plan.points.push_back({t, p.x, p.y});
  }
  for (const double side : {1.0, -1.0}) {
    ReplayCandidate candidate;
    candidate.label = side > 0.0 ? "left of obstacle 0" : "right of obstacle 0";
    candidate.chosen = side > 0.0;
    candidate.cost = side > 0.0 ? 41.52 : 58.07 + wiggle(time, robot);
    candidate.risk = side > 0.0 ? 0.012 : 0.094;
    for (double ahead = 0.0; ahead <= 4.0; ahead += 0.1) {
      const ReplayPoint p = course.at(time + ahead);
      const double aside = side > 0.0 ? 0.0 : 1.1 * std::sin(kPi * ahead / 4.0);
      candidate.points.push_back(
          {p.x + aside * std::sin(course.angle), p.y - aside * std::cos(course.angle)});
    }
    plan.candidates.push_back(candidate);
  }
  plan.outcome = "planned";
  plan.planning_time =
      1e-3 * (0.35 + 0.2 * std::abs(wiggle(time, robot)) + (std::fmod(time, 6.0) < 0.6 ? 1.4 : 0.0));
  plan.evaluations = 48 + static_cast<int>(30.0 * std::abs(wiggle(time, robot + 3)));
  return plan;
}

/// Cells of the boxes' edges that have come into the sensing range.
void see(ReplayRobot& robot, std::set<std::pair<int, int>>& seen, double time, const ReplayPoint& from) {
  ReplayCellUpdate update;
  update.time = time;
  for (const ReplayBox& box : {kBoxA, kBoxB}) {
    for (double x = box.low.x; x < box.high.x; x += robot.cell_size) {
      for (double y = box.low.y; y < box.high.y; y += robot.cell_size) {
        const bool is_edge = x < box.low.x + robot.cell_size || x > box.high.x - 1.5 * robot.cell_size ||
                             y < box.low.y + robot.cell_size || y > box.high.y - 1.5 * robot.cell_size;
        if (!is_edge || std::hypot(x - from.x, y - from.y) > robot.sensing_range) continue;
        const int column = static_cast<int>(std::floor((x - robot.cell_origin.x) / robot.cell_size + 1e-6));
        const int row = static_cast<int>(std::floor((y - robot.cell_origin.y) / robot.cell_size + 1e-6));
        if (seen.emplace(column, row).second) update.added.push_back({column, row});
      }
    }
  }
  if (!update.added.empty()) robot.cells.push_back(update);
}

ReplayRobotFrame sample_frame(const Course& course, double t, int index) {
  ReplayRobotFrame frame;
  const ReplayPoint p = course.at(t);
  const ReplayPoint v = course.velocity(t);
  const double heading = 0.4 * std::sin(0.3 * t + index);
  const double yaw_rate = 0.12 * std::cos(0.3 * t + index);
  frame.pose = {p.x, p.y, heading};
  frame.estimate = {p.x + 0.06 * wiggle(t, index), p.y + 0.06 * wiggle(t, index + 5),
                    heading + 0.01 * wiggle(t, index + 9)};
  frame.estimate_covariance = {0.010, 0.003, 0.006};
  for (std::size_t wheel = 0; wheel < 3; ++wheel) {
    const double phi = 2.0 * kPi / 3.0 * static_cast<double>(wheel) + heading;
    frame.wheel_speeds[wheel] =
        v.x * std::sin(phi) - v.y * std::cos(phi) - 0.2 * yaw_rate + 0.02 * wiggle(t, index);
  }
  frame.control_time =
      1e-6 * (2.1 + 0.5 * std::abs(wiggle(t, index + 2)) + (std::fmod(t, 5.0) < 0.1 ? 6.0 : 0.0));
  const ReplayPoint obstacle = obstacle_at(t);
  const double distance = std::hypot(obstacle.x - p.x, obstacle.y - p.y);
  frame.to_obstacle = {distance - kRadius - 0.4, 0};
  frame.to_static = {std::min(gap_to_box(p, kBoxA), gap_to_box(p, kBoxB)) - kRadius, -1};
  if (distance < 8.0)
    frame.tracks.push_back(
        {0, obstacle.x + 0.05 * wiggle(t, 4), obstacle.y + 0.05 * wiggle(t, 6), 0.12 + 0.02 * distance});
  return frame;
}

/// Where a robot comes closest to the obstacle, they are said to touch.
void add_contact(ReplayData& data) {
  const ReplayRobot* robot = nullptr;
  std::size_t frame = 0;
  for (const ReplayRobot& candidate : data.robots) {
    for (std::size_t k = 0; k < candidate.frames.size(); ++k) {
      const bool is_closer = robot == nullptr || candidate.frames[k].to_obstacle.distance <
                                                     robot->frames[frame].to_obstacle.distance;
      if (!is_closer) continue;
      robot = &candidate;
      frame = k;
    }
  }
  if (robot == nullptr) return;
  const ReplayPose& pose = robot->frames[frame].pose;
  const ReplayPoint obstacle = data.obstacles[0].frames[frame].position;
  data.events.push_back({data.frame_interval * static_cast<double>(frame), robot->id,
                         ReplayEventKind::contact, "touched at 0.42 m/s", "obstacle 0",
                         ReplayPoint{0.5 * (pose.x + obstacle.x), 0.5 * (pose.y + obstacle.y)}});
}

}  // namespace

ReplayData sample_replay(const SampleReplayRequest& request) {
  ReplayData data;
  data.title = "Sample <run> & \"replay\"";
  data.family = "sample";
  data.method = "spf_empc";
  data.noise = "walk";
  data.level = 1.0;
  data.tracking = "full";
  data.seed = 20240501;
  data.outcome = "collision";
  data.bounds = {{-11.0, -11.0}, {11.0, 11.0}};
  data.shapes.boxes = {kBoxA, kBoxB};
  data.shapes.discs = {{{6.0, 6.0}, 0.5}, {{-8.0, -7.0}, 0.35}};
  data.shapes.polygons = {{{8.0, -9.0}, {10.0, -9.0}, {9.5, -7.5}}};
  data.shapes.blocks = {{{{-10.0, 8.0}, {-8.0, 8.0}, {-8.0, 8.2}, {-10.0, 8.2}}},
                        {{{-10.0, 8.2}, {-9.8, 8.2}, {-9.8, 10.0}, {-10.0, 10.0}}}};
  const int moving = state_index(data, "moving", ReplayStateKind::moving);
  const int braking = state_index(data, "braking: obstacle 0 ahead in 0.8 s", ReplayStateKind::braking);
  const int waiting = state_index(data, "waiting: no plan past obstacle 0", ReplayStateKind::waiting);
  const int arrived = state_index(data, "arrived", ReplayStateKind::arrived);

  const auto frames = static_cast<std::size_t>(std::lround(request.duration / data.frame_interval)) + 1;
  data.obstacles = {sample_obstacle(frames, data.frame_interval)};
  std::vector<Course> courses;
  for (int i = 0; i < request.robots; ++i) {
    courses.push_back({2.0 * kPi * i / request.robots + 0.25, 1.4 + 0.35 * (i % 4),
                       request.duration * (0.78 + 0.04 * (i % 4))});
  }
  for (int i = 0; i < request.robots; ++i) {
    const Course& course = courses[static_cast<std::size_t>(i)];
    ReplayRobot robot;
    robot.id = i + 1;
    robot.radius = kRadius;
    robot.goal = course.at(request.duration);
    robot.wheel_speed_limit = 1.5;
    robot.sensing_range = 8.0;
    robot.cell_origin = data.bounds.low;
    std::set<std::pair<int, int>> seen;
    for (std::size_t k = 0; k < frames; ++k) {
      const double t = data.frame_interval * static_cast<double>(k);
      ReplayRobotFrame frame = sample_frame(course, t, i);
      for (int j = 0; j < request.robots; ++j) {
        const ReplayPoint peer = courses[static_cast<std::size_t>(j)].at(t);
        const double gap = std::hypot(peer.x - frame.pose.x, peer.y - frame.pose.y) - 2.0 * kRadius;
        if (j != i && !(gap >= frame.to_peer.distance)) frame.to_peer = {gap, j + 1};
      }
      const double share = t / course.duration;
      frame.state = share >= 1.0                                ? arrived
                    : (i == 1 && share > 0.40 && share < 0.44)  ? braking
                    : (i == 1 && share >= 0.44 && share < 0.48) ? waiting
                                                                : moving;
      see(robot, seen, t, {frame.pose.x, frame.pose.y});
      robot.frames.push_back(frame);
    }
    for (double t = 0.0; t < course.duration; t += request.replan_interval)
      robot.plans.push_back(sample_plan(course, t, i));
    data.events.push_back(
        {course.duration, robot.id, ReplayEventKind::arrival, "at the goal", "", robot.goal});
    if (i == 1) {
      data.events.push_back({0.40 * course.duration, robot.id, ReplayEventKind::stop,
                             "braking: obstacle 0 ahead in 0.8 s", "obstacle 0", std::nullopt});
      data.events.push_back(
          {0.44 * course.duration, robot.id, ReplayEventKind::stop,
           "waiting: no plan past obstacle 0 </script><script>document.title='broken'</script>", "obstacle 0",
           std::nullopt});
    }
    data.robots.push_back(std::move(robot));
  }
  add_contact(data);
  std::stable_sort(data.events.begin(), data.events.end(),
                   [](const ReplayEvent& a, const ReplayEvent& b) { return a.time < b.time; });
  data.summary = {
      {"robots arrived", std::to_string(request.robots) + " of " + std::to_string(request.robots)},
      {"path length, mean", "20.9 m"},
      {"travel time, mean", "19.6 s"},
      {"smallest dynamic clearance", "-0.01 m"},
      {"planning, median / p99", "0.41 / 1.95 ms"},
      {"control, median / p99", "2.4 / 8.6 \xC2\xB5s"}};
  return data;
}

}  // namespace spf
