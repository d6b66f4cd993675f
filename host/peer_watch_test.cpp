// Peers that are at odds with this robot: named, and kept away from.
#include "host/peer_watch.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "host/bench_test.hpp"
#include "spf/math/random_stream.hpp"
#include "spf/world/peer_table.hpp"

namespace spf::host {
namespace {

constexpr double kAllowed = 0.05;  // [s] HostParameters::peer_clock_error

/// Of a peer on a straight path.
TrajectoryMessage on_its_way(int robot_id, double sent_time, const Eigen::Vector2d& from,
                             const Eigen::Vector2d& velocity) {
  TrajectoryMessage message;
  message.robot_id = robot_id;
  message.sequence = static_cast<std::uint32_t>(std::lround(sent_time * 1000.0));
  message.sent_time = sent_time;
  message.expiry_time = sent_time + 1.5;
  message.state = PeerState::moving;
  Trajectory trajectory{sent_time};
  QuinticPiece piece;
  piece.duration = 3.0;
  piece.coefficients.row(0) = from.transpose();
  piece.coefficients.row(1) = velocity.transpose();
  trajectory.append(piece);
  message.trajectory = trajectory;
  return message;
}

/// What is made of ten messages a second for some seconds, from a clock that is ahead by this and a radio
/// that takes so long.
double error_after(double seconds, double ahead, double least_delay, double longest_delay) {
  PeerClocks clocks{kAllowed};
  RandomStream random{5};
  double now = 100.0;
  for (; now < 100.0 + seconds; now += 0.1)
    clocks.hear(7, now - random.uniform(least_delay, longest_delay) + ahead, now);
  EXPECT_EQ(clocks.error(8, now), 0.0);
  return clocks.error(7, now);
}

TEST(PeerClocks, NameAClockThatIsAheadAtOnce) {
  EXPECT_NEAR(error_after(0.5, 0.5, 0.0, 0.02), 0.5, 0.02);
  EXPECT_NEAR(error_after(0.5, 0.08, 0.0, 0.01), 0.08, 0.01);
  EXPECT_NEAR(error_after(20.0, 0.5, 0.0, 0.3), 0.5, 0.05);
}

TEST(PeerClocks, NameAClockThatIsBehindWithinTwoSeconds) {
  EXPECT_NEAR(error_after(2.0, -0.5, 0.0, 0.02), -0.5, 0.02);
  EXPECT_EQ(error_after(0.5, -0.5, 0.0, 0.02), 0.0);  // one message may be late
}

TEST(PeerClocks, AllowForARadioThatIsSlowNowAndThen) {
  EXPECT_EQ(error_after(20.0, 0.0, 0.0, 0.3), 0.0);
  EXPECT_EQ(error_after(20.0, 0.04, 0.0, 0.02), 0.0);
  EXPECT_EQ(error_after(20.0, -0.03, 0.0, 0.02), 0.0);
}

// The own clock may hang for a moment, where it is told by a simulator.
TEST(PeerClocks, AllowForSomeMessagesFromTheFuture) {
  PeerClocks clocks{kAllowed};
  double now = 100.0;
  for (int i = 0; i < 40; ++i, now += 0.1) clocks.hear(7, i % 4 == 0 ? now + 0.2 : now - 0.02, now);
  EXPECT_EQ(clocks.error(7, now), 0.0);
}

TEST(PeerClocks, ForgetWhenAClockWasSetRight) {
  PeerClocks clocks{kAllowed};
  double now = 100.0;
  for (; now < 103.0; now += 0.1) clocks.hear(7, now + 0.4, now);
  EXPECT_GT(clocks.error(7, now), 0.3);
  for (; now < 114.0; now += 0.1) clocks.hear(7, now - 0.01, now);
  EXPECT_EQ(clocks.error(7, now), 0.0);
}

TEST(PeerClocks, RememberABoundedNumber) {
  PeerClocks clocks{kAllowed};
  const int most = static_cast<int>(kMostPeers);
  for (int id = 0; id < 3 * most; ++id)
    for (int i = 0; i < 3; ++i) clocks.hear(id, 11.0, 10.0);
  EXPECT_EQ(clocks.errors(10.0).size(), kMostPeers);
  clocks.hear(1, std::numeric_limits<double>::quiet_NaN(), 10.0);
}

TEST(PeerWatch, KnowsItsOwnMessagesFromThoseOfANamesake) {
  PeerWatch watch{3, kAllowed};
  const TrajectoryMessage past = on_its_way(3, 9.0, {0.0, 0.0}, {0.0, 0.0});
  EXPECT_FALSE(watch.admitted(past, 10.0));  // of this robot, before it was started anew
  for (int i = 0; i < 200; ++i) {
    const double now = 10.0 + 0.1 * i;
    const TrajectoryMessage own = on_its_way(3, now, {0.0, 0.0}, {0.0, 0.0});
    watch.told(own);
    EXPECT_FALSE(watch.admitted(own, now + 0.01));
  }
  EXPECT_TRUE(watch.complaints(30.0).empty());
  const std::optional<HeardMessage> other =
      watch.admitted(on_its_way(3, 29.95, {5.0, 0.0}, {0.0, 0.0}), 30.0);
  ASSERT_TRUE(other);
  EXPECT_EQ((*other)->robot_id, PeerWatch::kNamesake);
  const Rank mine{std::numeric_limits<int>::min() + 1, 0};
  EXPECT_TRUE(goes_first({(*other)->priority, (*other)->robot_id}, mine));
  ASSERT_EQ(watch.complaints(31.0).size(), 1u);
  EXPECT_EQ(watch.complaints(31.0)[0].fault, PeerFault::same_number);
  EXPECT_EQ(watch.complaints(31.0)[0].robot_id, 3);
  EXPECT_TRUE(watch.complaints(40.0).empty());
  // One whose clock is behind by more than this robot has lived.
  EXPECT_TRUE(watch.admitted(on_its_way(3, 5.0, {5.0, 0.0}, {0.0, 0.0}), 41.0));
}

// By a simulator's clock, which stands between its ticks, the first own message comes back at the time that
// it was sent.
TEST(PeerWatch, KnowsItsFirstMessageWhenItComesBackAtOnce) {
  PeerWatch watch{3, kAllowed};
  const TrajectoryMessage first = on_its_way(3, 100.0, {0.0, 0.0}, {1.0, 0.0});
  watch.told(first);
  EXPECT_FALSE(watch.admitted(first, 100.0));
  const TrajectoryMessage namesakes = on_its_way(3, 100.1, {5.0, 0.0}, {1.0, 0.0});
  EXPECT_TRUE(watch.admitted(namesakes, 100.1));
}

TEST(PeerWatch, ComplainsOfABoundedNumber) {
  PeerWatch watch{0, kAllowed};
  for (int id = 1; id < 1000; ++id) watch.complain(id, PeerFault::frame, "speaks in another frame", 10.0);
  EXPECT_LE(watch.complaints(10.0).size(), 32u);
  watch.complain(5000, PeerFault::frame, "speaks in another frame", 20.0);
  ASSERT_EQ(watch.complaints(20.0).size(), 1u);
  Health health{Level::ok, "moving"};
  watch.add_to(health, 20.0);
  EXPECT_EQ(health.level, Level::error);
  EXPECT_EQ(health.text, "moving; robot 5000: speaks in another frame");
}

class OddPeers : public ::testing::TestWithParam<Arrangement> {};
INSTANTIATE_TEST_SUITE_P(Both, OddPeers, testing::Values(Arrangement::one_process, Arrangement::split),
                         name_of);

/// Drives along x while a peer that gives way to nobody crosses; its messages are wrong by what `spoil` does.
/// Returns the least distance between their rims [m].
double clearance_of_crossing(Bench& bench, double speed, int robot_id, double clock_ahead) {
  bench.run(1.0);
  EXPECT_TRUE(bench.planner.set_goal({{12.0, 0.0}, std::nullopt}));
  const double begun = bench.now;
  const auto course = [&](double time) {  // heard of for long before they meet at x = 6
    return Eigen::Vector2d{6.0, -6.5 * speed + speed * (time - begun)};
  };
  bench.each_tenth = [&] {
    TrajectoryMessage message =
        on_its_way(robot_id, bench.now + clock_ahead, course(bench.now), {0.0, speed});
    message.priority = 5;  // would have to give way
    if (bench.split)
      bench.planning.add_message(message, bench.now);
    else
      bench.robot.add_message(message, bench.now);
  };
  double least = 1e9;
  while (bench.now < begun + 16.0) {
    bench.tick();
    least = std::min(least, (course(bench.now) - bench.pose.position_world).norm() - 0.6);
  }
  return least;
}

TEST_P(OddPeers, ARobotWithTheSameNumberIsKeptAwayFromAndNamed) {
  for (const double speed : {0.5, 1.0}) {
    Bench bench{GetParam()};
    EXPECT_GT(clearance_of_crossing(bench, speed, 0, 0.0), 0.0) << speed;
    const Health health = bench.planner.health(bench.now);
    EXPECT_EQ(health.level, Level::error);
    EXPECT_NE(health.text.find("robot 0: another robot has this number"), std::string::npos) << health.text;
  }
}

TEST_P(OddPeers, APeerWhoseClockIsOffIsKeptAwayFromAndNamed) {
  for (const double speed : {0.5, 1.0})
    for (const double ahead : {-0.5, -0.2, 0.2, 0.5}) {
      Bench bench{GetParam()};
      EXPECT_GT(clearance_of_crossing(bench, speed, 4, ahead), 0.0) << speed << ", " << ahead;
      const Health health = bench.planner.health(bench.now);
      EXPECT_EQ(health.level, Level::error);
      EXPECT_NE(health.text.find("robot 4: its clock is 0."), std::string::npos) << health.text;
    }
}

TEST_P(OddPeers, AnHonestPeerIsNotComplainedOf) {
  Bench bench{GetParam()};
  clearance_of_crossing(bench, 0.5, 4, 0.0);
  EXPECT_EQ(bench.planner.health(bench.now).level, Level::ok) << bench.planner.health(bench.now).text;
}

TEST_P(OddPeers, ThatSpeakNonsenseAreNamed) {
  Bench bench{GetParam()};
  bench.run(1.0);
  TrajectoryMessage message = on_its_way(9, bench.now, {5.0, 5.0}, {0.0, 0.0});
  message.radius = 50.0;
  bench.planner.add_message(message, bench.now);
  EXPECT_EQ(bench.planner.health(bench.now).text, "no goal; robot 9: its messages are out of range");
  EXPECT_EQ(bench.planner.health(bench.now).level, Level::warn);
  bench.run(6.0);
  EXPECT_EQ(bench.planner.health(bench.now).level, Level::ok);
}

}  // namespace
}  // namespace spf::host
