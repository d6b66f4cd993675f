#include "report/replay_json.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>

#include <nlohmann/json.hpp>

#include "report/integer_column.hpp"
#include "report/polyline.hpp"

namespace spf {
namespace {

using nlohmann::json;

constexpr double kLengthStep = 1e-3;          // [m]
constexpr double kSigmaStep = 1e-4;           // [m] an estimate may be good to a millimetre
constexpr double kAngleStep = 1e-3;           // [rad]
constexpr double kTimeStep = 1e-3;            // [s]
constexpr double kComputingStep = 1e-7;       // [s]
constexpr double kPlanTolerance = 0.004;      // [m] below a pixel even when 4 m fill a screen
constexpr double kCandidateTolerance = 0.01;  // [m]

json length(double value) {
  return quantised(value, kLengthStep);
}
json point(const ReplayPoint& p) {
  return json::array({length(p.x), length(p.y)});
}

/// Five significant digits are enough to read; more would only fill the file.
json short_number(double value) {
  if (!std::isfinite(value)) return nullptr;
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.5g", value);
  return std::strtod(text.data(), nullptr);
}

/// The column of one number of every item.
template <class Items, class Number>
json column(const Items& items, double step, Number&& number) {
  IntegerColumn integers{step};
  for (const auto& item : items) integers.push(static_cast<double>(number(item)));
  return integers.take();
}

/// Texts that come again and again are stored once.
class SharedTexts {
 public:
  int index(const std::string& text) {
    const auto [found, is_new] = known_.emplace(text, static_cast<int>(texts_.size()));
    if (is_new) texts_.push_back(text);
    return found->second;
  }
  [[nodiscard]] const json& texts() const { return texts_; }

