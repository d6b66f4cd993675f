#include "spf/planning/orca/orca_planner.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "spf/math/angles.hpp"
#include "spf/math/random_stream.hpp"
#include "spf/planning/cost_to_go.hpp"
#include "spf/testing/allocation_guard.hpp"

namespace spf {
namespace {

using Eigen::Vector2d;

constexpr double kRounding = 1e-9;
constexpr double kPeriod = 0.1;

Vector2d random_in_disc(RandomStream& random, double radius) {
  const double angle = random.uniform(-kPi, kPi);
  return std::sqrt(random.uniform()) * radius * Vector2d{std::cos(angle), std::sin(angle)};
}

/// Least distance of two centres over the next `horizon` seconds, from the closed form of its square.
double least_distance(const Vector2d& offset, const Vector2d& relative_velocity, double horizon) {
  const double square = relative_velocity.squaredNorm();
  const double closest = square > 0.0 ? offset.dot(relative_velocity) / square : 0.0;
  return (offset - std::clamp(closest, 0.0, horizon) * relative_velocity).norm();
}

Encounter random_encounter(RandomStream& random, double share) {
  Encounter encounter;
  encounter.reach = random.uniform(0.2, 1.0);
  const double angle = random.uniform(-kPi, kPi);
  encounter.offset = encounter.reach * random.uniform(1.05, 6.0) * Vector2d{std::cos(angle), std::sin(angle)};
  encounter.own_velocity = random_in_disc(random, 1.5);
  encounter.other_velocity = random_in_disc(random, 1.5);
  encounter.share = share;
  return encounter;
}

// ---- One encounter ----

TEST(OrcaHalfPlane, LeastChangeReachesTheBorderOfContact) {
  RandomStream random{1};
  constexpr double kHorizon = 2.0;
  for (int i = 0; i < 300; ++i) {
    const Encounter encounter = random_encounter(random, 1.0);
    const HalfPlane plane = allowed_velocities(encounter, kHorizon, kPeriod, Vector2d::UnitY());
    ASSERT_NEAR(plane.normal.norm(), 1.0, kRounding) << "case " << i;
    // Along the normal up to the border: there the discs just touch within the horizon.
    const Vector2d relative = encounter.own_velocity - encounter.other_velocity;
    const double change = plane.violation(encounter.own_velocity);
    const Vector2d border = relative + change * plane.normal;
    EXPECT_NEAR(least_distance(encounter.offset, border, kHorizon), encounter.reach, 1e-7) << "case " << i;
    // No velocity on the other side of that border is nearer.
    const bool touching = least_distance(encounter.offset, relative, kHorizon) < encounter.reach;
    EXPECT_EQ(touching, change > 0.0) << "case " << i;
    for (int k = 0; k < 200; ++k) {
      const Vector2d trial = relative + random_in_disc(random, 0.999 * std::abs(change));
      EXPECT_EQ(least_distance(encounter.offset, trial, kHorizon) < encounter.reach, touching)
          << "case " << i << ", sample " << k;
    }
  }
}

TEST(OrcaHalfPlane, VelocitiesThatBothAllowKeepTheDistance) {
  RandomStream random{2};
  constexpr double kHorizon = 2.5;
  int checked = 0;
  for (int i = 0; i < 300; ++i) {
    const Encounter own = random_encounter(random, 0.5);
    const Encounter other{-own.offset, own.other_velocity, own.own_velocity, own.reach, 0.5};
    const HalfPlane own_plane = allowed_velocities(own, kHorizon, kPeriod, Vector2d::UnitY());
    const HalfPlane other_plane = allowed_velocities(other, kHorizon, kPeriod, -Vector2d::UnitY());
    for (int k = 0; k < 50; ++k) {
      const Vector2d own_choice = random_in_disc(random, 2.0);
      const Vector2d other_choice = random_in_disc(random, 2.0);
      if (own_plane.violation(own_choice) > 0.0 || other_plane.violation(other_choice) > 0.0) continue;
      ++checked;
      EXPECT_GE(least_distance(own.offset, own_choice - other_choice, kHorizon), own.reach - kRounding)
          << "case " << i << ", sample " << k;
    }
  }
  EXPECT_GT(checked, 1000);
}

TEST(OrcaHalfPlane, StandingStillIsAllowedBesideWhatStands) {
  RandomStream random{3};
  for (int i = 0; i < 300; ++i) {
    Encounter encounter = random_encounter(random, 1.0);
    encounter.other_velocity.setZero();
    const HalfPlane plane = allowed_velocities(encounter, 1.0, kPeriod, Vector2d::UnitY());
    EXPECT_LE(plane.violation(Vector2d::Zero()), kRounding) << "case " << i;
  }
}

TEST(OrcaHalfPlane, DiscsThatOverlapAreApartAfterOnePeriod) {
  RandomStream random{4};
  for (int i = 0; i < 300; ++i) {
    Encounter encounter = random_encounter(random, 1.0);
    encounter.offset *= 0.99 * encounter.reach * random.uniform() / encounter.offset.norm();
    const HalfPlane plane = allowed_velocities(encounter, 2.0, kPeriod, Vector2d::UnitY());
    const Vector2d chosen = encounter.own_velocity + plane.violation(encounter.own_velocity) * plane.normal -
                            encounter.other_velocity;
    EXPECT_NEAR((encounter.offset - kPeriod * chosen).norm(), encounter.reach, kRounding) << "case " << i;
  }
}

TEST(OrcaHalfPlane, HeadOnBothTurnRight) {
  const Encounter own{{3.0, 0.0}, {1.0, 0.0}, {-1.0, 0.0}, 0.6, 0.5};
  const Encounter other{{-3.0, 0.0}, {-1.0, 0.0}, {1.0, 0.0}, 0.6, 0.5};
  EXPECT_LT(allowed_velocities(own, 2.0, kPeriod, Vector2d::UnitY()).normal.y(), -0.9);
  EXPECT_GT(allowed_velocities(other, 2.0, kPeriod, Vector2d::UnitY()).normal.y(), 0.9);
}

// ---- The choice among half-planes, against a dense sampling of all velocities ----

class OrcaProgramme : public ::testing::Test {
 protected:
  /// Half-planes of random number and offset; `offset_low` near -1 leaves room, near 0 leaves none.
  std::vector<HalfPlane> random_planes(double offset_low, double offset_high) {
    std::vector<HalfPlane> planes(static_cast<std::size_t>(random.uniform(1.0, 12.0)));
    for (HalfPlane& plane : planes) {
      const double angle = random.uniform(-kPi, kPi);
      plane = {{std::cos(angle), std::sin(angle)}, random.uniform(offset_low, offset_high)};
    }
    return planes;
  }
  /// Calls `see` with velocities all over the disc.
  template <class See>
  static void sample_disc(const See& see) {
    constexpr int kSteps = 100;
    for (int i = -kSteps; i <= kSteps; ++i) {
      for (int j = -kSteps; j <= kSteps; ++j) {
        const Vector2d velocity = Vector2d{i, j} / kSteps;
        if (velocity.norm() <= 1.0) see(velocity);
      }
    }
  }
  static double largest_violation(const std::vector<HalfPlane>& planes, std::size_t from, std::size_t to,
                                  const Vector2d& velocity) {
    double largest = 0.0;
    for (std::size_t k = from; k < to; ++k) largest = std::max(largest, planes[k].violation(velocity));
    return largest;
  }

