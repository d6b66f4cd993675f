// The agent behind its door: where it goes, when it stands and what it says about it.
#include "spf/team/robot_agent.hpp"

#include <gtest/gtest.h>

#include "spf/math/random_stream.hpp"
#include "spf/team/ideal_host_test.hpp"

namespace spf {
namespace {

/// Both ways to plan have to keep what the agent promises.
class RobotAgentTest : public ::testing::TestWithParam<const char*> {
 protected:
  [[nodiscard]] AgentParameters parameters() const { return with_method(AgentParameters{}, GetParam()); }

  /// Plans are accepted with 5 % more speed and 10 % more acceleration (PlannerParameters); some are looked
  /// at ten times a piece only, between which it may be a little more.
  static void expect_limits(const IdealHost& host) {
    const RobotParameters robot;
    EXPECT_LE(host.highest_speed, robot.max_speed * 1.06);
    EXPECT_LE(host.highest_acceleration, robot.max_acceleration * 1.12);
    EXPECT_LT(host.largest_jump, 1e-6);
  }
};

const TrueBox kBoxAhead{{-1.0, -1.2}, {1.0, 0.8}};

/// A wall across the room with a gap of 1.2 m at the origin: enough for one robot of 0.6 m.
const std::vector<TrueBox> kWallWithGap{{{-0.5, 0.6}, {0.5, 10.0}}, {{-0.5, -10.0}, {0.5, -0.6}}};

INSTANTIATE_TEST_SUITE_P(Methods, RobotAgentTest, ::testing::Values("space_time", "spf_empc"),
                         [](const auto& parameter) { return std::string{parameter.param}; });

TEST_P(RobotAgentTest, ReachesItsGoalAroundAKnownBox) {
  IdealHost host{parameters(), map_of({kBoxAhead}), {-4.0, 0.0}};
  host.boxes = {kBoxAhead};
  host.agent.set_goal({4.0, 0.0});
  EXPECT_TRUE(host.arrives_within(16.0));
  EXPECT_LT((host.position - Eigen::Vector2d{4.0, 0.0}).norm(), 0.05);
  EXPECT_GT(host.box_clearance, 0.0);
  EXPECT_EQ(host.agent.status().state, PeerState::arrived);
  expect_limits(host);
}

TEST_P(RobotAgentTest, ReachesItsGoalAroundABoxThatItHasToSee) {
  IdealHost host{parameters(), empty_map(), {-4.0, 0.0}};
  host.boxes = {kBoxAhead};
  host.send_scans = true;
  host.agent.set_goal({4.0, 0.0});
  EXPECT_TRUE(host.arrives_within(20.0));
  EXPECT_GT(host.box_clearance, 0.0);
  EXPECT_FALSE(host.agent.map().occupied_points().empty());
  expect_limits(host);
}

TEST_P(RobotAgentTest, GivesWayToAnObstacleThatComesTowardsIt) {
  IdealHost host{parameters(), empty_map(), {-4.0, 0.0}};
  host.obstacles = {{5, 0.4, [](double time) { return Eigen::Vector2d{4.0 - 0.5 * time, 0.1}; }}};
  host.agent.set_goal({4.0, 0.0});
  EXPECT_TRUE(host.arrives_within(20.0));
  EXPECT_GT(host.obstacle_clearance, 0.0);
  expect_limits(host);
}

TEST_P(RobotAgentTest, StandsWithoutAGoal) {
  IdealHost host{parameters(), empty_map(), {1.0, 1.0}};
  host.run(1.0);
  EXPECT_EQ(host.agent.status().reason, StopCause::no_goal);
  EXPECT_EQ(host.agent.status().state, PeerState::stopped);
  EXPECT_EQ(host.position, (Eigen::Vector2d{1.0, 1.0}));
}

TEST_P(RobotAgentTest, BrakesWhenItsGoalIsTakenAway) {
  IdealHost host{parameters(), empty_map(), {-4.0, 0.0}};
  host.agent.set_goal({4.0, 0.0});
  host.run(3.0);
  ASSERT_GT(host.speed(), 0.9);
  host.agent.clear_goal();
  host.run(1.5);  // 1 s to stop, and jerk-limited ends
  EXPECT_EQ(host.speed(), 0.0);
  EXPECT_EQ(host.agent.status().reason, StopCause::no_goal);
  expect_limits(host);
}

TEST_P(RobotAgentTest, PausesAndGoesOn) {
  IdealHost host{parameters(), empty_map(), {-4.0, 0.0}};
  host.agent.set_goal({4.0, 0.0});
  host.run(3.0);
  host.stop = StopCause::paused;
  host.run(0.2);
  EXPECT_EQ(host.agent.status().state, PeerState::braking);
  host.run(1.8);
  EXPECT_EQ(host.speed(), 0.0);
  EXPECT_EQ(host.agent.status().reason, StopCause::paused);
  const Eigen::Vector2d stopped = host.position;
  host.run(1.0);
  EXPECT_EQ(host.position, stopped);
  host.stop = StopCause::none;
  EXPECT_TRUE(host.arrives_within(12.0));
  expect_limits(host);
}

TEST_P(RobotAgentTest, SlowsDownToANewLimitOfSpeedAndSpeedsUpAgain) {
  IdealHost host{parameters(), empty_map(), {-9.0, 0.0}};
  host.agent.set_goal({9.0, 0.0});
  host.run(3.0);
  ASSERT_GT(host.speed(), 0.9);
  for (const double limit : {0.5, 0.2}) {
    host.agent.reconfigure(slowed_to(parameters(), limit));
    const double before = host.speed();
    double hardest = 0.0;
    double last = before;
    for (int i = 0; i < 400; ++i) {
      host.tick();
      hardest = std::max(hardest, (last - host.speed()) / IdealHost::kTick);
      last = host.speed();
      // A tenth of a second until it plans, then at 1 m/s^2, and ramps.
      const int braked = 10 + static_cast<int>(100.0 * (before - limit)) + 50;  // ticks
      EXPECT_LE(host.speed(), i < braked ? 1.06 * before : 1.06 * limit);
    }
    EXPECT_LE(hardest, 1.12);
    EXPECT_GT(host.speed(), 0.8 * limit);
    EXPECT_EQ(host.agent.status().state, PeerState::moving);
  }
  host.agent.reconfigure(parameters());
  host.run(3.0);
  EXPECT_GT(host.speed(), 0.9);
  EXPECT_TRUE(host.arrives_within(20.0));
}

TEST_P(RobotAgentTest, KeepsWhatItKnowsWhenItsParametersChange) {
  IdealHost host{parameters(), empty_map(), {-4.0, 0.0}};
  host.boxes = {kBoxAhead};
  host.send_scans = true;
  host.obstacles = {{5, 0.4, [](double) { return Eigen::Vector2d{-4.0, 5.0}; }}};
  host.agent.set_goal({4.0, 0.0});
  host.run(2.0);
  const std::size_t seen = host.agent.map().occupied_points().size();
  ASSERT_GT(seen, 0u);
  AgentParameters changed = parameters();
  changed.team.goal_tolerance = 0.5;
  changed.heading_mode = HeadingMode::motion;
  host.agent.reconfigure(changed);
  EXPECT_EQ(host.agent.map().occupied_points().size(), seen);
  EXPECT_EQ(host.agent.tracks().size(), 1u);
  double turned = 0.0;
  while (host.time() < 30.0 && host.agent.status().reason != StopCause::arrived) {
    host.tick();
    turned = std::max(turned, std::abs(host.agent.committed().heading_state(host.time()).heading));
  }
  EXPECT_GT(turned, 0.2);  // it faces the way round the box now
  EXPECT_EQ(host.agent.status().reason, StopCause::arrived);
  EXPECT_GT(host.box_clearance, 0.0);
}

TEST(RobotAgent, StaysAsItWasWhenItsNewParametersAreRefused) {
  IdealHost host{AgentParameters{}, empty_map(), {-4.0, 0.0}};
  host.agent.set_goal({4.0, 0.0});
  AgentParameters changed;
  changed.robot.max_speed = -1.0;
  EXPECT_THROW(host.agent.reconfigure(changed), std::invalid_argument);
  EXPECT_EQ(host.agent.parameters().robot.max_speed, 1.0);
  EXPECT_TRUE(host.arrives_within(12.0));
}

TEST_P(RobotAgentTest, TurnsToTheHeadingOfItsGoalWhateverItsMode) {
  for (const HeadingMode mode : {HeadingMode::keep, HeadingMode::goal, HeadingMode::motion}) {
    SCOPED_TRACE(enum_name(mode));
    AgentParameters of_mode = parameters();
    of_mode.heading_mode = mode;
    IdealHost host{of_mode, empty_map(), {-4.0, 0.0}};
    host.agent.set_goal({0.0, 2.0}, -2.0);
    EXPECT_TRUE(host.arrives_within(12.0));
    host.run(4.0);
    EXPECT_NEAR(host.agent.committed().heading_state(host.time()).heading, -2.0, 0.01);
    host.agent.set_goal({0.0, 2.0}, 1.0);  // on the spot
    host.run(4.0);
    EXPECT_NEAR(host.agent.committed().heading_state(host.time()).heading, 1.0, 0.01);
    EXPECT_EQ(host.agent.status().reason, StopCause::arrived);
  }
}

TEST(SteeredRobot, DrivesAheadToItsGoalAndTurnsThereToTheHeadingAskedFor) {
  AgentParameters differential;
  differential.robot.drive = DriveType::differential;
  IdealHost host{differential, empty_map(), {-4.0, 0.0}};
  host.agent.set_goal({0.0, 2.0}, -2.0);
  double sideways = 0.0;
  double turned = 0.0;
  host.more_input = [&](double now, AgentInput&) {
    const FlatState flat = host.agent.committed().state(now);
    const HeadingState heading = host.agent.committed().heading_state(now);
    sideways = std::max(
        sideways,
        std::abs(
            twist_in_body({flat.velocity_world.x(), flat.velocity_world.y(), 0.0}, heading.heading).y()));
    turned = std::max(turned, std::abs(heading.yaw_rate));
  };
  EXPECT_TRUE(host.arrives_within(12.0));
  host.run(4.0);
  EXPECT_NEAR(host.agent.committed().heading_state(host.time()).heading, -2.0, 0.01);
  EXPECT_LT((host.position - Eigen::Vector2d{0.0, 2.0}).norm(), 0.05);
  EXPECT_LT(sideways, 0.02);  // of a cubic that stands for an arc
  EXPECT_GT(turned, 0.5);
  EXPECT_LT(host.largest_jump, 1e-3);
  EXPECT_EQ(host.agent.status().reason, StopCause::arrived);
}

TEST_P(RobotAgentTest, SaysThatThereIsNoPathToAWalledInGoal) {
  const std::vector<TrueBox> ring{{{2.0, -2.0}, {6.0, -1.5}},
                                  {{2.0, 1.5}, {6.0, 2.0}},
                                  {{2.0, -2.0}, {2.5, 2.0}},
                                  {{5.5, -2.0}, {6.0, 2.0}}};
  IdealHost host{parameters(), map_of(ring), {-4.0, 0.0}};
  host.boxes = ring;
  host.agent.set_goal({4.0, 0.0});
  host.run(15.0);
  EXPECT_LT(host.speed(), 0.02);
  EXPECT_EQ(host.agent.status().reason, StopCause::no_path);
  EXPECT_EQ(host.agent.status().blocking_id, -1);
  EXPECT_GT(host.box_clearance, 0.0);
  host.run(1.0);
  EXPECT_EQ(host.agent.status().reason, StopCause::no_path);
}

TEST_P(RobotAgentTest, SaysThatThereIsNoPathToAGoalInsideABox) {
  IdealHost host{parameters(), map_of({kBoxAhead}), {-4.0, 0.0}};
  host.boxes = {kBoxAhead};
  host.agent.set_goal({0.0, -0.2});
  host.run(12.0);
  EXPECT_LT(host.speed(), 0.02);
  EXPECT_EQ(host.agent.status().reason, StopCause::no_path);
  EXPECT_LT(kBoxAhead.distance(host.position), 0.6);  // as near as its guide lets it
  EXPECT_GT(host.box_clearance, 0.0);
}

TEST_P(RobotAgentTest, NamesTheObstacleThatIsParkedInTheOnlyGap) {
  IdealHost host{parameters(), map_of(kWallWithGap), {-4.0, 0.0}};
  host.boxes = kWallWithGap;
  bool gone = false;
  host.obstacles = {{23, 0.4, [&gone](double) { return Eigen::Vector2d{0.0, gone ? 8.0 : 0.0}; }}};
  host.agent.set_goal({4.0, 0.0});
  host.run(15.0);
  for (int i = 0; i < 20; ++i) {  // it does not only happen to stand
    host.run(0.1);
    EXPECT_LT(host.speed(), 0.05);
    EXPECT_EQ(host.agent.status().reason, StopCause::obstacle_ahead);
    EXPECT_EQ(host.agent.status().blocking_id, 23);
  }
  EXPECT_GT(host.obstacle_clearance, 0.0);
  EXPECT_GT(host.box_clearance, 0.0);
  gone = true;
  EXPECT_TRUE(host.arrives_within(20.0));
}

TEST_P(RobotAgentTest, NamesThePeerThatIsParkedInTheOnlyGap) {
  IdealHost host{parameters(), map_of(kWallWithGap), {-4.0, 0.0}};
  host.boxes = kWallWithGap;
  std::uint32_t sequence = 0;
  bool gone = false;
  host.more_input = [&](double time, AgentInput& input) {
    const Eigen::Vector2d position{0.0, gone ? 8.0 : 0.0};
    input.messages.push_back(
        told_by(9, ++sequence, time, PeerState::arrived, Trajectory::standing(position, time, 1.0)));
  };
  host.agent.set_goal({4.0, 0.0});
  host.run(25.0);
  for (int i = 0; i < 20; ++i) {
    host.run(0.1);
    EXPECT_LT(host.speed(), 0.05);
    EXPECT_EQ(host.agent.status().reason, StopCause::peer_ahead);
    EXPECT_EQ(host.agent.status().blocking_id, 9);
  }
  EXPECT_GT(host.position.norm(), 0.6);
  gone = true;
  EXPECT_TRUE(host.arrives_within(20.0));
}

/// ES2 alone does not: a disc that it takes for standing is no danger before it touches.
TEST(RobotAgent, GoesOnDodgingAfterItHasArrived) {
  for (const char* method : {"space_time", "spf_empc", "es2_constant_velocity"}) {
    SCOPED_TRACE(method);
    IdealHost host{with_method(AgentParameters{}, method), empty_map(), {-2.0, 0.0}};
    host.agent.set_goal({0.0, 0.0});
    ASSERT_TRUE(host.arrives_within(8.0));
    const double start = host.time();
    host.obstacles = {{5, 0.4, [start](double time) {
                         return Eigen::Vector2d{-5.0 + 0.6 * (time - start), 0.05};
                       }}};
    double farthest = 0.0;
    for (int i = 0; i < 1800; ++i) {
      host.tick();
      farthest = std::max(farthest, host.position.norm());
    }
    EXPECT_GT(host.obstacle_clearance, 0.0);
    EXPECT_GT(farthest, 0.3);  // it did step aside
    EXPECT_EQ(host.agent.status().reason, StopCause::arrived);
    EXPECT_LT(host.position.norm(), 0.05);
    EXPECT_LT(host.largest_jump, 1e-6);
  }
}

TEST_P(RobotAgentTest, TellsItsPlanOftenEnoughAndTruly) {
  AgentParameters agent = parameters();
  agent.robot.radius = 0.25;
  IdealHost host{agent, empty_map(), {-3.0, 0.0}, 4};
  host.agent.set_goal({1.0, 0.0});
  double last = 0.0;
  std::uint32_t sequence = 0;
  bool was_moving = false;
  for (int i = 0; i < 1200; ++i) {
    const AgentOutput output = host.tick();
    if (!output.broadcast) {
      EXPECT_LE(host.time() - last, agent.team.message_period + 1e-9);
      continue;
    }
    const TrajectoryMessage& message = *output.broadcast;
    EXPECT_GT(message.sequence, sequence);
    sequence = message.sequence;
    last = host.time();
    EXPECT_EQ(message.robot_id, 4);
    EXPECT_EQ(message.radius, 0.25);
    EXPECT_EQ(message.sent_time, host.time());
    EXPECT_NEAR(message.expiry_time, host.time() + agent.team.message_lifetime, 1e-9);
    EXPECT_EQ(message.state, host.agent.status().state);
    EXPECT_TRUE(std::isfinite(message.position_sigma));
    for (const double ahead : {0.0, 0.5, 3.0, 30.0}) {
      const double then = host.time() + ahead;
      EXPECT_EQ(message.trajectory.position(then), host.agent.committed().position(then));
    }
    was_moving = was_moving || message.state == PeerState::moving;
  }
  EXPECT_TRUE(was_moving);
  EXPECT_EQ(host.told.back().state, PeerState::arrived);
}

TEST_P(RobotAgentTest, AvoidsAPeerOfLowerPriorityThatDrivesIntoIt) {
  IdealHost host{parameters(), empty_map(), {-4.0, 0.0}, 1};
  // Number 7 ought to yield, and does not: it comes along the robot's own line at 0.7 m/s.
  const Trajectory course = straight({4.5, 0.0}, {-0.7, 0.0}, 0.0, 12.0);
  std::uint32_t sequence = 0;
  double least = std::numeric_limits<double>::infinity();
  host.more_input = [&](double time, AgentInput& input) {
    least = std::min(least, (host.position - course.position(time)).norm());
    input.messages.push_back(told_by(7, ++sequence, time, PeerState::moving, course));
  };
  host.agent.set_goal({4.0, 0.0});
  EXPECT_TRUE(host.arrives_within(25.0));
  EXPECT_GT(least, 0.6);  // both radii
  expect_limits(host);
}

TEST(RobotAgent, OfThePapersMethodBrakesForAPeerOfLowerPriority) {
  // Beside walls there is no way round the peer, which ought to yield and does not: it stops only in the gap.
  const std::vector<TrueBox> corridor{{{-6.0, 0.6}, {6.0, 2.0}}, {{-6.0, -2.0}, {6.0, -0.6}}};
  const AgentParameters parameters = with_method(AgentParameters{}, "spf_empc");
  IdealHost host{parameters, map_of(corridor), {-4.0, 0.0}, 1};
  host.boxes = corridor;
  const Trajectory course = straight({4.5, 0.0}, {-0.7, 0.0}, 0.0, 4.0);  // then it stands at 1.7
  std::uint32_t sequence = 0;
  double least = std::numeric_limits<double>::infinity();
  host.more_input = [&](double time, AgentInput& input) {
    least = std::min(least, (host.position - course.position(time)).norm());
    const PeerState state = time < 4.0 ? PeerState::moving : PeerState::stopped;
    input.messages.push_back(told_by(7, ++sequence, time, state, course));
  };
  host.agent.set_goal({5.0, 0.0});
  host.run(12.0);
  EXPECT_GT(least, 0.6);
  EXPECT_LT(host.speed(), 0.05);
  EXPECT_EQ(host.agent.status().reason, StopCause::peer_ahead);
  EXPECT_EQ(host.agent.status().blocking_id, 7);
}

TEST_P(RobotAgentTest, LetsTheDiscOfASilentPeerGrowAndForgetsIt) {
  IdealHost host{parameters(), empty_map(), {-4.0, 0.0}};
  const Eigen::Vector2d last_position{0.0, 3.0};
  host.more_input = [&](double time, AgentInput& input) {
    if (time > 1.0) return;
    const auto sequence = static_cast<std::uint32_t>(std::lround(100.0 * time));
    input.messages.push_back(
        told_by(9, sequence, time, PeerState::moving, Trajectory::standing(last_position, time, 1.0)));
  };
  host.agent.set_goal({4.0, 0.0});
  host.run(1.5);
  ASSERT_EQ(host.agent.peers().size(), 1U);
  EXPECT_FALSE(host.agent.peers()[0].expired);
  const PeerTableParameters table;
  double growth = -1.0;
  for (int i = 0; i < 30; ++i) {
    host.run(0.1);
    ASSERT_EQ(host.agent.peers().size(), 1U);
    const Peer& peer = host.agent.peers()[0];
    EXPECT_EQ(peer.position(host.time()), last_position);
    if (!peer.expired) continue;
    EXPECT_GT(peer.growth, growth);
    growth = peer.growth;
    EXPECT_LE(growth, table.growth_rate * (host.time() - 2.0) + 1e-9);
  }
  EXPECT_GT(growth, 0.7);  // 4.5 s, silent since 1 s, expired since 2 s
  host.run(10.0);
  EXPECT_TRUE(host.agent.peers().empty());
}

class RobotAgentMethodTest : public ::testing::TestWithParam<std::string> {};

INSTANTIATE_TEST_SUITE_P(Methods, RobotAgentMethodTest, ::testing::ValuesIn([] {
                           std::vector<std::string> names;
                           const MethodTable methods;
                           for (const Method& method : methods.all()) names.push_back(method.name);
                           return names;
                         }()),
                         [](const auto& parameter) { return std::string{parameter.param}; });

TEST_P(RobotAgentMethodTest, CrossesAShortWayPastAnObstacleAndAPeer) {
  IdealHost host{
      with_method(AgentParameters{}, GetParam()), map_of({{{0.0, 1.5}, {1.0, 2.5}}}), {-3.0, 0.0}, 2};
  host.obstacles = {{5, 0.4, [](double) { return Eigen::Vector2d{0.2, -0.3}; }}};
  std::uint32_t sequence = 0;
  host.more_input = [&](double time, AgentInput& input) {
    input.messages.push_back(
        told_by(1, ++sequence, time, PeerState::moving, straight({2.0, -4.0}, {0.0, 0.5}, 0.0, 14.0)));
  };
  host.agent.set_goal({3.0, 0.2}, 1.0);
  EXPECT_TRUE(host.arrives_within(25.0)) << to_string(host.agent.status().reason);
  EXPECT_GT(host.obstacle_clearance, 0.0);
  EXPECT_LT(host.largest_jump, 1e-6);
}

TEST_P(RobotAgentMethodTest, GivesTheSameBitsForTheSameInputs) {
  const AgentParameters parameters = with_method(AgentParameters{}, GetParam());
  IdealHost host{parameters, map_of({kBoxAhead}), {-3.0, 0.0}};
  host.obstacles = {{5, 0.4, [](double time) { return Eigen::Vector2d{3.0 - 0.5 * time, 1.2}; }}};
  RandomStream noise{9};
  AgentInput heard;  // by both agents
  host.more_input = [&](double, AgentInput& input) {
    input.state.pose_world.position_world += 0.01 * noise.normal2();
    if (input.observation)
      for (Detection& detection : input.observation->detections)
        detection.position_world += 0.02 * noise.normal2();
    heard = input;
  };
  RobotAgent second{1, parameters, map_of({kBoxAhead}), {{-3.0, 0.0}, 0.0}, 0.0};
  host.agent.set_goal({3.0, 0.0});
  second.set_goal({3.0, 0.0});
  for (int i = 0; i < 600; ++i) {
    const AgentOutput first = host.tick();
    const AgentOutput other = step(second, host.time(), heard);
    ASSERT_EQ(first.broadcast.has_value(), other.broadcast.has_value()) << host.time();
    ASSERT_EQ(host.agent.committed().duration(), second.committed().duration());
    ASSERT_EQ(host.agent.committed().tail_position(), second.committed().tail_position());
  }
  EXPECT_GT((host.position - Eigen::Vector2d{-3.0, 0.0}).norm(), 1.0);
}

TEST(RobotAgent, ExactlyOnItsPlanItIsSureOfIt) {
  RobotAgent agent{1, AgentParameters{}, empty_map(), {{-3.0, 0.0}, 0.0}, 0.0};
  agent.set_goal({3.0, 0.0});
  for (int tick = 1; tick <= 1000; ++tick) {
    if (!agent.plan_due(0.01 * tick)) continue;
    StateEstimate exact;
    exact.valid = true;
    exact.pose_world = {agent.committed().position(0.01 * tick), 0.0};
    const std::optional<TrajectoryMessage> told = agent.plan(0.01 * tick, exact);
    EXPECT_EQ(told.value_or(TrajectoryMessage{}).position_sigma, 0.0);
  }
  EXPECT_LT((agent.committed().position(10.0) - Eigen::Vector2d{3.0, 0.0}).norm(), 0.05);
}

TEST(RobotAgent, TellsHowFarItMayBeFromItsPlan) {
  RobotAgent agent{1, AgentParameters{}, empty_map(), {{-3.0, 0.0}, 0.0}, 0.0};
  agent.set_goal({3.0, 0.0});
  StateEstimate state;
  state.valid = true;
  state.pose_world = {{-3.0, 0.0}, 0.0};
  state.position_variance = 0.04;
  const std::optional<TrajectoryMessage> told = agent.plan(0.0, state);
  ASSERT_TRUE(told.has_value());
  EXPECT_NEAR(told->position_sigma, 0.2, 1e-12);
}

TEST(RobotAgent, BrakesForACauseThatNoPlanCanMendAndNamesIt) {
  for (const StopCause cause : {StopCause::stale_pose, StopCause::no_scan, StopCause::emergency_stop}) {
    IdealHost host{AgentParameters{}, empty_map(), {-8.0, 0.0}};
    host.agent.set_goal({8.0, 0.0});
    host.run(3.0);
    ASSERT_GT(host.speed(), 0.9);
    host.stop = cause;
    host.run(0.2);
    EXPECT_EQ(host.agent.status().state, PeerState::braking);
    host.run(2.0);
    EXPECT_EQ(host.speed(), 0.0);
    EXPECT_EQ(host.agent.status().reason, cause);
    host.stop = StopCause::none;
    EXPECT_TRUE(host.arrives_within(20.0));
  }
}

/// Plans nothing and counts what it is asked.
class Counter final : public Planner {
 public:
  explicit Counter(int* calls) : calls_{calls} {}
  void plan(const PlanRequest& request, PlanResult& result) override {
    ++*calls_;
    result.clear();
    stand_instead(request, RobotParameters{}, PlanOutcome::unsafe, result);
  }

