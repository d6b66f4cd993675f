#include "sim/static_map.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <memory>
#include <stdexcept>

#include "sim/geometry.hpp"
#include "sim/simulation.hpp"
#include "spf/math/random_stream.hpp"

namespace spf::sim {
namespace {

using testing::HasSubstr;

/// Two rooms of 4 m x 6 m beside each other, with a door of 1.6 m in the wall between them.
StaticMap two_rooms(const Pose2& origin, double cell = 0.1) {
  const auto cells = [cell](double length) { return static_cast<std::size_t>(std::lround(length / cell)); };
  const std::size_t width = cells(8.0);
  const std::size_t height = cells(6.0);
  std::vector<std::int8_t> values(width * height, 0);
  for (std::size_t row = 0; row < height; ++row)
    for (std::size_t column = cells(3.8); column < cells(4.2); ++column)
      if (row < cells(2.2) || row >= cells(3.8)) values[row * width + column] = 100;
  values[0] = -1;  // unknown is no wall
  return {origin, cell, width, height, values};
}

TEST(StaticMap, HasFacesWhereFreeCellsEnd) {
  const StaticMap map = two_rooms({});
  double length = 0.0;
  for (const Segment& face : map.faces()) {
    EXPECT_LE((face.to - face.from).norm(), StaticMap::kLongestFace + 1e-9);
    length += (face.to - face.from).norm();
  }
  // The edges but for the ends of the wall, its two sides, and the two ends at the door.
  EXPECT_NEAR(length, 2.0 * (8.0 + 6.0) - 2.0 * 0.4 + 4.0 * 2.2 + 2.0 * 0.4, 1e-9);
  EXPECT_LT(map.faces().size(), 20u);
}

TEST(StaticMap, IsTheSameHoweverItLies) {
  const StaticMap upright = two_rooms({});
  const Pose2 pose{{-3.0, 12.0}, 2.2};
  const StaticMap turned = two_rooms(pose);
  RandomStream random{11};
  for (int k = 0; k < 500; ++k) {
    const Eigen::Vector2d at{random.uniform(-1.0, 9.0), random.uniform(-1.0, 7.0)};
    const Eigen::Vector2d there = pose.position_world + Eigen::Rotation2Dd{pose.heading} * at;
    EXPECT_EQ(turned.occupied(there), upright.occupied(at)) << at.transpose();
    const auto nearest = [](const StaticMap& map, const Eigen::Vector2d& position) {
      double distance = 1e9;
      for (const Segment& face : map.faces())
        distance = std::min(distance, distance_to_segment(position, face));
      return distance;
    };
    EXPECT_NEAR(nearest(turned, there), nearest(upright, at), 1e-9) << at.transpose();
  }
  EXPECT_TRUE(upright.occupied({4.0, 1.0}));
  EXPECT_FALSE(upright.occupied({4.0, 3.0}));
  EXPECT_FALSE(upright.occupied({0.05, 0.05}));
  EXPECT_TRUE(upright.occupied({-0.01, 3.0}));
  EXPECT_TRUE(upright.occupied({NAN, 3.0}));
}

TEST(StaticMap, RefusesNoise) {
  const std::size_t side = 1024;
  std::vector<std::int8_t> values(side * side, 0);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = (i + i / side) % 2 == 0 ? 100 : 0;
  try {
    const StaticMap map{{}, 0.05, side, side, values};
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), HasSubstr("more than 524288 faces"));
  }
}

Scenario in_two_rooms(double heading) {
  Scenario scenario;
  const Pose2 origin{{2.0, -1.0}, heading};
  scenario.map = std::make_shared<const StaticMap>(two_rooms(origin));
  const auto at = [&](double x, double y) -> Eigen::Vector2d {
    return origin.position_world + Eigen::Rotation2Dd{heading} * Eigen::Vector2d{x, y};
  };
  scenario.robots = {{{at(1.0, 5.0), 0.0}, at(7.0, 5.0), std::nullopt}};
  return scenario;
}

TEST(StaticMap, RobotsKnowItAsItIs) {
  for (const double heading : {0.0, 0.7}) {
    const Scenario scenario = in_two_rooms(heading);
    ASSERT_TRUE(problems_of(scenario).empty());
    const OccupancyMap map = robot_map(scenario);
    const StaticShapes truth{scenario};
    RandomStream random{12};
    for (int k = 0; k < 300; ++k) {
      const Eigen::Vector2d at = scenario.robots[0].start.position_world +
                                 Eigen::Vector2d{random.uniform(-6.0, 8.0), random.uniform(-6.0, 8.0)};
      if (scenario.map->occupied(at)) continue;
      const double distance = std::min(truth.clearance(at, 0.0), map.max_distance());
      EXPECT_NEAR(map.distance(at), distance, 0.06) << heading << ": " << at.transpose();
    }
  }
}

TEST(StaticMap, RefusesRobotsInWalls) {
  Scenario scenario = in_two_rooms(0.0);
  const auto first_problem = [&scenario] {
    const std::vector<ScenarioProblem> found = problems_of(scenario);
    return found.empty() ? std::string{} : to_text(found.front());
  };
  scenario.robots[0].goal_world = {6.0, 0.0};
  EXPECT_EQ(first_problem(), "robots[0].goal is in an occupied cell of the map, or beyond its edges");
  scenario.robots[0].goal_world = {5.6, 0.0};
  EXPECT_THAT(first_problem(),
              HasSubstr("robots[0].goal is 0.2 m from a wall of the map, less than the radius"));
  scenario.robots[0].goal_world = {50.0, 0.0};
  EXPECT_THAT(first_problem(), HasSubstr("beyond its edges"));
}

TEST(StaticMap, ARobotDrivesThroughTheDoor) {
  for (const double heading : {0.0, 0.7})
    for (const MapKnowledge knowledge : {MapKnowledge::known, MapKnowledge::sensed}) {
      Scenario scenario = in_two_rooms(heading);
      scenario.simulation.sensing.map = knowledge;
      const TrialResult result = Simulation{scenario, AgentParameters{}}.run();
      EXPECT_EQ(result.outcome, TrialOutcome::success) << heading << ", " << enum_name(knowledge);
    }
}

}  // namespace
}  // namespace spf::sim