  RandomStream random{5};
  VelocityProgramme programme{16};
};

TEST_F(OrcaProgramme, ChoosesTheClosestAllowedVelocity) {
  int feasible = 0;
  for (int i = 0; i < 400; ++i) {
    const std::vector<HalfPlane> planes = random_planes(-0.9, 0.3);
    const Vector2d preferred = random_in_disc(random, 1.3);
    const VelocityChoice choice = programme.choose(planes, 0, preferred, 1.0);
    ASSERT_LE(choice.velocity.norm(), 1.0 + kRounding) << "case " << i;
    feasible += choice.feasible ? 1 : 0;
    if (choice.feasible) {
      EXPECT_LE(largest_violation(planes, 0, planes.size(), choice.velocity), kRounding) << "case " << i;
    }
    const double reached = (choice.velocity - preferred).norm();
    sample_disc([&](const Vector2d& velocity) {
      if (largest_violation(planes, 0, planes.size(), velocity) > 0.0) return;
      EXPECT_TRUE(choice.feasible) << "case " << i;
      EXPECT_GE((velocity - preferred).norm(), reached - kRounding) << "case " << i;
    });
  }
  EXPECT_GT(feasible, 100);
  EXPECT_LT(feasible, 350);
}

TEST_F(OrcaProgramme, MakesTheLargestViolationLeastAndKeepsTheHardPlanes) {
  int infeasible = 0;
  for (int i = 0; i < 400; ++i) {
    // Hard planes that all allow standing still, as static surfaces do, then soft ones.
    std::vector<HalfPlane> planes = random_planes(-0.5, 0.0);
    planes.resize(std::min<std::size_t>(planes.size(), 4));
    const std::size_t hard = planes.size();
    for (const HalfPlane& plane : random_planes(-0.2, 0.9)) planes.push_back(plane);
    const VelocityChoice choice = programme.choose(planes, hard, random_in_disc(random, 1.0), 1.0);
    EXPECT_LE(choice.velocity.norm(), 1.0 + kRounding) << "case " << i;
    EXPECT_LE(largest_violation(planes, 0, hard, choice.velocity), kRounding) << "case " << i;
    if (choice.feasible) continue;
    ++infeasible;
    const double reached = largest_violation(planes, hard, planes.size(), choice.velocity);
    sample_disc([&](const Vector2d& velocity) {
      if (largest_violation(planes, 0, hard, velocity) > 0.0) return;
      EXPECT_GE(largest_violation(planes, hard, planes.size(), velocity), reached - kRounding)
          << "case " << i;
    });
  }
  EXPECT_GT(infeasible, 100);
}

TEST_F(OrcaProgramme, HardPlanesThatExcludeEachOtherCountAsSoft) {
  // Both sides ask for 0.2 m/s away from the other; one of them twice as much.
  const std::vector<HalfPlane> planes{{{1.0, 0.0}, 0.2}, {{-1.0, 0.0}, 0.4}};
  const VelocityChoice choice = programme.choose(planes, 2, {0.0, 0.5}, 1.0);
  EXPECT_FALSE(choice.feasible);
  EXPECT_NEAR(choice.velocity.x(), -0.1, kRounding);  // each is violated by 0.3 m/s
}

// ---- The planner ----

class OrcaPlannerTest : public ::testing::Test {
 protected:
  struct Robot {
    OrcaPlanner planner;
    CostToGo guide;
    Vector2d goal;
    Trajectory committed;
    PlanResult result;
  };

