// The agent among broken sensors and hostile peers: it neither crashes nor stops.
#include <gtest/gtest.h>

#include "spf/math/random_stream.hpp"
#include "spf/team/ideal_host_test.hpp"

namespace spf {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

class HostileTest : public ::testing::TestWithParam<const char*> {
 protected:
  [[nodiscard]] AgentParameters parameters() const { return with_method(AgentParameters{}, GetParam()); }

  /// A short crossing past a box with the given addition to every input; hands back who the agent believed
  /// in.
  std::vector<Peer> expect_arrival(const std::function<void(double, AgentInput&)>& more_input) {
    const TrueBox box{{-1.0, -1.2}, {0.0, 0.8}};
    IdealHost host{parameters(), map_of({box}), {-3.0, 0.0}, 2};
    host.boxes = {box};
    host.more_input = more_input;
    host.agent.set_goal({2.0, 0.0});
    EXPECT_TRUE(host.arrives_within(20.0)) << to_string(host.agent.status().reason);
    EXPECT_GT(host.box_clearance, 0.0);
    EXPECT_LT(host.largest_jump, 1e-6);
    return host.agent.peers();
  }
};

INSTANTIATE_TEST_SUITE_P(Methods, HostileTest,
                         ::testing::Values("space_time", "spf_empc", "es2_constant_velocity", "orca"),
                         [](const auto& parameter) { return std::string{parameter.param}; });

TEST_P(HostileTest, StatesThatAreNotKnown) {
  int tick = 0;
  expect_arrival([&tick](double, AgentInput& input) {
    if (++tick % 3 == 0) input.state = {};
    if (tick % 3 == 1) input.state.valid = false;
  });
}

TEST_P(HostileTest, TimesFarFromThePresent) {
  expect_arrival([](double time, AgentInput& input) {
    if (!input.observation) return;
    // Every other sweep comes with a broken clock.
    const int tick = static_cast<int>(std::lround(10.0 * time));
    if (tick % 2 == 0) input.observation->time = tick % 4 == 0 ? 1e9 : kNaN;
  });
}

TEST_P(HostileTest, DetectionsAndScansThatMakeNoSense) {
  expect_arrival([](double, AgentInput& input) {
    if (!input.observation) return;
    std::vector<Detection>& detections = input.observation->detections;
    detections.push_back({1, {kNaN, 0.0}, std::nullopt, 0.3, 0.0});
    detections.push_back({2, {0.0, 2.0}, Eigen::Vector2d{kInfinity, 0.0}, 0.3, 0.0});
    detections.push_back({3, {0.0, 2.0}, std::nullopt, kNaN, 0.0});
    detections.push_back({4, {0.0, 2.0}, std::nullopt, -1.0, 0.0});
    detections.push_back({5, {0.0, 2.0}, std::nullopt, 0.3, kInfinity});
    detections.push_back({6, {1e300, -1e300}, Eigen::Vector2d{1e200, 1e200}, 0.3, 1e150});
    RangeScan scan;
    scan.angle_min = kNaN;
    scan.ranges = {1.0, kNaN, -kInfinity};
    input.observation->scan = scan;
  });
}

/// A message of a peer that stands out of the way, and is good but for what the caller breaks.
TrajectoryMessage good_message(int id, std::uint32_t sequence, double time) {
  return told_by(id, sequence, time, PeerState::moving, straight({0.0, 8.0}, {0.1, 0.0}, time, 2.0));
}

TEST_P(HostileTest, MessagesThatAreMalformed) {
  std::uint32_t sequence = 100;
  const std::vector<Peer> believed = expect_arrival([&](double time, AgentInput& input) {
    const auto add = [&](int id, const std::function<void(TrajectoryMessage&)>& spoil) {
      TrajectoryMessage message = good_message(id, ++sequence, time);
      spoil(message);
      input.messages.push_back(message);
    };
    add(10, [](TrajectoryMessage& m) { m.trajectory = straight({kNaN, 0.0}, {0.0, 0.0}, 0.0, 2.0); });
    add(11, [](TrajectoryMessage& m) { m.trajectory = straight({0.0, 0.0}, {kInfinity, 0.0}, 0.0, 2.0); });
    add(12, [](TrajectoryMessage& m) { m.trajectory = Trajectory{}; });
    add(13, [](TrajectoryMessage& m) { m.sent_time = kNaN; });
    add(14, [](TrajectoryMessage& m) { m.expiry_time = kNaN; });
    add(15, [](TrajectoryMessage& m) { m.sent_time = 1e300; });
    add(16, [](TrajectoryMessage& m) { m.radius = kNaN; });
    add(17, [](TrajectoryMessage& m) { m.radius = -1.0; });
    add(18, [](TrajectoryMessage& m) { m.position_sigma = kInfinity; });
    add(19, [](TrajectoryMessage& m) { m.trajectory = straight({0.0, 8.0}, {0.1, 0.0}, kNaN, 2.0); });
    add(20, [](TrajectoryMessage& m) { m.trajectory.set_heading(HeadingProfile{kNaN}); });
    // In the robot's name, in its way.
    add(2, [&](TrajectoryMessage& m) { m.trajectory = straight({1.0, 0.0}, {0.0, 0.0}, time, 9.0); });
    // Overtaken on the way: what the peer said before it left the robot's way.
    add(21, [](TrajectoryMessage&) {});
    add(21, [&](TrajectoryMessage& m) {
      m.sequence -= 50;
      m.trajectory = straight({1.0, 0.0}, {0.0, 0.0}, time, 9.0);
    });
  });
  ASSERT_EQ(believed.size(), 1U);
  EXPECT_EQ(believed[0].robot_id, 21);
  EXPECT_GT(believed[0].position(0.0).y(), 7.0);
}

TEST_P(HostileTest, MessagesWithHugeButFiniteNumbers) {
  std::uint32_t sequence = 0;
  expect_arrival([&](double time, AgentInput& input) {
    int id = 30;
    for (const double huge : {1e12, 1e150, 1e300, -1e308}) {
      TrajectoryMessage message = good_message(id++, ++sequence, time);
      message.trajectory = straight({huge, huge}, {-huge, huge}, time, 2.0);
      input.messages.push_back(message);
      message = good_message(id++, ++sequence, time);
      QuinticPiece piece;
      piece.coefficients.setConstant(huge);
      piece.coefficients.row(0) << 0.0, 8.0;
      piece.duration = std::abs(huge);
      message.trajectory = Trajectory{time};
      message.trajectory.append(piece);
      message.trajectory.append(piece);
      message.position_sigma = std::abs(huge);
      message.expiry_time = std::abs(huge);
      input.messages.push_back(message);
      message = good_message(id++, ++sequence, time);
      message.trajectory = straight({0.0, 8.0}, {0.1, 0.0}, -std::abs(huge), 1e-300);
      input.messages.push_back(message);
    }
  });
}

TEST_P(HostileTest, RandomMessages) {
  RandomStream random{77};
  const auto number = [&random] {
    switch (static_cast<int>(random.uniform(0.0, 6.0))) {
      case 0:
        return kNaN;
      case 1:
        return std::ldexp(random.uniform(-1.0, 1.0), static_cast<int>(random.uniform(-1000.0, 1000.0)));
      default:
        return random.uniform(-3.0, 12.0);
    }
  };
  IdealHost host{parameters(), empty_map(), {-3.0, 0.0}, 2};
  host.more_input = [&](double time, AgentInput& input) {
    for (int i = 0; i < 3; ++i) {
      TrajectoryMessage message;
      message.robot_id = static_cast<int>(random.uniform(0.0, 12.0));
      message.sequence = static_cast<std::uint32_t>(random.bits());
      message.sent_time = random.uniform() < 0.5 ? time : number();
      message.expiry_time = message.sent_time + number();
      message.radius = number();
      message.position_sigma = std::abs(number());
      message.state = static_cast<PeerState>(static_cast<int>(random.uniform(0.0, 4.0)));
      message.trajectory = Trajectory{random.uniform() < 0.5 ? time : number()};
      for (int k = 0; k < 3; ++k) {
        QuinticPiece piece;
        for (int j = 0; j < 12; ++j)
          piece.coefficients(j / 2, j % 2) = random.uniform() < 0.3 ? number() : 0.1;
        piece.duration = 1e-3 + std::abs(random.uniform() < 0.3 ? number() : 1.0);
        if (piece.duration > 0.0) message.trajectory.append(piece);
      }
      input.messages.push_back(message);
    }
  };
  host.agent.set_goal({2.0, 0.0});
  for (int i = 0; i < 500; ++i) {
    host.tick();
    ASSERT_TRUE(host.position.allFinite());
    ASSERT_TRUE(std::isfinite(host.agent.committed().duration()));
  }
  EXPECT_LT(host.largest_jump, 1e-6);
}

TEST_P(HostileTest, AStepFarIntoTheFuture) {
  IdealHost host{parameters(), empty_map(), {-3.0, 0.0}};
  host.agent.set_goal({2.0, 0.0});
  host.run(1.0);
  // The host slept: the next plan ends at once, and the agent stands, as nothing is known of the present.
  const double late = 1e9;
  host.agent.plan(late, StateEstimate{}, StopCause::stale_pose);
  EXPECT_EQ(host.agent.committed().state(late).velocity_world.norm(), 0.0);
  EXPECT_FALSE(host.agent.plan_due(late));
  // A plan that ends at the goal has arrived long since, as far as anybody knows.
  const StopCause reason = host.agent.status().reason;
  EXPECT_TRUE(reason == StopCause::stale_pose || reason == StopCause::arrived) << to_string(reason);
}

}  // namespace
}  // namespace spf