 private:
  std::map<std::string, int> known_;
  json texts_ = json::array();
};

struct Ellipse {
  double half_axis_long = kUnknown, half_axis_short = kUnknown, angle = 0.0;
};

/// One-sigma ellipse of a covariance: eigenvalues of a symmetric 2x2 matrix.
Ellipse one_sigma(const ReplayCovariance& covariance) {
  const double mean = 0.5 * (covariance.xx + covariance.yy);
  const double spread = std::hypot(0.5 * (covariance.xx - covariance.yy), covariance.xy);
  if (!std::isfinite(mean) || !std::isfinite(spread)) return {};
  return {std::sqrt(std::max(0.0, mean + spread)), std::sqrt(std::max(0.0, mean - spread)),
          0.5 * std::atan2(2.0 * covariance.xy, covariance.xx - covariance.yy)};
}

/// A row, not an object: there are thousands of them, and names would be a third of the file.
/// [label, chosen, cost, risk, n, x, y]
json candidate_json(const ReplayCandidate& candidate, SharedTexts& texts) {
  const std::vector<ReplayPoint> points = thinned(candidate.points, kCandidateTolerance);
  return json::array({texts.index(candidate.label), candidate.chosen ? 1 : 0, short_number(candidate.cost),
                      short_number(candidate.risk), points.size(),
                      column(points, kLengthStep, [](const ReplayPoint& p) { return p.x; }),
                      column(points, kLengthStep, [](const ReplayPoint& p) { return p.y; })});
}

/// [time, outcome, computing, evaluations, n, t, x, y, candidates]
json plan_json(const ReplayPlan& plan, SharedTexts& texts) {
  const std::vector<ReplayTimedPoint> points = thinned(plan.points, kPlanTolerance);
  json candidates = json::array();
  for (const ReplayCandidate& candidate : plan.candidates)
    candidates.push_back(candidate_json(candidate, texts));
  return json::array({quantised(plan.time, kTimeStep), texts.index(plan.outcome),
                      quantised(plan.planning_time, kComputingStep), plan.evaluations, points.size(),
                      column(points, kTimeStep, [](const ReplayTimedPoint& p) { return p.time; }),
                      column(points, kLengthStep, [](const ReplayTimedPoint& p) { return p.x; }),
                      column(points, kLengthStep, [](const ReplayTimedPoint& p) { return p.y; }),
                      std::move(candidates)});
}

json cells_json(const std::vector<ReplayCell>& cells) {
  return {{"x", column(cells, 1.0, [](const ReplayCell& cell) { return cell.x; })},
          {"y", column(cells, 1.0, [](const ReplayCell& cell) { return cell.y; })},
          {"n", cells.size()}};
}

/// Tracks as unbroken runs: id, first frame, number of frames, columns.
json tracks_json(const std::vector<ReplayRobotFrame>& frames) {
  struct Run {
    std::size_t first;
    std::vector<ReplayTrack> tracks;
  };
  json runs = json::array();
  std::map<int, Run> open;
  const auto close = [&runs](int id, const Run& run) {
    runs.push_back(
        {{"id", id},
         {"first", run.first},
         {"n", run.tracks.size()},
         {"x", column(run.tracks, kLengthStep, [](const ReplayTrack& track) { return track.x; })},
         {"y", column(run.tracks, kLengthStep, [](const ReplayTrack& track) { return track.y; })},
         {"sigma", column(run.tracks, kLengthStep, [](const ReplayTrack& track) { return track.sigma; })}});
  };
  for (std::size_t k = 0; k < frames.size(); ++k) {
    for (const ReplayTrack& track : frames[k].tracks) {
      Run& run = open.try_emplace(track.id, Run{k, {}}).first->second;
      if (run.first + run.tracks.size() == k) run.tracks.push_back(track);  // a repeated id counts once
    }
    for (auto entry = open.begin(); entry != open.end();) {
      const bool is_over = entry->second.first + entry->second.tracks.size() <= k;
      if (is_over) close(entry->first, entry->second);
      entry = is_over ? open.erase(entry) : std::next(entry);
    }
  }
  for (const auto& [id, run] : open) close(id, run);
  return runs;
}

json clearance_json(const std::vector<ReplayRobotFrame>& frames, ReplayClearance ReplayRobotFrame::*member) {
  return {{"distance",
           column(frames, kLengthStep, [=](const ReplayRobotFrame& f) { return (f.*member).distance; })},
          {"index", column(frames, 1.0, [=](const ReplayRobotFrame& f) { return (f.*member).index; })}};
}

json robot_json(const ReplayRobot& robot, SharedTexts& texts) {
  using Frame = ReplayRobotFrame;
  const std::vector<Frame>& frames = robot.frames;
  std::vector<Ellipse> sigma;
  for (const Frame& frame : frames) sigma.push_back(one_sigma(frame.estimate_covariance));
  json wheels = json::array();
  for (std::size_t i = 0; i < robot.wheels; ++i) {
    wheels.push_back(column(frames, kLengthStep, [i](const Frame& f) { return f.wheel_speeds[i]; }));
  }
  json plans = json::array();
  for (const ReplayPlan& plan : robot.plans) plans.push_back(plan_json(plan, texts));
  json updates = json::array();
  for (const ReplayCellUpdate& update : robot.cells) {
    updates.push_back({{"time", quantised(update.time, kTimeStep)},
                       {"added", cells_json(update.added)},
                       {"removed", cells_json(update.removed)}});
  }
  json goals = json::array();
  for (const ReplayGoal& goal : robot.goals)
    goals.push_back({{"time", quantised(goal.time, kTimeStep)}, {"at", point(goal.position)}});
  json corners = json::array();
  for (const ReplayPoint& corner : robot.corners) corners.push_back(point(corner));
  json whole = {
      {"id", robot.id},
      {"radius", length(robot.radius)},
      {"goal", point(robot.goal)},
      {"wheel_limit", length(robot.wheel_speed_limit)},
      {"range", length(robot.sensing_range)},
      {"x", column(frames, kLengthStep, [](const Frame& f) { return f.pose.x; })},
      {"y", column(frames, kLengthStep, [](const Frame& f) { return f.pose.y; })},
      {"heading", column(frames, kAngleStep, [](const Frame& f) { return f.pose.heading; })},
      {"estimate_x", column(frames, kLengthStep, [](const Frame& f) { return f.estimate.x; })},
      {"estimate_y", column(frames, kLengthStep, [](const Frame& f) { return f.estimate.y; })},
      {"estimate_heading", column(frames, kAngleStep, [](const Frame& f) { return f.estimate.heading; })},
      {"sigma_long", column(sigma, kSigmaStep, [](const Ellipse& e) { return e.half_axis_long; })},
      {"sigma_short", column(sigma, kSigmaStep, [](const Ellipse& e) { return e.half_axis_short; })},
      {"sigma_angle", column(sigma, kAngleStep, [](const Ellipse& e) { return e.angle; })},
      {"state", column(frames, 1.0, [](const Frame& f) { return f.state; })},
      {"wheels", std::move(wheels)},
      {"clearance",
       {{"obstacle", clearance_json(frames, &Frame::to_obstacle)},
        {"peer", clearance_json(frames, &Frame::to_peer)},
        {"static", clearance_json(frames, &Frame::to_static)}}},
      {"control", column(frames, kComputingStep, [](const Frame& f) { return f.control_time; })},
      {"tracks", tracks_json(frames)},
      {"plans", std::move(plans)},
      {"cell_size", quantised(robot.cell_size, kSigmaStep)},
      {"cell_origin", point(robot.cell_origin)},
      {"cells", std::move(updates)},
  };
  if (!robot.corners.empty()) whole["corners"] = std::move(corners);
  if (!robot.goals.empty()) whole["goals"] = std::move(goals);
  return whole;
}

json obstacle_json(const ReplayObstacle& obstacle) {
  using Frame = ReplayObstacleFrame;
  const auto series = [&obstacle](double step, auto&& number) {
    return column(obstacle.frames, step, number);
  };
  return {{"id", obstacle.id},
          {"radius", length(obstacle.radius)},
          {"x", series(kLengthStep, [](const Frame& f) { return f.position.x; })},
          {"y", series(kLengthStep, [](const Frame& f) { return f.position.y; })},
          {"vx", series(kLengthStep, [](const Frame& f) { return f.velocity.x; })},
          {"vy", series(kLengthStep, [](const Frame& f) { return f.velocity.y; })},
          {"field_x", series(kLengthStep, [](const Frame& f) { return f.field.center.x; })},
          {"field_y", series(kLengthStep, [](const Frame& f) { return f.field.center.y; })},
          {"field_long", series(kLengthStep, [](const Frame& f) { return f.field.half_axis_long; })},
          {"field_short", series(kLengthStep, [](const Frame& f) { return f.field.half_axis_short; })},
          {"field_angle", series(kAngleStep, [](const Frame& f) { return f.field.angle; })}};
}

const char* name(ReplayStateKind kind) {
  switch (kind) {
    case ReplayStateKind::moving:
      return "moving";
    case ReplayStateKind::braking:
      return "braking";
    case ReplayStateKind::waiting:
      return "waiting";
    case ReplayStateKind::arrived:
      return "arrived";
    case ReplayStateKind::trouble:
      return "trouble";
  }
  return "trouble";
}

const char* name(ReplayEventKind kind) {
  switch (kind) {
    case ReplayEventKind::contact:
      return "contact";
    case ReplayEventKind::stop:
      return "stop";
    case ReplayEventKind::arrival:
      return "arrival";
    case ReplayEventKind::note:
      return "note";
  }
  return "note";
}

json events_json(const std::vector<ReplayEvent>& events, SharedTexts& texts) {
  json list = json::array();
  for (const ReplayEvent& event : events) {
    list.push_back({{"time", quantised(event.time, kTimeStep)},
                    {"robot", event.robot},
                    {"kind", name(event.kind)},
                    {"text", texts.index(event.text)},
                    {"other", texts.index(event.other)},
                    {"at", event.position ? point(*event.position) : json()}});
  }
  return list;
}

json map_json(const ReplayData& data) {
  const auto box = [](const ReplayBox& b) {
    return json::array({length(b.low.x), length(b.low.y), length(b.high.x), length(b.high.y)});
  };
  json boxes = json::array();
  for (const ReplayBox& b : data.shapes.boxes) boxes.push_back(box(b));
  json discs = json::array();
  for (const ReplayDisc& d : data.shapes.discs) {
    discs.push_back(json::array({length(d.center.x), length(d.center.y), length(d.radius)}));
  }
  const auto corners = [](const auto& points) {
    json list = json::array();
    for (const ReplayPoint& p : points) {
      list.push_back(length(p.x));
      list.push_back(length(p.y));
    }
    return list;
  };
  json polygons = json::array();
  for (const std::vector<ReplayPoint>& polygon : data.shapes.polygons) polygons.push_back(corners(polygon));
  json blocks = json::array();
  for (const std::array<ReplayPoint, 4>& block : data.shapes.blocks) blocks.push_back(corners(block));
  return {{"bounds", box(data.bounds)},
          {"boxes", std::move(boxes)},
          {"discs", std::move(discs)},
          {"polygons", std::move(polygons)},
          {"blocks", std::move(blocks)}};
}

/// JSON text may spell any character of a string as \uXXXX; outside of strings these three do not occur.
std::string safe_in_html(const std::string& text) {
  std::string safe;
  safe.reserve(text.size());
  for (const char character : text) {
    switch (character) {
      case '<':
        safe += "\\u003c";
        break;
      case '>':
        safe += "\\u003e";
        break;
      case '&':
        safe += "\\u0026";
        break;
      default:
        safe += character;
    }
  }
  return safe;
}

}  // namespace

std::string replay_json(const ReplayData& data) {
  require_consistent(data);
  SharedTexts texts;
  json robots = json::array();
  for (const ReplayRobot& robot : data.robots) robots.push_back(robot_json(robot, texts));
  json obstacles = json::array();
  for (const ReplayObstacle& obstacle : data.obstacles) obstacles.push_back(obstacle_json(obstacle));
  json states = json::array();
  for (const ReplayState& state : data.states)
    states.push_back({{"text", state.text}, {"kind", name(state.kind)}});
  json summary = json::array();
  for (const auto& [label, value] : data.summary) summary.push_back(json::array({label, value}));
  json events = events_json(data.events, texts);

  const json whole = {
      {"title", data.title},
      {"family", data.family},
      {"method", data.method},
      {"noise", data.noise},
      {"level", std::isfinite(data.level) ? json(data.level) : json()},
      {"tracking", data.tracking},
      {"seed", std::to_string(data.seed)},  // text: a browser's numbers end at 2^53
      {"trial", data.trial},
      {"outcome", data.outcome},
      {"success", data.success},
      {"frame_interval", data.frame_interval},
      {"frames", frame_count(data)},
      {"field_threshold", std::isfinite(data.field_threshold) ? json(data.field_threshold) : json()},
      {"map", map_json(data)},
      {"states", std::move(states)},
      {"robots", std::move(robots)},
      {"obstacles", std::move(obstacles)},
      {"events", std::move(events)},
      {"summary", std::move(summary)},
      {"texts", texts.texts()},
  };
  return safe_in_html(whole.dump(-1, ' ', true, json::error_handler_t::replace));
}

}  // namespace spf