  static OrcaParameters published() {
    OrcaParameters parameters;
    parameters.limit_acceleration = false;
    return parameters;
  }
  Robot robot_at(const Vector2d& start, const Vector2d& goal, const OrcaParameters& parameters) const {
    Robot made{OrcaPlanner{parameters, robot, kPeriod},
               CostToGo{CostToGoParameters{}, 0.2},
               goal,
               Trajectory::standing(start, 0.0, 1.0),
               {}};
    made.guide.update(map, goal, start);
    return made;
  }
  PlanRequest request_of(const Robot& planning, int id, double time) const {
    PlanRequest request;
    request.time = time;
    request.head = planning.committed.state(time);
    request.goal_world = planning.goal;
    request.guide = &planning.guide;
    request.committed = &planning.committed;
    request.world = {time, id, &map, &tracks, &peers};
    return request;
  }
  static Peer peer_of(const Robot& other, int id, PeerState state) {
    Peer peer;
    peer.robot_id = id;
    peer.state = state;
    peer.trajectory = other.committed;
    return peer;
  }
  void place_obstacle(const Vector2d& position, const Vector2d& velocity) {
    ObstacleTrack track;
    track.state = {position, velocity, 0.4};
    tracks.push_back(track);
  }

  RobotParameters robot;
  OccupancyMap map{GridFrame::covering({-10.0, -10.0}, {10.0, 10.0}, 0.1), 2.0};
  std::vector<ObstacleTrack> tracks;
  std::vector<Peer> peers;
};

/// Two robots that hear each other's last trajectory, until both have arrived; the least distance of centres.
TEST_F(OrcaPlannerTest, TwoRobotsHeadOnPassWithoutContact) {
  for (const double sideways : {0.0, 1e-3, -0.2, 0.35}) {
    Robot a = robot_at({-5.0, 0.0}, {5.0, 0.0}, published());
    Robot b = robot_at({5.0, sideways}, {-5.0, sideways}, published());
    double least = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 200; ++k) {
      const double time = kPeriod * k;
      const Peer heard_a = peer_of(a, 0, PeerState::moving);
      const Peer heard_b = peer_of(b, 1, PeerState::moving);
      peers = {heard_b};
      a.planner.plan(request_of(a, 0, time), a.result);
      peers = {heard_a};
      b.planner.plan(request_of(b, 1, time), b.result);
      a.committed = a.result.trajectory;
      b.committed = b.result.trajectory;
      for (int j = 0; j <= 10; ++j) {
        const double now = time + 0.01 * j;
        least = std::min(least, (a.committed.position(now) - b.committed.position(now)).norm());
      }
    }
    EXPECT_GT(least, 2.0 * robot.radius) << "offset " << sideways;
    EXPECT_LT(least, 1.0) << "offset " << sideways;  // they did meet
    EXPECT_LT((a.committed.tail_position() - a.goal).norm(), 0.01);
    EXPECT_LT((b.committed.tail_position() - b.goal).norm(), 0.01);
    EXPECT_EQ(a.result.outcome, PlanOutcome::goal_reached);
  }
}

TEST_F(OrcaPlannerTest, CrossesTheWayOfAnObstacleThatDoesNotReact) {
  for (const bool limited : {false, true}) {
    for (double start = -4.5; start < 4.6; start += 0.5) {
      OrcaParameters parameters;
      parameters.limit_acceleration = limited;
      Robot robot_a = robot_at({-4.0, 0.0}, {4.0, 0.0}, parameters);
      double least = std::numeric_limits<double>::infinity();
      bool named = false;
      for (int k = 0; k < 150; ++k) {
        const double time = kPeriod * k;
        const auto obstacle_at = [&](double at) { return Vector2d{0.0, start + 3.0 - 0.7 * at}; };
        tracks.clear();
        place_obstacle(obstacle_at(time), {0.0, -0.7});
        tracks.front().time = time;
        tracks.front().id = 7;
        robot_a.planner.plan(request_of(robot_a, 0, time), robot_a.result);
        named = named || robot_a.result.blocking_track == 7;
        robot_a.committed = robot_a.result.trajectory;
        for (int j = 0; j <= 10; ++j) {
          const double now = time + 0.01 * j;
          least = std::min(least, (robot_a.committed.position(now) - obstacle_at(now)).norm());
        }
      }
      EXPECT_GT(least, robot.radius + 0.4) << "start " << start << ", limited " << limited;
      EXPECT_LT((robot_a.committed.tail_position() - robot_a.goal).norm(), 0.02);
      if (least < 0.75) {
        EXPECT_TRUE(named);
      }
    }
  }
}

TEST_F(OrcaPlannerTest, GoesRoundStaticShapesWithoutContact) {
  map.add_box({-1.0, -1.2}, {1.0, 0.8});
  map.add_disc({2.5, 0.9}, 0.5);
  map.add_border({-10.0, -10.0}, {10.0, 10.0});
  for (const bool limited : {false, true}) {
    OrcaParameters parameters;
    parameters.limit_acceleration = limited;
    Robot robot_a = robot_at({-5.0, -0.3}, {5.0, 0.1}, parameters);
    double least = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 200; ++k) {
      robot_a.planner.plan(request_of(robot_a, 0, kPeriod * k), robot_a.result);
      robot_a.committed = robot_a.result.trajectory;
      for (int j = 0; j <= 10; ++j)
        least = std::min(least, map.distance(robot_a.committed.position(kPeriod * k + 0.01 * j)));
    }
    EXPECT_GT(least, robot.radius) << "limited " << limited;
    EXPECT_LT((robot_a.committed.tail_position() - robot_a.goal).norm(), 0.02) << "limited " << limited;
  }
}

