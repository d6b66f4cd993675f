#include "spf_empc_ros/simulator_messages.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "sim/extent.hpp"
#include "sim/geometry.hpp"
#include "sim/simulation.hpp"
#include "spf/math/polygon.hpp"
#include "spf/math/segment.hpp"
#include "spf_empc_ros/color.hpp"
#include "spf_empc_ros/conversions.hpp"

namespace spf_empc_ros {
namespace {

using spf::sim::Box;
using spf::sim::Disc;
using spf::sim::RobotTruth;
using spf::sim::Scenario;
using spf::sim::Segment;
using spf::sim::World;

constexpr std::int8_t kOccupied = 100;

template <class Points>
Box bounds_of(const Points& points) {
  Box bounds{points[0], points[0]};
  for (const Eigen::Vector2d& point : points) {
    bounds.low = bounds.low.cwiseMin(point);
    bounds.high = bounds.high.cwiseMax(point);
  }
  return bounds;
}

/// A grid being filled: marks the cells whose centre a shape covers.
class CellPainter {
 public:
  CellPainter(nav_msgs::OccupancyGrid& grid, const Eigen::Vector2d& low)
      : grid_{grid}, low_{low}, cell_{grid.info.resolution} {}

  /// `distance` from a centre to the shape must not be above `reach`.
  template <class Distance>
  void paint(const Eigen::Vector2d& low, const Eigen::Vector2d& high, double reach,
             const Distance& distance) {
    const auto [i0, j0] = cell_of(low - Eigen::Vector2d::Constant(reach));
    const auto [i1, j1] = cell_of(high + Eigen::Vector2d::Constant(reach));
    for (long j = j0; j <= j1; ++j)
      for (long i = i0; i <= i1; ++i) {
        const Eigen::Vector2d centre =
            low_ + cell_ * Eigen::Vector2d{static_cast<double>(i) + 0.5, static_cast<double>(j) + 0.5};
        if (distance(centre) <= reach)
          grid_.data[static_cast<std::size_t>(j) * grid_.info.width + static_cast<std::size_t>(i)] =
              kOccupied;
      }
  }

 private:
  [[nodiscard]] std::pair<long, long> cell_of(const Eigen::Vector2d& position) const {
    const Eigen::Vector2d steps = (position - low_) / cell_;
    return {std::clamp(std::lround(std::floor(steps.x())), 0L, static_cast<long>(grid_.info.width) - 1),
            std::clamp(std::lround(std::floor(steps.y())), 0L, static_cast<long>(grid_.info.height) - 1)};
  }
  nav_msgs::OccupancyGrid& grid_;
  Eigen::Vector2d low_;
  double cell_;  // [m]
};

void paint_shapes(const Scenario& scenario, CellPainter& painter, double resolution) {
  for (const Box& box : scenario.boxes)
    painter.paint(box.low, box.high, 0.0,
                  [&](const Eigen::Vector2d& position) { return spf::sim::distance_to_box(position, box); });
  for (const Disc& disc : scenario.discs)
    painter.paint(disc.center, disc.center, disc.radius,
                  [&](const Eigen::Vector2d& position) { return (position - disc.center).norm(); });
  // A thin wall covers no centre: its cells are those that it may cross.
  for (const Segment& wall : scenario.walls)
    painter.paint(wall.from.cwiseMin(wall.to), wall.from.cwiseMax(wall.to), resolution * std::sqrt(0.5),
                  [&](const Eigen::Vector2d& position) { return spf::distance_to_segment(position, wall); });
  for (const spf::sim::Polygon& polygon : scenario.polygons) {
    const Box bounds = bounds_of(polygon.corners);
    painter.paint(bounds.low, bounds.high, 0.0, [&](const Eigen::Vector2d& position) {
      return spf::signed_distance_to_polygon(position, polygon.corners);
    });
  }
  if (!scenario.map) return;
  const Box bounds = bounds_of(scenario.map->corners());
  painter.paint(bounds.low, bounds.high, 0.0, [&](const Eigen::Vector2d& position) {
    return scenario.map->occupied(position) ? 0.0 : resolution;
  });
}

/// Markers of one array, by name and number.
class WorldMarkers {
 public:
  explicit WorldMarkers(const Stamp& stamp) : stamp_{stamp} {}

