#include "spf/world/occupancy_map.hpp"

#include <Eigen/Geometry>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "spf/math/angles.hpp"
#include "spf/math/random_stream.hpp"

namespace spf {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kFloat = 1e-5;  // distances are kept as float: 2^-24 of some metres, with 10 times to spare

OccupancyMap map_of(double half, double resolution = 0.1, double max_distance = 2.0) {
  return {GridFrame::covering({-half, -half}, {half, half}, resolution), max_distance};
}

Eigen::Vector2d draw_position(RandomStream& random, double half) {
  const double x = random.uniform(-half, half);
  return {x, random.uniform(-half, half)};
}

/// Distance along a ray from inside a circle of radius `radius` about the origin to the circle.
double range_to_circle(const Eigen::Vector2d& from, double angle, double radius) {
  const Eigen::Vector2d direction{std::cos(angle), std::sin(angle)};
  const double along = from.dot(direction);
  return -along + std::sqrt(along * along - from.squaredNorm() + radius * radius);
}

RangeScan sweep_of(const std::vector<double>& ranges, double max_range = 8.0) {
  RangeScan scan;
  scan.angle_min = -kPi;
  scan.angle_increment = 2.0 * kPi / static_cast<double>(ranges.size());
  scan.max_range = max_range;
  scan.ranges = ranges;
  return scan;
}

RangeScan sweep_in_circle(const Pose2& pose, double radius, std::size_t beams = 180) {
  RangeScan scan = sweep_of(std::vector<double>(beams));
  for (std::size_t k = 0; k < beams; ++k) {
    const double angle = pose.heading + scan.angle_min + static_cast<double>(k) * scan.angle_increment;
    scan.ranges[k] = range_to_circle(pose.position_world, angle, radius);
  }
  return scan;
}

void expect_distances_of_points(const OccupancyMap& map) {
  const std::vector<Eigen::Vector2d> points = map.occupied_points();
  for (int j = 0; j < map.frame().height; ++j) {
    for (int i = 0; i < map.frame().width; ++i) {
      double nearest = map.max_distance();
      for (const Eigen::Vector2d& point : points) {
        nearest = std::min(nearest, (map.node_position(i, j) - point).norm());
      }
      ASSERT_NEAR(map.node_distance(i, j), nearest, kFloat) << "node " << i << ", " << j;
    }
  }
}

TEST(GridFrame, CoversWithoutAColumnTooMany) {
  const GridFrame frame = GridFrame::covering({-15.0, -15.0}, {15.0, 15.0}, 0.1);
  EXPECT_EQ(frame.width, 301);
  EXPECT_EQ(frame.height, 301);
  EXPECT_EQ(GridFrame::covering({0.0, 0.0}, {0.25, 0.0}, 0.1).width, 4);
  EXPECT_THROW((void)GridFrame::covering({0.0, 0.0}, {-1.0, 1.0}, 0.1), std::invalid_argument);
  EXPECT_THROW((void)GridFrame::covering({0.0, 0.0}, {1e4, 1e4}, 0.1), std::invalid_argument);
}

TEST(OccupancyMap, RefusesUnusableMeasures) {
  EXPECT_THROW((OccupancyMap{GridFrame{}, 2.0}), std::invalid_argument);
  EXPECT_THROW((OccupancyMap{GridFrame::covering({0, 0}, {1, 1}, 0.1), 0.0}), std::invalid_argument);
  OccupancyMap map = map_of(1.0);
  EXPECT_THROW(map.add_box({0.0, 0.0}, {0.0, 1.0}), std::invalid_argument);
  EXPECT_THROW(map.add_disc({std::nan(""), 0.0}, 1.0), std::invalid_argument);
}

TEST(OccupancyMap, KnownShapesHaveExactDistancesAtNodes) {
  OccupancyMap map = map_of(5.0);
  map.add_box({-2.03, 0.51}, {-0.77, 1.98});
  map.add_disc({1.5, -1.0}, 0.75);
  map.add_border({-4.5, -4.0}, {4.5, 4.9});
  for (int j = 0; j < map.frame().height; ++j) {
    for (int i = 0; i < map.frame().width; ++i) {
      const Eigen::Vector2d p = map.node_position(i, j);
      const double dx = std::max(-2.03 - p.x(), p.x() + 0.77);
      const double dy = std::max(0.51 - p.y(), p.y() - 1.98);
      const double box = dx > 0.0 && dy > 0.0 ? std::hypot(dx, dy) : std::max(dx, dy);
      const double disc = std::hypot(p.x() - 1.5, p.y() + 1.0) - 0.75;
      const double ex = std::max(-4.5 - p.x(), p.x() - 4.5);
      const double ey = std::max(-4.0 - p.y(), p.y() - 4.9);
      const double border = -(ex > 0.0 && ey > 0.0 ? std::hypot(ex, ey) : std::max(ex, ey));
      const double expected = std::min({box, disc, border, 2.0});
      ASSERT_NEAR(map.node_distance(i, j), expected, kFloat) << p.transpose();
    }
  }
}

TEST(OccupancyMap, APolygonOfABoxIsTheBox) {
  OccupancyMap boxed = map_of(3.0);
  boxed.add_box({-1.0, -0.5}, {1.5, 0.7});
  OccupancyMap drawn = map_of(3.0);
  drawn.add_polygon({{-1.0, -0.5}, {-1.0, 0.7}, {1.5, 0.7}, {1.5, -0.5}});
  for (int j = 0; j < drawn.frame().height; ++j)
    for (int i = 0; i < drawn.frame().width; ++i)
      ASSERT_NEAR(drawn.node_distance(i, j), boxed.node_distance(i, j), kFloat) << i << ", " << j;
  EXPECT_THROW(drawn.add_polygon({{0.0, 0.0}, {1.0, 0.0}}), std::invalid_argument);
  EXPECT_THROW(drawn.add_polygon({{0.0, 0.0}, {1.0, 0.0}, {kInfinity, 1.0}}), std::invalid_argument);
}

TEST(OccupancyMap, GradientMatchesCentralDifferences) {
  OccupancyMap map = map_of(3.0);
  map.add_box({-1.0, -1.0}, {0.5, 0.3});
  map.add_disc({1.5, 1.2}, 0.4);
  Pose2 pose;
  pose.position_world = {1.0, -1.5};
  for (int k = 0; k < 4; ++k) map.integrate(sweep_of({0.9, 0.7, 1.1, 0.8, 1.3, kInfinity, 0.6}), pose, {});
  ASSERT_FALSE(map.occupied_points().empty());
  RandomStream random{11};
  const double step = 1e-6;
  for (int k = 0; k < 2000; ++k) {
    const Eigen::Vector2d position = draw_position(random, 3.5);  // some outside the grid
    // The interpolation is smooth within a cell; skip the few positions whose difference would straddle two
    // cells.
    const Eigen::Array2d cell = ((position - map.frame().origin_world) / map.frame().resolution).array();
    if (((cell - cell.round()).abs() < 1e-3).any()) continue;
    Eigen::Vector2d expected;
    for (int axis = 0; axis < 2; ++axis) {
      const Eigen::Vector2d shift = step * Eigen::Vector2d::Unit(axis);
      expected[axis] = (map.distance(position + shift) - map.distance(position - shift)) / (2.0 * step);
    }
    // Bilinear: no truncation error; rounding 1e-16 * some metres / 2e-6.
    EXPECT_LT((map.distance_gradient(position) - expected).norm(), 1e-8) << position.transpose();
  }
}

TEST(OccupancyMap, HoldsTheEdgeValueOutsideTheGrid) {
  OccupancyMap map = map_of(2.0);
  map.add_disc({1.8, 0.0}, 0.5);
  EXPECT_DOUBLE_EQ(map.distance({7.0, 0.33}), map.distance({2.0, 0.33}));
  EXPECT_EQ(map.distance_gradient({7.0, 0.33}).x(), 0.0);
}

TEST(OccupancyMap, CopiesShareKnownShapesUntilOneChanges) {
  OccupancyMap map = map_of(2.0);
  map.add_disc({0.0, 0.0}, 0.5);
  OccupancyMap copy = map;
  copy.add_disc({1.0, 1.0}, 0.5);
  EXPECT_NEAR(copy.distance({1.0, 1.0}), -0.5, kFloat);
  EXPECT_GT(map.distance({1.0, 1.0}), 0.8);
  EXPECT_GT(copy.revision(), map.revision());
}

TEST(OccupancyMap, SensesSurfacesAtTheirHitPoints) {
  OccupancyMap map = map_of(6.0);
  Pose2 pose;
  pose.position_world = {0.7, -0.4};
  pose.heading = 0.3;
  for (int k = 0; k < 3; ++k) map.integrate(sweep_in_circle(pose, 4.0), pose, {});
  const std::vector<Eigen::Vector2d> points = map.occupied_points();
  ASSERT_GT(points.size(), 100u);
  for (const Eigen::Vector2d& point : points)
    EXPECT_NEAR(point.norm(), 4.0, 0.018);  // half the diagonal of a part
  expect_distances_of_points(map);
}

TEST(OccupancyMap, BelievesAfterThreeReturnsNotTwo) {
  OccupancyMap map = map_of(3.0);  // odds 1.857 per hit: 3.45 after two (0.775), 6.4 after three (0.865)
  for (int k = 0; k < 2; ++k) map.integrate(sweep_of({1.0}), Pose2{}, {});
  EXPECT_TRUE(map.occupied_points().empty());
  const std::uint64_t before = map.revision();
  map.integrate(sweep_of({1.0}), Pose2{}, {});
  EXPECT_EQ(map.occupied_points().size(), 1u);
  EXPECT_GT(map.revision(), before);
}

TEST(OccupancyMap, ForgetsVanishedSurfacesExactly) {
  OccupancyMap map = map_of(6.0);
  RandomStream random{5};
  // Rooms of changing size seen from changing positions: cells appear and vanish in all orders.
  for (int k = 0; k < 60; ++k) {
    Pose2 pose;
    pose.position_world = draw_position(random, 0.5);
    pose.heading = random.uniform(-kPi, kPi);
    map.integrate(sweep_in_circle(pose, 1.5 + 0.5 * ((k / 6) % 4), 90), pose, {});
    if (k % 10 == 9) expect_distances_of_points(map);
  }
  ASSERT_FALSE(map.occupied_points().empty());
  for (int k = 0; k < 400; ++k) {
    Pose2 pose;
    pose.position_world = draw_position(random, 0.5);
    pose.heading = random.uniform(-kPi, kPi);
    map.integrate(sweep_of(std::vector<double>(180, kInfinity)), pose, {});
  }
  EXPECT_TRUE(map.occupied_points().empty());
  EXPECT_DOUBLE_EQ(map.distance({2.0, 0.0}), map.max_distance());
}

TEST(OccupancyMap, GrazingBeamsDoNotWearAwayAWall) {
  OccupancyMap map = map_of(9.0);
  // Drive along a long wall at 0.4 m; most beams meet it at a small angle.
  const double wall_y = 0.43;
  const double step = 2.0 * kPi / 180.0;
  for (int k = 0; k < 120; ++k) {
    Pose2 pose;
    pose.position_world = {-3.0 + 0.05 * k, 0.0};
    RangeScan scan = sweep_of(std::vector<double>(180, kInfinity));
    for (std::size_t b = 0; b < 180; ++b) {
      const double angle = scan.angle_min + static_cast<double>(b) * step;
      if (std::sin(angle) > 0.06) scan.ranges[b] = wall_y / std::sin(angle);
    }
    map.integrate(scan, pose, {});
  }
  // Every cell of the wall that was passed is there.
  const std::vector<Eigen::Vector2d> points = map.occupied_points();
  for (int i = -25; i <= 25; ++i) {
    const bool there = std::any_of(points.begin(), points.end(), [i](const Eigen::Vector2d& point) {
      return std::fabs(point.x() - 0.1 * i) < 0.0501;  // half a cell, and the rounding of the hit point
    });
    EXPECT_TRUE(there) << "cell at x = " << 0.1 * i;
  }
}

TEST(OccupancyMap, MaskedDiscsAreNeitherMarkedNorSeenThrough) {
  OccupancyMap map = map_of(5.0);
  const std::vector<double> wall(90, 3.0);
  for (int k = 0; k < 5; ++k) map.integrate(sweep_of(wall), Pose2{}, {});
  const std::size_t wall_cells = map.occupied_points().size();
  ASSERT_GT(wall_cells, 60u);
  const std::vector<double> person(90, 1.5);
  for (int k = 0; k < 5; ++k) map.integrate(sweep_of(person), Pose2{}, {{{0.0, 0.0}, 1.6}});
  EXPECT_EQ(map.occupied_points().size(), wall_cells);
  for (int k = 0; k < 8; ++k) map.integrate(sweep_of(person), Pose2{}, {});
  EXPECT_GT(map.occupied_points().size(), wall_cells);
}

TEST(OccupancyMap, ReturnsFromKnownShapesAreNotEnteredTwice) {
  OccupancyMap map = map_of(5.0);
  map.add_border({-4.0, -4.0}, {4.0, 4.0});
  const std::uint64_t before = map.revision();
  RangeScan scan = sweep_of(std::vector<double>(120));
  for (std::size_t b = 0; b < scan.ranges.size(); ++b) {
    const double angle = scan.angle_min + static_cast<double>(b) * scan.angle_increment;
    scan.ranges[b] = 4.0 / std::max(std::fabs(std::cos(angle)), std::fabs(std::sin(angle)));
  }
  for (int k = 0; k < 5; ++k) map.integrate(scan, Pose2{}, {});
  EXPECT_TRUE(map.occupied_points().empty());
  EXPECT_EQ(map.revision(), before);
}

TEST(OccupancyMap, BadRangesAndPosesAreSkipped) {
  OccupancyMap map = map_of(3.0);
  const RangeScan scan = sweep_of({std::nan(""), -1.0, 0.0, -kInfinity, 1e300, kInfinity});
  for (int k = 0; k < 5; ++k) map.integrate(scan, Pose2{}, {});
  Pose2 lost;
  lost.position_world = {std::nan(""), 0.0};
  for (int k = 0; k < 5; ++k) map.integrate(sweep_of({1.0}), lost, {});
  lost.position_world = {1e12, 0.0};
  for (int k = 0; k < 5; ++k) map.integrate(sweep_of({1.0}), lost, {});
  RangeScan boundless = sweep_of({1e9, kInfinity}, 1e9);
  map.integrate(boundless, Pose2{}, {});
  EXPECT_TRUE(map.occupied_points().empty());
}

/// Occupied points and every distance.
void expect_equal(const OccupancyMap& a, const OccupancyMap& b) {
  const std::vector<Eigen::Vector2d> points = a.occupied_points(), others = b.occupied_points();
  ASSERT_EQ(points.size(), others.size());
  for (std::size_t i = 0; i < points.size(); ++i) EXPECT_EQ(points[i], others[i]);
  for (int j = 0; j < a.frame().height; ++j)
    for (int i = 0; i < a.frame().width; ++i) ASSERT_EQ(a.node_distance(i, j), b.node_distance(i, j));
}

TEST(OccupancyMap, ASensorMayClaimAnyRange) {
  std::vector<double> ranges(720, kInfinity);
  for (std::size_t k = 0; k < ranges.size(); k += 3) ranges[k] = 2.5;
  for (std::size_t k = 1; k < ranges.size(); k += 9) ranges[k] = 1e300;
  OccupancyMap honest = map_of(5.0);
  for (int sweep = 0; sweep < 3; ++sweep) honest.integrate(sweep_of(ranges, 1000.0), {{0.5, 0.5}, 0.0}, {});
  ASSERT_FALSE(honest.occupied_points().empty());
  for (const double claimed : {1e9, 1e18, 1e20, 1e300, std::numeric_limits<double>::max()}) {
    OccupancyMap map = map_of(5.0);
    for (int sweep = 0; sweep < 3; ++sweep) map.integrate(sweep_of(ranges, claimed), {{0.5, 0.5}, 0.0}, {});
    expect_equal(map, honest);
  }
}

TEST(OccupancyMap, ASensorMayBeAnywhere) {
  OccupancyMap map = map_of(5.0);
  for (const double far : {30.0, 1e6, 1e18, 1e300, -1e308, std::numeric_limits<double>::max()})
    for (const double range : {8.0, 1e9, 1e300})
      map.integrate(sweep_of(std::vector<double>(360, range), 2.0 * range), {{far, -far}, 1e300}, {});
  EXPECT_EQ(map.revision(), 0u);
  EXPECT_TRUE(map.occupied_points().empty());
}

TEST(OccupancyMap, AnglesThatGrowBeyondAllNumbersEnterNothing) {
  OccupancyMap map = map_of(5.0);
  RangeScan scan = sweep_of({2.0, 2.0, 2.0});
  scan.angle_increment = 1e308;
  map.integrate(scan, Pose2{}, {});
  scan.angle_increment = 0.1;
  scan.angle_min = 1e308;
  map.integrate(scan, {{0.0, 0.0}, 1e308}, {});
  EXPECT_EQ(map.revision(), 0u);
}

TEST(OccupancyMap, LooksAtABoundedNumberOfCells) {
  // 2 * 10^7 cells for 10^5 beams: 200 of each, 20 m here.
  OccupancyMap map = map_of(30.0);
  std::vector<double> ranges(kMostBeams, 25.0);
  for (std::size_t k = 0; k < ranges.size(); k += 2) ranges[k] = 15.0;
  for (int sweep = 0; sweep < 3; ++sweep) map.integrate(sweep_of(ranges, 100.0), Pose2{}, {});
  const std::vector<Eigen::Vector2d> points = map.occupied_points();
  ASSERT_FALSE(points.empty());
  for (const Eigen::Vector2d& point : points) EXPECT_NEAR(point.norm(), 15.0, 0.1);
  ranges.push_back(5.0);  // more beams than any scanner has
  const std::uint64_t revision = map.revision();
  for (int sweep = 0; sweep < 3; ++sweep) map.integrate(sweep_of(ranges, 100.0), Pose2{}, {});
  EXPECT_EQ(map.revision(), revision);
}

TEST(OccupancyMap, SegmentsKnowWhetherTheyAreClear) {
  OccupancyMap map = map_of(6.0);
  RandomStream random{21};
  for (int k = 0; k < 6; ++k) map.add_disc(draw_position(random, 5.0), random.uniform(0.2, 0.8));
  map.add_box({-1.0, -2.0}, {0.5, -1.2});
  for (int k = 0; k < 500; ++k) {
    const Eigen::Vector2d a = draw_position(random, 6.0);
    const Eigen::Vector2d b = draw_position(random, 6.0);
    double lowest = kInfinity;
    for (int s = 0; s <= 4000; ++s) lowest = std::min(lowest, map.distance(a + s / 4000.0 * (b - a)));
    // Looks every 2.5 cm at least; between two looks the distance dips by at most half of that at slope 1.
    const double clearance = random.uniform(0.1, 0.6);
    if (std::fabs(lowest - clearance) > 0.0126) {
      EXPECT_EQ(map.segment_clear(a, b, clearance), lowest >= clearance) << "case " << k;
    }
  }
}

TEST(OccupancyMap, KnowsDistancesBetweenSurfacesBetterThanByInterpolation) {
  RandomStream random{41};
  double worst = 0.0;
  double worst_interpolated = 0.0;
  for (int k = 0; k < 200; ++k) {
    OccupancyMap map = map_of(2.0);
    const double half = random.uniform(0.3, 0.6);
    const double middle = random.uniform(-0.3, 0.3);
    const bool pillars = k % 2 == 0;
    if (pillars) {
      map.add_disc({0.0, middle + half + 0.075}, 0.075);
      map.add_disc({0.0, middle - half - 0.075}, 0.075);
    } else {
      map.add_box({-3.0, middle + half}, {3.0, 3.0});
      map.add_box({-3.0, -3.0}, {3.0, middle - half});
    }
    for (int i = 0; i < 50; ++i) {
      const Eigen::Vector2d point{random.uniform(-0.1, 0.1), middle + random.uniform(-0.1, 0.1)};
      const double expected = pillars
                                  ? std::min((point - Eigen::Vector2d{0.0, middle + half + 0.075}).norm(),
                                             (point - Eigen::Vector2d{0.0, middle - half - 0.075}).norm()) -
                                        0.075
                                  : half - std::fabs(point.y() - middle);
      worst = std::max(worst, std::fabs(map.exact_distance(point) - expected));
      worst_interpolated = std::max(worst_interpolated, std::fabs(map.distance(point) - expected));
    }
  }
  EXPECT_LT(worst, 0.012);
  EXPECT_GT(worst_interpolated, 0.04);
}

TEST(OccupancyMap, KnowsSurfacesExactlyUntilItSensesThem) {
  OccupancyMap map{GridFrame::covering({-2.0, -2.0}, {2.0, 2.0}, 0.1), 1.0};
  map.add_box({1.0, -1.0}, {1.5, 1.0});
  EXPECT_EQ(map.surface_error(), 0.0);
  RangeScan scan;
  scan.angle_min = 0.0;
  scan.angle_increment = 0.1;
  scan.ranges = {0.8, 0.8};
  map.integrate(scan, Pose2{{-1.5, 0.0}, 0.0}, {});
  EXPECT_DOUBLE_EQ(map.surface_error(), 0.0125);
}

TEST(OccupancyMap, KeepsOutTheReturnsOfFlaggedBeamsAndKnowsWhatWasFree) {
  OccupancyMap map{GridFrame::covering({-5.0, -5.0}, {5.0, 5.0}, 0.1), 2.0};
  EXPECT_FALSE(map.seen_free({1.0, 0.0}));
  RangeScan scan;
  scan.angle_min = -0.25;
  scan.angle_increment = 0.01;
  scan.ranges.assign(51, 3.0);
  std::vector<std::uint8_t> kept_out(51, 0);
  for (std::size_t beam = 25; beam < 51; ++beam) kept_out[beam] = 1;
  for (int sweep = 0; sweep < 5; ++sweep) map.integrate(scan, {{0.0, 0.0}, 0.0}, {}, &kept_out);
  EXPECT_LT(map.distance(3.0 * Eigen::Vector2d{std::cos(-0.15), std::sin(-0.15)}), 0.1);
  EXPECT_GT(map.distance(3.0 * Eigen::Vector2d{std::cos(0.2), std::sin(0.2)}), 0.4);
  EXPECT_TRUE(map.seen_free({1.5, 0.0}));
  EXPECT_FALSE(map.seen_free({3.0, -0.45}));  // on the surface
  EXPECT_FALSE(map.seen_free({0.0, 2.0}));    // no beam went there
}

TEST(OccupancyMap, HoldsRectanglesThatAreTurned) {
  RandomStream random{31};
  for (int k = 0; k < 10; ++k) {
    const Pose2 frame{draw_position(random, 2.0), random.uniform(-kPi, kPi)};
    const Eigen::Rotation2Dd turn{frame.heading};
    OccupancyMap map = map_of(6.0);
    map.add_box({-0.5, -1.0}, {1.5, 0.3}, frame);
    map.add_border({-3.0, -3.0}, {3.0, 3.0}, frame);
    OccupancyMap straight = map_of(12.0, 0.02, 2.0);
    straight.add_box({-0.5, -1.0}, {1.5, 0.3});
    straight.add_border({-3.0, -3.0}, {3.0, 3.0});
    for (int i = 0; i < 200; ++i) {
      const Eigen::Vector2d position = draw_position(random, 3.0);
      const Eigen::Vector2d here = frame.position_world + turn * position;
      if (here.lpNorm<Eigen::Infinity>() > 5.9) continue;
      // Interpolation beside a corner may read up to resolution^2 / (4 d) too much, inside a ridge likewise.
      EXPECT_NEAR(map.distance(here), straight.distance(position), 0.06) << here.transpose();
    }
  }
  OccupancyMap map = map_of(6.0);
  EXPECT_THROW(map.add_box({1.0, 1.0}, {1.0, 2.0}, Pose2{}), std::invalid_argument);
  EXPECT_THROW(map.add_border({1.0, 1.0}, {0.0, 2.0}, Pose2{}), std::invalid_argument);
}

TEST(OccupancyMap, TakesOverWhatWasSensed) {
  OccupancyMap before = map_of(6.0);
  for (int k = 0; k < 5; ++k) before.integrate(sweep_in_circle(Pose2{}, 3.0), Pose2{}, {});
  ASSERT_GT(before.occupied_points().size(), 50u);
  ASSERT_TRUE(before.seen_free({0.5, 0.0}));

  OccupancyMap same = map_of(6.0);
  same.add_box({4.0, 4.0}, {5.0, 5.0});
  same.take_over_sensed(before);
  EXPECT_GT(same.revision(), before.revision());
  EXPECT_EQ(same.occupied_points().size(), before.occupied_points().size());
  EXPECT_TRUE(same.seen_free({0.5, 0.0}));
  EXPECT_LT(same.distance({4.5, 4.5}), 0.0);
  EXPECT_LT(same.distance({3.0, 0.0}), 0.1);
  EXPECT_GT(same.known_distance({3.0, 0.0}), 1.0);  // what is known has nothing there
  EXPECT_LT(same.known_distance({4.5, 4.5}), 0.0);

  const Pose2 moved{{1.0, -0.5}, 0.7};
  OccupancyMap elsewhere = map_of(7.0, 0.08);
  elsewhere.take_over_sensed(before, moved);
  EXPECT_GT(elsewhere.occupied_points().size(), before.occupied_points().size() / 2);
  for (const Eigen::Vector2d& point : elsewhere.occupied_points())
    EXPECT_NEAR((point - moved.position_world).norm(), 3.0, 0.08);
  expect_distances_of_points(elsewhere);

  OccupancyMap known = map_of(6.0);  // the half of the circle that is a wall here
  known.add_box({0.0, -5.0}, {5.0, 5.0});
  known.add_box({-1.0, -5.0}, {0.0, -2.0});
  known.take_over_sensed(before, {{0.01, 0.0}, 0.0});
  for (const Eigen::Vector2d& point : known.occupied_points()) EXPECT_LT(point.x(), 0.0);

  OccupancyMap nothing = map_of(6.0);
  nothing.take_over_sensed(map_of(6.0), moved);
  EXPECT_FALSE(nothing.sensed());
}

}  // namespace
}  // namespace spf