TEST_F(OrcaPlannerTest, HoldsTheWallAgainstAnObstacleThatPushes) {
  map.add_box({1.0, -9.0}, {2.0, 9.0});
  Robot robot_a = robot_at({0.6, 0.0}, {0.6, 5.0}, published());
  for (int k = 0; k < 30; ++k) {
    const double time = kPeriod * k;
    tracks.clear();
    place_obstacle({-1.0 + 0.6 * time, 0.05}, {0.6, 0.0});
    tracks.front().time = time;
    robot_a.planner.plan(request_of(robot_a, 0, time), robot_a.result);
    robot_a.committed = robot_a.result.trajectory;
    EXPECT_GT(map.distance(robot_a.committed.position(time + kPeriod)), robot.radius) << "step " << k;
  }
}

TEST_F(OrcaPlannerTest, KeepsTheAccelerationLimitAndEndsStanding) {
  RandomStream random{6};
  Robot robot_a = robot_at({0.0, 0.0}, {6.0, 0.0}, OrcaParameters{});
  for (int i = 0; i < 200; ++i) {
    tracks.clear();
    place_obstacle(random_in_disc(random, 3.0), random_in_disc(random, 1.0));
    PlanRequest request = request_of(robot_a, 0, 2.0);
    request.head.velocity_world = random_in_disc(random, robot.max_speed);
    robot_a.planner.plan(request, robot_a.result);
    const Trajectory& plan = robot_a.result.trajectory;
    EXPECT_LE(plan.max_acceleration(), robot.max_acceleration + kRounding) << "case " << i;
    EXPECT_LE(plan.max_speed(), robot.max_speed + kRounding) << "case " << i;
    EXPECT_LT((plan.state(2.0).velocity_world - request.head.velocity_world).norm(), kRounding);
    EXPECT_LT(plan.state(plan.end_time()).velocity_world.norm(), kRounding) << "case " << i;
    for (int k = 1; k < plan.piece_count(); ++k) {
      const QuinticPiece& before = plan.piece(k - 1);
      EXPECT_LT((before.position(before.duration) - plan.piece(k).position(0.0)).norm(), kRounding);
      EXPECT_LT((before.velocity(before.duration) - plan.piece(k).velocity(0.0)).norm(), kRounding);
    }
  }
}