  visualization_msgs::Marker& add(const char* name, int id, int type, const spf::Pose2& pose, double height) {
    visualization_msgs::Marker marker;
    marker.header.frame_id = stamp_.frame;
    marker.header.stamp = stamp_.time;
    marker.ns = name;
    marker.id = id;
    marker.type = type;
    marker.pose = to_message(pose);
    marker.pose.position.z = height;
    array_.markers.push_back(marker);
    return array_.markers.back();
  }
  void disc(const char* name, int id, const Eigen::Vector2d& position, double radius, double height,
            const std_msgs::ColorRGBA& paint) {
    visualization_msgs::Marker& marker =
        add(name, id, visualization_msgs::Marker::CYLINDER, {position, 0.0}, 0.5 * height);
    marker.scale.x = marker.scale.y = 2.0 * radius;
    marker.scale.z = height;
    marker.color = paint;
  }
  void line(const char* name, int id, const std::vector<Eigen::Vector2d>& positions) {
    visualization_msgs::Marker& marker =
        add(name, id, visualization_msgs::Marker::LINE_STRIP, spf::Pose2{}, 0.05);
    marker.scale.x = 0.06;
    marker.color = color(0.2F, 0.2F, 0.2F);
    for (const Eigen::Vector2d& position : positions) {
      geometry_msgs::Point point;
      point.x = position.x();
      point.y = position.y();
      marker.points.push_back(point);
    }
  }
  void segments(const char* name, const std::vector<Segment>& segments) {
    visualization_msgs::Marker& marker =
        add(name, 0, visualization_msgs::Marker::LINE_LIST, spf::Pose2{}, 0.05);
    marker.scale.x = 0.04;
    marker.color = color(0.2F, 0.2F, 0.2F);
    for (const Segment& segment : segments)
      for (const Eigen::Vector2d& end : {segment.from, segment.to}) {
        geometry_msgs::Point point;
        point.x = end.x();
        point.y = end.y();
        marker.points.push_back(point);
      }
  }
  [[nodiscard]] visualization_msgs::MarkerArray take() { return std::move(array_); }

