#include "sim/contact_monitor.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include "sim/geometry.hpp"
#include "spf/math/random_stream.hpp"

namespace spf::sim {
namespace {

constexpr double kDt = 0.005;  // [s]

/// A trial in which robots and dynamic obstacles are put where the test wants them, tick by tick.
class Stage {
 public:
  explicit Stage(std::size_t robots) : robots_(robots) { scenario_.robots.resize(robots); }
  void put(std::size_t robot, const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
    robots_[robot].motion = {from, to};
    robots_[robot].velocity_world = (to - from) / kDt;
  }
  void put_person(int id, const Eigen::Vector2d& at, bool appears = true) {
    dynamic_obstacles_ = {{id, true, appears, 0.25, {at, at}, {0.0, 0.0}}};
  }
  void put_disc(const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
    dynamic_obstacles_ = {{0, false, false, 0.4, {from, to}, (to - from) / DynamicObstacles::kStep}};
  }
  void clear_obstacles() { dynamic_obstacles_.clear(); }
  RobotTruth& robot(std::size_t index) { return robots_[index]; }
  ContactMonitor& run(double seconds = kDt, double share_from = 0.0) {
    const int ticks = static_cast<int>(std::lround(seconds / kDt));
    for (int i = 0; i < ticks; ++i, time_ += kDt)
      monitor_.check({time_, kDt, share_from, share_from + 0.05}, robots_, dynamic_obstacles_);
    return monitor_;
  }

 private:
  Scenario scenario_;
  std::vector<RobotTruth> robots_;
  std::vector<DynamicObstacle> dynamic_obstacles_;
  ContactMonitor monitor_{scenario_with(robots_.size())};
  double time_ = 0.0;

