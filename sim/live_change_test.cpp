// A trial that its caller runs tick by tick, and changes meanwhile.
#include <gtest/gtest.h>

#include <stdexcept>

#include "sim/families.hpp"
#include "sim/geometry.hpp"
#include "sim/simulation.hpp"
#include "sim/task_between.hpp"
#include "sim/world.hpp"

namespace spf::sim {
namespace {

using Eigen::Vector2d;

/// Two robots in lanes of 3 m, each of 8 m to the right, and a disc that stands aside.
Scenario two_lanes() {
  Scenario scenario;
  scenario.border = square(Vector2d::Zero(), 20.0);
  scenario.robots = {task_between({-4.0, 0.0}, {4.0, 0.0}), task_between({-4.0, 3.0}, {4.0, 3.0})};
  scenario.moving.push_back({{0.0, -7.0}, Vector2d::Zero(), 0.4});
  scenario.simulation.noise.level = 0.0;
  return scenario;
}

void run_to(Simulation& simulation, double time) {
  while (simulation.world().time() < time) simulation.tick();
}

const Vector2d& position(Simulation& simulation, std::size_t robot) {
  return simulation.world().positions()[robot];
}

TEST(LiveChange, TickByTickIsTheSameTrial) {
  const Scenario scenario = two_lanes();
  const TrialResult whole = Simulation{scenario, AgentParameters{}}.run();
  SimulationOptions options;
  options.record = true;
  Simulation simulation{scenario, AgentParameters{}, options};
  std::size_t frames = 0;
  while (!simulation.finished()) {
    simulation.tick();
    frames += simulation.take_recording()->frames.size();
  }
  EXPECT_EQ(simulation.result().digest, whole.digest);
  EXPECT_EQ(simulation.result().outcome, TrialOutcome::success);
  EXPECT_NEAR(static_cast<double>(frames), whole.sim_seconds / 0.1, 1.0);  // each frame was handed out once
}

TEST(LiveChange, ARobotObeysWhatItIsToldAndGoesOnWhereItIsPut) {
  Simulation simulation{two_lanes(), AgentParameters{}};
  run_to(simulation, 1.0);
  simulation.world().tell({0, FleetAct::goal, {{-4.0, -3.0}, {}}, 0});
  simulation.put(1, {{2.0, -5.0}, 0.0});
  run_to(simulation, 1.1);
  EXPECT_LT((position(simulation, 1) - Vector2d{2.0, -5.0}).norm(), 0.1);
  run_to(simulation, 20.0);
  EXPECT_LT((position(simulation, 0) - Vector2d{-4.0, -3.0}).norm(), 0.3);
  EXPECT_LT((position(simulation, 1) - Vector2d{4.0, 3.0}).norm(), 0.3);
}

TEST(LiveChange, ANewWallStandsForAllWhoAreThere) {
  Scenario scenario = two_lanes();
  Simulation simulation{scenario, AgentParameters{}};
  run_to(simulation, 1.0);
  scenario.walls.push_back({{1.0, -2.0}, {1.0, 2.0}});  // across the way of robot 0
  scenario.people.push_back({{{0.0, -5.0}, {3.0, -5.0}}});
  simulation.change(scenario);
  run_to(simulation, 25.0);
  EXPECT_TRUE(simulation.world().contacts().empty());
  EXPECT_LT((position(simulation, 0) - Vector2d{4.0, 0.0}).norm(), 0.3);  // by another way
  ASSERT_EQ(simulation.world().dynamic_obstacles().size(), 2U);
  EXPECT_TRUE(simulation.world().dynamic_obstacles()[1].person);
}

TEST(LiveChange, AMovingDiscAndAPersonArePutElsewhere) {
  Scenario scenario = two_lanes();
  scenario.people.push_back({{{0.0, -5.0}}});
  Simulation simulation{scenario, AgentParameters{}};
  run_to(simulation, 0.5);
  simulation.world().place_moving(0, {7.0, -7.0});
  simulation.world().place_moving(1, {-7.0, 7.0});
  simulation.world().place_moving(2, {0.0, 0.0});  // nobody
  run_to(simulation, 0.75);
  EXPECT_EQ(simulation.world().dynamic_obstacles()[0].motion.from, (Vector2d{7.0, -7.0}));
  EXPECT_LT((simulation.world().dynamic_obstacles()[1].motion.to - Vector2d{-7.0, 7.0}).norm(), 0.5);
}

TEST(LiveChange, NobodyWhoIsThereCanBeTakenAwayAndNothingChangesThen) {
  Scenario scenario = two_lanes();
  Simulation simulation{scenario, AgentParameters{}};
  Scenario fewer = scenario;
  fewer.robots.pop_back();
  fewer.walls.push_back({{1.0, -2.0}, {1.0, 2.0}});
  EXPECT_THROW(simulation.change(fewer), std::invalid_argument);
  scenario.walls.push_back({{4.0, -1.0}, {4.0, 1.0}});  // through a goal
  EXPECT_THROW(simulation.change(scenario), std::invalid_argument);
  EXPECT_TRUE(simulation.world().scenario().walls.empty());
}

}  // namespace
}  // namespace spf::sim
