#include "sim/world.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "sim/families.hpp"
#include "sim/geometry.hpp"

namespace spf::sim {
namespace {

/// Robots in lanes 5 m apart, each with 4 m to go along x.
Scenario lanes(int robots, TrackingMode tracking = TrackingMode::full) {
  Scenario scenario;
  scenario.border = square(Eigen::Vector2d::Zero(), 40.0);
  for (int i = 0; i < robots; ++i) {
    RobotTask task;
    task.start = {{-2.0, 5.0 * i}, 0.0};
    task.goal_world = {2.0, 5.0 * i};
    scenario.robots.push_back(task);
  }
  scenario.simulation.trial.tracking = tracking;
  return scenario;
}

/// Wheel speeds that move the robot at this velocity without turning.
Eigen::Vector3d wheels_for(const World& world, int robot, const Eigen::Vector2d& velocity) {
  const double heading = world.robots()[static_cast<std::size_t>(robot)].pose.heading;
  const Eigen::Vector3d twist{velocity.x(), velocity.y(), 0.0};
  return world.plant(robot).drive().input_from_world(twist, heading);
}

void run_until(World& world, double time) {
  while (world.time() < time - 1e-9) {
    world.begin_tick();
    world.end_tick();
  }
}

TEST(World, StandsStillWithoutCommands) {
  World world{lanes(2)};
  run_until(world, 1.0);
  for (int i = 0; i < 2; ++i) {
    const auto robot = static_cast<std::size_t>(i);
    EXPECT_EQ(world.robots()[robot].pose.position_world, world.scenario().robots[robot].start.position_world);
    EXPECT_EQ(world.robots()[robot].velocity_world, Eigen::Vector2d::Zero());
  }
  EXPECT_FALSE(world.finished());
}

TEST(World, WheelCommandsAreHeldAndMoveOnlyTheirRobot) {
  World world{lanes(2)};
  world.command(1, wheels_for(world, 1, {0.5, 0.0}));
  run_until(world, 3.0);
  EXPECT_NEAR(world.robots()[1].velocity_world.x(), 0.5, 1e-6);
  EXPECT_NEAR(world.robots()[1].velocity_world.y(), 0.0, 1e-9);
  EXPECT_GT(world.robots()[1].pose.position_world.x(), -1.0);
  EXPECT_EQ(world.robots()[0].pose.position_world, Eigen::Vector2d(-2.0, 0.0));
  EXPECT_EQ(world.positions()[1], world.robots()[1].pose.position_world);
}

TEST(World, IdealMotionPutsARobotWhereTheHostSays) {
  World world{lanes(1, TrackingMode::ideal)};
  world.begin_tick();
  const double to = world.next_time();
  world.place(0, {{-1.99, 0.0}, 0.25}, {0.4, 0.0});
  world.end_tick();
  EXPECT_EQ(world.time(), to);
  EXPECT_EQ(world.robots()[0].pose.position_world, Eigen::Vector2d(-1.99, 0.0));
  EXPECT_EQ(world.robots()[0].pose.heading, 0.25);
  EXPECT_EQ(world.robots()[0].motion.from, Eigen::Vector2d(-2.0, 0.0));
  EXPECT_EQ(world.robots()[0].velocity_world, Eigen::Vector2d(0.4, 0.0));
}

TEST(World, SensorsAreDueAtTheirRates) {
  Scenario scenario = lanes(2);
  scenario.simulation.trial.plant_rate = 200.0;
  scenario.simulation.pose_noise.rate = 50.0;
  scenario.simulation.sensing.rate = 4.0;
  World world{scenario};
  int poses = 0;
  std::vector<int> observations(2, 0);
  int at_once = 0;
  int steps = 0;
  for (int tick = 0; tick < 400; ++tick) {
    world.begin_tick();
    if (world.pose_due()) ++poses;
    if (world.step_due()) ++steps;
    for (const int robot : {0, 1}) {
      if (!world.observation_due(robot)) continue;
      EXPECT_TRUE(world.pose_due());
      ++observations[as_index(robot)];
    }
    if (world.observation_due(0) && world.observation_due(1)) ++at_once;
    world.end_tick();
  }
  EXPECT_EQ(poses, 100);
  EXPECT_EQ(observations[0], 8);
  EXPECT_EQ(observations[1], 9);
  EXPECT_EQ(at_once, 1);  // at the start
  EXPECT_EQ(steps, 20);
  EXPECT_DOUBLE_EQ(world.pose_interval(), 0.02);
}

TEST(World, ReportsTheTruthWhenNothingIsNoisy) {
  World world{make_scenario(family_setup(Family::t2), kDefaultSeed, 10000)};
  world.begin_tick();
  const PoseMeasurement pose = world.measure_pose(2);
  EXPECT_EQ(pose.pose_world.position_world, world.robots()[2].pose.position_world);
  Observation observation;
  world.observe(2, observation);
  EXPECT_EQ(observation.time, 0.0);
  std::size_t in_range = 0;
  for (const DynamicObstacle& obstacle : world.dynamic_obstacles())
    if ((obstacle.motion.from - pose.pose_world.position_world).norm() <=
        world.scenario().simulation.sensing.range)
      ++in_range;
  EXPECT_EQ(observation.detections.size(), in_range);
}

TEST(World, ArrivalNeedsTheGoalAndLowSpeed) {
  World world{lanes(1)};
  world.command(0, wheels_for(world, 0, {1.0, 0.0}));
  while (world.robots()[0].pose.position_world.x() < 1.95) {
    world.begin_tick();
    world.end_tick();
    ASSERT_LT(world.time(), 10.0);
  }
  EXPECT_FALSE(world.robots()[0].arrived);  // within 0.1 m, but fast
  EXPECT_FALSE(world.finished());
  world.command(0, Eigen::Vector3d::Zero());
  while (!world.robots()[0].arrived) {
    if (world.robots()[0].velocity_world.x() < 0.1)  // it rolled past: come back slowly
      world.command(0, wheels_for(world, 0, {-0.1, 0.0}));
    world.begin_tick();
    world.end_tick();
    ASSERT_LT(world.time(), 40.0);
  }
  EXPECT_EQ(world.arrivals(), std::vector<int>{0});
  EXPECT_TRUE(world.finished());
  const TrialResult result = world.result();
  EXPECT_EQ(result.outcome, TrialOutcome::success);
  EXPECT_NEAR(result.last_arrival, world.time(), 1e-9);
  EXPECT_GT(result.robots[0].path_length, 3.8);

  run_until(world, world.time() + 1.0);  // a host may go on
  EXPECT_TRUE(world.arrivals().empty());
  EXPECT_EQ(world.result().outcome, TrialOutcome::success);
}

TEST(World, AContactEndsTheTrialOrLeavesAWreck) {
  for (const AfterContact after : {AfterContact::end, AfterContact::wreck}) {
    Scenario scenario = lanes(2);
    scenario.boxes = {square({0.0, 0.0}, 1.0)};
    scenario.simulation.trial.after_contact = after;
    World world{scenario};
    world.command(0, wheels_for(world, 0, {1.0, 0.0}));
    while (world.contacts().empty()) {
      world.begin_tick();
      world.end_tick();
      ASSERT_LT(world.time(), 5.0);
    }
    EXPECT_EQ(world.contacts()[0].robot, 0);
    EXPECT_EQ(world.contacts()[0].with, ContactWith::box);
    EXPECT_EQ(world.result().outcome, TrialOutcome::collision);
    const bool wrecks = after == AfterContact::wreck;
    EXPECT_EQ(world.finished(), !wrecks);
    EXPECT_EQ(world.robots()[0].wrecked, wrecks);
    if (!wrecks) continue;
    const Eigen::Vector2d position = world.robots()[0].pose.position_world;
    run_until(world, world.time() + 0.5);
    EXPECT_EQ(world.robots()[0].pose.position_world, position);
  }
}

TEST(World, ResultsCanBeReadAnyTimeAndChangeNothing) {
  const Scenario scenario = make_scenario(family_setup(Family::t2), kDefaultSeed, 10000);
  World watched{scenario};
  World alone{scenario};
  for (int tick = 0; tick < 100; ++tick) {
    for (World* world : {&watched, &alone}) {
      world->begin_tick();
      world->end_tick();
    }
    (void)watched.result();
  }
  EXPECT_NE(alone.result().digest, 0U);
  EXPECT_EQ(watched.result().digest, alone.result().digest);
}

TEST(World, RefusesWhatCannotRunWithAllReasons) {
  Scenario scenario = lanes(1);
  scenario.robots[0].goal_world = {30.0, 0.0};
  scenario.simulation.sensing.rate = std::nan("");
  try {
    const World world{scenario};
    FAIL() << "accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string{error.what()}.find("robots[0].goal"), std::string::npos) << error.what();
    EXPECT_NE(std::string{error.what()}.find("sensing.rate"), std::string::npos) << error.what();
  }
}

TEST(World, SaysWhoLeftTheNumberLine) {
  World world{lanes(2, TrackingMode::ideal)};
  world.begin_tick();
  world.place(1, {{std::nan(""), 0.0}, 0.0}, Eigen::Vector2d::Zero());
  try {
    world.end_tick();
    FAIL() << "accepted";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string{error.what()}.find("robot 1"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace spf::sim
