// What every method shares: which requests can be planned, and what is done instead.
#include "spf/planning/planner.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "spf/planning/cost_to_go.hpp"

namespace spf {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

class PlanRequestTest : public ::testing::Test {
 protected:
  PlanRequestTest() {
    request.time = 3.0;
    request.head.position_world = {1.0, 2.0};
    request.head.velocity_world = {0.8, 0.0};
    request.world.map = &map;
    request.guide = &guide;
  }
  OccupancyMap map{GridFrame::covering({-5.0, -5.0}, {5.0, 5.0}, 0.1), 2.0};
  CostToGo guide{CostToGoParameters{}, 0.2};
  PlanRequest request;
  PlanResult result;
};

TEST_F(PlanRequestTest, IsUsableOnlyWithFiniteNumbersAMapAndAGuide) {
  EXPECT_TRUE(usable(request));
  const std::vector<std::function<void(PlanRequest&)>> spoilers{
      [](PlanRequest& bad) { bad.time = kNaN; },
      [](PlanRequest& bad) { bad.head.position_world.x() = kNaN; },
      [](PlanRequest& bad) { bad.head.velocity_world.y() = kNaN; },
      [](PlanRequest& bad) { bad.head.acceleration_world.y() = -std::numeric_limits<double>::infinity(); },
      [](PlanRequest& bad) { bad.heading.heading = kNaN; },
      [](PlanRequest& bad) { bad.heading.yaw_rate = kNaN; },
      [](PlanRequest& bad) { bad.goal_world.x() = kNaN; },
      [](PlanRequest& bad) { bad.goal_heading = kNaN; },
      [](PlanRequest& bad) { bad.position_sigma = kNaN; },
      [](PlanRequest& bad) { bad.world.map = nullptr; },
      [](PlanRequest& bad) { bad.guide = nullptr; },
  };
  for (std::size_t i = 0; i < spoilers.size(); ++i) {
    PlanRequest bad = request;
    spoilers[i](bad);
    EXPECT_FALSE(usable(bad)) << "case " << i;
  }
}

TEST_F(PlanRequestTest, IsRefusedWithOneOutcomeForEveryMethod) {
  EXPECT_EQ(refusal(request), PlanOutcome::no_path);  // the guide has never been computed
  guide.update(map, {3.0, 3.0}, request.head.position_world);
  EXPECT_EQ(refusal(request), std::nullopt);
  const OccupancyMap full = [] {
    OccupancyMap walled{GridFrame::covering({-5.0, -5.0}, {5.0, 5.0}, 0.1), 2.0};
    walled.add_box({-5.0, -5.0}, {5.0, 5.0});
    return walled;
  }();
  guide.update(full, {3.0, 3.0}, request.head.position_world);
  EXPECT_EQ(refusal(request), PlanOutcome::no_path);  // no position near the goal is free
  request.head.velocity_world.x() = kNaN;
  EXPECT_EQ(refusal(request), PlanOutcome::invalid_request);
}

TEST_F(PlanRequestTest, WithoutAPlanTheRobotBrakesFromItsHead) {
  stand_instead(request, RobotParameters{}, PlanOutcome::unsafe, result);
  EXPECT_EQ(result.outcome, PlanOutcome::unsafe);
  EXPECT_EQ(result.action, PlanAction::brake);
  EXPECT_EQ(result.trajectory.position(3.0), request.head.position_world);
  EXPECT_EQ(result.trajectory.state(3.0).velocity_world, request.head.velocity_world);
  EXPECT_LT(result.trajectory.state(result.trajectory.end_time()).velocity_world.norm(), 1e-9);
}

TEST_F(PlanRequestTest, ABrakingPlanGoesOn) {
  const Trajectory under_way = Trajectory::standing({1.0, 2.0}, 2.5, 1.0);
  request.committed = &under_way;
  request.braking = true;
  stand_instead(request, RobotParameters{}, PlanOutcome::unsafe, result);
  EXPECT_EQ(result.action, PlanAction::keep);
  EXPECT_EQ(result.trajectory.start_time(), 2.5);
}

TEST_F(PlanRequestTest, WithoutAFiniteHeadThePlanUnderWayGoesOnElseTheRobotStands) {
  const Trajectory under_way = Trajectory::standing({1.0, 2.0}, 2.5, 1.0);
  request.committed = &under_way;
  request.head.velocity_world.x() = kNaN;
  stand_instead(request, RobotParameters{}, PlanOutcome::invalid_request, result);
  EXPECT_EQ(result.action, PlanAction::keep);
  request.committed = nullptr;
  stand_instead(request, RobotParameters{}, PlanOutcome::invalid_request, result);
  EXPECT_EQ(result.action, PlanAction::brake);
  EXPECT_EQ(result.trajectory.tail_position(), request.head.position_world);
  request.time = kNaN;
  request.head.position_world.x() = kNaN;
  stand_instead(request, RobotParameters{}, PlanOutcome::invalid_request, result);
  EXPECT_TRUE(result.trajectory.tail_position().allFinite());
  EXPECT_TRUE(std::isfinite(result.trajectory.start_time()));
}

}  // namespace
}  // namespace spf
