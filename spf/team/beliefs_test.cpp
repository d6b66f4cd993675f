#include "spf/team/beliefs.hpp"

#include <gtest/gtest.h>

#include "spf/team/ideal_host_test.hpp"

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
      beliefs.observe(observation, Pose2{{0.0, 0.0}, 0.0});
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
    beliefs.observe(observation, Pose2{{0.0, 0.0}, 0.0});
  }
  EXPECT_GT(beliefs.map().occupied_points().size(), before);
}

TEST_F(BeliefsTest, WithoutAPoseAScanEntersNoMap) {
  Observation observation;
  observation.time = 0.1;
  observation.scan.emplace();
  observation.scan->ranges = {2.0, 2.0};
  const std::uint64_t revision = beliefs.map().revision();
  beliefs.observe(observation, std::nullopt);
  EXPECT_EQ(beliefs.map().revision(), revision);
}

TEST_F(BeliefsTest, KnowsWhichObservationsTellAboutThePresent) {
  Observation observation;
  const double stale = TeamParameters{}.stale_time;
  for (const double age : {0.0, stale, -0.05}) {
    observation.time = 10.0 - age;
    EXPECT_TRUE(beliefs.timely(observation, 10.0)) << age;
  }
  for (const double age : {stale + 0.01, 5.0, -0.2, std::numeric_limits<double>::quiet_NaN()}) {
    observation.time = 10.0 - age;
    EXPECT_FALSE(beliefs.timely(observation, 10.0)) << age;
  }
}

TEST_F(BeliefsTest, TheSnapshotHoldsTheRobotsOwnRank) {
  AgentParameters parameters;
  parameters.team.priority = 4;
  const Beliefs mine{6, parameters, empty_map()};
  EXPECT_EQ(mine.snapshot(1.0).rank().priority, 4);
  EXPECT_EQ(mine.snapshot(1.0).rank().robot_id, 6);
}

}  // namespace
}  // namespace spf
