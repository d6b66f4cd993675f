// Pictures for RViz: the plan as a path (nav_msgs/Path), and robot, plan, field ellipses and tracks as
// markers (visualization_msgs/MarkerArray). Frame: world (the fleet's).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "spf/field/probability_field.hpp"
#include "spf/team/robot_agent.hpp"
#include "wire/pose.hpp"

namespace spf::wire {

namespace display_parts {

inline constexpr double kSampleStep = 0.1;  // [s] of a drawn plan
inline constexpr int kMostSamples = 600;

using Color = std::array<float, 4>;  // red, green, blue, alpha

/// Colours of robots, easy to tell apart: the golden angle around the colour circle.
[[nodiscard]] inline Color robot_color(int robot_id, float alpha) {
  const double hue = std::fmod(0.55 + 0.381966 * robot_id, 1.0);
  const auto channel = [hue](double shift) {
    const double x = std::fabs(std::fmod(hue + shift, 1.0) * 6.0 - 3.0) - 1.0;
    return static_cast<float>(0.15 + 0.75 * std::clamp(x, 0.0, 1.0));
  };
  return {channel(0.0), channel(2.0 / 3.0), channel(1.0 / 3.0), alpha};
}

template <class Visit>
void sample(const Trajectory& plan, double from, Visit visit) {
  const double begin = std::max(from, plan.start_time());
  const double left = std::max(0.0, plan.end_time() - begin);
  const int steps = std::min(kMostSamples, static_cast<int>(std::ceil(left / kSampleStep)));
  for (int i = 0; i <= steps; ++i) visit(std::min(begin + kSampleStep * i, plan.end_time()));
}

template <class MarkerArray, class Stamp>
class Markers {
 public:
  using Marker = typename decltype(MarkerArray::markers)::value_type;

  Markers(const Stamp& stamp, std::string frame) : stamp_{stamp}, frame_{std::move(frame)} {}

  Marker& add(const std::string& kind, int id, int type, const Color& color) {
    Marker& marker = array_.markers.emplace_back();
    marker.header.stamp = stamp_;
    marker.header.frame_id = frame_;
    marker.ns = kind;
    marker.id = id;
    marker.type = type;
    marker.action = Marker::ADD;
    marker.pose.orientation.w = 1.0;
    marker.lifetime.sec = 1;
    marker.color.r = color[0];
    marker.color.g = color[1];
    marker.color.b = color[2];
    marker.color.a = color[3];
    return marker;
  }
  /// A flat ellipse.
  void add_ellipse(const std::string& kind, int id, const FieldEllipse& shape, double height,
                   const Color& color) {
    Marker& marker = add(kind, id, Marker::CYLINDER, color);
    fill(Pose2{shape.center_world, shape.heading}, marker.pose);
    marker.pose.position.z = height;
    marker.scale.x = 2.0 * shape.half_axes.x();
    marker.scale.y = 2.0 * shape.half_axes.y();
    marker.scale.z = 0.01;
  }
  MarkerArray take() { return std::move(array_); }

 private:
  Stamp stamp_;
  std::string frame_;
  MarkerArray array_;
};

template <class Markers>
void add_robot(const RobotAgent& agent, const Pose2& here, Markers& markers) {
  using Marker = typename Markers::Marker;
  constexpr Color kDark{0.1F, 0.1F, 0.1F, 1.0F};
  const double radius = agent.parameters().robot.radius;
  Marker& body = markers.add("robot", 0, Marker::CYLINDER, robot_color(agent.robot_id(), 0.9F));
  fill(here, body.pose);
  body.pose.position.z = 0.1;
  body.scale.x = body.scale.y = 2.0 * radius;
  body.scale.z = 0.2;
  Marker& front = markers.add("robot", 1, Marker::ARROW, kDark);
  fill(here, front.pose);
  front.pose.position.z = 0.22;
  front.scale.x = 1.2 * radius;
  front.scale.y = front.scale.z = 0.2 * radius;
  Marker& label = markers.add("robot", 2, Marker::TEXT_VIEW_FACING, kDark);
  fill(here, label.pose);
  label.pose.position.z = 0.6;
  label.scale.z = 0.4;
  label.text = std::to_string(agent.robot_id());
}

template <class Markers>
void add_plan(const RobotAgent& agent, double now, Markers& markers) {
  auto& line = markers.add("plan", 0, Markers::Marker::LINE_STRIP, robot_color(agent.robot_id(), 1.0F));
  line.scale.x = 0.06;
  sample(agent.committed(), now, [&](double time) {
    auto& point = line.points.emplace_back();
    fill(Eigen::Vector2d{agent.committed().position(time)}, point);
    point.z = 0.05;
  });
}

template <class Markers>
void add_tracks(const RobotAgent& agent, double now, Markers& markers) {
  int id = 0;
  for (const ObstacleTrack& track : agent.tracks()) {
    const double age = std::max(0.0, now - track.time);
    ObstacleState state = track.state;
    state.position_world += age * state.velocity_world;
    const ProbabilityField field{state, agent.parameters().robot.radius, agent.parameters().field};
    markers.add_ellipse("field", id, field.ellipse(field.threshold()), 0.02, {0.95F, 0.6F, 0.1F, 0.25F});
    const Eigen::Vector2d size = Eigen::Vector2d::Constant(state.radius);
    const Eigen::Vector2d unsure = size + Eigen::Vector2d::Constant(2.0 * track.position_sigma(age));
    markers.add_ellipse("track", id, {state.position_world, size, 0.0}, 0.04, {0.8F, 0.2F, 0.1F, 0.6F});
    markers.add_ellipse("track_sigma", id, {state.position_world, unsure, 0.0}, 0.03,
                        {0.8F, 0.2F, 0.1F, 0.2F});
    ++id;
  }
}

}  // namespace display_parts

/// What is left of a plan at a time [s].
template <class Path, class Clock>
[[nodiscard]] Path path_of(const Trajectory& plan, double from, const Clock& clock,
                           const std::string& frame) {
  Path path;
  path.header.stamp = clock.time(from);
  path.header.frame_id = frame;
  display_parts::sample(plan, from, [&](double time) {
    auto& stamped = path.poses.emplace_back();
    stamped.header.stamp = clock.time(time);
    stamped.header.frame_id = frame;
    fill(Pose2{plan.position(time), plan.heading_state(time).heading}, stamped.pose);
  });
  return path;
}

template <class MarkerArray, class Clock>
[[nodiscard]] MarkerArray markers_of(const RobotAgent& agent, const Pose2& here, double now,
                                     const Clock& clock, const std::string& frame) {
  display_parts::Markers<MarkerArray, decltype(clock.time(now))> markers{clock.time(now), frame};
  display_parts::add_robot(agent, here, markers);
  display_parts::add_plan(agent, now, markers);
  display_parts::add_tracks(agent, now, markers);
  return markers.take();
}

}  // namespace spf::wire