 private:
  Stamp stamp_;
  visualization_msgs::MarkerArray array_;
};

void add_static_scene(const Scenario& scenario, WorldMarkers& markers) {
  constexpr double kHeight = 0.5;  // [m]
  int id = 0;
  for (const Box& box : scenario.boxes) {
    visualization_msgs::Marker& marker = markers.add("box", id++, visualization_msgs::Marker::CUBE,
                                                     {0.5 * (box.low + box.high), 0.0}, 0.5 * kHeight);
    marker.scale.x = box.high.x() - box.low.x();
    marker.scale.y = box.high.y() - box.low.y();
    marker.scale.z = kHeight;
    marker.color = color(0.45F, 0.47F, 0.5F, 0.8F);
  }
  id = 0;
  for (const Disc& disc : scenario.discs)
    markers.disc("disc", id++, disc.center, disc.radius, kHeight, color(0.45F, 0.47F, 0.5F, 0.8F));
  id = 0;
  for (const Segment& wall : scenario.walls) markers.line("wall", id++, {wall.from, wall.to});
  id = 0;
  for (const spf::sim::Polygon& polygon : scenario.polygons) {
    std::vector<Eigen::Vector2d> outline = polygon.corners;
    outline.push_back(outline.front());
    markers.line("polygon", id++, outline);
  }
  if (scenario.map) markers.segments("map", scenario.map->faces());
  if (!scenario.border) return;
  const Box& border = *scenario.border;
  markers.line("border", 0,
               {border.low,
                {border.high.x(), border.low.y()},
                border.high,
                {border.low.x(), border.high.y()},
                border.low});
}

void add_robot(const World& world, std::size_t robot, WorldMarkers& markers) {
  const RobotTruth& truth = world.robots()[robot];
  if (truth.gone) return;
  const double radius = truth.radius;
  const int id = static_cast<int>(robot);
  const std_msgs::ColorRGBA paint = truth.wrecked || truth.broken ? color(0.1F, 0.1F, 0.1F)
                                    : truth.arrived               ? color(0.2F, 0.65F, 0.3F)
                                                                  : color(0.15F, 0.4F, 0.8F);
  markers.disc("robot", id, truth.pose.position_world, radius, 0.3, paint);
  visualization_msgs::Marker& nose =
      markers.add("heading", id, visualization_msgs::Marker::ARROW, truth.pose, 0.32);
  nose.scale.x = 1.4 * radius;
  nose.scale.y = nose.scale.z = 0.25 * radius;
  nose.color = color(1.0F, 1.0F, 1.0F);
  visualization_msgs::Marker& number = markers.add("number", id, visualization_msgs::Marker::TEXT_VIEW_FACING,
                                                   {truth.pose.position_world, 0.0}, 0.9);
  number.text = std::to_string(id);
  number.scale.z = 2.0 * radius;
  number.color = color(0.0F, 0.0F, 0.0F);
  if (const std::optional<spf::host::Goal>& goal = world.goal(id))
    markers.disc("goal", id, goal->position_world, 0.4 * radius, 0.02, color(0.1F, 0.6F, 0.2F, 0.6F));
}

std::string contact_text(const spf::sim::Contact& contact) {
  const std::string other = contact.other >= 0 ? " " + std::to_string(contact.other) : "";
  std::array<char, 160> text{};
  std::snprintf(text.data(), text.size(),
                "robot %d touched %s%s at %.2f s, at %.2f m/s (the other at %.2f m/s)", contact.robot,
                spf::enum_name(contact.with), other.c_str(), contact.time, contact.robot_speed,
                contact.other_speed);
  return text.data();
}

}  // namespace

std::string robot_name(int robot) {
  return "robot" + std::to_string(robot);
}

std::string base_frame(int robot) {
  return robot_name(robot) + "/base_link";
}

nav_msgs::Odometry odometry_message(const World& world, int robot, const spf::Pose2& measured,
                                    const Stamp& stamp) {
  const spf::PlantState& plant = world.plant(robot).state();
  const spf::sim::PoseNoiseParameters& noise = world.scenario().simulation.pose_noise;
  const Eigen::Vector3d twist = spf::twist_in_body(plant.twist_world, plant.pose_world.heading);
  nav_msgs::Odometry message;
  message.header.frame_id = stamp.frame;
  message.header.stamp = stamp.time;
  message.child_frame_id = base_frame(robot);
  message.pose.pose = to_message(measured);
  message.pose.covariance[0] = message.pose.covariance[7] = noise.position_sigma * noise.position_sigma;
  message.pose.covariance[35] = noise.heading_sigma * noise.heading_sigma;
  message.twist.twist.linear.x = twist.x();
  message.twist.twist.linear.y = twist.y();
  message.twist.twist.angular.z = twist.z();
  return message;
}

std::vector<geometry_msgs::TransformStamped> transforms(const World& world, const Stamp& stamp) {
  std::vector<geometry_msgs::TransformStamped> found;
  for (std::size_t i = 0; i < world.robots().size(); ++i) {
    const geometry_msgs::Pose pose = to_message(world.robots()[i].pose);
    geometry_msgs::TransformStamped transform;
    transform.header.frame_id = stamp.frame;
    transform.header.stamp = stamp.time;
    transform.child_frame_id = base_frame(static_cast<int>(i));
    transform.transform.translation.x = pose.position.x;
    transform.transform.translation.y = pose.position.y;
    transform.transform.rotation = pose.orientation;
    found.push_back(transform);
  }
  return found;
}

sensor_msgs::LaserScan scan_message(const spf::RangeScan& scan, double rate, int robot,
                                    const ros::Time& time) {
  sensor_msgs::LaserScan message = to_message(scan);
  message.header.frame_id = base_frame(robot);
  message.header.stamp = time;
  message.scan_time = static_cast<float>(1.0 / rate);
  return message;
}

spf_empc_msgs::ObstacleTracks obstacles_message(const std::vector<spf::Detection>& detections,
                                                const Stamp& stamp) {
  spf_empc_msgs::ObstacleTracks message;
  message.header.frame_id = stamp.frame;
  message.header.stamp = stamp.time;
  for (const spf::Detection& detection : detections) {
    spf_empc_msgs::ObstacleTrack track;
    track.id = detection.id;
    track.position.x = detection.position_world.x();
    track.position.y = detection.position_world.y();
    track.radius = detection.radius;
    const double variance = detection.position_sigma * detection.position_sigma;
    track.covariance[0] = track.covariance[5] = variance;
    if (detection.velocity_world) {
      track.velocity.x = detection.velocity_world->x();
      track.velocity.y = detection.velocity_world->y();
    } else {
      track.covariance[10] = track.covariance[15] = -1.0;
    }
    message.tracks.push_back(track);
  }
  return message;
}

geometry_msgs::PoseStamped goal_message(const spf::host::Goal& goal, double any_heading, const Stamp& stamp) {
  geometry_msgs::PoseStamped message;
  message.header.frame_id = stamp.frame;
  message.header.stamp = stamp.time;
  message.pose = to_message(spf::Pose2{goal.position_world, goal.heading.value_or(any_heading)});
  return message;
}

geometry_msgs::PoseStamped goal_message(const spf::sim::RobotTask& task, const Stamp& stamp) {
  return goal_message({task.goal_world, task.goal_heading}, task.start.heading, stamp);
}

nav_msgs::OccupancyGrid map_message(const Scenario& scenario, double resolution, const Stamp& stamp) {
  const Box extent = extent_of(scenario);
  nav_msgs::OccupancyGrid grid;
  grid.header.frame_id = stamp.frame;
  grid.header.stamp = grid.info.map_load_time = stamp.time;
  grid.info.resolution = static_cast<float>(resolution);
  const Eigen::Vector2d cells = (extent.high - extent.low) / static_cast<double>(grid.info.resolution);
  constexpr double kRounding = 1e-3;  // of a cell
  grid.info.width = static_cast<std::uint32_t>(std::ceil(cells.x() - kRounding));
  grid.info.height = static_cast<std::uint32_t>(std::ceil(cells.y() - kRounding));
  grid.info.origin = to_message(spf::Pose2{extent.low, 0.0});
  grid.data.assign(static_cast<std::size_t>(grid.info.width) * grid.info.height, 0);
  if (scenario.simulation.sensing.map == spf::sim::MapKnowledge::sensed) return grid;
  CellPainter painter{grid, extent.low};
  paint_shapes(scenario, painter, resolution);
  return grid;
}

visualization_msgs::MarkerArray world_markers(const World& world, const Stamp& stamp) {
  WorldMarkers markers{stamp};
  add_static_scene(world.scenario(), markers);
  for (std::size_t i = 0; i < world.robots().size(); ++i) add_robot(world, i, markers);
  const ros::Duration gone_after{0.5};
  visualization_msgs::MarkerArray result;
  for (const spf::sim::DynamicObstacle& obstacle : world.dynamic_obstacles())
    markers.disc(obstacle.person ? "person" : "disc", obstacle.id, obstacle.motion.at(world.share()),
                 obstacle.radius, 0.4, obstacle.person ? color(0.85F, 0.5F, 0.1F) : color(0.8F, 0.25F, 0.2F));
  result = markers.take();
  for (visualization_msgs::Marker& marker : result.markers)
    if (marker.ns == "person") marker.lifetime = gone_after;  // people leave
  return result;
}

spf_empc_msgs::TrialOutcome outcome_message(const spf::sim::TrialResult& result, bool finished,
                                            const Stamp& stamp) {
  using Message = spf_empc_msgs::TrialOutcome;
  Message message;
  message.header.stamp = stamp.time;
  message.header.frame_id = stamp.frame;
  message.robots = static_cast<std::uint32_t>(result.robots.size());
  message.duration = result.sim_seconds;
  std::string away;
  for (std::size_t i = 0; i < result.robots.size(); ++i) {
    const spf::sim::RobotResult& robot = result.robots[i];
    if (robot.arrived) ++message.arrived;
    if (!robot.arrived) away += (away.empty() ? "" : ", ") + std::to_string(i);
    message.arrival_times.push_back(robot.arrived ? robot.travel_time : -1.0);
    message.path_lengths.push_back(robot.path_length);
  }
  if (!result.contacts.empty()) {
    message.outcome = Message::COLLISION;
    message.cause = contact_text(result.contacts.front());
  } else if (!finished) {
    message.outcome = Message::RUNNING;
  } else if (result.outcome == spf::sim::TrialOutcome::success) {
    message.outcome = Message::SUCCESS;
  } else {
    message.outcome = Message::TIMEOUT;
    message.cause = "not at their goals: robots " + away;
  }
  return message;
}

}  // namespace spf_empc_ros
