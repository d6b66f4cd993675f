// A world served to robots that this test is, on a wall clock that it tells.
#include "simulator/server.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

namespace spf::simulator {
namespace {

/// A robot that drives along its start's x axis as soon as its clock runs; on the wall a tick takes no time
/// of its own.
class TestOutlet : public Outlet {
 public:
  explicit TestOutlet(Server& server) : server_{server} {}

  void clock(const sim::World& world) override { clock_times.push_back(world.time()); }
  void goal(const sim::World&, int, const host::Goal&, double) override { ++goals; }
  void order(const sim::World&, const sim::FleetOrder& order) override { orders.push_back(order.act); }
  void pose(const sim::World&, int robot, const Pose2&) override { poses += robot == 0 ? 1 : 0; }
  void truth(const sim::World&) override { ++truths; }
  void obstacles(const sim::World&, int, const std::vector<Detection>&) override { ++obstacle_reports; }
  void scan(const sim::World&, int, const RangeScan&) override { ++scans; }
  void scene(const sim::World&) override { ++scenes; }
  void outcome(const sim::World&, const sim::TrialResult&, bool finished) override { ended = finished; }
  [[nodiscard]] double wall() const override { return wall_; }
  bool serve_until(double wall) override {
    if (begun) server_.command_twist(0, {speed, 0.0, 0.0});
    wall_ = std::max(wall_, wall);
    return server_.world().time() < last;
  }
  [[nodiscard]] bool is_there(int) const override { return wall_ >= there_after; }
  void begin(const sim::World&) override { begun = true; }
  void say(const std::string& text) override { said.push_back(text); }

  double speed = 0.5, there_after = 0.0, last = 1e9;
  bool begun = false, ended = false;
  int goals = 0, poses = 0, truths = 0, obstacle_reports = 0, scans = 0, scenes = 0;
  std::vector<double> clock_times;
  std::vector<sim::FleetAct> orders;
  std::vector<std::string> said;

 private:
  Server& server_;
  double wall_ = 0.0;
};

/// One robot, 2 m before its goal.
Settings one_robot() {
  Settings settings;
  sim::RobotTask task;
  task.start = {{0.0, 0.0}, 0.0};
  task.goal_world = {2.0, 0.0};
  settings.scenario.border = sim::Box{{-5.0, -5.0}, {5.0, 5.0}};
  settings.scenario.robots = {task};
  settings.quits_when_done = true;
  return settings;
}

TEST(Server, WaitsForTheRobotsAndEndsWithTheTrial) {
  Server server{one_robot()};
  struct Stops : TestOutlet {  // at its goal
    using TestOutlet::TestOutlet;
    void pose(const sim::World& world, int robot, const Pose2& measured) override {
      TestOutlet::pose(world, robot, measured);
      if (measured.position_world.x() > 1.98) speed = 0.0;
    }
  } driver{server};
  driver.there_after = 7.0;
  driver.last = 30.0;
  EXPECT_EQ(server.run(driver), 0);
  EXPECT_TRUE(driver.ended);
  EXPECT_THAT(driver.said, testing::Contains("waiting for robot0"));
  EXPECT_THAT(server.summary(), testing::HasSubstr("success"));
  EXPECT_THAT(server.summary(), testing::HasSubstr("1 of 1 robots at goal"));
  EXPECT_GT(driver.scans, 40);
  EXPECT_EQ(driver.scans, driver.obstacle_reports);
  EXPECT_NEAR(driver.truths, driver.poses / 2, 3);
}

TEST(Server, RunsOnTheWallsClockAtItsSpeed) {
  Settings settings = one_robot();
  settings.speed = 2.0;
  settings.waits_for_robots = false;
  Server server{settings};
  TestOutlet outlet{server};
  outlet.speed = 0.0;
  outlet.last = 3.0;
  EXPECT_EQ(server.run(outlet), 1) << "it was to end, and did not";
  EXPECT_NEAR(outlet.wall(), 1.5, 0.02);
  EXPECT_THAT(server.timing(), testing::HasSubstr("shifted 0 times"));
  EXPECT_TRUE(std::is_sorted(outlet.clock_times.begin(), outlet.clock_times.end()));
}

TEST(Server, TellsOrdersButWhoseRobotsHaveNoUseForThem) {
  Settings settings = one_robot();
  settings.waits_for_robots = false;
  const auto at = [&](double time, sim::FleetAct act) {
    sim::FleetEvent event;
    event.time = time;
    event.order.robot = 0;
    event.order.act = act;
    event.order.goal.position_world = {1.0, 1.0};
    event.order.priority = 3;
    settings.scenario.events.push_back(event);
  };
  at(0.5, sim::FleetAct::pause);
  at(1.0, sim::FleetAct::resume);
  at(1.5, sim::FleetAct::priority);
  at(2.0, sim::FleetAct::goal);
  at(2.5, sim::FleetAct::cancel);
  Server server{settings};
  TestOutlet outlet{server};
  outlet.speed = 0.0;
  outlet.last = 3.0;
  (void)server.run(outlet);
  EXPECT_THAT(outlet.orders,
              testing::ElementsAre(sim::FleetAct::pause, sim::FleetAct::resume, sim::FleetAct::cancel));
  EXPECT_EQ(outlet.goals, 1);
}

TEST(Server, LosesTheMessagesOfAFault) {
  Settings settings = one_robot();
  settings.waits_for_robots = false;
  settings.faults = {make_fault("odom", 0, 1.0, 2.0, 1)};
  Server server{settings};
  TestOutlet outlet{server};
  outlet.last = 3.0;
  outlet.speed = 0.0;
  (void)server.run(outlet);
  EXPECT_NEAR(outlet.poses, 200, 3) << "of 300";
  EXPECT_GT(outlet.scans, 25);
}

TEST(Settings, NameWhatIsWrong) {
  Settings settings = one_robot();
  settings.speed = 1000.0;
  settings.frame = "/";
  std::vector<std::string> warnings;
  std::string problems;
  read_command("wheels", settings, problems);
  try {
    check(settings, problems, warnings);
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("command = wheels must be one of cmd_vel, wheel_speeds"));
    EXPECT_THAT(error.what(), testing::HasSubstr("speed = 1000"));
    EXPECT_THAT(error.what(), testing::HasSubstr("frame must not be empty"));
  }
  EXPECT_THROW((void)make_fault("odometry", 0, 0.0, 1.0, 1), std::invalid_argument);
  EXPECT_THROW((void)make_fault("odom", 1, 0.0, 1.0, 1), std::invalid_argument);
}

}  // namespace
}  // namespace spf::simulator