TEST_F(OrcaPlannerTest, TakesTheVelocityAtOnceWithoutLimits) {
  Robot robot_a = robot_at({0.0, 0.0}, {6.0, 0.0}, published());
  PlanRequest request = request_of(robot_a, 0, 1.0);
  request.head.velocity_world = {0.0, -1.0};
  request.keep_candidates = true;
  robot_a.planner.plan(request, robot_a.result);
  const FlatState at_once = robot_a.result.trajectory.state(1.0);
  EXPECT_NEAR(at_once.velocity_world.x(), robot.max_speed, kRounding);
  EXPECT_NEAR(at_once.velocity_world.y(), 0.0, kRounding);
  EXPECT_EQ(robot_a.result.outcome, PlanOutcome::success);
  ASSERT_EQ(robot_a.result.candidates.size(), 1u);
  EXPECT_TRUE(robot_a.result.candidates.front().chosen);
}

TEST_F(OrcaPlannerTest, LeavesHalfToAPeerThatMovesAndNothingToOneThatStands) {
  const Robot other = robot_at({1.6, -0.05}, {1.6, -0.05}, published());
  std::array<double, 2> sideways{};
  for (const int stopped : {0, 1}) {
    Robot robot_a = robot_at({0.0, 0.0}, {6.0, 0.0}, published());
    peers = {peer_of(other, 1, stopped == 1 ? PeerState::stopped : PeerState::moving)};
    PlanRequest request = request_of(robot_a, 0, 0.0);
    request.head.velocity_world = {1.0, 0.0};
    robot_a.planner.plan(request, robot_a.result);
    EXPECT_EQ(robot_a.result.blocking_peer, 1);
    sideways[static_cast<std::size_t>(stopped)] = robot_a.result.trajectory.state(0.05).velocity_world.y();
  }
  EXPECT_GT(sideways[0], 0.01);
  EXPECT_GT(sideways[1], 1.5 * sideways[0]);
}

TEST_F(OrcaPlannerTest, TakesItsShareOfAvoidingAnObstacle) {
  place_obstacle({2.0, -0.05}, {0.0, 0.0});
  std::array<double, 2> sideways{};
  for (const int full : {0, 1}) {
    OrcaParameters parameters = published();
    parameters.obstacle_share = full == 1 ? 1.0 : 0.5;
    Robot robot_a = robot_at({0.0, 0.0}, {6.0, 0.0}, parameters);
    PlanRequest request = request_of(robot_a, 0, 0.0);
    request.head.velocity_world = {1.0, 0.0};
    robot_a.planner.plan(request, robot_a.result);
    sideways[static_cast<std::size_t>(full)] = robot_a.result.trajectory.state(0.05).velocity_world.y();
  }
  EXPECT_GT(sideways[0], 0.01);
  EXPECT_GT(sideways[1], 1.5 * sideways[0]);
}

