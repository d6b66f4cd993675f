#include "spf/team/announcement.hpp"

#include <gtest/gtest.h>

#include "spf/team/ideal_host_test.hpp"
#include "spf/trajectory/constant_acceleration.hpp"

namespace spf {
namespace {

constexpr double kPeriod = 0.1;  // [s] between plans

TEST(Announcement, TellsEveryNewTrajectoryAndElseTheOldOneInTime) {
  AgentParameters parameters;
  parameters.team.priority = 2;
  Announcement announcement{4, parameters, 0.0};
  Trajectory committed = straight({0.0, 0.0}, {0.5, 0.0}, 0.0, 60.0);
  double last = -1.0;
  std::uint32_t sequence = 0;
  for (int k = 0; k < 50; ++k) {
    const double time = kPeriod * k;
    const bool is_new = k % 7 == 0;
    if (is_new) committed = straight({0.5 * time, 0.0}, {0.5, 0.0}, time, 60.0);
    announcement.update(time, {committed});
    const std::optional<TrajectoryMessage> message =
        announcement.message(time, time + kPeriod, committed, 0.02);
    EXPECT_TRUE(message.has_value() || !is_new) << time;
    if (!message) {
      EXPECT_LE(time + kPeriod - last, parameters.team.message_period + 1e-9) << time;
      continue;
    }
    last = time;
    EXPECT_EQ(message->sequence, ++sequence);
    EXPECT_EQ(message->robot_id, 4);
    EXPECT_EQ(message->priority, 2);
    EXPECT_EQ(message->position_sigma, 0.02);
    EXPECT_EQ(message->state, PeerState::moving);
    EXPECT_EQ(message->trajectory.start_time(), committed.start_time());
    EXPECT_EQ(message->expiry_time, time + parameters.team.message_lifetime);
  }
  EXPECT_LT(sequence, 40U);  // not at every plan
}

TEST(Announcement, ANewStateIsToldAtOnce) {
  Announcement announcement{4, AgentParameters{}, 0.0};
  const Trajectory committed = straight({0.0, 0.0}, {0.5, 0.0}, 0.0, 60.0);
  announcement.update(0.0, {committed});
  ASSERT_TRUE(announcement.message(0.0, 0.1, committed, 0.0));
  announcement.update(0.01, {committed});
  EXPECT_FALSE(announcement.message(0.01, 0.02, committed, 0.0));
  announcement.update(0.02, {committed, true});
  const std::optional<TrajectoryMessage> message = announcement.message(0.02, 0.03, committed, 0.0);
  ASSERT_TRUE(message);
  EXPECT_EQ(message->state, PeerState::braking);
}

TEST(Announcement, SaysWhyTheRobotStands) {
  Announcement announcement{4, AgentParameters{}, 0.0};
  const Trajectory standing = Trajectory::standing({1.0, 0.0}, 0.0, 1.0);
  Situation situation{standing};
  situation.goal_world = Eigen::Vector2d{5.0, 0.0};
  situation.cause = {StopCause::peer_ahead, 9};
  announcement.update(1.0, situation);
  EXPECT_EQ(announcement.status().state, PeerState::stopped);
  EXPECT_EQ(announcement.status().reason, StopCause::peer_ahead);
  EXPECT_EQ(announcement.status().blocking_id, 9);
  situation.stop = StopCause::paused;  // goes before
  announcement.update(1.1, situation);
  EXPECT_EQ(announcement.status().reason, StopCause::paused);
  EXPECT_EQ(announcement.status().blocking_id, -1);
  situation.stop = StopCause::none;
  situation.goal_world = Eigen::Vector2d{1.02, 0.0};
  announcement.update(1.2, situation);
  EXPECT_EQ(announcement.status().state, PeerState::arrived);
  EXPECT_EQ(announcement.status().reason, StopCause::arrived);
}

TEST(Announcement, TellsAtOnceWhatItClaims) {
  Announcement announcement{4, AgentParameters{}, 0.0};
  const Trajectory standing = Trajectory::standing({1.0, 0.0}, 0.0, 100.0);
  announcement.update(0.0, {standing});
  std::optional<PassageClaim> claim;
  const auto told = [&](double time) {
    return announcement.message(time, time + 0.01, standing, 0.0, claim);
  };
  EXPECT_TRUE(told(0.0));
  EXPECT_FALSE(told(0.01));
  claim = PassageClaim{{2.0, 0.0}, {3.0, 0.0}, 0.02, false, false};
  const std::optional<TrajectoryMessage> first = told(0.02);
  ASSERT_TRUE(first && first->claim);
  EXPECT_EQ(first->claim->since, 0.02);
  EXPECT_FALSE(told(0.03));
  claim->waits = true;
  EXPECT_TRUE(told(0.04));
  claim->inside = true;
  EXPECT_TRUE(told(0.05));
  claim.reset();
  const std::optional<TrajectoryMessage> last = told(0.06);
  ASSERT_TRUE(last);
  EXPECT_FALSE(last->claim);
}

TEST(Announcement, ARobotThatMeansToGoSoonStandsOnlyWhenItKeepsMeaningTo) {
  Announcement announcement{4, AgentParameters{}, 0.0};
  for (int k = 0; k <= 10; ++k) {
    const double time = 0.1 * k;
    // Planned anew each time: to go in 0.2 s.
    Trajectory soon{time};
    soon.append(constant_acceleration({0.0, 0.0}, {0.0, 0.0}, {0.0, 0.0}, 0.2));
    soon.append(constant_acceleration({0.0, 0.0}, {0.0, 0.0}, {1.0, 0.0}, 1.0));
    announcement.update(time, {soon});
    EXPECT_EQ(announcement.status().state, time > 0.5 ? PeerState::stopped : PeerState::moving) << time;
  }
}

}  // namespace
}  // namespace spf
