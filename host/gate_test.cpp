// What no honest sensor, clock or peer would say is refused by name, and counted; whatever it is, nothing
// breaks.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "host/bench_test.hpp"
#include "host/peer_witness.hpp"
#include "host/perception_host.hpp"
#include "host/plan_check.hpp"
#include "host/scan_check.hpp"
#include "spf/math/random_stream.hpp"
#include "spf/world/peer_table.hpp"

namespace spf::host {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

PoseMeasurement at(double time, double x, double heading = 0.0) {
  return {time, {{x, 0.0}, heading}};
}

TEST(PoseGate, NamesWhatItRefuses) {
  PoseGate gate{HostParameters{}, RobotParameters{}};
  EXPECT_EQ(gate.age(1.0), kInfinity);
  EXPECT_EQ(gate.judge(at(1.0, NAN), 1.0), PoseVerdict::malformed);
  EXPECT_EQ(gate.judge(at(1.0, 0.0, kInfinity), 1.0), PoseVerdict::malformed);
  EXPECT_EQ(gate.judge(at(NAN, 0.0), 1.0), PoseVerdict::malformed);
  EXPECT_EQ(gate.judge(at(1.0, 2e6), 1.0), PoseVerdict::malformed);
  EXPECT_EQ(gate.judge(at(1.2, 0.0), 1.0), PoseVerdict::future);
  EXPECT_EQ(gate.judge(at(1.0, 0.0), 1.0), PoseVerdict::accepted);
  EXPECT_EQ(gate.judge(at(1.0, 0.0), 1.0), PoseVerdict::late);
  EXPECT_EQ(gate.judge(at(0.9, 0.0), 1.0), PoseVerdict::late);
  EXPECT_EQ(gate.judge(at(1.01, 0.6), 1.01), PoseVerdict::jump);
  EXPECT_EQ(gate.judge(at(1.02, 0.0, 0.7), 1.02), PoseVerdict::jump);
  EXPECT_EQ(gate.judge(at(1.03, 0.01), 1.03), PoseVerdict::accepted);
  EXPECT_NEAR(gate.age(1.5), 0.47, 1e-12);
}

TEST(PoseGate, TimeAllowsDistance) {
  PoseGate gate{HostParameters{}, RobotParameters{}};
  EXPECT_EQ(gate.judge(at(1.0, 0.0), 1.0), PoseVerdict::accepted);
  EXPECT_EQ(gate.judge(at(3.0, 3.0), 3.0), PoseVerdict::accepted);
}

TEST(PoseGate, JumpsThatDoNotAgreeAreNeverBelieved) {
  PoseGate gate{HostParameters{}, RobotParameters{}};
  RandomStream random{3};
  EXPECT_EQ(gate.judge(at(1.0, 0.0), 1.0), PoseVerdict::accepted);
  for (int i = 1; i < 200; ++i) {
    // Each far from the one before.
    const double x = (i % 2 == 0 ? 1.0 : -1.0) * random.uniform(100.0, 200.0);
    EXPECT_EQ(gate.judge(at(1.0 + 0.01 * i, x), 1.0 + 0.01 * i), PoseVerdict::jump);
  }
}

TrajectoryMessage told(int robot_id, double time, const Trajectory& trajectory) {
  TrajectoryMessage message;
  message.robot_id = robot_id;
  message.sequence = std::isfinite(time) ? static_cast<std::uint32_t>(std::clamp(time * 100.0, 0.0, 4e9)) : 0;
  message.sent_time = time;
  message.expiry_time = time + 1.5;
  message.trajectory = trajectory;
  return message;
}

Trajectory standing(double x, double time) {
  return Trajectory::standing({x, 0.0}, time, 1.0);
}

Trajectory with_coefficient(double value, int row, double duration = 1.0) {
  Trajectory trajectory{1.0};
  QuinticPiece piece;
  piece.coefficients(row, 0) = value;
  piece.duration = duration;
  trajectory.append(piece);
  return trajectory;
}

TEST(PlanCheck, RefusesWhatNobodyCouldDrive) {
  const PlanLimits limits{2.0, 100.0};
  EXPECT_TRUE(drivable(standing(1.0, 5.0), limits));
  EXPECT_TRUE(drivable(with_coefficient(1.0, 1), limits));
  EXPECT_FALSE(drivable(Trajectory{1.0}, limits));
  EXPECT_FALSE(drivable(standing(NAN, 5.0), limits));
  EXPECT_FALSE(drivable(standing(1e7, 5.0), limits));
  EXPECT_FALSE(drivable(standing(1.0, kInfinity), limits));
  EXPECT_FALSE(drivable(with_coefficient(2.5, 1), limits));
  EXPECT_FALSE(drivable(with_coefficient(1e300, 5), limits));
  EXPECT_FALSE(drivable(with_coefficient(0.0, 1, 200.0), limits));
  EXPECT_FALSE(drivable(with_coefficient(0.0, 1, kInfinity), limits));
  Trajectory apart = standing(0.0, 1.0);
  apart.append(standing(1.0, 1.0).piece(0));
  EXPECT_FALSE(drivable(apart, limits));
}

TEST(TrackerHost, NamesThePlansItRefuses) {
  TrackerHost host{3, AgentParameters{}, HostParameters{}};
  EXPECT_EQ(host.add_plan(told(2, 10.0, standing(0.0, 10.0)), 10.0), PlanVerdict::foreign);
  EXPECT_EQ(host.add_plan(told(3, NAN, standing(0.0, 10.0)), 10.0), PlanVerdict::malformed);
  EXPECT_EQ(host.add_plan(told(3, 10.0, with_coefficient(3.0, 1)), 10.0), PlanVerdict::malformed);
  EXPECT_EQ(host.add_plan(told(3, 11.0, standing(0.0, 10.0)), 10.0), PlanVerdict::future);
  EXPECT_EQ(host.add_plan(told(3, 10.0, standing(0.0, 12.0)), 10.0), PlanVerdict::future);
  EXPECT_EQ(host.add_plan(told(3, 10.0, standing(0.0, 10.0)), 10.0), PlanVerdict::accepted);
  EXPECT_EQ(host.add_plan(told(3, 10.0, standing(0.0, 10.0)), 10.0), PlanVerdict::late);
  EXPECT_EQ(host.add_plan(told(3, 9.9, standing(0.0, 9.9)), 10.0), PlanVerdict::late);
  EXPECT_EQ(host.plans_refused(), 7u);
}

TEST(TrackerProcess, StandsUntilItKnowsWhereItIsAndWhatToDo) {
  TrackerProcess host{0, AgentParameters{}, HostParameters{}};
  EXPECT_EQ(host.step(10.0).stop, StopCause::no_pose);
  host.add_pose(at(10.0, 0.0), 10.0);
  EXPECT_EQ(host.step(10.0).stop, StopCause::no_scan);  // its guard would be blind
  RangeScan scan;
  scan.angle_increment = 0.1;
  scan.ranges.assign(60, kInfinity);
  ASSERT_TRUE(host.add_scan(10.0, scan, Pose2{}, 10.0));
  EXPECT_EQ(host.step(10.0).stop, StopCause::no_plan);
  // A plan that begins elsewhere is not chased.
  host.add_plan(told(0, 10.0, standing(2.0, 10.0)), 10.0);
  EXPECT_EQ(host.step(10.01).stop, StopCause::far_from_plan);
  EXPECT_TRUE(host.tracker().command().wheel_speeds.isZero());
  host.add_plan(told(0, 10.02, standing(0.1, 10.0)), 10.02);
  EXPECT_EQ(host.step(10.05).stop, StopCause::none);
  EXPECT_GT(host.tracker().command().twist_body.x(), 0.0);
}

/// Random bits as a message: numbers of all sizes, NaN and infinities among them.
double wild(RandomStream& random) {
  const double kind = random.uniform();
  if (kind < 0.1) return NAN;
  if (kind < 0.2) return random.uniform() < 0.5 ? kInfinity : -kInfinity;
  if (kind < 0.5) return random.normal() * std::pow(10.0, random.uniform(-300.0, 300.0));
  return random.normal();
}

TrajectoryMessage wild_message(RandomStream& random, double now, int robot_id) {
  const auto mostly = [&random](double sane) { return random.uniform() < 0.2 ? wild(random) : sane; };
  Trajectory trajectory{mostly(now)};
  const int pieces = static_cast<int>(random.uniform(0.0, 4.0));
  for (int i = 0; i < pieces; ++i) {
    QuinticPiece piece;
    piece.duration = std::abs(mostly(0.5));
    if (!(piece.duration > 0.0)) piece.duration = 1e-300;  // the wire refuses the others (conversions)
    for (double& coefficient : piece.coefficients.reshaped())
      coefficient = random.uniform() < 0.02 ? wild(random) : 0.1 * random.normal();
    trajectory.append(piece);
  }
  TrajectoryMessage message = told(robot_id, mostly(now), trajectory);
  message.sequence = static_cast<std::uint32_t>(random.uniform(0.0, 4e9));
  message.expiry_time = mostly(now + 1.5);
  message.radius = mostly(0.3);
  message.position_sigma = std::abs(mostly(0.02));
  return message;
}

TEST(Faults, NothingThatAPeerSendsStopsOrBreaksARobotFarAway) {
  Bench bench;
  RandomStream random{11};
  bench.planner.set_goal({{15.0, 10.0}, std::nullopt});
  int refused = 0;
  bench.each_tenth = [&] {
    for (int i = 0; i < 20; ++i) {
      TrajectoryMessage message = wild_message(random, bench.now, 1 + i % 7);
      const bool near = !message.trajectory.empty() &&
                        (message.trajectory.position(bench.now) - bench.pose.position_world).norm() < 8.0;
      if (near) continue;
      if (bench.planner.add_message(message, bench.now) == MessageVerdict::malformed) ++refused;
    }
  };
  bench.run(10.0);
  EXPECT_GT(refused, 100);
  EXPECT_GT((bench.pose.position_world).norm(), 5.0) << bench.reason();
  for (const Peer& peer : bench.planner.agent()->peers()) {
    EXPECT_LE(peer.radius, bench.host.largest_peer_radius);
    EXPECT_LE(peer.position_sigma, bench.host.largest_peer_sigma);
  }
}

TEST(Faults, AnOwnPlanFullOfNoiseNeverMakesItFast) {
  TrackerProcess host{0, AgentParameters{}, HostParameters{}};
  RandomStream random{12};
  const double limit = host.tracker().max_wheel_speed() + 1e-9;
  for (int i = 0; i < 3000; ++i) {
    const double now = 10.0 + 0.01 * i;
    host.add_pose(at(now, 0.0), now);
    host.add_plan(wild_message(random, now, 0), now);
    const TrackerCommand& command = host.step(now);
    ASSERT_TRUE(command.wheel_speeds.allFinite());
    ASSERT_LE(command.wheel_speeds.lpNorm<Eigen::Infinity>(), limit);
  }
  EXPECT_GT(host.tracker().plans_refused(), 1000u);
}

TEST(Faults, APeerRestartedWithItsSequenceFromZeroIsHeardAgainAfterItsSilence) {
  Bench bench;
  bench.run(1.0);
  TrajectoryMessage message = told(1, bench.now, standing(5.0, bench.now));
  message.sequence = 5000;
  bench.planner.add_message(message, bench.now);
  bench.tick();
  ASSERT_EQ(bench.planner.counts().messages_accepted, 1u);
  const auto say = [&](std::uint32_t sequence) {
    message = told(1, bench.now, standing(6.0, bench.now));
    message.sequence = sequence;
    bench.planner.add_message(message, bench.now);
    bench.tick();
  };
  say(1);
  EXPECT_EQ(bench.planner.counts().messages_old, 1u);
  bench.run(1.1);
  say(2);
  EXPECT_EQ(bench.planner.counts().messages_accepted, 2u);
  EXPECT_NEAR(bench.planner.agent()->peers().at(0).position(bench.now).x(), 5.0,
              1e-9);  // as of the last plan
  bench.run(0.1);
  EXPECT_NEAR(bench.planner.agent()->peers().at(0).position(bench.now).x(), 6.0, 1e-9);
}

TEST(Faults, ItsOwnSequenceGrowsOverRestartsOfItsAgent) {
  Bench bench{Arrangement::split, HostParameters{}, 700};
  std::uint32_t last = 700;
  const auto watch = [&](double seconds) {
    for (int i = 0; i < static_cast<int>(seconds / Bench::kTick); ++i) {
      bench.planner_alive = false;
      bench.tick();
      bench.planner_alive = true;
      bench.planning.add_pose({bench.now, bench.pose}, bench.now);
      const PlannerOutput& output = bench.planning.step(bench.now);
      if (!output.broadcast) continue;
      const TrajectoryMessage& told = *output.broadcast;
      EXPECT_GT(told.sequence, last);
      last = told.sequence;
    }
  };
  watch(2.0);
  const std::uint32_t before = last;
  EXPECT_GT(before, 700u);
  bench.planner.meet_clock_jump();  // makes the agent anew
  watch(2.0);
  EXPECT_GT(last, before);
  EXPECT_EQ(bench.planner.counts().restarts, 2u);
}

/// From a position on, at constant velocity.
Trajectory leaving(const Eigen::Vector2d& from, const Eigen::Vector2d& velocity, double time) {
  Trajectory trajectory{time};
  QuinticPiece piece;
  piece.duration = 3.0;
  piece.coefficients.row(0) = from.transpose();
  piece.coefficients.row(1) = velocity.transpose();
  trajectory.append(piece);
  return trajectory;
}

TEST(Faults, APeerThatClaimsThePositionOfAPillarDoesNotHideIt) {
  for (const double leaves : {-1.0, 0.0, 1.0}) {
    for (const double radius : {0.3, 2.0}) {
      SCOPED_TRACE(testing::Message() << "leaves at " << leaves << " m/s, radius " << radius);
      Bench bench;
      bench.pillars = {{{6.0, 0.05}, 0.3}};
      bench.planner.set_goal({{12.0, 0.0}, std::nullopt});
      bench.each_tenth = [&] {
        TrajectoryMessage lie =
            told(5, bench.now, leaving({6.0, 0.05}, {0.0, std::max(0.0, leaves)}, bench.now));
        lie.state = leaves < 0.0 ? PeerState::stopped : PeerState::moving;
        lie.radius = radius;
        bench.planner.add_message(lie, bench.now);
      };
      bench.run(15.0);
      EXPECT_GT(bench.clearance, 0.0) << bench.pose.position_world.transpose();
    }
  }
}

TEST(Faults, OdometryAtTwoKilohertzIsSeenToStandAsSoon) {
  PlannerProcess planner{0, AgentParameters{}, HostParameters{}};
  planner.planner().set_map(open_map());
  for (int i = 0; i < 900; ++i) {
    const double now = 10.0 + 5e-4 * i;
    planner.add_pose({now, Pose2{}}, now);
    planner.step(now);
  }
  EXPECT_NE(planner.planner().agent(),
            nullptr);  // 0.45 s of standing; without being seen to, it would wait for seconds
}

TEST(Faults, AnyNumberOfPeersIsHeldInBoundedRoom) {
  Bench bench;
  bench.run(1.0);
  ASSERT_NE(bench.planner.agent(), nullptr);
  const std::uint32_t most = static_cast<std::uint32_t>(kMostPeers);
  const auto send_many = [&](int from) {
    for (int id = from + 3 * static_cast<int>(most); id > from; --id)
      bench.planner.add_message(told(id, bench.now, standing(-15.0, bench.now)), bench.now);
  };
  send_many(100);
  EXPECT_EQ(bench.planner.counts().messages_accepted, most);
  EXPECT_EQ(bench.planner.counts().messages_crowded, 2 * most);
  bench.run(0.1);
  EXPECT_EQ(bench.planner.agent()->peers().size(), kMostPeers);
}

TEST(PeerWitness, RemembersABoundedNumberOfPeersTheSilentLeast) {
  PeerWitness witness;
  const int most = static_cast<int>(kMostPeers);
  const auto hear_all = [&](int from, double now) {
    for (int id = from; id < from + most; ++id) witness.add_message(told(id, now, standing(1.0, now)), now);
  };
  hear_all(0, 10.0);
  hear_all(0, 11.5);
  hear_all(most, 11.5);  // come too late, and drive nobody out
  EXPECT_TRUE(witness.trusts(0, 11.6));
  EXPECT_TRUE(witness.trusts(most - 1, 11.6));
  EXPECT_FALSE(witness.trusts(most, 20.0));
  hear_all(most, 15.0);  // the first have been silent
  hear_all(most, 16.5);
  EXPECT_FALSE(witness.trusts(0, 16.6));
  EXPECT_TRUE(witness.trusts(2 * most - 1, 16.6));
}

TEST(PeerWitness, TrustsWhoIsWhereItSays) {
  PeerWitness witness;
  std::vector<Peer> peers(1);
  peers[0].robot_id = 5;
  EXPECT_FALSE(witness.trusts(5, 10.0));
  const auto go = [&](double until, double& now, const Eigen::Vector2d& restart_step, double range) {
    for (; now < until; now += 0.1) {
      const Eigen::Vector2d from = Eigen::Vector2d{3.0, 0.0} + (now - 10.0) * restart_step;
      const TrajectoryMessage message = told(5, now, leaving(from, {0.0, 0.5}, now));
      witness.add_message(message, now);
      peers[0].trajectory = message.trajectory;
      RangeScan scan;
      scan.angle_min = -kPi;
      scan.angle_increment = 2.0 * kPi / 360;
      scan.ranges.assign(360, range);
      witness.add_scan(scan, Pose2{}, now, peers);
    }
  };
  // One that does what it says, and is seen.
  double now = 10.0;
  go(10.9, now, {0.0, 0.5}, 2.7);
  EXPECT_FALSE(witness.trusts(5, now - 0.1));  // not heard for long enough
  go(12.0, now, {0.0, 0.5}, 2.7);
  EXPECT_TRUE(witness.trusts(5, now - 0.1));
  // One through whose position a beam passes.
  go(12.15, now, {0.0, 0.5}, 8.0);
  EXPECT_FALSE(witness.trusts(5, now));
  EXPECT_FALSE(witness.trusts(5, now + 1.7));
  go(14.6, now, {0.0, 0.5}, 2.7);
  EXPECT_TRUE(witness.trusts(5, now - 0.1));
  // One that says every time that it leaves, and never does.
  go(16.0, now, {0.0, 0.0}, 2.7);
  EXPECT_FALSE(witness.trusts(5, now - 0.1));
}

RangeScan sweep(int beams, double range) {
  RangeScan scan;
  scan.angle_min = -kPi;
  scan.angle_increment = 2.0 * kPi / beams;
  scan.ranges.assign(static_cast<std::size_t>(beams), range);
  return scan;
}

TEST(ScanCheck, KnowsSenseFromNonsense) {
  EXPECT_TRUE(sensible(sweep(360, 1.0)));
  EXPECT_EQ(blind_share(sweep(360, kInfinity)), 0.0);
  EXPECT_EQ(blind_share(sweep(360, NAN)), 1.0);
  EXPECT_EQ(blind_share(sweep(360, -1.0)), 1.0);
  EXPECT_FALSE(sensible(RangeScan{}));
  RangeScan scan = sweep(360, 1.0);
  scan.angle_increment = NAN;
  EXPECT_FALSE(sensible(scan));
  scan.angle_increment = 0.1;
  EXPECT_FALSE(sensible(scan));  // six turns
  scan = sweep(360, 1.0);
  scan.max_range = -1.0;
  EXPECT_FALSE(sensible(scan));
  for (const double claimed : {2e6, 1e18, 1e20, 1e300, kInfinity}) {
    scan.max_range = claimed;
    EXPECT_FALSE(sensible(scan)) << claimed;
  }
  EXPECT_FALSE(sensible(sweep(200000, 1.0)));
  scan = sweep(1, 1.0);
  scan.angle_increment = 1e300;
  EXPECT_FALSE(sensible(scan));
  EXPECT_TRUE(sensible(Pose2{{-1.0, 0.5}, kPi}));
  EXPECT_FALSE(sensible(Pose2{{1e3, 0.0}, 0.0}));
  EXPECT_FALSE(sensible(Pose2{{0.0, -1e20}, 0.0}));
  EXPECT_FALSE(sensible(Pose2{{NAN, 0.0}, 0.0}));
  EXPECT_FALSE(sensible(Pose2{{0.0, 0.0}, kInfinity}));
}

TEST(PerceptionHost, NamesWhatItRefuses) {
  PerceptionHost host{AgentParameters{}, HostParameters{}};
  const auto scan = [&](double time, const RangeScan& ranges, double now) {
    return host.add_scan(time, {ranges, 0.0, 0.0, {}}, now) ? ObservationVerdict::accepted
                                                            : host.last_verdict();
  };
  EXPECT_EQ(scan(10.0, sweep(360, NAN), 10.0), ObservationVerdict::blind);
  EXPECT_EQ(scan(NAN, sweep(360, 1.0), 10.0), ObservationVerdict::malformed);
  EXPECT_EQ(scan(11.0, sweep(360, 1.0), 10.0), ObservationVerdict::future);
  EXPECT_EQ(scan(9.0, sweep(360, 1.0), 10.0), ObservationVerdict::late);
  EXPECT_EQ(scan(10.0, sweep(360, 1.0), 10.0), ObservationVerdict::accepted);
  EXPECT_EQ(scan(10.0, sweep(360, 1.0), 10.0), ObservationVerdict::late);
  EXPECT_FALSE(host.add_scan(10.1, {sweep(360, 1.0), 0.0, 0.0, {{{1e9, 0.0}, 0.0}, false}}, 10.1));
  EXPECT_EQ(host.last_verdict(), ObservationVerdict::malformed);
  EXPECT_FALSE(host.add_scan(10.1, {sweep(360, 1.0), 0.0, NAN, {}}, 10.1));
  EXPECT_EQ(host.last_verdict(), ObservationVerdict::malformed);
  Detection nowhere;
  nowhere.position_world.x() = NAN;
  EXPECT_FALSE(host.add_detections(10.0, {nowhere}, 10.0));
  EXPECT_EQ(host.last_verdict(), ObservationVerdict::malformed);
  EXPECT_TRUE(host.add_detections(10.0, {}, 10.0));
  EXPECT_EQ(host.refused(), 8u);
}

TEST(PlannerHost, WaitsForTheMapUnlessThereIsNone) {
  HostParameters parameters;
  PlannerProcess process{0, AgentParameters{}, parameters};
  PlannerHost& host = process.planner();
  const auto stand = [&](double from) {
    for (int i = 0; i < 100; ++i) {
      process.add_pose(at(from + 0.01 * i, 1.0), from + 0.01 * i);
      process.step(from + 0.01 * i);
    }
  };
  stand(10.0);
  EXPECT_EQ(host.status().reason, "waits for the map");
  EXPECT_EQ(host.agent(), nullptr);
  host.go_without_map();
  stand(11.0);
  ASSERT_NE(host.agent(), nullptr);
  EXPECT_NEAR(host.agent()->map().frame().origin_world.x(), 1.0 - 0.5 * parameters.grid_size, 0.11);
}

TEST(PlannerHost, LetsGoOfWhatNobodyLooksAtAnyMore) {
  HostParameters parameters;
  parameters.relies_on_scan = parameters.relies_on_obstacles = false;
  Bench bench{Arrangement::one_process, parameters};
  bench.send_scans = bench.send_detections = false;
  bench.run(1.0);
  SensedWorld sensed;
  sensed.has_detections = true;
  sensed.observation.time = bench.now;
  sensed.observation.detections.resize(1);
  sensed.observation.detections[0].position_world = {5.0, 5.0};
  ASSERT_EQ(bench.robot.add_observation(sensed, bench.now), ObservationVerdict::accepted);
  bench.run(0.2);
  EXPECT_EQ(bench.planner.agent()->tracks().size(), 1u);
  bench.run(AgentParameters{}.obstacles.timeout + 0.5);
  EXPECT_TRUE(bench.planner.agent()->tracks().empty());
}

TEST(PlannerHost, NamesTheObservationsItRefuses) {
  PlannerHost host{0, AgentParameters{}, HostParameters{}};
  const Localiser nowhere{AgentParameters{}, HostParameters{}};
  SensedWorld sensed;
  sensed.has_detections = true;
  const auto tell = [&](double time) {
    sensed.observation.time = time;
    return host.add_observation(sensed, 10.0, &nowhere);
  };
  EXPECT_EQ(tell(NAN), ObservationVerdict::malformed);
  EXPECT_EQ(tell(10.5), ObservationVerdict::future);
  EXPECT_EQ(tell(9.5), ObservationVerdict::late);
  EXPECT_EQ(tell(9.9), ObservationVerdict::accepted);
  EXPECT_EQ(tell(9.9), ObservationVerdict::late);
  sensed.observation.detections.resize(1);
  sensed.observation.detections[0].radius = -1.0;
  EXPECT_EQ(tell(10.0), ObservationVerdict::malformed);
  EXPECT_EQ(host.counts().inputs_refused, 5u);
}

}  // namespace
}  // namespace spf::host
