// Maps of cells, of any origin, turn and grain; and robots whose map changes under way.
#include "host/cell_map.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "host/bench_test.hpp"
#include "host/robot_map.hpp"

namespace spf::host {
namespace {

struct Cells {
  Pose2 origin;
  double resolution;
  std::size_t width, height;
  std::vector<std::int8_t> values = std::vector<std::int8_t>(width * height, 0);

  [[nodiscard]] CellMap view() const { return {origin, resolution, width, height, &values}; }
  /// Occupies the rectangle of these corners in the map's own frame [m].
  void occupy(const Eigen::Vector2d& low, const Eigen::Vector2d& high) {
    for (std::size_t j = 0; j < height; ++j)
      for (std::size_t i = 0; i < width; ++i) {
        const Eigen::Vector2d centre =
            resolution * Eigen::Vector2d{static_cast<double>(i) + 0.5, static_cast<double>(j) + 0.5};
        if ((centre.array() > low.array()).all() && (centre.array() < high.array()).all())
          values[j * width + i] = 100;
      }
  }
};

TEST(CellMap, IsTheSameHoweverItLiesInItsFrame) {
  const HostParameters host;
  for (const double resolution : {0.02, 0.05, 0.1, 0.25}) {
    for (const double heading : {0.0, 0.3, 1.5707963, -2.5, 3.14159265}) {
      Cells cells{{{3.0, -7.0}, heading},
                  resolution,
                  static_cast<std::size_t>(std::lround(10.0 / resolution)),
                  static_cast<std::size_t>(std::lround(6.0 / resolution))};
      cells.occupy({4.0, 2.0}, {5.0, 4.0});
      cells.values[0] = -1;  // unknown is free
      const OccupancyMap map = map_of_cells(cells.view(), host);
      const auto distance = [&](double x, double y) {
        return map.distance(cells.origin.position_world +
                            Eigen::Rotation2Dd{heading} * Eigen::Vector2d{x, y});
      };
      const double slack = 0.5 * map.frame().resolution;
      EXPECT_NEAR(distance(3.2, 3.0), 0.8, slack) << resolution << ", " << heading;
      EXPECT_NEAR(distance(4.5, 1.2), 0.8, slack) << resolution << ", " << heading;
      EXPECT_LT(distance(4.5, 3.0), 0.01) << resolution << ", " << heading;
      EXPECT_NEAR(distance(8.5, 0.5), 0.5, slack) << resolution << ", " << heading;  // the edge
      EXPECT_NEAR(distance(9.5, 4.0), 0.5, slack) << resolution << ", " << heading;
      EXPECT_LT(distance(10.3, 3.0), 0.1) << resolution << ", " << heading;  // the world has ended
    }
  }
}

TEST(CellMap, IsCoveredByFewBlocks) {
  Cells cells{{{0.0, 0.0}, 0.0}, 1.0, 40, 30};
  cells.occupy({2.0, 3.0}, {20.0, 6.0});    // a wall along x,
  cells.occupy({18.0, 6.0}, {20.0, 25.0});  // one along y that joins it,
  cells.occupy({30.0, 10.0}, {31.0, 11.0});
  EXPECT_EQ(occupied_blocks(cells.view()).size(), 3u);
  for (std::size_t i = 0; i < cells.values.size(); i += 7) cells.values[i] = 50;  // and noise
  std::vector<int> covered(cells.values.size(), 0);
  for (const CellBlock& block : occupied_blocks(cells.view()))
    for (std::size_t row = block.first_row; row < block.end_row; ++row)
      for (std::size_t column = block.first_column; column < block.end_column; ++column)
        ++covered[row * cells.width + column];
  for (std::size_t i = 0; i < covered.size(); ++i) ASSERT_EQ(covered[i], cells.values[i] >= 50 ? 1 : 0) << i;
}

TEST(CellMap, IsRefusedByName) {
  const HostParameters host;
  const auto refusal = [&](const Cells& cells) -> std::string {
    try {
      (void)map_of_cells(cells.view(), host);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return {};
  };
  Cells good{{{0.0, 0.0}, 0.0}, 0.1, 10, 10};
  EXPECT_EQ(refusal(good), "");
  Cells bad = good;
  bad.values.pop_back();
  EXPECT_EQ(refusal(bad), "data has 99 entries, not 100");
  bad = good;
  bad.resolution = 0.0;
  EXPECT_EQ(refusal(bad), "resolution is not above 0");
  bad = good;
  bad.origin.heading = NAN;
  EXPECT_EQ(refusal(bad), "its origin is not finite");
  bad = good;
  bad.width = std::size_t{1} << 40U;
  EXPECT_EQ(refusal(bad), "it has no cells, or too many");
  bad = good;
  bad.resolution = 1e9;
  EXPECT_EQ(refusal(bad), "it reaches farther than any robot goes");
  bad = good;
  bad.origin.position_world.x() = 1e300;
  EXPECT_EQ(refusal(bad), "it reaches farther than any robot goes");
}

class MapsUnderWay : public ::testing::TestWithParam<Arrangement> {};
INSTANTIATE_TEST_SUITE_P(Both, MapsUnderWay, testing::Values(Arrangement::one_process, Arrangement::split),
                         name_of);

/// As open_map(), with walls.
OccupancyMap map_with(const std::vector<std::pair<Eigen::Vector2d, Eigen::Vector2d>>& walls,
                      double size = 20.0) {
  OccupancyMap map{GridFrame::covering({-size, -size}, {size, size}, 0.1), 2.0};
  for (const auto& [low, high] : walls) map.add_box(low, high);
  return map;
}

TEST_P(MapsUnderWay, AMapThatIsToldAgainStopsNobody) {
  Bench bench{GetParam()};
  bench.drive();
  int number = 0;
  bench.each_tenth = [&] {
    if (++number % 5 != 0) return;
    // A map that grows, far away, and now and then is the same again.
    bench.planner.set_map(map_with({{{-19.0, 10.0}, {-18.0, 11.0 + 0.1 * (number % 3)}}}, 20.0 + number % 4));
  };
  for (int i = 0; i < 500; ++i) {
    bench.tick();
    ASSERT_GT(bench.speed(), 0.85) << i << ": " << bench.reason();
  }
  EXPECT_EQ(bench.planner.counts().restarts, 1u);
}

TEST_P(MapsUnderWay, AWallThatAppearsInTheWayIsDrivenAround) {
  Bench bench{GetParam()};
  bench.drive();
  const double x = bench.pose.position_world.x() + 3.0;
  bench.planner.set_map(map_with({{{x, -2.0}, {x + 0.3, 2.0}}}));
  double clearance = 1e9;
  for (int i = 0; i < 1500; ++i) {
    bench.tick();
    const Eigen::Vector2d at = bench.pose.position_world;
    const Eigen::Vector2d nearest{std::clamp(at.x(), x, x + 0.3), std::clamp(at.y(), -2.0, 2.0)};
    clearance = std::min(clearance, (at - nearest).norm() - 0.3);
  }
  EXPECT_GT(clearance, 0.0);
  EXPECT_GT(bench.pose.position_world.x(), x + 0.5) << bench.reason();
}

TEST_P(MapsUnderWay, WhatWasSensedIsKeptOnAnotherMap) {
  for (const double size : {20.0, 25.0}) {
    HostParameters parameters;
    parameters.relies_on_scan = false;
    Bench bench{GetParam(), parameters};
    bench.pillars = {{{2.0, 1.0}, 0.4}};
    bench.run(2.0);
    ASSERT_LT(bench.planner.map()->distance({1.65, 0.81}), 0.1);
    bench.send_scans = false;
    bench.planner.set_map(map_with({}, size));
    bench.run(1.0);
    EXPECT_LT(bench.planner.map()->distance({1.65, 0.81}), 0.1) << size;
    EXPECT_GT(bench.planner.map()->distance({-3.0, -3.0}), 1.5);
  }
}

// The pillar was seen from where the robot was thought to be; when it is found to be elsewhere, so is the
// pillar.
TEST_P(MapsUnderWay, ARelocalisationMovesWhatWasSensed) {
  HostParameters parameters;
  parameters.relies_on_scan = false;
  Bench bench{GetParam(), parameters};
  bench.pillars = {{{2.0, 1.0}, 0.4}};
  bench.run(2.0);
  const std::size_t seen = bench.planner.map()->occupied_points().size();
  ASSERT_GT(seen, 3u);
  bench.send_scans = false;
  const Pose2 correction{{1.0, -3.0}, 0.6};
  bench.distort = [&](const Pose2& truth) {
    return Pose2{correction.position_world + Eigen::Rotation2Dd{correction.heading} * truth.position_world,
                 wrap_angle(truth.heading + correction.heading)};
  };
  bench.run(4.0);
  ASSERT_NE(bench.planner.agent(), nullptr) << bench.reason();
  EXPECT_EQ(bench.planner.counts().restarts, 2u);
  const std::vector<Eigen::Vector2d> points = bench.planner.map()->occupied_points();
  EXPECT_GT(points.size(), seen / 2);
  const Eigen::Vector2d centre = bench.distort({{2.0, 1.0}, 0.0}).position_world;
  for (const Eigen::Vector2d& point : points) EXPECT_NEAR((point - centre).norm(), 0.4, 0.06);
}

TEST_P(MapsUnderWay, SmallCorrectionsOfTheLocalisationStopNobody) {
  Bench bench{GetParam()};
  bench.drive();
  Eigen::Vector2d drift = Eigen::Vector2d::Zero();
  int number = 0;
  bench.distort = [&](const Pose2& truth) { return Pose2{truth.position_world + drift, truth.heading}; };
  bench.each_tenth = [&] {
    if (++number % 5 == 0) drift.y() += number % 10 == 0 ? 0.05 : -0.05;
  };
  for (int i = 0; i < 500; ++i) {
    bench.tick();
    ASSERT_GT(bench.speed(), 0.7) << i << ": " << bench.reason();
  }
  EXPECT_EQ(bench.planner.counts().restarts, 1u);
}

}  // namespace
}  // namespace spf::host
