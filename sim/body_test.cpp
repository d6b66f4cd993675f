#include "sim/body.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "sim/range_sensor.hpp"
#include "sim/robot_truth.hpp"
#include "spf/math/angles.hpp"
#include "spf/math/random_stream.hpp"

namespace spf::sim {
namespace {

RobotParameters rectangle(double length, double width) {
  RobotParameters robot;
  robot.length = length;
  robot.width = width;
  return with_radius_of_footprint(robot);
}

/// Whether a point lies in the outline, by its own definition.
bool in_rectangle(const RobotParameters& robot, const Pose2& pose, const Eigen::Vector2d& point) {
  const Eigen::Vector2d inside = Eigen::Rotation2Dd{-pose.heading} * (point - pose.position_world);
  return std::abs(inside.x()) <= 0.5 * robot.length && std::abs(inside.y()) <= 0.5 * robot.width;
}

// Against points sampled on what it may touch.
TEST(Body, FindsTheFirstContactThatSamplingFinds) {
  const RobotParameters robot = rectangle(0.8, 0.4);
  const Footprint outline{robot};
  RandomStream random{3};
  const auto draw = [&](double extent) {
    const double x = random.uniform(-extent, extent);
    return Eigen::Vector2d{x, random.uniform(-extent, extent)};
  };
  int hits = 0;
  for (int i = 0; i < 300; ++i) {
    SCOPED_TRACE(i);
    Scenario scenario;
    if (i % 3 == 0)
      scenario.walls.push_back({draw(1.0), draw(1.0)});
    else if (i % 3 == 1)
      scenario.discs.push_back({draw(1.0), 0.2});
    else
      scenario.boxes.push_back({{0.3, 0.3}, {0.9, 0.5}});
    const StaticShapes shapes{scenario};
    const BodyMotion motion{
        &outline, {draw(1.0), draw(1.0)}, random.uniform(-kPi, kPi), random.uniform(-1.5, 1.5)};
    std::vector<Eigen::Vector2d> surface;
    for (int k = 0; k <= 400; ++k) {
      const double share = k / 400.0;
      for (const Segment& wall : scenario.walls)
        surface.emplace_back(wall.from + share * (wall.to - wall.from));
      for (const Disc& disc : scenario.discs)
        surface.emplace_back(disc.center + disc.radius * Eigen::Vector2d{std::cos(2.0 * kPi * share),
                                                                         std::sin(2.0 * kPi * share)});
      for (const Box& box : scenario.boxes) {
        const ConvexPolygon sides = polygon_of(box);
        for (std::size_t s = 0; s < 4; ++s)
          surface.emplace_back(sides.edge(s).from + share * (sides.edge(s).to - sides.edge(s).from));
      }
    }
    double sampled = std::numeric_limits<double>::infinity();
    for (int k = 0; k <= 1000 && std::isinf(sampled); ++k) {
      const double share = k / 1000.0;
      const Pose2 pose{motion.centre.at(share), motion.heading + share * motion.turn};
      for (const Eigen::Vector2d& point : surface)
        if (in_rectangle(robot, pose, point)) sampled = share;
    }
    const std::optional<Contact> found = shapes.first_contact(motion);
    const bool begins_inside = shapes.clearance(motion.at(0.0), motion.centre.from, robot.radius) <= 0.0;
    if (std::isinf(sampled)) {
      if (found && !begins_inside) {  // a graze between two samples
        EXPECT_NEAR(shapes.clearance(motion.at(found->time), found->position_world, robot.radius), 0.0, 1e-5);
      }
      continue;
    }
    ++hits;
    ASSERT_TRUE(found);
    EXPECT_LE(found->time, sampled + 1e-9);
    // Points on the surface lie 5 mm apart at most.
    EXPECT_NEAR(found->time * motion.reach(), sampled * motion.reach(), begins_inside ? 9.0 : 0.05);
  }
  EXPECT_GT(hits, 60);
}

TEST(Body, KnowsItsDistanceFromAnotherAndTheBorder) {
  const Footprint outline{rectangle(0.8, 0.4)};
  const ConvexPolygon one = outline.placed({0.0, 0.0}, 0.0);
  EXPECT_NEAR(one.distance_to(outline.placed({1.0, 0.0}, 0.0)), 0.2, 1e-12);
  EXPECT_NEAR(one.distance_to(outline.placed({1.0, 0.0}, kPi / 2.0)), 0.4, 1e-12);
  EXPECT_EQ(one.distance_to(outline.placed({0.5, 0.1}, 0.3)), 0.0);
  EXPECT_EQ(one.distance_to(polygon_of(Box{{-0.1, -0.1}, {0.1, 0.1}})), 0.0);
  EXPECT_NEAR(depth_inside(one, Box{{-1.0, -1.0}, {1.0, 1.0}}), 0.6, 1e-12);
  EXPECT_NEAR(depth_inside(one, Box{{-0.3, -1.0}, {1.0, 1.0}}), -0.1, 1e-12);
}

TEST(Body, IsWhatAScannerSees) {
  Scenario scenario;
  scenario.simulation.sensing.beams = 360;
  scenario.simulation.sensing.field_of_view = 360.0;
  const RangeSensor sensor{scenario};
  const Footprint outline{rectangle(0.8, 0.4)};
  RangeScan scan;
  const double radius = outline.circumscribed_radius();
  sensor.sweep({{0.0, 0.0}, 0.0}, {{{2.0, 0.0}, radius, &outline, 0.0}}, scan);
  EXPECT_NEAR(scan.ranges[180], 1.6, 1e-9);  // straight ahead: its short side
  sensor.sweep({{0.0, 0.0}, 0.0}, {{{2.0, 0.0}, radius, &outline, kPi / 2.0}}, scan);
  EXPECT_NEAR(scan.ranges[180], 1.8, 1e-9);
}

}  // namespace
}  // namespace spf::sim
