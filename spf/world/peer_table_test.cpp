#include "spf/world/peer_table.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "spf/math/angles.hpp"
#include "spf/math/random_stream.hpp"

namespace spf {
namespace {

/// A peer that drives at 0.5 m/s along x for 4 s from (id, 0).
TrajectoryMessage message_of(int id, std::uint32_t sequence, double time) {
  TrajectoryMessage message;
  message.robot_id = id;
  message.sequence = sequence;
  message.sent_time = time;
  message.expiry_time = time + 5.0;
  message.state = PeerState::moving;
  QuinticPiece piece;
  piece.coefficients(0, 0) = id;
  piece.coefficients(1, 0) = 0.5;
  piece.duration = 4.0;
  message.trajectory = Trajectory{time};
  message.trajectory.append(piece);
  return message;
}

TEST(PeerTable, KeepsTheNewestMessageOfEverybody) {
  PeerTable table{1};
  EXPECT_EQ(table.receive(message_of(5, 10, 0.0), 0.05), MessageVerdict::accepted);
  EXPECT_EQ(table.receive(message_of(2, 3, 0.0), 0.05), MessageVerdict::accepted);
  EXPECT_EQ(table.receive(message_of(1, 3, 0.0), 0.05), MessageVerdict::own);
  EXPECT_EQ(table.receive(message_of(5, 10, 0.0), 0.06), MessageVerdict::duplicate);
  EXPECT_EQ(table.receive(message_of(5, 9, 0.0), 0.06), MessageVerdict::old);
  EXPECT_EQ(table.receive(message_of(5, 11, 0.2), 0.25), MessageVerdict::accepted);
  const std::vector<Peer>& peers = table.peers(0.3);
  ASSERT_EQ(peers.size(), 2u);
  EXPECT_EQ(peers[0].robot_id, 2);
  EXPECT_EQ(peers[1].robot_id, 5);
  EXPECT_NEAR(peers[1].position(1.2).x(), 5.5, 1e-12);
  EXPECT_NEAR(peers[1].velocity(1.2).x(), 0.5, 1e-12);
  EXPECT_EQ(table.count(MessageVerdict::accepted), 3u);
  EXPECT_EQ(table.count(MessageVerdict::own), 1u);
  EXPECT_EQ(table.count(MessageVerdict::duplicate), 1u);
  EXPECT_EQ(table.count(MessageVerdict::old), 1u);
}

TEST(PeerTable, RefusesMalformedMessages) {
  const double nan = std::nan("");
  PeerTable table{1};
  const auto refused = [&](const TrajectoryMessage& message) {
    return table.receive(message, 0.0) == MessageVerdict::malformed;
  };
  TrajectoryMessage message = message_of(2, 1, 0.0);
  message.trajectory = Trajectory{};
  EXPECT_TRUE(refused(message)) << "without a trajectory";
  message = message_of(2, 1, 0.0);
  message.radius = nan;
  EXPECT_TRUE(refused(message)) << "radius";
  message = message_of(2, 1, 0.0);
  message.position_sigma = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(refused(message)) << "sigma";
  message = message_of(2, 1, 0.0);
  message.sent_time = nan;
  EXPECT_TRUE(refused(message)) << "time";
  EXPECT_TRUE(refused(message_of(2, 1, 1.5))) << "from the future";
  EXPECT_TRUE(refused(message_of(2, 1, -20.0))) << "from long ago";
  message = message_of(2, 1, 0.0);
  QuinticPiece piece;
  piece.coefficients(3, 1) = nan;
  piece.duration = 1.0;
  message.trajectory.append(piece);
  EXPECT_TRUE(refused(message)) << "coefficient";
  EXPECT_TRUE(table.peers(0.0).empty());
  EXPECT_EQ(table.receive(message_of(2, 1, 0.9), 0.0),
            MessageVerdict::accepted);  // clocks may differ by that much
  EXPECT_EQ(table.receive(message_of(3, 1, 0.0), nan), MessageVerdict::malformed);
}

TEST(PeerTable, ASilentPeerBecomesAGrowingDiscThenIsForgotten) {
  PeerTableParameters parameters;
  PeerTable table{1, parameters};
  (void)table.receive(message_of(4, 1, 0.0), 0.0);
  EXPECT_FALSE(table.peers(0.99).front().expired);
  const Peer silent = table.peers(2.0).front();
  EXPECT_TRUE(silent.expired);
  EXPECT_NEAR(silent.position(2.0).x(), 4.5, 1e-12);  // where it was due when it had been silent for 1 s
  EXPECT_NEAR(silent.position(9.0).x(), 4.5, 1e-12);
  EXPECT_EQ(silent.velocity(0.5), Eigen::Vector2d::Zero());
  EXPECT_NEAR(silent.growth, parameters.growth_rate * 1.0, 1e-12);
  EXPECT_NEAR(table.peers(9.0).front().growth, parameters.largest_growth, 1e-12);
  EXPECT_TRUE(table.peers(1.0 + parameters.forget_time + 0.01).empty());
}

TEST(PeerTable, ExpiresWhenTheMessageSaysSo) {
  PeerTable table{1};
  TrajectoryMessage message = message_of(4, 1, 0.0);
  message.expiry_time = 0.4;
  (void)table.receive(message, 0.0);
  EXPECT_FALSE(table.peers(0.39).front().expired);
  EXPECT_TRUE(table.peers(0.41).front().expired);
}

TEST(PeerTable, AReturningPeerIsBelievedAgainEvenWithANewSequence) {
  PeerTable table{1};
  (void)table.receive(message_of(4, 1000, 0.0), 0.0);
  EXPECT_EQ(table.receive(message_of(4, 1, 0.5), 0.5), MessageVerdict::old);
  ASSERT_TRUE(table.peers(2.0).front().expired);
  EXPECT_EQ(table.receive(message_of(4, 1, 2.5), 2.5), MessageVerdict::accepted);
  EXPECT_FALSE(table.peers(2.6).front().expired);
  EXPECT_EQ(table.peers(2.6).front().growth, 0.0);
}

TEST(PeerTable, SequencesMayRunOverTheirEnd) {
  PeerTable table{1};
  (void)table.receive(message_of(4, 0xFFFFFFFFu, 0.0), 0.0);
  EXPECT_EQ(table.receive(message_of(4, 0u, 0.1), 0.1), MessageVerdict::accepted);
}

TEST(PeerTable, AnArrivedPeerStandsWhileItSpeaks) {
  PeerTable table{1};
  for (std::uint32_t k = 0; k < 1000; ++k) {
    TrajectoryMessage message = message_of(4, k, 0.0);  // the trajectory ended long ago, the message is fresh
    message.state = PeerState::arrived;
    message.sent_time = 0.5 * k;
    message.expiry_time = message.sent_time + 1.0;
    ASSERT_EQ(table.receive(message, 0.5 * k), MessageVerdict::accepted);
  }
  const Peer peer = table.peers(499.8).front();
  EXPECT_FALSE(peer.expired);
  EXPECT_NEAR(peer.position(499.8).x(), 6.0, 1e-12);
  EXPECT_EQ(peer.velocity(499.8), Eigen::Vector2d::Zero());
}

TEST(PeerTable, HoldsABoundedNumberOfPeers) {
  PeerTable table{0};
  const int most = static_cast<int>(kMostPeers);
  for (int id = 10 * most; id > 0; --id) (void)table.receive(message_of(id, 1, 0.0), 0.0);
  EXPECT_EQ(table.peers(0.0).size(), kMostPeers);
  EXPECT_EQ(table.count(MessageVerdict::accepted), kMostPeers);
  EXPECT_EQ(table.count(MessageVerdict::crowded), 9 * kMostPeers);
  // Known peers are heard; new ones wait until a known one has fallen silent.
  const int silent = 10 * most;
  for (int id = silent - 1; id > 9 * most; --id)
    ASSERT_EQ(table.receive(message_of(id, 2, 0.5), 0.5), MessageVerdict::accepted);
  EXPECT_EQ(table.receive(message_of(1, 1, 0.9), 0.9), MessageVerdict::crowded);
  EXPECT_EQ(table.receive(message_of(1, 1, 1.1), 1.1), MessageVerdict::accepted);
  EXPECT_EQ(table.receive(message_of(2, 1, 1.1), 1.1), MessageVerdict::crowded);
  const std::vector<Peer>& peers = table.peers(1.1);
  EXPECT_EQ(peers.size(), kMostPeers);
  EXPECT_EQ(peers.front().robot_id, 1);
  EXPECT_EQ(peers.back().robot_id, silent - 1);
}

/// One piece with one coefficient set, in both axes.
TrajectoryMessage message_with(int row, double coefficient, double duration) {
  TrajectoryMessage message = message_of(2, 1, 0.0);
  QuinticPiece piece;
  piece.coefficients.row(row).setConstant(coefficient);
  piece.duration = duration;
  message.trajectory = Trajectory{0.0};
  message.trajectory.append(piece);
  return message;
}

TEST(PeerTable, BelievesNothingThatLeavesTheFinite) {
  const auto verdict = [](const TrajectoryMessage& message) { return PeerTable{1}.receive(message, 0.0); };
  for (const double sign : {-1.0, 1.0}) {
    EXPECT_EQ(verdict(message_with(0, sign * 1e6, 10.0)), MessageVerdict::accepted)
        << "far, but a valid position";
    EXPECT_EQ(verdict(message_with(0, sign * 1e300, 1.0)), MessageVerdict::malformed) << "position";
    EXPECT_EQ(verdict(message_with(1, sign * 1e300, 1e-300)), MessageVerdict::malformed) << "speed alone";
    EXPECT_EQ(verdict(message_with(2, sign * 1e300, 1e-300)), MessageVerdict::malformed) << "acceleration";
    EXPECT_EQ(verdict(message_with(5, sign * 1e6, 1e60)), MessageVerdict::malformed)
        << "grows past the finite";
    EXPECT_EQ(verdict(message_with(5, sign * 1.0, 1e8)), MessageVerdict::malformed)
        << "grows beyond all bounds";
    EXPECT_EQ(verdict(message_with(3, sign * 1e-3, 1e8)), MessageVerdict::malformed) << "likewise";
  }
  EXPECT_EQ(verdict(message_with(0, 1.0, 1e300)), MessageVerdict::malformed) << "duration";
  TrajectoryMessage message = message_of(2, 1, 0.0);
  message.position_sigma = 1e300;
  EXPECT_EQ(verdict(message), MessageVerdict::malformed) << "sigma";
  message = message_of(2, 1, 0.0);
  HeadingPhases phases;
  phases.cruise_rate = 2.0 * kPi * 1e200;
  message.trajectory.set_heading(HeadingProfile::from_phases(phases).value());
  EXPECT_EQ(verdict(message), MessageVerdict::malformed) << "turns faster than all numbers";
}

TEST(PeerTable, WhatItBelievesCanBeReckonedWith) {
  RandomStream random{5};
  const auto wild = [&random] {
    return (random.uniform() < 0.5 ? -1.0 : 1.0) * std::pow(10.0, random.uniform(-300.0, 300.0));
  };
  int accepted = 0;
  for (int i = 0; i < 20000; ++i) {
    TrajectoryMessage message = message_of(2, 1, 0.0);
    message.trajectory = Trajectory{-std::abs(random.uniform() < 0.1 ? wild() : 0.0)};
    for (int k = 0; k < 3; ++k) {
      QuinticPiece piece;
      for (double& coefficient : piece.coefficients.reshaped())
        coefficient = random.uniform() < 0.05 ? wild() : random.uniform(-1.0, 1.0);
      piece.duration = random.uniform() < 0.1 ? std::abs(wild()) : random.uniform(0.1, 10.0);
      message.trajectory.append(piece);
    }
    PeerTable table{1};
    if (table.receive(message, 0.0) != MessageVerdict::accepted) continue;
    ++accepted;
    const Peer peer = table.peers(0.0).front();
    for (const double time : {-1e300, -1.0, 0.0, 0.3, 1.0, 5.0, 1e3, 1e8, 1e300}) {
      const FlatState state = peer.trajectory->state(time);
      ASSERT_TRUE(std::isfinite(state.position_world.squaredNorm() * state.velocity_world.squaredNorm() *
                                state.acceleration_world.squaredNorm()));
    }
  }
  EXPECT_GT(accepted, 1000);
}

}  // namespace
}  // namespace spf
