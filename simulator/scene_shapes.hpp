// Pictures of what is true (visualization_msgs/MarkerArray): static shapes, robots with their goals, moving
// obstacles. Frame: world.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "sim/world.hpp"
#include "wire/pose.hpp"

namespace spf::simulator {

/// One marker, whatever the messages.
struct Shape {
  enum class Kind { cylinder, cube, arrow, text, line_strip, line_list };
  const char* name = "";  ///< what it is; unique with `id`
  int id = 0;
  Kind kind = Kind::cylinder;
  Pose2 pose;
  double height = 0.0;                                 ///< [m] of the pose above the ground
  std::array<double, 3> scale{};                       ///< [m]
  std::array<float, 4> color{0.2F, 0.2F, 0.2F, 1.0F};  ///< red, green, blue, alpha
  std::vector<Eigen::Vector2d> points;                 ///< [m] of lines
  std::string text;
  bool may_leave = false;  ///< is there only as long as it is told anew
};

/// A moment of a trial.
struct Scene {
  const sim::Scenario* scenario = nullptr;  // these three must outlive it
  const std::vector<sim::RobotTruth>* robots = nullptr;
  const std::vector<sim::DynamicObstacle>* dynamic_obstacles = nullptr;
  double share = 0.0;                            ///< of the obstacles' step
  std::vector<std::optional<host::Goal>> goals;  ///< by robot
};

[[nodiscard]] Scene scene_of(const sim::World& world);
[[nodiscard]] std::vector<Shape> shapes_of(const Scene& scene);

/// `until_gone`: a message's duration after which what may leave is gone.
template <class MarkerArray, class Time, class Duration>
[[nodiscard]] MarkerArray markers_of(const std::vector<Shape>& shapes, const std::string& frame,
                                     const Time& time, const Duration& until_gone) {
  using Marker = typename decltype(MarkerArray::markers)::value_type;
  const std::array<int, 6> types{Marker::CYLINDER,         Marker::CUBE,       Marker::ARROW,
                                 Marker::TEXT_VIEW_FACING, Marker::LINE_STRIP, Marker::LINE_LIST};
  MarkerArray array;
  for (const Shape& shape : shapes) {
    Marker& marker = array.markers.emplace_back();
    marker.header.frame_id = frame;
    marker.header.stamp = time;
    marker.ns = shape.name;
    marker.id = shape.id;
    marker.type = types[static_cast<std::size_t>(shape.kind)];
    wire::fill(shape.pose, marker.pose);
    marker.pose.position.z = shape.height;
    marker.scale.x = shape.scale[0];
    marker.scale.y = shape.scale[1];
    marker.scale.z = shape.scale[2];
    marker.color.r = shape.color[0];
    marker.color.g = shape.color[1];
    marker.color.b = shape.color[2];
    marker.color.a = shape.color[3];
    for (const Eigen::Vector2d& point : shape.points) wire::fill(point, marker.points.emplace_back());
    marker.text = shape.text;
    if (shape.may_leave) marker.lifetime = until_gone;
  }
  return array;
}

}  // namespace spf::simulator
