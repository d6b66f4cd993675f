#include "spf/planning/space_time/space_time_planner.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "spf/math/random_stream.hpp"
#include "spf/planning/contact_risk.hpp"
#include "spf/planning/planner_parameters.hpp"
#include "spf/testing/allocation_guard.hpp"

namespace spf {
namespace {

constexpr double kTime = 10.0;  // [s]

SpaceTimePlanner make_planner(const SpaceTimeParameters& parameters = {}) {
  return SpaceTimePlanner{parameters, PlannerParameters{}, RobotParameters{}};
}

/// A room of 20 m with a robot at the origin that wants to go to +x.
class SpaceTimePlannerTest : public ::testing::Test {
 protected:
  SpaceTimePlannerTest() : map{GridFrame::covering({-10.0, -10.0}, {10.0, 10.0}, 0.1), 2.0} {
    map.add_border({-10.0, -10.0}, {10.0, 10.0});
    request.time = kTime;
    request.goal_world = {6.0, 0.0};
  }

  const PlanResult& plan() {
    request.world = {request.time, 3, &map, &tracks, &peers};
    guide.update(map, request.goal_world, request.head.position_world);
    request.guide = &guide;
    planner.plan(request, result);
    return result;
  }
  void add_track(const Eigen::Vector2d& position, const Eigen::Vector2d& velocity) {
    ObstacleTrack track;
    track.id = 40 + static_cast<int>(tracks.size());
    track.time = kTime;
    track.state = {position, velocity, 0.4};
    track.position_variance = 1e-4;
    track.velocity_variance = 1e-4;
    tracks.push_back(track);
  }
  void add_peer(int id, const Eigen::Vector2d& position, const Eigen::Vector2d& velocity) {
    Peer peer;
    peer.robot_id = id;
    peer.state = PeerState::moving;
    QuinticPiece piece;
    piece.duration = 20.0;
    piece.coefficients.row(0) = position.transpose();
    piece.coefficients.row(1) = velocity.transpose();
    Trajectory course{kTime};
    course.append(piece);
    peer.trajectory = course;
    peers.push_back(peer);
  }
  /// Drives the plans, one every 0.1 s, while all obstacles move as predicted; the least gap between surfaces
  /// [m].
  double drive(double seconds) {
    double least = std::numeric_limits<double>::infinity();
    const double end = request.time + seconds;
    while (request.time < end) {
      const Trajectory committed = plan().trajectory;
      for (int k = 1; k <= 10; ++k) {
        const double time = request.time + 0.01 * k;
        const Eigen::Vector2d position = committed.position(time);
        for (const ObstacleTrack& track : tracks) {
          const Eigen::Vector2d centre =
              track.state.position_world + (time - track.time) * track.state.velocity_world;
          least = std::min(least, (position - centre).norm() - 0.7);
        }
        for (const Peer& peer : peers) least = std::min(least, (position - peer.position(time)).norm() - 0.6);
      }
      request.time += 0.1;
      request.head = committed.state(request.time);
      old_plan = committed;
      request.committed = &old_plan;
      for (ObstacleTrack& track : tracks) {  // seen again
        track.state.position_world += (request.time - track.time) * track.state.velocity_world;
        track.time = request.time;
      }
    }
    return least;
  }

