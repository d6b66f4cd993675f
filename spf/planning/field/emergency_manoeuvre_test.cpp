#include "spf/planning/field/emergency_manoeuvre.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "spf/math/angles.hpp"
#include "spf/math/random_stream.hpp"
#include "spf/planning/braking.hpp"

namespace spf {
namespace {

constexpr double kSceneTime = 4.0;  // [s]
constexpr double kHorizon = 3.0;    // [s]

/// Obstacles at constant velocity, which may run into a stopped robot.
PlannerParameters planner_parameters() {
  PlannerParameters parameters;
  parameters.dynamic_model = DynamicModel::constant_velocity;
  return parameters;
}

struct EmergencyScene {
  OccupancyMap map{GridFrame::covering({-10.0, -10.0}, {10.0, 10.0}, 0.1), 2.0};
  std::vector<ObstacleTrack> tracks;
  std::vector<Peer> peers;
  FlatState head;
  RobotParameters robot;

  void add(const Eigen::Vector2d& position, const Eigen::Vector2d& velocity) {
    ObstacleTrack track;
    track.id = static_cast<int>(tracks.size());
    track.time = kSceneTime;
    track.state = {position, velocity, 0.4};
    tracks.push_back(track);
  }
  [[nodiscard]] EmergencyManoeuvre evade(const PlannerParameters& planner = planner_parameters()) const {
    ClearanceModel model{planner, robot, FieldParameters{}};
    model.prepare({kSceneTime, 1, &map, &tracks, &peers}, kSceneTime, PeerSelection::all);
    return best_emergency_manoeuvre(head, {}, kSceneTime, kSceneTime + kHorizon, model, robot);
  }
  /// Least gap of the surfaces over the horizon, sampled: independent of the clearance model [m].
  [[nodiscard]] double gap(const Trajectory& trajectory) const {
    double least = std::numeric_limits<double>::infinity();
    for (double ahead = 0.0; ahead <= kHorizon; ahead += 0.005) {
      const Eigen::Vector2d position = trajectory.position(kSceneTime + ahead);
      for (const ObstacleTrack& track : tracks) {
        const Eigen::Vector2d centre = track.state.position_world + ahead * track.state.velocity_world;
        least = std::min(least, (position - centre).norm() - robot.radius - track.state.radius);
      }
    }
    return least;
  }
};

TEST(EmergencyManoeuvre, BrakesWhenNothingIsNear) {
  EmergencyScene scene;
  scene.head.velocity_world = {0.8, 0.3};
  const EmergencyManoeuvre manoeuvre = scene.evade();
  EXPECT_FALSE(manoeuvre.sidestep);
  EXPECT_TRUE(manoeuvre.report.clear());
  const Trajectory braking = braking_trajectory(scene.head, {}, kSceneTime, scene.robot);
  EXPECT_EQ(manoeuvre.trajectory.tail_position(), braking.tail_position());
}

/// From rest, half a second at 1 m/s^2 and back to rest leads 0.25 m far: enough against what would graze the
/// robot.
TEST(EmergencyManoeuvre, StepsAsideWhenStandingWouldBeGrazed) {
  for (int i = 0; i < 24; ++i) {
    SCOPED_TRACE(i);
    const double angle = 2.0 * kPi * i / 24;
    const Eigen::Vector2d from{std::cos(angle), std::sin(angle)};
    EmergencyScene scene;
    const Eigen::Vector2d beside{-from.y(), from.x()};
    scene.add(2.0 * from + 0.53 * beside, -0.8 * from);
    const EmergencyManoeuvre manoeuvre = scene.evade();
    EXPECT_TRUE(manoeuvre.sidestep);
    EXPECT_TRUE(manoeuvre.report.clear());
    EXPECT_GT(scene.gap(manoeuvre.trajectory), 0.0);
    EXPECT_LT(scene.gap(braking_trajectory(scene.head, {}, kSceneTime, scene.robot)),
              0.0);  // there was a need
  }
}

TEST(EmergencyManoeuvre, KeepsOutOfTheWallItHasBehind) {
  EmergencyScene scene;
  scene.map.add_box({-9.0, -2.0}, {9.0, -0.4});  // 0.1 m from the robot's side
  scene.add({0.5, 2.0}, {0.0, -0.7});
  const EmergencyManoeuvre manoeuvre = scene.evade();
  EXPECT_TRUE(manoeuvre.report.clear());
  EXPECT_GT(scene.gap(manoeuvre.trajectory), 0.0);
  for (double ahead = 0.0; ahead < kHorizon; ahead += 0.02)
    EXPECT_GT(manoeuvre.trajectory.position(kSceneTime + ahead).y() + 0.4, scene.robot.radius);
}

TEST(EmergencyManoeuvre, KeepsTheLimitsEndsStandingAndIsNoWorseThanBraking) {
  RandomStream random{15};
  int sidesteps = 0;
  for (int i = 0; i < 300; ++i) {
    SCOPED_TRACE(i);
    EmergencyScene scene;
    scene.head.velocity_world =
        random.uniform(0.0, 1.0) * random.normal2().normalized() * scene.robot.max_speed;
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector2d position = random.uniform(0.9, 3.0) * random.normal2().normalized();
      scene.add(position, -random.uniform(0.2, 0.6) * (position + 0.5 * random.normal2()).normalized());
    }
    const EmergencyManoeuvre manoeuvre = scene.evade();
    const Trajectory& trajectory = manoeuvre.trajectory;
    const FlatState start = trajectory.state(kSceneTime);
    EXPECT_LT((start.position_world - scene.head.position_world).norm(), 1e-12);
    EXPECT_LT((start.velocity_world - scene.head.velocity_world).norm(), 1e-12);
    EXPECT_EQ(trajectory.start_time(), kSceneTime);
    EXPECT_LT(trajectory.state(trajectory.end_time() - 1e-9).velocity_world.norm(), 1e-6);
    // Constant accelerations: exact to rounding.
    EXPECT_LE(trajectory.max_speed(), scene.robot.max_speed * (1.0 + 1e-9));
    EXPECT_LE(trajectory.max_acceleration(), scene.robot.max_acceleration * (1.0 + 1e-9));
    // The reports are correct: no contact in a clear one (they use half the margin of 0.05 m).
    const double gap = scene.gap(trajectory);
    if (manoeuvre.report.clear()) {
      EXPECT_GT(gap, 0.0);
    }
    const double braking_gap = scene.gap(braking_trajectory(scene.head, {}, kSceneTime, scene.robot));
    if (braking_gap > 0.05) {
      EXPECT_TRUE(manoeuvre.report.clear());
    }
    sidesteps += manoeuvre.sidestep ? 1 : 0;
  }
  EXPECT_GT(sidesteps, 100);
}

TEST(EmergencyManoeuvre, WithoutAWayOutTakesTheLatestConflict) {
  // Discs close in from all sides, those on the right later.
  EmergencyScene scene;
  for (int i = 0; i < 8; ++i) {
    const double angle = 2.0 * kPi * i / 8;
    const Eigen::Vector2d from{std::cos(angle), std::sin(angle)};
    scene.add((from.x() > 0.5 ? 2.0 : 1.4) * from, -0.7 * from);
  }
  const EmergencyManoeuvre manoeuvre = scene.evade();
  EXPECT_FALSE(manoeuvre.report.clear());
  ClearanceModel model{planner_parameters(), scene.robot, FieldParameters{}};
  model.prepare({kSceneTime, 1, &scene.map, &scene.tracks, &scene.peers}, kSceneTime, PeerSelection::all);
  const Trajectory braking = braking_trajectory(scene.head, {}, kSceneTime, scene.robot);
  const double braking_time =
      model.check(braking, {kSceneTime, kSceneTime + kHorizon, kSceneTime + kHorizon, 0.5}).time;
  EXPECT_GT(manoeuvre.report.time, braking_time);
  EXPECT_TRUE(manoeuvre.sidestep);
  EXPECT_GT(manoeuvre.trajectory.tail_position().x(), 0.0);
}

/// Ten manoeuvres a second of a robot that stops in front of an obstacle, inside its field.
double least_gap_of_manoeuvres(const Eigen::Vector2d& obstacle_from, const Eigen::Vector2d& velocity,
                               const std::vector<Eigen::Vector2d>& wall) {
  EmergencyScene scene;
  if (!wall.empty()) scene.map.add_box(wall[0], wall[1]);
  scene.add(obstacle_from, velocity);
  double least = std::numeric_limits<double>::infinity();
  for (int step = 0; step < 40; ++step) {
    const EmergencyManoeuvre manoeuvre = scene.evade(PlannerParameters{});
    for (int k = 0; k < 10; ++k) {
      const Eigen::Vector2d position = manoeuvre.trajectory.position(kSceneTime + 0.01 * k);
      const Eigen::Vector2d centre = scene.tracks[0].state.position_world + 0.01 * k * velocity;
      least = std::min(least, (position - centre).norm() - 0.7);
    }
    scene.head = manoeuvre.trajectory.state(kSceneTime + 0.1);
    scene.tracks[0].state.position_world += 0.1 * velocity;
  }
  return least;
}

/// In the field nothing is clear, and the obstacle does not wait: a robot that stops there is run over.
TEST(EmergencyManoeuvre, LeavesTheFieldOfAnObstacleThatComes) {
  for (int i = 0; i < 24; ++i) {
    SCOPED_TRACE(i);
    const double angle = 2.0 * kPi * i / 24;
    const Eigen::Vector2d from{std::cos(angle), std::sin(angle)};
    const Eigen::Vector2d beside{-from.y(), from.x()};
    const Eigen::Vector2d start = 1.6 * from + (0.1 + 0.02 * i) * beside;
    ASSERT_LT((start - 0.6 * from).norm(), 1.3);  // the robot lies in the field
    EXPECT_GT(least_gap_of_manoeuvres(start, -0.6 * from, {}), 0.0);
  }
}

TEST(EmergencyManoeuvre, LeavesTheFieldOnTheOtherSideOfAWall) {
  // 0.1 m of room above the robot, which is the nearer way out of the field.
  EXPECT_GT(least_gap_of_manoeuvres({1.5, -0.1}, {-0.4, 0.0}, {{-9.0, 0.4}, {9.0, 2.0}}), 0.0);
}

TEST(EmergencyManoeuvre, TellsHowLongItStaysInTheField) {
  EmergencyScene scene;
  scene.add({5.0, 0.0}, {-0.5, 0.0});
  EXPECT_EQ(scene.evade(PlannerParameters{}).time_in_fields, 0.0);
  scene.tracks[0].state.position_world = {0.3, 0.6};  // half in: out within the second that it takes
  scene.tracks[0].state.velocity_world.setZero();
  const EmergencyManoeuvre manoeuvre = scene.evade(PlannerParameters{});
  EXPECT_TRUE(manoeuvre.sidestep);
  EXPECT_GT(manoeuvre.time_in_fields, 0.1);
  EXPECT_LT(manoeuvre.time_in_fields, 1.0);
  const Eigen::Vector2d out = manoeuvre.trajectory.position(kSceneTime + manoeuvre.time_in_fields);
  EXPECT_GE((out - Eigen::Vector2d{0.3, 0.6}).norm(), 0.7);
}

}  // namespace
}  // namespace spf
