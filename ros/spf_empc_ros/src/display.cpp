#include "spf_empc_ros/display.hpp"

#include <algorithm>
#include <cmath>

#include "spf/field/probability_field.hpp"
#include "spf_empc_ros/color.hpp"
#include "spf_empc_ros/conversions.hpp"

namespace spf_empc_ros {
namespace {

using visualization_msgs::Marker;

constexpr double kSampleStep = 0.1;  // [s] of a drawn plan
constexpr int kMostSamples = 600;

/// Colours of robots, easy to tell apart: the golden angle around the colour circle.
std_msgs::ColorRGBA robot_color(int robot_id, float alpha) {
  const double hue = std::fmod(0.55 + 0.381966 * robot_id, 1.0);
  const auto channel = [hue](double shift) {
    const double x = std::fabs(std::fmod(hue + shift, 1.0) * 6.0 - 3.0) - 1.0;
    return static_cast<float>(0.15 + 0.75 * std::clamp(x, 0.0, 1.0));
  };
  return color(channel(0.0), channel(2.0 / 3.0), channel(1.0 / 3.0), alpha);
}

template <class Visit>
void sample(const spf::Trajectory& plan, double from, Visit visit) {
  const double begin = std::max(from, plan.start_time());
  const double left = std::max(0.0, plan.end_time() - begin);
  const int steps = std::min(kMostSamples, static_cast<int>(std::ceil(left / kSampleStep)));
  for (int i = 0; i <= steps; ++i) visit(std::min(begin + kSampleStep * i, plan.end_time()));
}

class Markers {
 public:
  Markers(const ros::Time& stamp, std::string frame) : stamp_{stamp}, frame_{std::move(frame)} {}

  Marker& add(const std::string& kind, int id, int type) {
    Marker marker;
    marker.header.stamp = stamp_;
    marker.header.frame_id = frame_;
    marker.ns = kind;
    marker.id = id;
    marker.type = type;
    marker.action = Marker::ADD;
    marker.pose.orientation.w = 1.0;
    marker.lifetime = ros::Duration{1.0};
    array_.markers.push_back(marker);
    return array_.markers.back();
  }
  /// A flat ellipse.
  Marker& add_ellipse(const std::string& kind, int id, const spf::FieldEllipse& shape, double height) {
    Marker& marker = add(kind, id, Marker::CYLINDER);
    marker.pose = to_message(spf::Pose2{shape.center_world, shape.heading});
    marker.pose.position.z = height;
    marker.scale.x = 2.0 * shape.half_axes.x();
    marker.scale.y = 2.0 * shape.half_axes.y();
    marker.scale.z = 0.01;
    return marker;
  }
  visualization_msgs::MarkerArray take() { return std::move(array_); }

 private:
  ros::Time stamp_;
  std::string frame_;
  visualization_msgs::MarkerArray array_;
};

void add_robot(const spf::RobotAgent& agent, const spf::Pose2& here, Markers& markers) {
  const double radius = agent.parameters().robot.radius;
  Marker& body = markers.add("robot", 0, Marker::CYLINDER);
  body.pose = to_message(here);
  body.pose.position.z = 0.1;
  body.scale.x = body.scale.y = 2.0 * radius;
  body.scale.z = 0.2;
  body.color = robot_color(agent.robot_id(), 0.9F);
  Marker& front = markers.add("robot", 1, Marker::ARROW);
  front.pose = to_message(here);
  front.pose.position.z = 0.22;
  front.scale.x = 1.2 * radius;
  front.scale.y = front.scale.z = 0.2 * radius;
  front.color = color(0.1F, 0.1F, 0.1F, 1.0F);
  Marker& label = markers.add("robot", 2, Marker::TEXT_VIEW_FACING);
  label.pose = to_message(here);
  label.pose.position.z = 0.6;
  label.scale.z = 0.4;
  label.color = color(0.1F, 0.1F, 0.1F, 1.0F);
  label.text = std::to_string(agent.robot_id());
}

void add_plan(const spf::RobotAgent& agent, double now, Markers& markers) {
  Marker& line = markers.add("plan", 0, Marker::LINE_STRIP);
  line.scale.x = 0.06;
  line.color = robot_color(agent.robot_id(), 1.0F);
  sample(agent.committed(), now, [&](double time) {
    geometry_msgs::Point point;
    const Eigen::Vector2d position = agent.committed().position(time);
    point.x = position.x();
    point.y = position.y();
    point.z = 0.05;
    line.points.push_back(point);
  });
}

void add_tracks(const spf::RobotAgent& agent, double now, Markers& markers) {
  int id = 0;
  for (const spf::ObstacleTrack& track : agent.tracks()) {
    spf::ObstacleState state = track.state;
    state.position_world += std::max(0.0, now - track.time) * state.velocity_world;
    const spf::ProbabilityField field{state, agent.parameters().robot.radius, agent.parameters().field};
    markers.add_ellipse("field", id, field.ellipse(field.threshold()), 0.02).color =
        color(0.95F, 0.6F, 0.1F, 0.25F);
    const double sigma = track.position_sigma(std::max(0.0, now - track.time));
    const Eigen::Vector2d size = Eigen::Vector2d::Constant(state.radius);
    markers.add_ellipse("track", id, {state.position_world, size, 0.0}, 0.04).color =
        color(0.8F, 0.2F, 0.1F, 0.6F);
    markers
        .add_ellipse("track_sigma", id,
                     {state.position_world, size + Eigen::Vector2d::Constant(2.0 * sigma), 0.0}, 0.03)
        .color = color(0.8F, 0.2F, 0.1F, 0.2F);
    ++id;
  }
}

}  // namespace

nav_msgs::Path path_message(const spf::Trajectory& plan, double from, const ClockEdge& clock,
                            const std::string& frame) {
  nav_msgs::Path path;
  path.header.stamp = clock.time(from);
  path.header.frame_id = frame;
  sample(plan, from, [&](double time) {
    geometry_msgs::PoseStamped stamped;
    stamped.header.stamp = clock.time(time);
    stamped.header.frame_id = frame;
    stamped.pose = to_message(spf::Pose2{plan.position(time), plan.heading_state(time).heading});
    path.poses.push_back(stamped);
  });
  return path;
}

visualization_msgs::MarkerArray marker_message(const spf::RobotAgent& agent, const spf::Pose2& here,
                                               double now, const ClockEdge& clock, const std::string& frame) {
  Markers markers{clock.time(now), frame};
  add_robot(agent, here, markers);
  add_plan(agent, now, markers);
  add_tracks(agent, now, markers);
  return markers.take();
}

}  // namespace spf_empc_ros
