#include "spf/team/commitment.hpp"

#include <gtest/gtest.h>

#include "spf/planning/steering.hpp"
#include "spf/team/ideal_host_test.hpp"

namespace spf {
namespace {

PlanRequest request_at(double time) {
  PlanRequest request;
  request.time = time;
  return request;
}

StateEstimate estimate_at(const Eigen::Vector2d& position) {
  StateEstimate estimate;
  estimate.pose_world = {position, 0.4};
  estimate.valid = true;
  return estimate;
}

PlanResult follow(const Trajectory& trajectory) {
  PlanResult result;
  result.action = PlanAction::follow;
  result.trajectory = trajectory;
  return result;
}

class CommitmentTest : public ::testing::Test {
 protected:
  /// Committed to a straight path along x at 0.8 m/s from time 1 s on.
  void set_out() {
    PlanRequest request = request_at(1.0);
    commitment.begin_plan(StateEstimate{}, request);
    commitment.follow(request, follow(straight({0.0, 0.0}, {0.8, 0.0}, 1.0, 5.0)));
  }
  Commitment commitment{AgentParameters{}, {{0.0, 0.0}, 0.0}, 0.0};
};

TEST_F(CommitmentTest, StandsUntilAPlanIsFollowed) {
  EXPECT_EQ(commitment.trajectory().position(9.0), (Eigen::Vector2d{0.0, 0.0}));
  set_out();
  EXPECT_FALSE(commitment.braking());
  EXPECT_NEAR(commitment.trajectory().position(2.0).x(), 0.8, 1e-12);
}

TEST_F(CommitmentTest, ThePlanGoesOnFromThePlan) {
  set_out();
  PlanRequest request = request_at(2.0);
  commitment.begin_plan(estimate_at({0.9, 0.0}), request);  // 0.1 m ahead of it
  EXPECT_EQ(request.committed, &commitment.trajectory());
  EXPECT_NEAR(request.head.position_world.x(), 0.8, 1e-12);
  EXPECT_NEAR(request.head.velocity_world.x(), 0.8, 1e-12);
  EXPECT_GT(commitment.tracking_variance(), 0.0);
  EXPECT_LT(commitment.tracking_variance(), 0.01);
}

TEST_F(CommitmentTest, ARobotThatIsSlowedDownKeepsItsPlanUntilItIsFarBehind) {
  set_out();
  PlanRequest request = request_at(2.0);
  const Hold hold{{0.2, 0.1, -0.3}, false};
  commitment.begin_plan(estimate_at({0.75, 0.0}), request, hold);
  EXPECT_NE(request.committed, nullptr);
  commitment.begin_plan(estimate_at({0.75 - TeamParameters{}.reanchor_distance, 0.0}), request, hold);
  EXPECT_EQ(request.committed, nullptr);
  EXPECT_EQ(request.head.velocity_world, (Eigen::Vector2d{0.2, 0.1}));
}

TEST_F(CommitmentTest, ARobotThatMayNotGoOnPlansFromWhereItIsAsItIsToldToMove) {
  set_out();
  PlanRequest request = request_at(2.0);
  const Hold hold{{0.2, 0.1, -0.3}, true};
  commitment.begin_plan(estimate_at({0.75, 0.0}), request, hold);  // 0.05 m behind it
  EXPECT_EQ(request.committed, nullptr);
  EXPECT_EQ(request.head.position_world, (Eigen::Vector2d{0.75, 0.0}));
  EXPECT_EQ(request.head.velocity_world, (Eigen::Vector2d{0.2, 0.1}));
  EXPECT_EQ(request.heading.heading, 0.4);
  EXPECT_EQ(request.heading.yaw_rate, -0.3);
  // What may be noise is no difference.
  StateEstimate unsure = estimate_at({0.75, 0.0});
  unsure.position_variance = 0.02 * 0.02;
  commitment.begin_plan(unsure, request, hold);
  EXPECT_NE(request.committed, nullptr);
}

TEST_F(CommitmentTest, ARobotThatWasCarriedAwayStartsAnewWhereItIs) {
  set_out();
  const double limit = TeamParameters{}.reanchor_distance;
  PlanRequest request = request_at(2.0);
  commitment.begin_plan(estimate_at({0.8, limit + 0.01}), request);
  EXPECT_EQ(request.committed, nullptr);
  EXPECT_EQ(request.head.position_world, (Eigen::Vector2d{0.8, limit + 0.01}));
  EXPECT_EQ(request.head.velocity_world, (Eigen::Vector2d{0.0, 0.0}));
  EXPECT_EQ(request.heading.heading, 0.4);
  EXPECT_EQ(commitment.tracking_variance(), 0.0);
}

TEST_F(CommitmentTest, ThereIsNoStartingAnewForAnEstimateThatMayBeThatFarOff) {
  set_out();
  StateEstimate vague = estimate_at({0.8, 1.0});
  vague.position_variance = 0.3 * 0.3;
  PlanRequest request = request_at(2.0);
  commitment.begin_plan(vague, request);
  EXPECT_NE(request.committed, nullptr);
}

class CommitmentAtRest : public ::testing::TestWithParam<DriveType> {
 protected:
  static constexpr double kStart = 1000.0;  // [s] whatever the clock's origin
  static AgentParameters parameters() {
    AgentParameters parameters;
    parameters.robot.drive = GetParam();
    return parameters;
  }
  /// Whether the plan made so long after the start goes on from the plan before.
  bool goes_on(const StateEstimate& estimate, double after) {
    PlanRequest request = request_at(kStart + after);
    commitment.begin_plan(estimate, request);
    return request.committed != nullptr;
  }
  const bool sideways = GetParam() == DriveType::omni || GetParam() == DriveType::mecanum;
  const StateEstimate beside = estimate_at({0.0, 0.1});
  Commitment commitment{parameters(), {{0.0, 0.0}, 0.4}, kStart};
};

TEST_P(CommitmentAtRest, ARobotThatCannotMoveSidewaysPlansFromWhereItStands) {
  EXPECT_TRUE(goes_on(beside, 0.1));
  EXPECT_TRUE(goes_on(beside, 0.3));
  EXPECT_TRUE(goes_on(estimate_at({0.0, 0.01}), 0.9));
  StateEstimate unsure = beside;
  unsure.position_variance = 0.03 * 0.03;
  EXPECT_TRUE(goes_on(unsure, 0.95));
  EXPECT_EQ(goes_on(beside, 1.0), sideways);
}

INSTANTIATE_TEST_SUITE_P(Drives, CommitmentAtRest,
                         ::testing::Values(DriveType::omni, DriveType::mecanum, DriveType::differential,
                                           DriveType::car));

TEST(CommitmentSteered, ARobotThatTurnsOnTheSpotIsNotAtRest) {
  AgentParameters parameters;
  parameters.robot.drive = DriveType::differential;
  const Steering steering{parameters.robot};
  Trajectory turning{0.0};
  SteeredState state;
  for (int k = 0; k < 15; ++k) {
    const SteeredState before = state;
    steering.turn(3.0, 0.1, state);
    Steering::append(before, state, 0.1, turning);
  }
  Commitment commitment{parameters, {{0.0, 0.0}, 0.0}, 0.0};
  commitment.follow(request_at(0.0), follow(turning));
  ASSERT_GT(commitment.trajectory().heading_state(1.0).yaw_rate, 0.5);
  for (double time = 0.1; time < 1.45; time += 0.1) {
    PlanRequest request = request_at(time);
    commitment.begin_plan(estimate_at({0.0, 0.1}), request);
    EXPECT_NE(request.committed, nullptr) << time;
  }
}

TEST_F(CommitmentTest, KeepsThePlanUnderWayWhenToldTo) {
  set_out();
  PlanRequest request = request_at(2.0);
  commitment.begin_plan(StateEstimate{}, request);
  PlanResult result = follow(straight({5.0, 5.0}, {0.0, 0.0}, 2.0, 1.0));
  result.action = PlanAction::keep;
  commitment.follow(request, result);
  EXPECT_EQ(commitment.trajectory().start_time(), 1.0);
  EXPECT_FALSE(commitment.braking());
}

TEST_F(CommitmentTest, BrakesWhereThereIsNoPlanToKeep) {
  set_out();
  PlanRequest request = request_at(2.0);
  commitment.begin_plan(estimate_at({3.0, 3.0}), request);
  PlanResult result;
  result.action = PlanAction::keep;
  commitment.follow(request, result);
  EXPECT_TRUE(commitment.braking());
  EXPECT_EQ(commitment.trajectory().start_time(), 2.0);
}

TEST_F(CommitmentTest, BrakesOnceAndEndsStanding) {
  set_out();
  EXPECT_TRUE(commitment.brake(2.0));
  EXPECT_TRUE(commitment.braking());
  EXPECT_FALSE(commitment.brake(2.1));
  EXPECT_EQ(commitment.trajectory().start_time(), 2.0);
  EXPECT_LT(commitment.trajectory().state(5.0).velocity_world.norm(), 1e-9);
  EXPECT_LE(commitment.trajectory().max_acceleration(), RobotParameters{}.max_acceleration + 1e-9);
}

TEST(CommitmentHeading, FollowsItsMode) {
  for (const HeadingMode mode : {HeadingMode::keep, HeadingMode::goal, HeadingMode::motion}) {
    SCOPED_TRACE(enum_name(mode));
    AgentParameters parameters;
    parameters.heading_mode = mode;
    Commitment commitment{parameters, {{0.0, 0.0}, 0.3}, 0.0};
    PlanRequest request = request_at(1.0);
    request.goal_world = {9.0, 9.0};
    request.goal_heading = -1.0;
    commitment.begin_plan(StateEstimate{}, request);
    commitment.follow(request, follow(straight({0.0, 0.0}, {0.3, 0.3}, 1.0, 20.0)));
    const double wanted = mode == HeadingMode::keep ? 0.3 : (mode == HeadingMode::goal ? -1.0 : 0.25 * kPi);
    EXPECT_NEAR(commitment.trajectory().heading_state(20.0).heading, wanted, 1e-9);
    EXPECT_NEAR(commitment.trajectory().heading_state(1.0).heading, 0.3, 1e-9);  // without a jump
  }
}

/// Drives straight along x to a goal 5 m away, planning every 0.1 s; the heading at each plan.
std::vector<double> headings_along(Commitment& commitment, const Trajectory& trajectory,
                                   double goal_heading) {
  std::vector<double> headings;
  for (double time = trajectory.start_time(); time < trajectory.end_time() + 4.0; time += 0.1) {
    PlanRequest request = request_at(time);
    request.goal_world = trajectory.tail_position();
    request.goal_heading = goal_heading;
    commitment.begin_plan(StateEstimate{}, request);
    headings.push_back(request.heading.heading);
    commitment.follow(request, follow(trajectory));
  }
  return headings;
}

/// At 1 m/s along x, then braking with 1 m/s^2.
Trajectory trajectory_to(double distance) {
  Trajectory trajectory = straight({0.0, 0.0}, {1.0, 0.0}, 1.0, distance - 0.5);
  QuinticPiece brake;
  brake.duration = 1.0;
  brake.coefficients.row(0) << distance - 0.5, 0.0;
  brake.coefficients.row(1) << 1.0, 0.0;
  brake.coefficients.row(2) << -0.5, 0.0;
  trajectory.append(brake);
  return trajectory;
}

TEST(CommitmentHeading, TurnsToTheGoalsHeadingAtTheEndWhateverTheMode) {
  for (const HeadingMode mode : {HeadingMode::keep, HeadingMode::motion}) {
    SCOPED_TRACE(enum_name(mode));
    AgentParameters parameters;
    parameters.heading_mode = mode;
    Commitment commitment{parameters, {{0.0, 0.0}, 0.0}, 0.0};
    const std::vector<double> headings = headings_along(commitment, trajectory_to(5.0), 2.0);
    EXPECT_NEAR(headings[40], 0.0, 1e-9);  // 1 m before the goal
    EXPECT_NEAR(headings.back(), 2.0, 1e-6);
    EXPECT_NEAR(commitment.trajectory().heading().target_heading(), 2.0, 1e-9);
  }
}

TEST(CommitmentHeading, KeepsTheHeadingOfItsLastGoalOnTheWayToTheNext) {
  Commitment commitment{AgentParameters{}, {{0.0, 0.0}, 0.3}, 0.0};
  EXPECT_NEAR(headings_along(commitment, trajectory_to(5.0), 2.0).back(), 2.0, 1e-6);
  PlanRequest request = request_at(20.0);
  request.goal_world = {-5.0, 0.0};
  commitment.begin_plan(StateEstimate{}, request);
  commitment.follow(request, follow(straight({5.0, 0.0}, {-1.0, 0.0}, 20.0, 5.0)));
  EXPECT_NEAR(commitment.trajectory().heading().target_heading(), 2.0, 1e-9);
}

/// How long each of 36 directions was out of a view at most [s], from when the robot has looked around once.
std::vector<double> longest_unseen(const std::vector<double>& headings, double period, const Sight& sight) {
  std::vector<double> longest(36, 0.0), unseen(36, 0.0);
  for (std::size_t plan = 30; plan < headings.size(); ++plan)
    for (std::size_t i = 0; i < longest.size(); ++i) {
      const double direction = 2.0 * kPi * static_cast<double>(i) / 36.0;
      const double off = angle_difference(direction, headings[plan] + sight.view_centre);
      unseen[i] = std::abs(off) <= sight.view_half ? 0.0 : unseen[i] + period;
      longest[i] = std::max(longest[i], unseen[i]);
    }
  return longest;
}

TEST(CommitmentHeading, LooksAllRoundWithAScannerThatHasABlindSide) {
  for (const double speed : {0.0, 0.7})
    for (const double centre : {0.0, kPi}) {  // mounted ahead, and the other way round
      SCOPED_TRACE(testing::Message() << speed << " m/s, its scanner to " << centre << " rad");
      Commitment commitment{AgentParameters{}, {{0.0, 0.0}, 0.3}, 0.0};
      const Trajectory motion = straight({0.0, 0.0}, {speed, 0.0}, 0.0, 20.0);
      std::vector<double> headings;
      Sight sight;
      sight.view_half = 0.75 * kPi;
      sight.view_centre = centre;
      for (double time = 0.0; time < 12.0; time += 0.1) {
        PlanRequest request = request_at(time);
        request.goal_world = {30.0, 0.0};
        request.world.sight = sight;
        commitment.begin_plan(StateEstimate{}, request);
        headings.push_back(request.heading.heading);
        commitment.follow(request, follow(motion));
      }
      const std::vector<double> unseen = longest_unseen(headings, 0.1, sight);
      EXPECT_GT(*std::max_element(unseen.begin(), unseen.end()), 0.0);
      EXPECT_LT(*std::max_element(unseen.begin(), unseen.end()), 2.5);
      if (speed > 0.0) {
        EXPECT_EQ(unseen[0], 0.0) << "where it goes";
      }
    }
}

TEST(CommitmentHeading, TurnsItsBlindSideAwayFromWhomItKnowsThere) {
  for (const double side : {-1.0, 1.0}) {
    SCOPED_TRACE(side);
    Commitment commitment{AgentParameters{}, {{0.0, 0.0}, 0.0}, 0.0};
    ObstacleTrack track;
    track.state.position_world = {-2.0, side * 0.3};
    const std::vector<ObstacleTrack> tracks{track};
    bool seen = false;
    for (double time = 0.0; time < 1.5; time += 0.1) {
      PlanRequest request = request_at(time);
      request.goal_world = {30.0, 0.0};
      request.world.tracks = &tracks;
      request.world.sight.view_half = 0.75 * kPi;
      commitment.begin_plan(StateEstimate{}, request);
      const double direction = std::atan2(track.state.position_world.y(), track.state.position_world.x());
      seen = seen || std::abs(angle_difference(direction, request.heading.heading)) <= 0.75 * kPi;
      commitment.follow(request, follow(straight({0.0, 0.0}, {0.5, 0.0}, time, 20.0)));
    }
    EXPECT_TRUE(seen);
  }
}

TEST(CommitmentHeading, WithABlindSideStandsAsItsGoalSaysAndDoesNotTurnWhereItIsToKeepItsHeading) {
  for (const HeadingMode mode : {HeadingMode::look, HeadingMode::keep}) {
    AgentParameters parameters;
    parameters.heading_mode = mode;
    Commitment commitment{parameters, {{0.0, 0.0}, 0.3}, 0.0};
    double heading = 0.0;
    for (double time = 0.0; time < 12.0; time += 0.1) {
      PlanRequest request = request_at(time);
      request.goal_world = {0.0, 0.0};
      if (mode == HeadingMode::look) request.goal_heading = 1.0;
      request.world.sight.view_half = 0.75 * kPi;
      commitment.begin_plan(StateEstimate{}, request);
      heading = request.heading.heading;
      commitment.follow(request, follow(Trajectory::standing({0.0, 0.0}, time, 20.0)));
    }
    EXPECT_NEAR(heading, mode == HeadingMode::look ? 1.0 : 0.3, 1e-6);
  }
}

TEST(CommitmentHeading, KeepsStillWhileItsMotionSaysNothing) {
  AgentParameters parameters;
  parameters.heading_mode = HeadingMode::motion;
  Commitment commitment{parameters, {{0.0, 0.0}, 0.3}, 0.0};
  PlanRequest request = request_at(1.0);
  commitment.begin_plan(StateEstimate{}, request);
  commitment.follow(request, follow(straight({0.0, 0.0}, {0.0, -0.05}, 1.0, 20.0)));
  EXPECT_NEAR(commitment.trajectory().heading_state(20.0).heading, 0.3, 1e-9);
}

TEST_F(CommitmentTest, ARobotThatIsHeldStandsWhereItIsAndNotWhereItsBrakingLeads) {
  set_out();
  ASSERT_TRUE(commitment.brake(2.0));
  const double near = 0.09 * TeamParameters{}.reanchor_distance;
  const Eigen::Vector2d there = commitment.trajectory().position(2.1);
  EXPECT_FALSE(commitment.stand_where(estimate_at(there + Eigen::Vector2d{0.0, near}), 2.1));
  EXPECT_FALSE(commitment.stand_where(StateEstimate{}, 2.1));
  EXPECT_TRUE(commitment.stand_where(estimate_at({0.5, 0.0}), 2.1));
  EXPECT_TRUE(commitment.braking());
  EXPECT_EQ(commitment.trajectory().position(2.1), (Eigen::Vector2d{0.5, 0.0}));
  EXPECT_EQ(commitment.trajectory().position(9.0), (Eigen::Vector2d{0.5, 0.0}));
  EXPECT_NEAR(commitment.trajectory().heading_state(9.0).heading, 0.4, 1e-12);
  EXPECT_FALSE(commitment.stand_where(estimate_at({0.5, 0.0}), 2.2));
}

}  // namespace
}  // namespace spf
