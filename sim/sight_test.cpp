// A robot whose map is unknown, at all kinds of speed, brakes and sight: it never touches what stands, and
// slows for what it may see too late.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>

#include "sim/geometry.hpp"
#include "sim/simulation.hpp"
#include "spf/robot/robot_scale.hpp"

namespace spf::sim {
namespace {

struct Shape {
  const char* name;
  void (*build)(Scenario&);
};

void build_wall(Scenario& scenario) {
  scenario.boxes.push_back({{10.0, -7.0}, {10.3, 7.0}});
}
void build_pillar(Scenario& scenario) {
  scenario.discs.push_back({{10.0, 0.05}, 0.25});
}
void build_pocket(Scenario& scenario) {
  scenario.boxes.push_back({{12.0, -3.0}, {12.3, 3.0}});
  scenario.boxes.push_back({{6.0, 2.7}, {12.0, 3.0}});
  scenario.boxes.push_back({{6.0, -3.0}, {12.0, -2.7}});
}
/// A corridor that turns left, then right.
void build_corner(Scenario& scenario) {
  scenario.boxes.push_back({{-20.0, -10.0}, {10.0, -1.2}});
  scenario.boxes.push_back({{-20.0, 1.2}, {7.0, 10.0}});
  scenario.boxes.push_back({{10.0, -10.0}, {20.0, 5.0}});
}
void build_gap(Scenario& scenario) {
  scenario.boxes.push_back({{10.0, -10.0}, {10.3, 2.0}});
  scenario.boxes.push_back({{10.0, 3.4}, {10.3, 10.0}});
}

constexpr std::array<Shape, 5> kShapes{{{"wall", build_wall},
                                        {"pillar", build_pillar},
                                        {"pocket", build_pocket},
                                        {"corner", build_corner},
                                        {"gap", build_gap}}};

Scenario unknown_scene(double max_speed, double braking, double sight, double shift) {
  Scenario scenario;
  scenario.border = Box{{-26.0, -10.0}, {26.0, 10.0}};
  RobotTask task;
  task.start = {{-15.0, shift}, 0.0};
  task.goal_world = {16.0, 7.0};
  scenario.robots = {task};
  scenario.robot.max_speed = max_speed;
  scenario.robot.max_acceleration = braking;
  scenario.robot.max_wheel_speed = 1.5 * max_speed;
  scenario.simulation.sensing.map = MapKnowledge::sensed;
  scenario.simulation.sensing.range = sight;
  scenario.simulation.trial.time_limit = 60.0;
  return scenario;
}

TrialResult drive(const Scenario& scenario) {
  return Simulation{scenario, agent_parameters_for(scenario, defaults_for(scenario.robot)), {}}.run();
}

class SightSlow : public testing::TestWithParam<Shape> {};

TEST_P(SightSlow, NothingThatStandsIsTouched) {
  int run = 0;
  for (const double max_speed : {0.5, 1.5, 3.0})
    for (const double braking : {0.1, 0.4, 2.0})
      for (const double sight : {2.0, 6.0}) {
        Scenario scenario = unknown_scene(max_speed, braking, sight, 0.02 * (run++ % 5));
        GetParam().build(scenario);
        const TrialResult result = drive(scenario);
        EXPECT_NE(result.outcome, TrialOutcome::collision)
            << GetParam().name << ": max_speed " << max_speed << ", max_acceleration " << braking
            << ", sight " << sight << ", clearance " << result.static_clearance;
      }
}

INSTANTIATE_TEST_SUITE_P(Shapes, SightSlow, testing::ValuesIn(kShapes),
                         [](const auto& which) { return std::string{which.param.name}; });

TEST(Sight, AWallSeenInTimeIsDrivenRound) {
  Scenario scenario = unknown_scene(1.5, 0.5, 8.0, 0.0);
  build_wall(scenario);
  scenario.simulation.trial.time_limit = 120.0;
  EXPECT_EQ(drive(scenario).outcome, TrialOutcome::success);
}

TEST(Sight, SlowsForWhatIsSeenLate) {
  for (const double shift : {-0.1, 0.0, 0.1}) {
    Scenario scenario;
    scenario.border = square({0.0, 0.0}, 30.0);
    RobotTask task;
    task.start = {{-8.0, shift}, 0.0};
    task.goal_world = {8.0, 0.0};
    scenario.robots = {task};
    scenario.moving = {{{8.0, 0.0}, {-1.0, 0.0}, 0.3}};
    scenario.simulation.sensing.range = 1.6;
    EXPECT_EQ(drive(scenario).outcome, TrialOutcome::success) << "shift " << shift;
  }
}

}  // namespace
}  // namespace spf::sim