 private:
  int* calls_;
};

TEST(RobotAgent, BuildsThePlannerItIsGivenAndNoOther) {
  int made = 0;
  int calls = 0;
  AgentParameters parameters;
  parameters.make_planner = [&](const AgentParameters&) {
    ++made;
    return std::make_unique<Counter>(&calls);
  };
  IdealHost host{parameters, empty_map(), {-3.0, 0.0}};
  host.agent.set_goal({3.0, 0.0});
  host.run(1.0);
  EXPECT_EQ(made, 1);
  EXPECT_NEAR(calls, 10, 1);
  EXPECT_EQ(host.agent.status().reason, StopCause::planner_failed);
  EXPECT_EQ(host.agent.last_plan().outcome, PlanOutcome::unsafe);
}

// Nothing near it, and then somebody upon it: every method means the same.
TEST(RobotAgent, RiskIsTheSameForEveryMethod) {
  const MethodTable methods;
  for (const Method& method : methods.all()) {
    SCOPED_TRACE(method.name);
    IdealHost host{with_method(AgentParameters{}, method), empty_map(), {-3.0, 0.0}};
    host.agent.set_goal({6.0, 0.0});
    host.run(0.5);
    EXPECT_EQ(host.agent.last_plan().risk, 0.0);
    const Eigen::Vector2d beside = host.position + Eigen::Vector2d{0.3, 0.4};
    host.obstacles = {{5, 0.4, [beside](double) { return beside; }}};
    host.run(0.2);
    EXPECT_GT(host.agent.last_plan().risk, 0.99);
    EXPECT_LE(host.agent.last_plan().risk, 1.0);
  }
}

TEST(RobotAgent, RefusesWhatIsOutOfRange) {
  AgentParameters parameters;
  parameters.team.stale_time = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW((RobotAgent{1, parameters, empty_map(), {}, 0.0}), std::invalid_argument);
  RobotAgent agent{1, AgentParameters{}, empty_map(), {}, 0.0};
  EXPECT_THROW(agent.set_goal({std::numeric_limits<double>::infinity(), 0.0}), std::invalid_argument);
  EXPECT_THROW(agent.set_goal({0.0, 0.0}, std::numeric_limits<double>::quiet_NaN()), std::invalid_argument);
}

}  // namespace
}  // namespace spf