  OccupancyMap map;
  std::vector<ObstacleTrack> tracks;
  std::vector<Peer> peers;
  CostToGo guide{CostToGoParameters{}, 0.2};
  PlanRequest request;
  SpaceTimePlanner planner = make_planner();
  PlanResult result;
  Trajectory old_plan;
};

TEST_F(SpaceTimePlannerTest, TakesTheDirectWayAtOnceWhenItIsFree) {
  plan();
  EXPECT_EQ(result.outcome, PlanOutcome::success);
  EXPECT_EQ(result.stats.primitives, 1);
  EXPECT_EQ(result.blocking_track, -1);
  EXPECT_EQ(result.blocking_peer, -1);
  // 1 s and 0.5 m to full speed, then straight ahead: 1.5 m after 2 s at most, hardly less when it is smooth.
  EXPECT_LE(result.trajectory.position(kTime + 2.0).x(), 1.5 + 0.1);
  EXPECT_GT(result.trajectory.position(kTime + 2.0).x(), 1.2);
  for (double ahead = 0.0; ahead < 4.0; ahead += 0.1)
    EXPECT_NEAR(result.trajectory.position(kTime + ahead).y(), 0.0, 1e-6);
  // Somebody far away, or going away, changes nothing.
  add_track({-2.0, 0.0}, {-0.5, 0.0});
  add_track({0.0, 9.0}, {0.0, 0.3});
  plan();
  EXPECT_EQ(result.stats.primitives, 1);
}

TEST_F(SpaceTimePlannerTest, DodgesADiscThatComesTowardsIt) {
  add_track({2.5, 0.05}, {-0.6, 0.0});
  plan();
  EXPECT_GT(result.stats.primitives, 100);
  EXPECT_EQ(result.blocking_track, 40);
  double least = std::numeric_limits<double>::infinity();
  for (double ahead = 0.0; ahead <= 3.0; ahead += 0.01) {
    const Eigen::Vector2d centre{2.5 - 0.6 * ahead, 0.05};
    least = std::min(least, (result.trajectory.position(kTime + ahead) - centre).norm());
  }
  EXPECT_GT(least, 0.7);
  EXPECT_GT(drive(10.0), 0.0);
  EXPECT_LT((request.head.position_world - request.goal_world).norm(), 0.1);
}

TEST_F(SpaceTimePlannerTest, LetsAPeerOfHigherPriorityCross) {
  add_peer(1, {2.0, -2.0}, {0.0, 0.9});
  plan();
  EXPECT_EQ(result.blocking_peer, 1);
  EXPECT_GT(drive(12.0), 0.0);
  EXPECT_LT((request.head.position_world - request.goal_world).norm(), 0.1);
}

TEST_F(SpaceTimePlannerTest, LeadsOutOfAMarginAndAnObstacle) {
  map.add_box({-1.0, 0.25}, {1.0, 1.0});  // the robot's side is in it by 0.05 m
  drive(1.5);
  EXPECT_GT(map.distance(request.head.position_world), 0.3);
  tracks.clear();
  add_track(request.head.position_world + Eigen::Vector2d{0.1, 0.1}, {0.0, 0.0});  // on top of it
  drive(2.0);
  EXPECT_GT((request.head.position_world - tracks[0].state.position_world).norm(), 0.7);
}

TEST_F(SpaceTimePlannerTest, SaysSoWhenNothingIsSafe) {
  // Eight discs close in on a robot at rest: whatever it does, it meets one.
  for (int k = 0; k < 8; ++k) {
    const double angle = 0.25 * kPi * k;
    const Eigen::Vector2d direction{std::cos(angle), std::sin(angle)};
    add_track(1.5 * direction, -0.8 * direction);
  }
  plan();
  EXPECT_EQ(result.outcome, PlanOutcome::unsafe);
  EXPECT_GE(result.blocking_track, 40);
  EXPECT_GT(contact_risk(result.trajectory, request, 0.3), 0.5);
  EXPECT_FALSE(result.trajectory.empty());
}

TEST_F(SpaceTimePlannerTest, SaysThatTheGoalIsCutOffAndGoesOnAllTheSame) {
  request.goal_cut_off = true;
  plan();
  EXPECT_EQ(result.outcome, PlanOutcome::no_path);
  EXPECT_EQ(result.action, PlanAction::follow);
  EXPECT_GT(result.trajectory.position(kTime + 2.0).x(), 1.0);
}

TEST_F(SpaceTimePlannerTest, KeepsAPlanThatIsStillTheBest) {
  plan();
  EXPECT_EQ(result.action, PlanAction::follow);
  old_plan = result.trajectory;
  request.time += 0.1;
  request.head = old_plan.state(request.time);
  request.committed = &old_plan;
  plan();
  EXPECT_EQ(result.action, PlanAction::keep);
  EXPECT_EQ(result.outcome, PlanOutcome::success);
  EXPECT_EQ(result.trajectory.start_time(), kTime);
}

TEST_F(SpaceTimePlannerTest, RefusesWhatIsNoRequest) {
  plan();
  PlanRequest bad = request;
  bad.head.velocity_world.x() = std::numeric_limits<double>::quiet_NaN();
  planner.plan(bad, result);
  EXPECT_EQ(result.outcome, PlanOutcome::invalid_request);
  EXPECT_TRUE(result.trajectory.tail_position().allFinite());
  bad = request;
  bad.guide = nullptr;
  planner.plan(bad, result);
  EXPECT_EQ(result.outcome, PlanOutcome::invalid_request);
  bad = request;
  const CostToGo no_free_goal{CostToGoParameters{}};
  bad.guide = &no_free_goal;
  planner.plan(bad, result);
  EXPECT_EQ(result.outcome, PlanOutcome::no_path);
  EXPECT_EQ(result.trajectory.tail_position(), request.head.position_world);
}

TEST_F(SpaceTimePlannerTest, KeepsEveryCandidateOnlyWhenAsked) {
  add_track({2.5, 0.05}, {-0.6, 0.0});
  plan();
  EXPECT_TRUE(result.candidates.empty());
  const Trajectory chosen = result.trajectory;
  request.keep_candidates = true;
  planner.plan(request, result);
  const auto rolled_out = [](const Candidate& candidate) {
    return candidate.kind == Candidate::Kind::primitive;
  };
  EXPECT_EQ(std::count_if(result.candidates.begin(), result.candidates.end(), rolled_out),
            result.stats.primitives);
  // Among them is to wait here and go then: twice, for a short and a long time. And all keep the limits.
  const double shortly = kTime + SpaceTimeParameters{}.short_sidestep;
  const auto waits = [shortly](const Candidate& candidate) {
    return candidate.trajectory.position(shortly) == Eigen::Vector2d::Zero() &&
           candidate.trajectory.tail_position() != Eigen::Vector2d::Zero();
  };
  EXPECT_EQ(std::count_if(result.candidates.begin(), result.candidates.end(), waits), 2);
  for (const Candidate& candidate : result.candidates) EXPECT_LT(candidate.trajectory.max_speed(), 1.05);
  // Showing the candidates must not change the choice.
  EXPECT_EQ(result.trajectory.position(kTime + 1.0), chosen.position(kTime + 1.0));
  const auto is_chosen = [](const Candidate& candidate) { return candidate.chosen; };
  EXPECT_EQ(std::count_if(result.candidates.begin(), result.candidates.end(), is_chosen), 1);
}

TEST_F(SpaceTimePlannerTest, DoesNotAllocate) {
  for (int k = 0; k < 8; ++k) add_track({1.0 + 0.3 * k, 1.5 - 0.4 * k}, {-0.3, 0.1 * k});
  for (int k = 0; k < 8; ++k) add_peer(k + 4, {2.0, 2.0 - k}, {-0.5, 0.0});
  plan();
  const AllocationGuard guard;
  request.guide = &guide;
  planner.plan(request, result);
  EXPECT_EQ(guard.allocations(), 0);
  EXPECT_GT(result.stats.primitives, 100);
}

TEST_F(SpaceTimePlannerTest, RefusesParametersOutOfRange) {
  SpaceTimeParameters parameters;
  parameters.horizon = 0.0;
  EXPECT_THROW((void)make_planner(parameters), std::invalid_argument);
}

/// Requests as they come, and as they ought not to come.
class RandomRequests {
 public:
  explicit RandomRequests(std::uint64_t seed) : random_{seed} {}

