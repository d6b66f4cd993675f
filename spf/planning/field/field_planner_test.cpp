#include "spf/planning/field/field_planner.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "spf/math/angles.hpp"
#include "spf/math/random_stream.hpp"
#include "spf/testing/allocation_guard.hpp"

namespace spf {
namespace {

/// Ground truth of a box, independent of the map.
struct TrueSquare {
  Eigen::Vector2d center;
  double side;
  [[nodiscard]] double distance(const Eigen::Vector2d& p) const {
    const Eigen::Vector2d d = (p - center).cwiseAbs() - Eigen::Vector2d::Constant(0.5 * side);
    return d.cwiseMax(0.0).norm() + std::min(0.0, d.maxCoeff());
  }
};

/// A walled field of 30 m with boxes, obstacles, peers and one robot's request.
struct PlannerScene {
  std::vector<TrueSquare> boxes;
  std::unique_ptr<OccupancyMap> map;
  std::vector<ObstacleTrack> tracks;
  std::vector<Peer> peers;
  CostToGo guide{CostToGoParameters{}, 0.2};
  PlanRequest request;

  void finish(const Eigen::Vector2d& start, const Eigen::Vector2d& goal, int robot_id = 3) {
    map = std::make_unique<OccupancyMap>(GridFrame::covering({-15.0, -15.0}, {15.0, 15.0}, 0.1), 2.0);
    map->add_border({-15.0, -15.0}, {15.0, 15.0});
    for (const TrueSquare& box : boxes) {
      const Eigen::Vector2d half = Eigen::Vector2d::Constant(0.5 * box.side);
      map->add_box(box.center - half, box.center + half);
    }
    request.time = 10.0;
    request.head.position_world = start;
    request.goal_world = goal;
    request.world = {10.0, robot_id, map.get(), &tracks, &peers};
    guide.update(*map, goal, start);
    request.guide = &guide;
  }
  [[nodiscard]] double box_clearance(const Eigen::Vector2d& p) const {
    double least = 1e9;
    for (const TrueSquare& box : boxes) least = std::min(least, box.distance(p) - 0.3);
    return least;
  }
};

Eigen::Vector2d draw_position(RandomStream& random, double half_side) {
  const double x = random.uniform(-half_side, half_side);
  const double y = random.uniform(-half_side, half_side);
  return {x, y};
}

void draw_boxes(RandomStream& random, int count, double half_side,
                const std::vector<Eigen::Vector2d>& keep_free, std::vector<TrueSquare>& boxes) {
  while (static_cast<int>(boxes.size()) < count) {
    const Eigen::Vector2d center = draw_position(random, half_side);
    const TrueSquare box{center, random.uniform(1.0, 2.0)};
    bool fits = true;
    for (const TrueSquare& other : boxes)
      fits =
          fits && ((other.center - box.center).cwiseAbs().maxCoeff() > 0.5 * (box.side + other.side) + 0.9);
    for (const Eigen::Vector2d& position : keep_free) fits = fits && box.distance(position) > 1.0;
    if (fits) boxes.push_back(box);
  }
}

ObstacleTrack make_track(int id, const Eigen::Vector2d& position, const Eigen::Vector2d& velocity) {
  ObstacleTrack track;
  track.id = id;
  track.time = 10.0;
  track.state = {position, velocity, 0.4};
  return track;
}

/// Length of the polyline through samples every 10 ms: shorter than the curve by less than a millimetre here.
double path_length(const Trajectory& trajectory) {
  double length = 0.0;
  for (double ahead = 0.0; ahead < trajectory.duration(); ahead += 0.01) {
    const double time = trajectory.start_time() + ahead;
    length += (trajectory.position(time + 0.01) - trajectory.position(time)).norm();
  }
  return length;
}

PlannerParameters with_model(DynamicModel model) {
  PlannerParameters parameters;
  parameters.dynamic_model = model;
  return parameters;
}

TEST(FieldPlanner, GoesStraightToAGoalInTheOpen) {
  PlannerScene scene;
  scene.finish({-2.0, 0.0}, {3.0, 0.0});
  FieldPlanner planner{PlannerParameters{}, RobotParameters{}, FieldParameters{}};
  PlanResult result;
  planner.plan(scene.request, result);
  ASSERT_EQ(result.outcome, PlanOutcome::success);
  const Trajectory& plan = result.trajectory;
  EXPECT_LT((plan.tail_position() - scene.request.goal_world).norm(), 1e-9);
  const QuinticPiece& last = plan.piece(plan.piece_count() - 1);
  EXPECT_LT(last.velocity(last.duration).norm(), 1e-9);
  EXPECT_LT(path_length(plan), 5.001);
  // Rest to rest over 5 m with 1 m/s and 1 m/s^2 takes at least 6 s; smoothness costs some more.
  EXPECT_GT(plan.duration(), 6.0 / (1.0 + kAccelerationTolerance));
  EXPECT_LT(plan.duration(), 7.4);
  EXPECT_LE(plan.max_speed(), 1.0 + kSpeedTolerance);
  EXPECT_LE(plan.max_acceleration(), 1.0 + kAccelerationTolerance);
}

TEST(FieldPlanner, PlansThroughSixSquaresWithoutContact) {
  RandomStream random{101};
  for (int i = 0; i < 25; ++i) {
    SCOPED_TRACE(i);
    PlannerScene scene;
    const double angle = random.uniform(-kPi, kPi);
    const Eigen::Vector2d start = 6.0 * Eigen::Vector2d{std::cos(angle), std::sin(angle)};
    draw_boxes(random, 6, 5.0, {start, -start}, scene.boxes);
    scene.finish(start, -start);
    FieldPlanner planner{PlannerParameters{}, RobotParameters{}, FieldParameters{}};
    PlanResult result;
    // Plan after plan, each from a position on the last, to the goal.
    Trajectory committed = Trajectory::standing(start, 10.0, 1.0);
    double time = 10.0;
    while (result.outcome != PlanOutcome::goal_reached && time < 50.0) {
      scene.request.time = scene.request.world.time = time;
      scene.request.head = committed.state(time);
      scene.request.committed = &committed;
      planner.plan(scene.request, result);
      ASSERT_TRUE(result.outcome == PlanOutcome::success || result.outcome == PlanOutcome::goal_reached)
          << to_string(result.outcome) << " at " << time;
      committed = result.trajectory;
      // Independent of the clearance model: exact boxes, every 5 ms of the whole plan.
      for (double ahead = 0.0; ahead <= committed.duration(); ahead += 0.005)
        ASSERT_GT(scene.box_clearance(committed.position(time + ahead)), 0.0)
            << "planned at " << time << " +" << ahead;
      time += 0.8;
    }
    EXPECT_EQ(result.outcome, PlanOutcome::goal_reached);
    EXPECT_LT(time, 30.0);
  }
}

TEST(FieldPlanner, LeavesAUShapedTrap) {
  PlannerScene scene;
  for (int i = -3; i <= 3; ++i) scene.boxes.push_back({{2.0, 1.0 * i}, 1.0});
  for (int i = 0; i <= 3; ++i) {
    scene.boxes.push_back({{2.0 - i, 3.0}, 1.0});
    scene.boxes.push_back({{2.0 - i, -3.0}, 1.0});
  }
  scene.finish({0.5, 0.0}, {6.0, 0.0});
  FieldPlanner planner{PlannerParameters{}, RobotParameters{}, FieldParameters{}};
  PlanResult result;
  planner.plan(scene.request, result);
  ASSERT_EQ(result.outcome, PlanOutcome::success);
  EXPECT_LT(result.trajectory.tail_position().x(), 2.5);
  EXPECT_GT(std::abs(result.trajectory.tail_position().y()), 2.0);
}

TEST(FieldPlanner, TriesBothSidesOfAMovingDiscAndKeepsOutOfItsField) {
  for (const double y : {-0.2, 0.0, 0.15}) {
    SCOPED_TRACE(y);
    PlannerScene scene;
    scene.tracks.push_back(make_track(1, {0.0, y}, {-0.4, 0.0}));
    scene.finish({-3.5, 0.0}, {4.0, 0.0});
    scene.request.keep_candidates = true;
    FieldPlanner planner{PlannerParameters{}, RobotParameters{}, FieldParameters{}};
    PlanResult result;
    planner.plan(scene.request, result);
    ASSERT_EQ(result.outcome, PlanOutcome::success);
    EXPECT_EQ(result.blocking_track, 1);
    double highest = -1e9;
    double lowest = 1e9;
    int chosen = 0;
    double best_cost = 1e18;
    for (const Candidate& candidate : result.candidates) {
      double extreme = 0.0;
      for (double ahead = 0.0; ahead < candidate.trajectory.duration(); ahead += 0.02) {
        const double at = candidate.trajectory.position(10.0 + ahead).y();
        if (std::abs(at) > std::abs(extreme)) extreme = at;
      }
      highest = std::max(highest, extreme);
      lowest = std::min(lowest, extreme);
      chosen += candidate.chosen ? 1 : 0;
      best_cost = std::min(best_cost, candidate.cost);
    }
    EXPECT_GT(highest, 0.5);
    EXPECT_LT(lowest, -0.5);
    EXPECT_EQ(chosen, 1);
    for (const Candidate& candidate : result.candidates) {
      if (candidate.chosen) {
        EXPECT_EQ(candidate.cost, best_cost);
      }
    }
    const ProbabilityField field{scene.tracks[0].state, 0.3, FieldParameters{}};
    for (double ahead = 0.0; ahead < result.trajectory.duration(); ahead += 0.01)
      ASSERT_GE(field.mahalanobis(result.trajectory.position(10.0 + ahead)), field.threshold() - 1e-3);
  }
}

TEST(FieldPlanner, CountsEveryRunOfTheOptimiser) {
  FieldPlanner planner{PlannerParameters{}, RobotParameters{}, FieldParameters{}};
  PlanResult result;
  PlannerScene open;
  open.finish({-3.5, 0.0}, {5.0, 0.0});
  planner.plan(open.request, result);
  ASSERT_EQ(result.outcome, PlanOutcome::success);
  EXPECT_EQ(result.stats.optimiser_calls, 1);
  EXPECT_GT(result.stats.inner_iterations, 1);
  EXPECT_GE(result.stats.evaluations, result.stats.inner_iterations);
  // A disc on the path: the first run meets it, then each side is run.
  PlannerScene blocked;
  blocked.tracks.push_back(make_track(1, {1.0, 0.05}, {0.0, 0.0}));
  blocked.finish({-3.5, 0.0}, {5.0, 0.0});
  planner.plan(blocked.request, result);
  ASSERT_EQ(result.outcome, PlanOutcome::success);
  EXPECT_GE(result.stats.optimiser_calls, 2);
  EXPECT_GT(result.stats.inner_iterations, result.stats.optimiser_calls);
}

TEST(FieldPlanner, KeepsItsSideWhenBothAreAlike) {
  PlannerScene scene;
  scene.tracks.push_back(make_track(1, {1.0, 0.0}, {0.0, 0.0}));
  scene.finish({-3.5, 0.0}, {5.0, 0.0});
  FieldPlanner planner{PlannerParameters{}, RobotParameters{}, FieldParameters{}};
  PlanResult result;
  Trajectory committed;
  int side = 0;
  for (int i = 0; i < 12; ++i) {
    // The obstacle jitters about the line.
    scene.tracks[0].state.position_world.y() = 0.04 * (i % 2 == 0 ? 1.0 : -1.0);
    scene.tracks[0].time = scene.request.time;
    planner.plan(scene.request, result);
    ASSERT_EQ(result.outcome, PlanOutcome::success);
    double extreme = 0.0;
    for (double ahead = 0.0; ahead < result.trajectory.duration(); ahead += 0.02) {
      const double at = result.trajectory.position(scene.request.time + ahead).y();
      if (std::abs(at) > std::abs(extreme)) extreme = at;
    }
    if (i == 0) side = extreme > 0.0 ? 1 : -1;
    EXPECT_GT(extreme * side, 0.0) << "plan " << i;
    committed = result.trajectory;
    scene.request.time += 0.2;
    scene.request.world.time = scene.request.time;
    scene.request.head = committed.state(scene.request.time);
    scene.request.committed = &committed;
  }
}

TEST(FieldPlanner, AvoidsAnObstacleInEveryModelOfIt) {
  for (const DynamicModel model :
       {DynamicModel::frozen, DynamicModel::constant_velocity, DynamicModel::probability_field}) {
    SCOPED_TRACE(enum_name(model));
    PlannerScene scene;
    scene.tracks.push_back(make_track(1, {1.5, -0.1}, {-0.5, 0.0}));
    scene.finish({-3.5, 0.0}, {5.0, 0.0});
    FieldPlanner planner{with_model(model), RobotParameters{}, FieldParameters{}};
    PlanResult result;
    planner.plan(scene.request, result);
    ASSERT_EQ(result.outcome, PlanOutcome::success);
    for (double ahead = 0.0; ahead < 5.0; ahead += 0.01) {
      const Eigen::Vector2d p = result.trajectory.position(10.0 + ahead);
      const double moved = model == DynamicModel::constant_velocity ? ahead : 0.0;
      const Eigen::Vector2d obstacle{1.5 - 0.5 * moved, -0.1};
      ASSERT_GT((p - obstacle).norm(), 0.7) << ahead;
    }
  }
  PlannerScene scene;
  scene.tracks.push_back(make_track(1, {1.5, 0.0}, {-0.5, 0.0}));
  scene.finish({-3.5, 0.0}, {5.0, 0.0});
  FieldPlanner blind{with_model(DynamicModel::none), RobotParameters{}, FieldParameters{}};
  PlanResult result;
  blind.plan(scene.request, result);
  EXPECT_LT(path_length(result.trajectory), 7.55);
}

TEST(FieldPlanner, YieldsToAPeerOfHigherPriorityOnly) {
  for (const int peer_id : {0, 9}) {
    PlannerScene scene;
    Peer peer;
    peer.robot_id = peer_id;
    peer.state = PeerState::moving;
    QuinticPiece piece;  // comes straight at the robot, a little to one side
    piece.duration = 8.0;
    piece.coefficients.row(0) = Eigen::RowVector2d{4.0, 0.1};
    piece.coefficients.row(1) = Eigen::RowVector2d{-1.0, 0.0};
    Trajectory course{10.0};
    course.append(piece);
    peer.trajectory = course;
    scene.peers.push_back(peer);
    scene.finish({-3.5, 0.0}, {4.0, 0.0}, 3);
    FieldPlanner planner{PlannerParameters{}, RobotParameters{}, FieldParameters{}};
    PlanResult result;
    planner.plan(scene.request, result);
    ASSERT_EQ(result.outcome, PlanOutcome::success);
    double least = 1e9;
    for (double ahead = 0.0; ahead < 5.0; ahead += 0.01)
      least = std::min(
          least, (result.trajectory.position(10.0 + ahead) - peer.trajectory->position(10.0 + ahead)).norm());
    if (peer_id == 0) {
      EXPECT_GT(least, 0.64);
    } else {
      EXPECT_LT(least, 0.2);
    }
  }
}

TEST(FieldPlanner, StandsAtTheGoalAndTurnsThere) {
  PlannerScene scene;
  scene.finish({2.0, 1.0}, {2.0, 1.0});
  scene.request.goal_heading = 1.0;
  FieldPlanner planner{PlannerParameters{}, RobotParameters{}, FieldParameters{}};
  PlanResult result;
  planner.plan(scene.request, result);
  EXPECT_EQ(result.outcome, PlanOutcome::goal_reached);
  EXPECT_EQ(result.stats.evaluations, 0);
  EXPECT_LT((result.trajectory.position(30.0) - scene.request.goal_world).norm(), 1e-12);
  EXPECT_NEAR(result.trajectory.heading_state(30.0).heading, 1.0, 1e-9);
}

TEST(FieldPlanner, KeepsTheWheelsWithinTheirLimits) {
  RobotParameters robot;
  robot.max_wheel_speed = 0.7;  // less than max_speed
  const Drive drive{robot};
  PlannerScene scene;
  scene.finish({-2.0, 0.0}, {4.0, 1.0});
  scene.request.goal_heading = 2.5;
  FieldPlanner planner{PlannerParameters{}, robot, FieldParameters{}};
  PlanResult result;
  planner.plan(scene.request, result);
  ASSERT_EQ(result.outcome, PlanOutcome::success);
  double fastest = 0.0;
  for (double ahead = 0.0; ahead <= result.trajectory.duration(); ahead += 0.01) {
    const FlatState state = result.trajectory.state(10.0 + ahead);
    const HeadingState heading = result.trajectory.heading_state(10.0 + ahead);
    const Eigen::Vector3d twist{state.velocity_world.x(), state.velocity_world.y(), heading.yaw_rate};
    fastest = std::max(fastest, drive.input_from_world(twist, heading.heading).cwiseAbs().maxCoeff());
  }
  EXPECT_LE(fastest, robot.max_wheel_speed * 1.001);  // sampled ten times a piece by the planner
  EXPECT_GT(fastest, 0.5);
}

TEST(FieldPlanner, DoesNotLoopNearTheGoal) {
  // The known trap of the base planner: close to the goal its optimiser need not end.
  RandomStream random{51};
  for (int i = 0; i < 200; ++i) {
    SCOPED_TRACE(i);
    PlannerScene scene;
    const Eigen::Vector2d offset = std::pow(10.0, random.uniform(-2.5, -0.3)) * random.normal2().normalized();
    scene.finish({1.0, 1.0}, Eigen::Vector2d{1.0, 1.0} + offset);
    scene.request.head.velocity_world = random.uniform(0.0, 0.4) * offset.normalized();
    FieldPlanner planner{PlannerParameters{}, RobotParameters{}, FieldParameters{}};
    PlanResult result;
    planner.plan(scene.request, result);
    EXPECT_TRUE(result.outcome == PlanOutcome::success || result.outcome == PlanOutcome::goal_reached);
    EXPECT_LT(result.trajectory.duration(), 5.0);
    EXPECT_LT(path_length(result.trajectory), offset.norm() + 0.5);
  }
}

TEST(FieldPlanner, BrakesWhenThereIsNoSafePlan) {
  // A corridor as wide as one robot, and an oncoming robot of higher priority.
  PlannerScene scene;
  Peer peer;
  peer.robot_id = 1;
  peer.state = PeerState::moving;
  QuinticPiece piece;
  piece.duration = 8.0;
  piece.coefficients.row(0) = Eigen::RowVector2d{4.0, 0.0};
  piece.coefficients.row(1) = Eigen::RowVector2d{-1.0, 0.0};
  Trajectory course{10.0};
  course.append(piece);
  peer.trajectory = course;
  scene.peers.push_back(peer);
  scene.finish({-0.5, 0.0}, {5.0, 0.0});
  scene.map->add_box({-15.0, 0.5}, {15.0, 2.0});
  scene.map->add_box({-15.0, -2.0}, {15.0, -0.5});
  scene.guide.update(*scene.map, {5.0, 0.0}, {-0.5, 0.0});
  scene.request.head.velocity_world = {0.8, 0.0};
  FieldPlanner planner{PlannerParameters{}, RobotParameters{}, FieldParameters{}};
  PlanResult result;
  planner.plan(scene.request, result);
  EXPECT_EQ(result.outcome, PlanOutcome::unsafe);
  EXPECT_EQ(result.blocking_peer, 1);
  const QuinticPiece& last = result.trajectory.piece(result.trajectory.piece_count() - 1);
  EXPECT_LT(last.velocity(last.duration).norm(), 1e-9);
  EXPECT_LT(result.trajectory.duration(), 1.2);
}

TEST(FieldPlanner, StopsInFrontOfWhatStandsOnItsPath) {
  // A wall with one gap, and a stopped robot in it.
  PlannerScene scene;
  Peer peer;
  peer.robot_id = 7;
  peer.state = PeerState::stopped;
  peer.trajectory = Trajectory::standing({2.5, 0.0}, 0.0, 1.0);
  scene.peers.push_back(peer);
  scene.finish({-1.5, 0.0}, {5.0, 0.0});
  scene.map->add_box({2.0, 0.5}, {3.0, 15.0});
  scene.map->add_box({2.0, -15.0}, {3.0, -0.5});
  scene.guide.update(*scene.map, {5.0, 0.0}, {-1.5, 0.0});
  FieldPlanner planner{PlannerParameters{}, RobotParameters{}, FieldParameters{}};
  PlanResult result;
  planner.plan(scene.request, result);
  for (double ahead = 0.0; ahead <= result.trajectory.duration(); ahead += 0.01)
    ASSERT_GT((result.trajectory.position(10.0 + ahead) - Eigen::Vector2d{2.5, 0.0}).norm(), 0.6);
  const QuinticPiece& last = result.trajectory.piece(result.trajectory.piece_count() - 1);
  EXPECT_LT(last.velocity(last.duration).norm(), 1e-9);
}

TEST(FieldPlanner, SaysWhenThereIsNoPath) {
  PlannerScene scene;
  scene.finish({-0.5, 0.0}, {5.0, 0.0});
  scene.map->add_box({2.0, -15.0}, {3.0, 15.0});
  scene.guide.update(*scene.map, {5.0, 0.0}, {-0.5, 0.0});
  FieldPlanner planner{PlannerParameters{}, RobotParameters{}, FieldParameters{}};
  PlanResult result;
  planner.plan(scene.request, result);
  EXPECT_EQ(result.outcome, PlanOutcome::no_path);
  EXPECT_FALSE(result.trajectory.empty());
}

TEST(FieldPlanner, RefusesWhatIsNoRequest) {
  PlannerScene scene;
  scene.finish({-0.5, 0.0}, {5.0, 0.0});
  FieldPlanner planner{PlannerParameters{}, RobotParameters{}, FieldParameters{}};
  PlanResult result;
  PlanRequest bad = scene.request;
  bad.head.velocity_world.x() = std::nan("");
  planner.plan(bad, result);
  EXPECT_EQ(result.outcome, PlanOutcome::invalid_request);
  bad = scene.request;
  bad.world.map = nullptr;
  planner.plan(bad, result);
  EXPECT_EQ(result.outcome, PlanOutcome::invalid_request);
  EXPECT_FALSE(result.trajectory.empty());
  PlannerParameters parameters;
  parameters.horizon = 0.0;
  EXPECT_THROW((FieldPlanner{parameters, RobotParameters{}, FieldParameters{}}), std::invalid_argument);
}

/// Crowded: boxes, obstacles and peers at random.
void draw_crowd(RandomStream& random, PlannerScene& scene) {
  const Eigen::Vector2d start = draw_position(random, 9.0);
  const Eigen::Vector2d goal = draw_position(random, 9.0);
  draw_boxes(random, 14, 9.0, {start, goal}, scene.boxes);
  for (int i = 0; i < 6; ++i) {
    const Eigen::Vector2d position = draw_position(random, 9.0);
    scene.tracks.push_back(make_track(i, position, 0.7 * random.normal2()));
  }
  for (int i = 0; i < 8; ++i) {
    Peer peer;
    peer.robot_id = i < 4 ? i : i + 1;
    peer.state = i % 3 == 0 ? PeerState::stopped : PeerState::moving;
    QuinticPiece piece;
    piece.duration = 5.0;
    piece.coefficients.row(0) = draw_position(random, 9.0).transpose();
    if (peer.state == PeerState::moving) piece.coefficients.row(1) = 0.6 * random.normal2().transpose();
    Trajectory course{9.0};
    course.append(piece);
    peer.trajectory = course;
    scene.peers.push_back(peer);
  }
  scene.finish(start, goal, 4);
  scene.request.head.velocity_world = 0.6 * random.uniform() * random.normal2().normalized();
}

TEST(FieldPlannerSlow, EndsWithinItsBudgetWhateverTheScene) {
  RandomStream random{61};
  PlanResult result;
  int successes = 0;
  for (int i = 0; i < 500; ++i) {
    SCOPED_TRACE(i);
    PlannerParameters parameters = with_model(i % 3 == 0   ? DynamicModel::frozen
                                              : i % 3 == 1 ? DynamicModel::constant_velocity
                                                           : DynamicModel::probability_field);
    if (i % 5 == 0) parameters.max_evaluations = 200;
    PlannerScene scene;
    draw_crowd(random, scene);
    FieldPlanner planner{parameters, RobotParameters{}, FieldParameters{}};
    planner.plan(scene.request, result);
    EXPECT_LE(result.stats.evaluations, parameters.max_evaluations);
    EXPECT_FALSE(result.trajectory.empty());
    const FlatState head = result.trajectory.state(scene.request.time);
    EXPECT_LT((head.position_world - scene.request.head.position_world).norm(), 1e-9);
    EXPECT_LT((head.velocity_world - scene.request.head.velocity_world).norm(), 1e-9);
    if (result.outcome != PlanOutcome::success) continue;
    ++successes;
    for (double ahead = 0.0; ahead < result.trajectory.duration(); ahead += 0.01)
      ASSERT_GT(scene.box_clearance(result.trajectory.position(10.0 + ahead)), 0.0) << ahead;
  }
  EXPECT_GT(successes, 350);
}

// ES2 plans as ES2* would if all obstacles stood: to the bit, so that nothing but the prediction differs.
TEST(FieldPlannerSlow, TheBaselinesDifferInTheirPredictionAlone) {
  int successes = 0;
  int apart = 0;
  for (std::uint64_t i = 0; i < 60; ++i) {
    SCOPED_TRACE(i);
    const auto planned = [i](DynamicModel model, bool standing) {
      RandomStream random{mix(91, i)};
      PlannerScene scene;
      draw_crowd(random, scene);
      if (standing)
        for (ObstacleTrack& track : scene.tracks) track.state.velocity_world.setZero();
      FieldPlanner planner{with_model(model), RobotParameters{}, FieldParameters{}};
      PlanResult result;
      planner.plan(scene.request, result);
      return result;
    };
    const PlanResult es2 = planned(DynamicModel::frozen, false);
    const PlanResult same = planned(DynamicModel::constant_velocity, true);
    EXPECT_EQ(es2.outcome, same.outcome);
    EXPECT_EQ(es2.blocking_track, same.blocking_track);
    EXPECT_EQ(es2.stats.evaluations, same.stats.evaluations);
    EXPECT_EQ(es2.trajectory.duration(), same.trajectory.duration());
    for (double ahead = 0.0; ahead < es2.trajectory.duration(); ahead += 0.1)
      EXPECT_EQ(es2.trajectory.position(10.0 + ahead), same.trajectory.position(10.0 + ahead));
    successes += es2.outcome == PlanOutcome::success ? 1 : 0;
    const PlanResult moving = planned(DynamicModel::constant_velocity, false);
    apart += moving.trajectory.position(12.0) != es2.trajectory.position(12.0) ? 1 : 0;
  }
  EXPECT_GT(successes, 30);
  EXPECT_GT(apart, 20);  // the velocities matter
}

TEST(FieldPlanner, GivesTheSameBitsAgain) {
  RandomStream random{71};
  PlannerScene scene;
  draw_crowd(random, scene);
  FieldPlanner one{PlannerParameters{}, RobotParameters{}, FieldParameters{}};
  FieldPlanner two{PlannerParameters{}, RobotParameters{}, FieldParameters{}};
  PlanResult first;
  PlanResult second;
  one.plan(scene.request, first);
  two.plan(scene.request, second);
  EXPECT_EQ(first.stats.evaluations, second.stats.evaluations);
  EXPECT_EQ(first.trajectory.duration(), second.trajectory.duration());
  EXPECT_EQ(first.trajectory.position(12.0), second.trajectory.position(12.0));
}

TEST(FieldPlanner, DoesNotAllocateAfterTheFirstPlan) {
  RandomStream random{81};
  for (int i = 0; i < 20; ++i) {
    SCOPED_TRACE(i);
    PlannerScene scene;
    draw_crowd(random, scene);
    FieldPlanner planner{PlannerParameters{}, RobotParameters{}, FieldParameters{}};
    PlanResult result;
    planner.plan(scene.request, result);
    const Trajectory committed = result.trajectory;
    scene.request.committed = &committed;
    scene.request.time += 0.3;
    scene.request.head = committed.state(scene.request.time);
    const AllocationGuard guard;
    planner.plan(scene.request, result);
    EXPECT_EQ(guard.allocations(), 0);
  }
}

}  // namespace
}  // namespace spf
