#include "spf/team/beliefs.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "spf/math/plane.hpp"
#include "spf/team/ideal_host_test.hpp"
#include "spf/team/schedule.hpp"

namespace spf {
namespace {

/// What a robot at the origin sees 2 m ahead, in one beam, sent ten times.
class BeliefsTest : public ::testing::Test {
 protected:
  std::size_t occupied_after(const std::function<void(double, Observation&)>& more) {
    for (int k = 1; k <= 10; ++k) {
      const double time = 0.1 * k;
      Observation observation;
      observation.time = time;
      RangeScan scan;
      scan.angle_min = -0.05;
      scan.angle_increment = 0.05;
      scan.ranges = {2.0, 2.0, 2.0};
      observation.scan = scan;
      more(time, observation);
      beliefs.refresh(time);
      beliefs.observe(observation, Pose2{{0.0, 0.0}, 0.0}, observation.time);
    }
    return beliefs.map().occupied_points().size();
  }
  Beliefs beliefs{1, AgentParameters{}, empty_map()};
};

TEST_F(BeliefsTest, WhatIsSeenWhereNobodyMovesIsStatic) {
  const std::size_t before = beliefs.map().occupied_points().size();
  EXPECT_GT(occupied_after([](double, Observation&) {}), before);
}

TEST_F(BeliefsTest, ATrackedObstacleMasksItsReturns) {
  const std::size_t before = beliefs.map().occupied_points().size();
  EXPECT_EQ(occupied_after([](double, Observation& observation) {
              observation.detections.push_back({5, {2.4, 0.0}, std::nullopt, 0.4, 0.0});
            }),
            before);
  EXPECT_EQ(beliefs.tracks().size(), 1U);
}

TEST_F(BeliefsTest, APeerMasksItsReturnsUnlessItIsDistrusted) {
  std::uint32_t sequence = 0;
  const auto hear = [&](double time, Observation&) {
    beliefs.hear(
        told_by(7, ++sequence, time, PeerState::stopped, Trajectory::standing({2.3, 0.0}, time, 1.0)), time);
  };
  const std::size_t before = beliefs.map().occupied_points().size();
  EXPECT_EQ(occupied_after(hear), before);
  beliefs.set_distrusted({7});
  beliefs.refresh(1.0);
  for (int k = 11; k <= 20; ++k) {
    Observation observation;
    observation.time = 0.1 * k;
    RangeScan scan;
    scan.angle_min = -0.05;
    scan.angle_increment = 0.05;
    scan.ranges = {2.0, 2.0, 2.0};
    observation.scan = scan;
    beliefs.observe(observation, Pose2{{0.0, 0.0}, 0.0}, observation.time);
  }
  EXPECT_GT(beliefs.map().occupied_points().size(), before);
}

TEST_F(BeliefsTest, WithoutAPoseAScanEntersNoMap) {
  Observation observation;
  observation.time = 0.1;
  observation.scan.emplace();
  observation.scan->ranges = {2.0, 2.0};
  const std::uint64_t revision = beliefs.map().revision();
  beliefs.observe(observation, std::nullopt, observation.time);
  EXPECT_EQ(beliefs.map().revision(), revision);
}

TEST(Timeliness, IsOfObservationsThatTellAboutThePresent) {
  constexpr double kStale = 0.3;
  for (const double age : {0.0, kStale, -0.05})
    EXPECT_EQ(timeliness(10.0 - age, 10.0, kStale), Timeliness::timely) << age;
  for (const double age : {kStale + 0.01, 5.0, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_EQ(timeliness(10.0 - age, 10.0, kStale), Timeliness::late) << age;
  EXPECT_EQ(timeliness(10.2, 10.0, kStale), Timeliness::ahead);
  EXPECT_EQ(timeliness(10.05, 10.0, kStale, 0.02), Timeliness::ahead);
  EXPECT_EQ(timeliness(10.2, 10.0, kStale, 5.0), Timeliness::ahead);  // whatever the host tolerates
}

TEST_F(BeliefsTest, IgnoreObservationsThatDoNotTellAboutThePresent) {
  Observation observation;
  observation.detections.resize(1);
  for (const double time : {9.0, 11.0, std::numeric_limits<double>::quiet_NaN()}) {
    observation.time = time;
    beliefs.observe(observation, std::nullopt, 10.0);
    beliefs.refresh(10.0);
    EXPECT_TRUE(beliefs.tracks().empty()) << time;
  }
  observation.time = 10.0;
  beliefs.observe(observation, std::nullopt, 10.0);
  beliefs.refresh(10.0);
  EXPECT_EQ(beliefs.tracks().size(), 1u);
}

TEST_F(BeliefsTest, TheSnapshotHoldsTheRobotsOwnRank) {
  AgentParameters parameters;
  parameters.team.priority = 4;
  const Beliefs mine{6, parameters, empty_map()};
  EXPECT_EQ(mine.snapshot(1.0).rank().priority, 4);
  EXPECT_EQ(mine.snapshot(1.0).rank().robot_id, 6);
}

/// A robot at the origin whose scans alone show a disc that drives past.
class ScansAlone : public ::testing::Test {
 protected:
  void look(const Eigen::Vector2d& disc, double radius) {
    time += 0.1;
    Observation observation;
    observation.time = time;
    RangeScan& scan = observation.scan.emplace();
    scan.angle_min = -3.14159265358979;
    scan.angle_increment = 2.0 * 3.14159265358979 / 720;
    for (int beam = 0; beam < 720; ++beam) {
      const double angle = scan.angle_min + beam * scan.angle_increment;
      const Eigen::Vector2d direction{std::cos(angle), std::sin(angle)};
      const double along = disc.dot(direction);
      const double beside = cross(disc, direction);
      const bool hit = along > 0.0 && std::abs(beside) < radius;
      scan.ranges.push_back(hit ? along - std::sqrt(radius * radius - beside * beside) : 1e9);
    }
    beliefs.observe(observation, Pose2{}, time);
    beliefs.refresh(time);
  }
  static AgentParameters perceiving() {
    AgentParameters parameters;
    parameters.perception.enabled = true;
    return parameters;
  }
  double time = 0.0;
  Beliefs beliefs{1, perceiving(), empty_map()};
};

TEST_F(ScansAlone, AreEnoughToTrackWhatMovesAndToKeepItOutOfTheMap) {
  Eigen::Vector2d disc{3.0, -1.5};
  for (int k = 0; k < 30; ++k) look(disc += Eigen::Vector2d{0.0, 0.1}, 0.3);
  ASSERT_EQ(beliefs.tracks().size(), 1U);
  const ObstacleTrack& track = beliefs.tracks()[0];
  EXPECT_GE(track.id, kScanTrackId);
  EXPECT_LT((track.state.position_world - disc).norm(), 0.05);
  EXPECT_LT((track.state.velocity_world - Eigen::Vector2d{0.0, 1.0}).norm(), 0.1);
  EXPECT_NEAR(track.state.radius, 0.3, 0.03);
  EXPECT_TRUE(beliefs.map().occupied_points().empty());
}

TEST_F(ScansAlone, LetGoAtOnceOfWhatHasVanished) {
  for (int k = 0; k < 5; ++k) look({3.0, -1.5 + 0.1 * k}, 0.3);
  EXPECT_EQ(beliefs.tracks().size(), 1U);
  for (int k = 0; k < 5; ++k) look({3.0, 100.0}, 0.3);
  EXPECT_TRUE(beliefs.tracks().empty());  // the tracker alone would remember it for 2 s
}

TEST_F(ScansAlone, LeaveToTheMapWhatNeverMoves) {
  for (int k = 0; k < 25; ++k) look({0.0, 3.0}, 0.3);
  EXPECT_TRUE(beliefs.tracks().empty());
  EXPECT_LT(beliefs.map().distance({0.0, 2.7}), 0.1);
}

}  // namespace
}  // namespace spf