  /// Inside boxes, obstacles and margins too; the goal now and then right here.
  Eigen::Vector2d position() {
    const double x = random_.uniform(-9.5, 9.5);
    const double y = random_.uniform(-9.5, 9.5);
    return {x, y};
  }
  FlatState head(double max_speed) {
    FlatState head;
    head.position_world = position();
    if (random_.uniform() < 0.8)
      head.velocity_world = max_speed * random_.uniform() * random_.normal2().normalized();
    return head;
  }
  ObstacleTrack track(int id, const Eigen::Vector2d& robot) {
    ObstacleTrack track;
    track.id = id;
    track.time = kTime - random_.uniform(0.0, 2.0);
    const bool on_top = random_.uniform() < 0.2;
    track.state.position_world = on_top ? robot : Eigen::Vector2d{robot + 2.0 * random_.normal2()};
    if (random_.uniform() < 0.7) track.state.velocity_world = number() * random_.normal2();
    track.state.radius = random_.uniform() < 0.1 ? 0.0 : random_.uniform(0.1, 1.0);
    track.position_variance = std::abs(number());
    track.velocity_variance = random_.uniform(0.0, 1.0);
    track.velocity_diffusion = random_.uniform(0.0, 0.5);
    return track;
  }
  Peer peer(int id, const Eigen::Vector2d& robot) {
    Peer peer;
    peer.robot_id = id;
    peer.state = static_cast<PeerState>(static_cast<int>(random_.uniform(0.0, 4.0)));
    peer.expired = random_.uniform() < 0.2;
    peer.growth = peer.expired ? 0.7 : 0.0;
    peer.position_sigma = std::abs(number());
    QuinticPiece piece;
    piece.duration = random_.uniform(0.1, 6.0);
    piece.coefficients.row(0) = (robot + 2.0 * random_.normal2()).transpose();
    piece.coefficients.row(1) = number() * random_.normal2().transpose();
    Trajectory course{kTime - 0.3};
    course.append(piece);
    peer.trajectory = course;
    return peer;
  }
  /// Mostly about 1; sometimes nothing, sometimes absurd.
  double number() {
    const double kind = random_.uniform();
    if (kind < 0.1) return 0.0;
    if (kind < 0.13) return std::ldexp(1.0, static_cast<int>(random_.uniform(-900.0, 900.0)));
    return random_.uniform(-1.0, 1.0);
  }
  RandomStream& random() { return random_; }