  static Scenario scenario_with(std::size_t robots) {
    Scenario scenario;
    scenario.robots.resize(robots);
    return scenario;
  }
};

TEST(ContactMonitor, RecordsWhoWithWhatWhenAndHowFast) {
  Stage stage{2};
  stage.put(0, {10.0, 0.0}, {10.0, 0.0});
  stage.put(1, {0.0, 0.0}, {0.005, 0.0});  // 1 m/s
  stage.put_disc({0.752, 0.0},
                 {0.652, 0.0});  // towards it with 1 m/s: 0.005 m in this tick's part of the step
  const ContactMonitor& monitor = stage.run();  // gap 0.052 at first, 0.042 at its end: no contact
  EXPECT_TRUE(monitor.contacts().empty());
  EXPECT_NEAR(monitor.dynamic_distance(), 0.742, 1e-12);
  EXPECT_NEAR(monitor.dynamic_clearance(), 0.042, 1e-12);
  stage.put(1, {0.045, 0.0}, {0.050, 0.0});
  stage.run(kDt, 0.0);  // 0.707 -> 0.697 within the tick; touches at 0.7 after 0.7 of it
  ASSERT_EQ(monitor.contacts().size(), 1U);
  const Contact& contact = monitor.contacts()[0];
  EXPECT_EQ(contact.robot, 1);
  EXPECT_EQ(contact.with, ContactWith::moving);
  EXPECT_EQ(contact.other, 0);
  EXPECT_NEAR(contact.time, kDt + 0.7 * kDt, 1e-9);
  EXPECT_NEAR(contact.robot_speed, 1.0, 1e-9);
  EXPECT_NEAR(contact.other_speed, 1.0, 1e-9);
}

TEST(ContactMonitor, KnowsTheSizeOfEveryRobot) {
  Scenario scenario;
  scenario.robots.resize(2);
  scenario.fleet.resize(2);
  scenario.fleet[1].radius = 0.5;
  give_kinds_in_turn(scenario);
  ContactMonitor monitor{scenario};
  std::vector<RobotTruth> robots(2);
  robots[1].radius = 0.5;
  const auto contacts_at = [&](double gap, double time) {
    robots[0].motion = {{0.0, 0.0}, {0.0, 0.0}};
    robots[1].motion = {{gap, 0.0}, {gap, 0.0}};
    monitor.check({time, kDt, 0.0, 0.05}, robots, {});
    return monitor.contacts().size();
  };
  EXPECT_EQ(contacts_at(0.81, 0.0), 0U);
  EXPECT_NEAR(monitor.peer_clearance(), 0.01, 1e-12);
  EXPECT_EQ(contacts_at(0.79, kDt), 1U);

  const std::vector<DynamicObstacle> disc{{0, false, false, 0.4, {{0.0, 1.0}, {0.0, 1.0}}, {0.0, 0.0}}};
  robots[1].motion = {{0.0, 0.15}, {0.0, 0.15}};
  robots[0].motion = {{5.0, 0.0}, {5.0, 0.0}};
  monitor.check({2.0 * kDt, kDt, 0.0, 0.05}, robots, disc);
  ASSERT_EQ(monitor.contacts().size(), 2U);
  EXPECT_EQ(monitor.contacts()[1].robot, 1);
}

TEST(ContactMonitor, ForgivesOnlyPeopleWhoAppearOutOfNowhere) {
  for (const bool appears : {true, false}) {
    Stage stage{1};
    stage.put(0, {0.0, 0.0}, {0.0, 0.0});
    stage.put_person(7, {1.4, 0.0}, appears);
    stage.run(0.1);
    stage.put(0, {0.5, 0.0}, {1.0, 0.0});
    stage.put_person(7, {1.0, 0.0}, appears);
    EXPECT_EQ(stage.run().contacts().empty(), appears);
  }
}

TEST(ContactMonitor, FastRobotsDoNotJumpThroughEachOther) {
  Stage stage{2};
  stage.put(0, {-1.0, 0.0}, {1.0, 0.0});
  stage.put(1, {1.0, 0.1}, {-1.0, 0.1});
  const ContactMonitor& monitor = stage.run();
  ASSERT_EQ(monitor.contacts().size(), 1U);
  EXPECT_EQ(monitor.contacts()[0].with, ContactWith::robot);
  EXPECT_EQ(monitor.contacts()[0].other, 1);
  // They are 2 (1 - 2 share) apart along x: sum of radii 0.6 at share (1 - sqrt(0.36 - 0.01) / 2) / 2.
  EXPECT_NEAR(monitor.contacts()[0].time, kDt * 0.5 * (1.0 - 0.5 * std::sqrt(0.35)), 1e-12);
  EXPECT_NEAR(monitor.peer_clearance(), 0.1 - 0.6, 1e-12);
}

TEST(ContactMonitor, MeetsOnlyWhatTravels) {
  Stage stage{1};
  stage.put(0, {0.0, 0.0}, {0.0, 0.0});
  stage.robot(0).arrived = true;
  stage.put_disc({1.0, 0.0}, {1.0, 0.0});
  EXPECT_TRUE(std::isinf(stage.run().dynamic_distance()));
  stage.put_disc({0.5, 0.0}, {0.5, 0.0});
  EXPECT_EQ(stage.run().contacts().size(), 1U);  // contacts count after arrival, too
}

TEST(ContactMonitor, PeopleWhoWalkIntoAStandingRobotCountApartAndOnce) {
  Stage stage{1};
  stage.put(0, {0.0, 0.0}, {0.0, 0.0});
  stage.put_person(7, {3.0, 0.0});
  stage.run(1.1);
  stage.put_person(7, {0.5, 0.0});
  const ContactMonitor& monitor = stage.run(0.5);
  EXPECT_TRUE(monitor.contacts().empty());
  ASSERT_EQ(monitor.hits_while_standing().size(), 1U);
  EXPECT_EQ(monitor.hits_while_standing()[0].with, ContactWith::person);
  EXPECT_EQ(monitor.hits_while_standing()[0].other, 7);
}

TEST(ContactMonitor, PeopleWhoMeetAMovingRobotAreContacts) {
  Stage stage{1};
  stage.put_person(7, {3.0, 0.0});
  stage.put(0, {0.0, 0.0}, {0.005, 0.0});
  stage.run(1.1);
  stage.put_person(7, {0.5, 0.0});
  EXPECT_EQ(stage.run().contacts().size(), 1U);
}

TEST(ContactMonitor, PeopleWhoAppearTooNearAreForgivenUntilTheyHaveLeft) {
  Stage stage{1};
  stage.put(0, {0.0, 0.0}, {0.005, 0.0});
  stage.run();
  stage.put_person(7, {1.4, 0.0});
  stage.run();
  stage.put_person(7, {0.4, 0.0});
  EXPECT_TRUE(stage.run().contacts().empty());
  stage.put_person(7, {1.6, 0.0});
  stage.run();
  stage.put_person(7, {0.4, 0.0});
  EXPECT_EQ(stage.run().contacts().size(), 1U);
}

/// Robots that wander through a cluttered scene, and what an exhaustive check in every tick finds.
TEST(ContactMonitor, ShortcutsFindWhatALookAtEverythingFinds) {
  RandomStream random{31};
  Scenario scenario;
  scenario.border = square(Eigen::Vector2d::Zero(), 24.0);
  for (int i = 0; i < 8; ++i)
    scenario.boxes.push_back(square({random.uniform(-9, 9), random.uniform(-9, 9)}, 1.0));
  scenario.discs = {{{5.0, 5.0}, 0.7}};
  constexpr std::size_t kRobots = 12;
  scenario.robots.resize(kRobots);
  const double radius = scenario.robot.radius;
  std::vector<RobotTruth> robots(kRobots);
  for (RobotTruth& truth : robots) {
    truth.motion.to = {random.uniform(-11, 11), random.uniform(-11, 11)};
    truth.velocity_world = random.normal2();
  }
  ContactMonitor monitor{scenario};
  const StaticShapes shapes{scenario};
  std::size_t static_contacts = 0;
  std::vector<bool> touching(kRobots, false);
  std::set<std::pair<std::size_t, std::size_t>> touched;
  std::vector<double> least(kRobots, ContactMonitor::kFarStatic);
  double least_peer = ContactMonitor::kNearPeer;
  for (int tick = 0; tick < 4000; ++tick) {
    for (std::size_t i = 0; i < kRobots; ++i) {
      RobotTruth& truth = robots[i];
      truth.velocity_world += 0.1 * random.normal2() - 0.002 * truth.motion.to;
      const double jump = i == 0 && tick % 500 == 0 ? 100.0 : 1.0;  // one leaves every margin at once
      truth.motion = {truth.motion.to, truth.motion.to + jump * kDt * truth.velocity_world};
      const bool touches = shapes.first_contact(truth.motion, radius).has_value();
      static_contacts += touches && !touching[i];  // once while it lasts
      touching[i] = touches;
      least[i] = std::min(least[i], shapes.clearance(truth.motion.to, radius));
    }
    for (std::size_t i = 0; i < kRobots; ++i)
      for (std::size_t j = i + 1; j < kRobots; ++j) {
        const double gap = swept_distance(robots[i].motion, robots[j].motion) - 2.0 * radius;
        least_peer = std::min(least_peer, gap);
        if (gap < 0.0) touched.insert({i, j});
      }
    monitor.check({tick * kDt, kDt, 0.0, 0.05}, robots, {});
  }
  std::size_t with_robots = 0;
  for (const Contact& contact : monitor.contacts()) with_robots += contact.with == ContactWith::robot;
  EXPECT_EQ(monitor.contacts().size() - with_robots, static_contacts);
  EXPECT_EQ(with_robots, touched.size());
  EXPECT_GT(static_contacts, 10U);
  EXPECT_GT(touched.size(), 5U);
  EXPECT_EQ(monitor.peer_clearance(), least_peer);
  for (std::size_t i = 0; i < kRobots; ++i)
    EXPECT_NEAR(monitor.static_clearance(static_cast<int>(i)), least[i], 1e-12);
}

}  // namespace
}  // namespace spf::sim
