#include "simulator/scene_shapes.hpp"

#include <utility>

namespace spf::simulator {
namespace {

using sim::Box;
using sim::Disc;
using sim::RobotTruth;
using sim::Scenario;
using sim::Segment;
using Color = std::array<float, 4>;

constexpr Color kSolid{0.45F, 0.47F, 0.5F, 0.8F};
constexpr Color kBlack{0.0F, 0.0F, 0.0F, 1.0F};

class Shapes {
 public:
  Shape& add(const char* name, int id, Shape::Kind kind, const Pose2& pose, double height) {
    Shape& shape = shapes_.emplace_back();
    shape.name = name;
    shape.id = id;
    shape.kind = kind;
    shape.pose = pose;
    shape.height = height;
    return shape;
  }
  Shape& disc(const char* name, int id, const Eigen::Vector2d& position, double radius, double height,
              const Color& color) {
    Shape& shape = add(name, id, Shape::Kind::cylinder, {position, 0.0}, 0.5 * height);
    shape.scale = {2.0 * radius, 2.0 * radius, height};
    shape.color = color;
    return shape;
  }
  void line(const char* name, int id, std::vector<Eigen::Vector2d> positions) {
    Shape& shape = add(name, id, Shape::Kind::line_strip, Pose2{}, 0.05);
    shape.scale[0] = 0.06;
    shape.points = std::move(positions);
  }
  void segments(const char* name, const std::vector<Segment>& segments) {
    Shape& shape = add(name, 0, Shape::Kind::line_list, Pose2{}, 0.05);
    shape.scale[0] = 0.04;
    for (const Segment& segment : segments)
      shape.points.insert(shape.points.end(), {segment.from, segment.to});
  }
  [[nodiscard]] std::vector<Shape> take() { return std::move(shapes_); }

 private:
  std::vector<Shape> shapes_;
};

void add_static_scene(const Scenario& scenario, Shapes& shapes) {
  constexpr double kHeight = 0.5;  // [m]
  int id = 0;
  for (const Box& box : scenario.boxes) {
    Shape& shape =
        shapes.add("box", id++, Shape::Kind::cube, {0.5 * (box.low + box.high), 0.0}, 0.5 * kHeight);
    shape.scale = {box.high.x() - box.low.x(), box.high.y() - box.low.y(), kHeight};
    shape.color = kSolid;
  }
  id = 0;
  for (const Disc& disc : scenario.discs)
    shapes.disc("pillar", id++, disc.center, disc.radius, kHeight, kSolid);
  id = 0;
  for (const Segment& wall : scenario.walls) shapes.line("wall", id++, {wall.from, wall.to});
  id = 0;
  for (const sim::Polygon& polygon : scenario.polygons) {
    std::vector<Eigen::Vector2d> outline = polygon.corners;
    outline.push_back(outline.front());
    shapes.line("polygon", id++, std::move(outline));
  }
  if (scenario.map) shapes.segments("map", scenario.map->faces());
  if (!scenario.border) return;
  const Box& border = *scenario.border;
  shapes.line("border", 0,
              {border.low,
               {border.high.x(), border.low.y()},
               border.high,
               {border.low.x(), border.high.y()},
               border.low});
}

void add_robot(const RobotTruth& truth, int id, const std::optional<host::Goal>& goal, Shapes& shapes) {
  if (truth.gone) return;
  const double radius = truth.radius;
  const Color color = truth.wrecked || truth.broken ? Color{0.1F, 0.1F, 0.1F, 1.0F}
                      : truth.arrived               ? Color{0.2F, 0.65F, 0.3F, 1.0F}
                                                    : Color{0.15F, 0.4F, 0.8F, 1.0F};
  shapes.disc("robot", id, truth.pose.position_world, radius, 0.3, color);
  Shape& nose = shapes.add("heading", id, Shape::Kind::arrow, truth.pose, 0.32);
  nose.scale = {1.4 * radius, 0.25 * radius, 0.25 * radius};
  nose.color = {1.0F, 1.0F, 1.0F, 1.0F};
  Shape& number = shapes.add("number", id, Shape::Kind::text, {truth.pose.position_world, 0.0}, 0.9);
  number.text = std::to_string(id);
  number.scale[2] = 2.0 * radius;
  number.color = kBlack;
  if (goal) shapes.disc("goal", id, goal->position_world, 0.4 * radius, 0.02, {0.1F, 0.6F, 0.2F, 0.6F});
}

}  // namespace

Scene scene_of(const sim::World& world) {
  Scene scene{&world.scenario(), &world.robots(), &world.dynamic_obstacles(), world.share(), {}};
  for (std::size_t i = 0; i < world.robots().size(); ++i)
    scene.goals.push_back(world.goal(static_cast<int>(i)));
  return scene;
}

std::vector<Shape> shapes_of(const Scene& scene) {
  Shapes shapes;
  add_static_scene(*scene.scenario, shapes);
  for (std::size_t i = 0; i < scene.robots->size(); ++i)
    add_robot((*scene.robots)[i], static_cast<int>(i), scene.goals[i], shapes);
  for (const sim::DynamicObstacle& obstacle : *scene.dynamic_obstacles) {
    const Color color = obstacle.person ? Color{0.85F, 0.5F, 0.1F, 1.0F} : Color{0.8F, 0.25F, 0.2F, 1.0F};
    Shape& shape = shapes.disc(obstacle.person ? "person" : "disc", obstacle.id,
                               obstacle.motion.at(scene.share), obstacle.radius, 0.4, color);
    shape.may_leave = obstacle.person;
  }
  return shapes.take();
}

}  // namespace spf::simulator