 private:
  RandomStream random_;
};

TEST_F(SpaceTimePlannerTest, AlwaysGivesAFiniteTrajectoryWithinLimitsThatStartsAtTheHead) {
  RandomRequests draw{99};
  const RobotParameters robot;
  const PlannerParameters planner_defaults;
  for (int k = 0; k < 6; ++k) {
    const Eigen::Vector2d low = draw.position().cwiseMin(8.0);
    map.add_box(low, low + Eigen::Vector2d{1.5, 1.0});
  }
  for (int i = 0; i < 2000; ++i) {
    SCOPED_TRACE(i);
    tracks.clear();
    peers.clear();
    if (i % 20 == 0) request.goal_world = draw.position();
    request.head = draw.head(robot.max_speed);
    if (i % 20 == 7) request.head.position_world = request.goal_world;
    request.position_sigma = i % 11 == 0 ? 1e3 : 0.05;
    const int obstacles = static_cast<int>(draw.random().uniform(0.0, 12.0));
    for (int k = 0; k < obstacles; ++k) tracks.push_back(draw.track(k, request.head.position_world));
    for (int k = 0; k < obstacles / 2; ++k) peers.push_back(draw.peer(k, request.head.position_world));
    plan();
    const Trajectory& trajectory = result.trajectory;
    ASSERT_FALSE(trajectory.empty());
    ASSERT_TRUE(std::isfinite(trajectory.duration()));
    const FlatState start = trajectory.state(kTime);
    EXPECT_LT((start.position_world - request.head.position_world).norm(), 1e-12);
    EXPECT_LT((start.velocity_world - request.head.velocity_world).norm(), 1e-12);
    // The tolerances with which every plan is accepted.
    EXPECT_LE(trajectory.max_speed(), robot.max_speed * (1.0 + kSpeedTolerance) + 1e-9);
    EXPECT_LE(trajectory.max_acceleration(), robot.max_acceleration * (1.0 + kAccelerationTolerance) + 1e-9);
    EXPECT_TRUE(trajectory.tail_position().allFinite());
    EXPECT_LT(trajectory.state(trajectory.end_time() - 1e-9).velocity_world.norm(), 1e-5);
    const double risk = contact_risk(trajectory, request, robot.radius);
    EXPECT_TRUE(risk >= 0.0 && risk <= 1.0) << risk;
    if (HasFailure()) break;
  }
}

}  // namespace
}  // namespace spf
