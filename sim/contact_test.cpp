#include "sim/contact.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>

#include "sim/geometry.hpp"
#include "spf/math/random_stream.hpp"

namespace spf::sim {
namespace {

constexpr int kSamples = 4000;  // of one step, by brute force

Eigen::Vector2d draw(RandomStream& random, double extent) {
  const double x = random.uniform(-extent, extent);
  const double y = random.uniform(-extent, extent);
  return {x, y};
}

Motion draw_motion(RandomStream& random) {
  Motion motion;
  motion.from = draw(random, 1.0);
  motion.to = draw(random, 1.0);
  return motion;
}

TEST(Contact, SweptDistanceAndFirstContactMatchSampling) {
  RandomStream random{21};
  int hits = 0;
  for (int i = 0; i < 500; ++i) {
    SCOPED_TRACE(i);
    const Motion a = draw_motion(random);
    const Motion b = draw_motion(random);
    const double reach = random.uniform(0.05, 0.6);
    double least = 1e9;
    double first = -1.0;
    for (int k = 0; k <= kSamples; ++k) {
      const double share = static_cast<double>(k) / kSamples;
      const double distance = (a.at(share) - b.at(share)).norm();
      least = std::min(least, distance);
      if (first < 0.0 && distance < reach) first = share;
    }
    // Relative speed up to 6 m a step: a sample is at most 6 / 4000 / 2 m from the least distance.
    EXPECT_NEAR(swept_distance(a, b), least, 1e-3);
    EXPECT_LE(swept_distance(a, b), least + 1e-12);
    const std::optional<double> found = first_within(a, b, reach);
    if (first >= 0.0) {
      ++hits;
      ASSERT_TRUE(found);
      EXPECT_LE(*found, first + 1e-12);
      // Just touching at the found share, unless it began inside.
      if (*found > 0.0) {
        EXPECT_NEAR((a.at(*found) - b.at(*found)).norm(), reach, 1e-9);
      }
    } else if (found) {
      EXPECT_LT(least - reach, 1e-3);  // a graze between two samples
    }
  }
  EXPECT_GT(hits, 100);
  EXPECT_LT(hits, 400);
}

TEST(Contact, StaticShapesMatchSampling) {
  RandomStream random{22};
  int hits = 0;
  for (int i = 0; i < 500; ++i) {
    SCOPED_TRACE(i);
    Scenario scenario;
    scenario.border = square(Eigen::Vector2d::Zero(), 2.2);
    scenario.boxes = {square(draw(random, 1.0), random.uniform(0.1, 0.5))};
    scenario.discs = {{draw(random, 1.0), random.uniform(0.05, 0.3)}};
    scenario.walls = {{draw(random, 1.0), draw(random, 1.0)}};
    const double radius = random.uniform(0.02, 0.2);
    const Motion motion = draw_motion(random);
    const StaticShapes shapes{scenario};
    double first = -1.0;
    double least = 1e9;
    for (int k = 0; k <= kSamples; ++k) {
      const double share = static_cast<double>(k) / kSamples;
      const Eigen::Vector2d position = motion.at(share);
      const double clearance =
          std::min({depth_inside(position, *scenario.border), distance_to_box(position, scenario.boxes[0]),
                    (position - scenario.discs[0].center).norm() - scenario.discs[0].radius,
                    distance_to_segment(position, scenario.walls[0])}) -
          radius;
      EXPECT_NEAR(shapes.clearance(position, radius), clearance, 1e-12);
      least = std::min(least, clearance);
      if (first < 0.0 && clearance < 0.0) first = share;
    }
    const std::optional<Contact> found = shapes.first_contact(motion, radius);
    if (first >= 0.0) {
      ++hits;
      ASSERT_TRUE(found);
      EXPECT_LE(found->time, first + 1e-9);
      if (found->time > 0.0) {
        EXPECT_NEAR(shapes.clearance(found->position_world, radius), 0.0, 1e-6);
      }
    } else if (found) {
      EXPECT_LT(least, 1e-3);
    }
  }
  EXPECT_GT(hits, 100);
}

/// A convex shape drawn as a polygon is met when and where the shape itself is.
TEST(Contact, PolygonsAndMapsAreMetLikeBoxes) {
  RandomStream random{23};
  const double cell = 0.25;
  int hits = 0;
  for (int i = 0; i < 500; ++i) {
    SCOPED_TRACE(i);
    Scenario boxed;
    const Eigen::Vector2d low = cell * (draw(random, 1.0) / cell).array().floor().matrix();
    boxed.boxes = {{low, low + Eigen::Vector2d{2.0 * cell, 3.0 * cell}}};
    Scenario drawn;
    const Box& box = boxed.boxes.front();
    drawn.polygons = {{{box.low, {box.low.x(), box.high.y()}, box.high, {box.high.x(), box.low.y()}}}};
    Scenario mapped;
    const Eigen::Vector2d corner{-5.0, -5.0};
    std::vector<std::int8_t> values(40 * 40, 0);
    const Eigen::Vector2d first = (low - corner) / cell;
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 2; ++column)
        values[static_cast<std::size_t>((std::lround(first.y()) + row) * 40 + std::lround(first.x()) +
                                        column)] = 100;
    mapped.map = std::make_shared<const StaticMap>(Pose2{corner, 0.0}, cell, 40, 40, values);
    const double radius = random.uniform(0.02, 0.2);
    Motion motion = draw_motion(random);
    const StaticShapes boxes{boxed};
    if (boxes.clearance(motion.from, 0.0) <= 0.0) continue;
    const std::optional<Contact> expected = boxes.first_contact(motion, radius);
    hits += expected ? 1 : 0;
    for (const Scenario* scenario : {&drawn, &mapped}) {
      const StaticShapes shapes{*scenario};
      EXPECT_NEAR(shapes.clearance(motion.from, radius, 2.0), boxes.clearance(motion.from, radius, 2.0),
                  1e-9);
      const std::optional<Contact> found = shapes.first_contact(motion, radius);
      ASSERT_EQ(found.has_value(), expected.has_value());
      if (!found) continue;
      EXPECT_NEAR(found->time, expected->time, 1e-6);
      EXPECT_EQ(found->with, scenario == &drawn ? ContactWith::polygon : ContactWith::map);
      EXPECT_EQ(found->other, scenario == &drawn ? 0 : -1);
    }
  }
  EXPECT_GT(hits, 50);
}

TEST(Contact, NamesWhatWasTouchedFirst) {
  Scenario scenario;
  scenario.border = square(Eigen::Vector2d::Zero(), 20.0);
  scenario.boxes = {square({5.0, 0.0}, 1.0), square({2.0, 0.0}, 1.0)};
  const StaticShapes shapes{scenario};
  const auto at_box = shapes.first_contact({{0.0, 0.0}, {10.0, 0.0}}, 0.25);
  ASSERT_TRUE(at_box);
  EXPECT_EQ(at_box->with, ContactWith::box);
  EXPECT_EQ(at_box->other, 1);
  EXPECT_NEAR(at_box->time, 0.125, 1e-9);
  const auto at_border = shapes.first_contact({{0.0, 0.0}, {0.0, 10.0}}, 0.25);
  ASSERT_TRUE(at_border);
  EXPECT_EQ(at_border->with, ContactWith::border);
  EXPECT_NEAR(at_border->time, 0.975, 1e-9);
  EXPECT_FALSE(shapes.first_contact({{0.0, 0.0}, {1.0, 0.0}}, 0.25));
}

TEST(UniformGrid, ReportsEveryNearPointOnce) {
  RandomStream random{23};
  std::vector<Eigen::Vector2d> points;
  for (int i = 0; i < 300; ++i) points.push_back(draw(random, 20.0));
  points.push_back(points[5]);
  UniformGrid grid{1.5};
  grid.assign(points);
  for (const double radius : {0.0, 0.7, 3.0, 100.0, std::numeric_limits<double>::infinity()}) {
    const Eigen::Vector2d position = draw(random, 20.0);
    std::vector<int> visits(points.size(), 0);
    grid.visit(position, radius, [&](int index) { ++visits[static_cast<std::size_t>(index)]; });
    for (std::size_t i = 0; i < points.size(); ++i) {
      EXPECT_LE(visits[i], 1);
      if ((points[i] - position).norm() <= radius) {
        EXPECT_EQ(visits[i], 1);
      }
    }
  }
}

}  // namespace
}  // namespace spf::sim