TEST_F(OrcaPlannerTest, CoincidentRobotsPartInOppositeDirections) {
  Robot a = robot_at({0.0, 0.0}, {3.0, 0.0}, published());
  Robot b = robot_at({0.0, 0.0}, {3.0, 0.0}, published());
  peers = {peer_of(b, 1, PeerState::moving)};
  a.planner.plan(request_of(a, 0, 0.0), a.result);
  peers = {peer_of(a, 0, PeerState::moving)};
  b.planner.plan(request_of(b, 1, 0.0), b.result);
  const Vector2d away_a = a.result.trajectory.state(0.05).velocity_world;
  const Vector2d away_b = b.result.trajectory.state(0.05).velocity_world;
  ASSERT_TRUE(away_a.allFinite() && away_b.allFinite());
  EXPECT_GT(away_a.y(), 0.9);
  EXPECT_LT(away_b.y(), -0.9);
}

TEST_F(OrcaPlannerTest, IsFiniteWhateverLiesUponTheRobot) {
  map.add_box({-0.5, -0.5}, {0.5, 0.5});  // its start is inside, at the point of least slope
  Robot robot_a = robot_at({0.0, 0.0}, {6.0, 0.0}, OrcaParameters{});
  for (int i = 0; i < 5; ++i) place_obstacle({0.0, 0.0}, {0.0, 0.0});
  place_obstacle({std::nan(""), 0.0}, {0.0, 0.0});
  place_obstacle({0.1, 0.0}, {std::nan(""), 0.0});
  peers = {peer_of(robot_a, 1, PeerState::stopped), peer_of(robot_a, 2, PeerState::moving)};
  for (int k = 0; k < 30; ++k) {
    robot_a.planner.plan(request_of(robot_a, 0, kPeriod * k), robot_a.result);
    robot_a.committed = robot_a.result.trajectory;
    const FlatState state = robot_a.committed.state(kPeriod * (k + 1));
    ASSERT_TRUE(state.position_world.allFinite() && state.velocity_world.allFinite()) << "step " << k;
  }
  EXPECT_GT(map.distance(robot_a.committed.tail_position()), 0.0);  // it has left the box
}

TEST_F(OrcaPlannerTest, AnswersAnUnusableRequestWithSomethingUsable) {
  Robot robot_a = robot_at({1.0, 2.0}, {6.0, 0.0}, OrcaParameters{});
  PlanRequest request = request_of(robot_a, 0, 0.5);
  request.head.velocity_world.x() = std::nan("");
  robot_a.planner.plan(request, robot_a.result);
  EXPECT_EQ(robot_a.result.outcome, PlanOutcome::invalid_request);
  EXPECT_EQ(robot_a.result.trajectory.tail_position(), Vector2d(1.0, 2.0));

  request.committed = nullptr;
  robot_a.planner.plan(request, robot_a.result);
  EXPECT_EQ(robot_a.result.outcome, PlanOutcome::invalid_request);
  EXPECT_EQ(robot_a.result.trajectory.tail_position(), Vector2d(1.0, 2.0));

  const CostToGo not_ready{CostToGoParameters{}};
  request = request_of(robot_a, 0, 0.5);
  request.guide = &not_ready;
  robot_a.planner.plan(request, robot_a.result);
  EXPECT_EQ(robot_a.result.outcome, PlanOutcome::no_path);
}

TEST_F(OrcaPlannerTest, AllocatesNothing) {
  map.add_box({1.0, -1.0}, {2.0, 1.0});
  RandomStream random{7};
  for (int i = 0; i < 30; ++i) place_obstacle(random_in_disc(random, 3.0), random_in_disc(random, 1.0));
  Robot robot_a = robot_at({0.0, 0.0}, {6.0, 0.0}, OrcaParameters{});
  const PlanRequest request = request_of(robot_a, 0, 0.0);
  const AllocationGuard guard;
  for (int i = 0; i < 10; ++i) robot_a.planner.plan(request, robot_a.result);
  EXPECT_EQ(guard.allocations(), 0);
}

TEST_F(OrcaPlannerTest, RefusesParametersOutOfRange) {
  OrcaParameters parameters;
  parameters.time_horizon = 0.0;
  parameters.margin = std::nan("");
  EXPECT_EQ(problems(parameters).size(), 2u);
  EXPECT_THROW(OrcaPlanner(parameters, robot, kPeriod), std::invalid_argument);
  EXPECT_THROW(OrcaPlanner(OrcaParameters{}, robot, 0.0), std::invalid_argument);
}

}  // namespace
}  // namespace spf
