#include "sim/walkers.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/simulation.hpp"

namespace spf::sim {
namespace {

using testing::HasSubstr;

PersonTask person_on(std::vector<Eigen::Vector2d> waypoints,
                     PersonBehaviour behaviour = PersonBehaviour::reacting) {
  PersonTask task;
  task.waypoints = std::move(waypoints);
  task.speed = 1.0;
  task.behaviour = behaviour;
  return task;
}

TEST(Walkers, AFixedPersonKeepsToTheWayAndTheSpeed) {
  Scenario scenario;
  scenario.people = {person_on({{0.0, 0.0}, {2.0, 0.0}, {2.0, 1.0}}, PersonBehaviour::fixed)};
  Walkers walkers{scenario};
  const auto after = [&](int steps) {
    for (int i = 0; i < steps; ++i) {
      const Eigen::Vector2d before = walkers.motion(0).to;
      walkers.advance({});
      EXPECT_EQ(walkers.motion(0).from, before);  // without gaps
    }
    return walkers.motion(0).to;
  };
  EXPECT_LT((after(15) - Eigen::Vector2d{1.5, 0.0}).norm(), 1e-9);
  EXPECT_LT((after(10) - Eigen::Vector2d{2.0, 0.5}).norm(), 1e-9);
  EXPECT_LT((after(10) - Eigen::Vector2d{2.0, 0.5}).norm(), 1e-9);  // and back
  EXPECT_LT((after(25) - Eigen::Vector2d{0.0, 0.0}).norm(), 1e-9);
  EXPECT_LT((after(5) - Eigen::Vector2d{0.5, 0.0}).norm(), 1e-9);  // and forth again
}

TEST(Walkers, AWayMayLoopOrEnd) {
  Scenario scenario;
  scenario.people.assign(3, person_on({{0.0, 0.0}, {2.0, 0.0}, {2.0, 1.0}}, PersonBehaviour::fixed));
  scenario.people[0].at_last = AtLastWaypoint::loop;
  scenario.people[1].at_last = AtLastWaypoint::stay;
  scenario.people[2].waypoints = {{5.0, 5.0}};
  Walkers walkers{scenario};
  const double lap = 3.0 + std::hypot(2.0, 1.0);
  double walked = 0.0;
  for (int i = 0; i < 1000; ++i) {
    walkers.advance({});
    walked += 0.1;
    const double rest = std::fmod(walked, lap);
    if (rest < 2.0) {
      EXPECT_LT((walkers.motion(0).to - Eigen::Vector2d{rest, 0.0}).norm(), 1e-6) << i;
    }
  }
  EXPECT_EQ(walkers.motion(1).to, Eigen::Vector2d(2.0, 1.0));
  EXPECT_EQ(walkers.motion(2).to, Eigen::Vector2d(5.0, 5.0));
}

/// Least gap between the bodies of the first person and another body that moves steadily.
double least_gap(const PersonTask& task, const RoundBody& other, int steps) {
  Scenario scenario;
  scenario.people = {task};
  Walkers walkers{scenario};
  RoundBody body = other;
  double least = 1e9;
  for (int i = 0; i < steps; ++i) {
    walkers.advance({body});
    const Motion motion{body.position, body.position + Walkers::kStep * body.velocity};
    least = std::min(least, swept_distance(walkers.motion(0), motion) - task.radius - body.radius);
    body.position = motion.to;
  }
  return least;
}

TEST(Walkers, AReactingPersonAvoidsARobotAndAFixedOneDoesNot) {
  RoundBody robot;
  robot.radius = 0.3;
  for (const double offset : {-0.3, -0.1, 0.0, 0.1, 0.3}) {
    robot.position = {6.0, offset};
    robot.velocity = {-1.0, 0.0};
    EXPECT_GT(least_gap(person_on({{0.0, 0.0}, {8.0, 0.0}}), robot, 60), 0.0) << offset;
    EXPECT_LT(least_gap(person_on({{0.0, 0.0}, {8.0, 0.0}}, PersonBehaviour::fixed), robot, 60), 0.0)
        << offset;
    robot.velocity.setZero();  // it stands in the way
    EXPECT_GT(least_gap(person_on({{0.0, 0.0}, {12.0, 0.0}}), robot, 120), 0.0) << offset;
  }
}

TEST(Walkers, PeopleGoAroundEachOtherAndArrive) {
  Scenario scenario;
  for (int i = 0; i < 6; ++i) {
    const double angle = i * 3.14159265358979 / 3.0 + 0.02;
    const Eigen::Vector2d at = 4.0 * Eigen::Vector2d{std::cos(angle), std::sin(angle)};
    PersonTask task = person_on({at, -at});
    task.at_last = AtLastWaypoint::stay;
    scenario.people.push_back(task);
  }
  Walkers walkers{scenario};
  for (int step = 0; step < 300; ++step) {
    walkers.advance({});
    for (std::size_t i = 0; i < 6; ++i)
      for (std::size_t j = 0; j < i; ++j)
        ASSERT_GT(swept_distance(walkers.motion(i), walkers.motion(j)), 0.4) << step;  // they may brush
  }
  for (std::size_t i = 0; i < 6; ++i)
    EXPECT_LT((walkers.motion(i).to - scenario.people[i].waypoints[1]).norm(), 0.5) << i;
}

TEST(Walkers, AReactingPersonStaysOutOfWalls) {
  Scenario scenario;
  scenario.border = Box{{-1.0, -0.8}, {13.0, 0.8}};  // a corridor of 1.6 m
  scenario.discs = {{{4.0, 0.8}, 0.5}};
  scenario.polygons = {{{{8.0, -0.8}, {9.0, -0.8}, {8.5, -0.2}}}};
  scenario.people = {person_on({{0.0, -0.2}, {12.0, 0.2}}), person_on({{12.0, 0.2}, {0.0, -0.2}})};
  const StaticShapes shapes{scenario};
  for (const PersonTask& person : scenario.people) ASSERT_EQ(blocked_path(person, shapes), "");
  Walkers walkers{scenario};
  double farthest = 0.0;
  for (int step = 0; step < 2000; ++step) {
    walkers.advance({});
    for (std::size_t i = 0; i < 2; ++i) {
      ASSERT_GE(shapes.clearance(walkers.motion(i).to, walkers.radius(i)), -1e-9) << step;
      ASSERT_LE((walkers.motion(i).to - walkers.motion(i).from).norm(), 0.131) << step;
    }
    farthest = std::max(farthest, walkers.motion(0).to.x());
  }
  EXPECT_GT(farthest, 11.5);
}

TEST(Walkers, AWayThroughAWallIsNamed) {
  Scenario scenario;
  scenario.walls = {{{3.0, -1.0}, {3.0, 1.0}}};
  scenario.robots = {{{{0.0, 5.0}, 0.0}, {6.0, 5.0}, std::nullopt}};
  scenario.people = {person_on({{0.0, 0.0}, {0.0, 3.0}, {6.0, 3.0}, {6.0, 0.0}})};
  EXPECT_TRUE(problems_of(scenario).empty());
  scenario.people[0].at_last = AtLastWaypoint::loop;
  ASSERT_EQ(problems_of(scenario).size(), 1u);
  EXPECT_EQ(
      to_text(problems_of(scenario)[0]),
      "people[0].waypoints must leave a path: from waypoint 3 to 0 a person of this radius meets wall 0");
  scenario.people = {person_on({{0.0, 5.2}})};
  ASSERT_EQ(problems_of(scenario).size(), 1u);
  EXPECT_THAT(to_text(problems_of(scenario)[0]), HasSubstr("robots[0].start is inside people[0]"));
  scenario.people = {person_on({})};
  ASSERT_EQ(problems_of(scenario).size(), 1u);
  EXPECT_THAT(to_text(problems_of(scenario)[0]), HasSubstr("people[0].waypoints must be at least 1"));
}

TEST(Walkers, TrialsDrawWhereAPersonStarts) {
  Scenario scenario;
  scenario.robots = {{{{2.0, 0.0}, 0.0}, {2.0, 3.0}, std::nullopt}};
  scenario.people = {person_on({{0.0, 0.0}, {10.0, 0.0}})};
  scenario.people[0].anywhere = true;
  std::vector<double> starts;
  for (scenario.trial = 0; scenario.trial < 50; ++scenario.trial) {
    const Walkers walkers{scenario};
    const Walkers again{scenario};
    EXPECT_EQ(walkers.motion(0).from, again.motion(0).from);
    EXPECT_EQ(walkers.motion(0).from.y(), 0.0);
    EXPECT_GE((walkers.motion(0).from - Eigen::Vector2d{2.0, 0.0}).norm(), 1.25);  // not beside the robot
    starts.push_back(walkers.motion(0).from.x());
  }
  EXPECT_LT(*std::min_element(starts.begin(), starts.end()), 0.6);
  EXPECT_GT(*std::max_element(starts.begin(), starts.end()), 9.0);
}

TEST(Walkers, ATrialAmongThemRepeats) {
  Scenario scenario;
  scenario.border = Box{{-6.0, -3.0}, {6.0, 3.0}};
  scenario.robots = {{{{-5.0, 0.0}, 0.0}, {5.0, 0.0}, std::nullopt}};
  scenario.people = {person_on({{5.0, 0.3}, {-5.0, 0.3}}), person_on({{0.0, -2.5}, {0.0, 2.5}})};
  scenario.moving = {{{3.0, 2.0}, {-0.4, -0.3}, 0.3}};
  const TrialResult once = Simulation{scenario, AgentParameters{}}.run();
  const TrialResult again = Simulation{scenario, AgentParameters{}}.run();
  EXPECT_EQ(once.outcome, TrialOutcome::success);
  EXPECT_EQ(once.sim_seconds, again.sim_seconds);
  EXPECT_EQ(once.robots[0].travel_time, again.robots[0].travel_time);
}

}  // namespace
}  // namespace spf::sim
