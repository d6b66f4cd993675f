#include "host/scan_guard.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "host/driver_scan.hpp"
#include "host/guard_world_test.hpp"
#include "spf/testing/allocation_guard.hpp"

namespace spf::host {
namespace {

constexpr double kNothing = std::numeric_limits<double>::infinity();

std::function<Eigen::Vector3d(double)> always(double x, double y, double yaw_rate = 0.0) {
  return [=](double) { return Eigen::Vector3d{x, y, yaw_rate}; };
}

AgentParameters agent_with(double max_speed, double max_acceleration) {
  AgentParameters agent;
  agent.robot.max_speed = max_speed;
  agent.robot.max_acceleration = max_acceleration;
  return agent;
}

// ---- what stops it ----------------------------------------------------------------------------------------

TEST(ScanGuard, StopsBeforeAWallAtAnySpeedAndWithAnyBrakes) {
  for (const double speed : {0.5, 1.0, 2.0, 3.0}) {
    for (const double brakes : {0.1, 0.3, 1.0, 2.0}) {
      for (const double sigma : {0.0, 0.02}) {
        SCOPED_TRACE(testing::Message() << speed << " m/s, " << brakes << " m/s^2, noise " << sigma);
        GuardWorld world{agent_with(speed, brakes)};
        world.range_sigma = sigma;
        const double far = 0.5 * speed * speed / brakes;
        world.walls = {{{far + 1.0, -9.0}, {far + 1.0, 9.0}}};
        world.moving(speed);
        world.command = always(speed, 0.0);
        world.run(1.5 * speed / brakes + 10.0);
        EXPECT_LT(world.speed(), 0.01);
        EXPECT_GT(world.gap, 0.0);
        EXPECT_LT(world.gap, 0.15);
        EXPECT_EQ(world.guard.verdict().action, GuardAction::stops);
        EXPECT_EQ(world.guard.counts().stops, 1u);
      }
    }
  }
}

TEST(ScanGuard, StopsBeforeAWallInAnyDirectionAndAlongACurve) {
  for (int i = 0; i < 12; ++i) {
    const double angle = 0.55 * i;
    for (const double yaw_rate : {0.0, 0.4, -0.9}) {
      GuardWorld world;
      world.walls = {{{-2.0, -2.0}, {2.0, -2.0}},
                     {{2.0, -2.0}, {2.0, 2.0}},
                     {{2.0, 2.0}, {-2.0, 2.0}},
                     {{-2.0, 2.0}, {-2.0, -2.0}}};
      world.pose.heading = 0.3 * i;
      world.command = always(std::cos(angle), std::sin(angle), yaw_rate);
      world.run(12.0);
      // Turning all the while it slides along the wall; that may cost it some millimetres.
      EXPECT_GT(world.gap, yaw_rate == 0.0 ? 0.0 : -0.005) << angle << ", " << yaw_rate;
    }
  }
}

TEST(ScanGuard, StopsBeforeThinThings) {
  struct Thin {
    int beams;
    double radius;
  };
  for (const Thin& thin : {Thin{720, 0.025}, Thin{720, 0.01}, Thin{360, 0.015}, Thin{180, 0.02}}) {
    for (const double aside : {-0.25, -0.1, 0.0, 0.013, 0.2}) {
      GuardWorld world;
      world.beams = thin.beams;
      world.range_sigma = 0.01;
      world.discs = {{{4.0, aside}, thin.radius}};
      world.command = always(1.0, 0.0);
      world.run(8.0);
      EXPECT_GT(world.gap, 0.0) << thin.beams << " beams, " << thin.radius << " m, " << aside;
      EXPECT_LT(world.speed(), 0.01);
    }
  }
}

TEST(ScanGuard, TwoBeamsAtThreeMetresAreAThing) {
  GuardWorld world;
  RangeScan scan = world.sweep();
  scan.ranges[359] = scan.ranges[360] = 3.0;
  ASSERT_TRUE(world.guard.add_scan(10.0, scan, Pose2{}, 10.0));
  EXPECT_NEAR(world.guard.judge(10.0, {1.0, 0.0, 0.0}).free_distance, 2.7, 0.001);
}

TEST(ScanGuard, StopsForAPersonWhoStepsInAMetreAhead) {
  for (const double from : {-1.0, 1.0}) {
    for (const double pace : {1.0, 1.5}) {
      GuardWorld world;
      world.command = always(1.0, 0.0);
      world.run(2.0);
      ASSERT_GT(world.speed(), 0.95);
      // In the middle of the way when the robot's front is still a metre away.
      const double seconds = 1.0 / pace;
      const double x = world.pose.position_world.x() + 0.3 + 0.25 + 1.0 + seconds;
      world.discs = {{{x, from}, 0.25, {0.0, -from * pace}}};
      world.run(seconds);
      world.discs[0].velocity_world.setZero();
      world.run(3.0);
      EXPECT_GT(world.gap, 0.0) << from << ", " << pace;
      EXPECT_LT(world.speed(), 0.01);
    }
  }
}

TEST(ScanGuard, LetsADiscCrossAndGoesOn) {
  for (const double pace : {0.5, 1.0}) {
    for (const double ahead : {0.9, 1.2, 1.6}) {
      GuardWorld world;
      world.command = always(1.0, 0.0);
      world.run(2.0);
      // It enters the way so far before the robot's front.
      const double seconds = 2.0;
      const double x = world.pose.position_world.x() + 0.3 + 0.3 + ahead + seconds;
      world.discs = {{{x, 0.6 + pace * seconds}, 0.3, {0.0, -pace}}};
      world.run(12.0);
      EXPECT_GT(world.gap, 0.0) << pace << ", " << ahead;
      EXPECT_GT(world.speed(), 0.95) << pace << ", " << ahead;
    }
  }
}

/// The speed at which the robot goes when what comes towards it at 1 m/s arrives.
double speed_at_contact(double fastest_approach) {
  GuardParameters parameters;
  parameters.fastest_approach = fastest_approach;
  GuardWorld world{AgentParameters{}, parameters};
  world.discs = {{{7.0, 0.0}, 0.3, {-1.0, 0.0}}};
  world.command = always(1.0, 0.0);
  while (world.gap > 0.0) world.tick();
  return world.speed();
}

TEST(ScanGuard, StandsByTheTimeThatSomethingArrives) {
  EXPECT_LT(speed_at_contact(2.0), 0.02);
  EXPECT_GT(speed_at_contact(0.0), 0.3);  // were everything to stand still
}

// ---- what does not ----------------------------------------------------------------------------------------

TEST(ScanGuard, GoesThroughADoorThatItFits) {
  for (const double sigma : {0.0, 0.02}) {
    GuardWorld world;
    world.range_sigma = sigma;
    for (const double side : {-0.35, 0.35}) {
      const double end = 10.0 * side;
      world.walls.push_back({{2.0, side}, {2.0, end}});
      world.walls.push_back({{2.2, side}, {2.2, end}});
      world.walls.push_back({{2.0, side}, {2.2, side}});
    }
    world.command = always(1.0, 0.0);
    world.run(5.5);
    EXPECT_GT(world.pose.position_world.x(), 4.8);
    EXPECT_LE(world.held, sigma > 0.0 ? 2 : 0);
    EXPECT_EQ(world.guard.counts().stops, 0u);
  }
}

TEST(ScanGuard, PassesAWallAndAPeerThatItDoesNotTouch) {
  for (const double gap : {0.05, 0.1, 0.3}) {
    for (const double yaw_rate : {0.0, 1.0}) {
      GuardWorld world;
      world.range_sigma = 0.02;
      // Along x in the world, turning or not.
      world.command = [&](double) {
        return twist_in_body({1.0, -2.0 * world.pose.position_world.y(), yaw_rate}, world.pose.heading);
      };
      world.run(0.5);
      world.walls = {{{-9.0, 0.3 + gap}, {20.0, 0.3 + gap}}};
      world.discs = {{{5.0, -0.6 - gap}, 0.3}, {{7.0, -0.7 - gap}, 0.4}};
      world.run(8.0);
      EXPECT_EQ(world.held, 0) << gap << ", " << yaw_rate;
    }
  }
}

TEST(ScanGuard, FollowsACurveAroundAPillar) {
  for (const double yaw_rate : {1.0, 0.0}) {
    GuardWorld world;
    world.pose.position_world = {0.0, -1.0};
    world.discs = {{{0.0, 0.0}, 0.6}};
    world.walls = {{{-2.0, -1.42}, {2.0, -1.42}}};
    // Round the pillar at 0.1 m from it, with the body turning along or not.
    world.command = [&](double) {
      const Eigen::Vector2d velocity = twist_in_world(world.twist_body, world.pose.heading).head<2>();
      const Eigen::Vector2d soon = world.pose.position_world + 0.09 * velocity;
      const Eigen::Vector2d outwards = soon.normalized();
      const Eigen::Vector2d course = left_of(outwards) + (1.0 - soon.norm()) * outwards;
      return twist_in_body({0.9 * course.x(), 0.9 * course.y(), yaw_rate}, world.pose.heading);
    };
    world.run(1.0);  // to get going
    world.held = 0;
    world.run(12.0);
    EXPECT_EQ(world.held, 0) << yaw_rate;
    EXPECT_GT(world.gap, 0.05) << yaw_rate;
  }
}

TEST(ScanGuard, LetsTheRobotTurnAndLeaveWhatItNearlyTouches) {
  GuardWorld world;
  world.walls = {{{0.32, -3.0}, {0.32, 3.0}}};
  RangeScan scan = world.sweep();
  ASSERT_TRUE(world.guard.add_scan(10.0, scan, Pose2{}, 10.0));
  const Eigen::Vector3d towards{0.5, 0.0, 0.7};
  EXPECT_EQ(world.guard.judge(10.0, towards).action, GuardAction::stops);
  EXPECT_EQ(world.guard.allowed(towards), Eigen::Vector3d(0.0, 0.0, 0.7));
  for (const Eigen::Vector3d& away :
       {Eigen::Vector3d{-1.0, 0.0, 0.0}, Eigen::Vector3d{-0.1, 1.0, 0.0}, Eigen::Vector3d{0.0, -1.0, 0.0},
        Eigen::Vector3d{0.0, 0.0, 1.5}, Eigen::Vector3d{-0.5, 0.5, 1.0}}) {
    EXPECT_EQ(world.guard.judge(10.0, away).action, GuardAction::none) << away.transpose();
    EXPECT_EQ(world.guard.allowed(away), away);
  }
}

TEST(ScanGuard, IgnoresWhatBelongsToTheRobotAndWhatOneBeamSawOnce) {
  GuardWorld world;
  world.command = always(1.0, 0.0);
  RandomStream random{2};
  world.spoil = [&](RangeScan& scan) {
    for (std::size_t i = 300; i < 420; ++i) scan.ranges[i] = 0.18;  // a mast
    scan.ranges[static_cast<std::size_t>(random.uniform(0.0, 720.0))] = random.uniform(0.35, 2.0);
    scan.ranges[static_cast<std::size_t>(random.uniform(420.0, 720.0))] = NAN;
  };
  world.run(30.0);
  EXPECT_EQ(world.held, 0);
}

TEST(ScanGuard, HavingStoppedItWaitsForAWayWorthGoing) {
  GuardWorld world;
  world.range_sigma = 0.01;
  world.walls = {{{2.0, -3.0}, {2.0, 3.0}}};
  world.command = always(1.0, 0.0);
  world.run(6.0);
  const double stood = world.pose.position_world.x();
  world.run(20.0);
  EXPECT_LT(world.pose.position_world.x() - stood, 0.02);
  EXPECT_EQ(world.guard.counts().stops, 1u);
  EXPECT_NEAR(world.guard.counts().held_time, 24.0, 2.0);
  world.walls.clear();
  world.run(2.0);
  EXPECT_GT(world.speed(), 0.95);
}

// ---- scans ------------------------------------------------------------------------------------------------

TEST(ScanGuard, CarriesAScanAlongAsTheWheelsMove) {
  GuardWorld world;
  RangeScan scan = world.sweep();
  for (std::size_t i = 350; i < 371; ++i) scan.ranges[i] = 2.0;
  const Eigen::Vector3d ahead{1.0, 0.0, 0.0};
  world.guard.moves(10.0, ahead);
  world.guard.moves(10.1, ahead);
  ASSERT_TRUE(world.guard.add_scan(10.05, scan, Pose2{}, 10.12));  // of 0.05 m ago
  EXPECT_NEAR(world.guard.judge(10.1, ahead).free_distance, 1.65, 1e-9);
  world.guard.moves(10.2, {1.0, 0.0, 5.0});
  world.guard.moves(10.3, {0.0, 0.0, 5.0});
  EXPECT_EQ(world.guard.judge(10.3, ahead).free_distance, kNothing);  // it has turned away
}

TEST(ScanGuard, TakesAScannerAnywhereOnTheRobot) {
  GuardWorld world;
  RangeScan scan = world.sweep();
  const Pose2 behind{{-0.2, 0.1}, kPi};
  for (std::size_t i = 0; i < 10; ++i) scan.ranges[i] = 2.0;  // to the sensor's rear: ahead of the robot
  for (std::size_t i = 710; i < 720; ++i) scan.ranges[i] = 2.0;
  ASSERT_TRUE(world.guard.add_scan(10.0, scan, behind, 10.0));
  EXPECT_NEAR(world.guard.judge(10.0, {1.0, 0.0, 0.0}).free_distance, 1.5, 0.01);
}

TEST(ScanGuard, TakesAScannerThatHangsUpsideDown) {
  for (const double side : {1.0, -1.0}) {
    GuardWorld world;
    DriverScan driver;
    driver.scan = world.sweep();
    for (std::size_t i = 175; i < 186; ++i) driver.scan.ranges[i] = 2.0;  // its right is the robot's left
    driver.mount =
        planar_mount({0.0, 0.0, 0.3}, Eigen::Quaterniond{Eigen::AngleAxisd{kPi, Eigen::Vector3d::UnitX()}})
            .value();
    make_plain(driver, NoReturn::infinite);
    ASSERT_TRUE(world.guard.add_scan(10.0, driver.scan, driver.mount.in_body, 10.0));
    const double distance = world.guard.judge(10.0, {0.0, side, 0.0}).free_distance;
    if (side > 0.0)
      EXPECT_NEAR(distance, 1.7, 0.01);
    else
      EXPECT_EQ(distance, kNothing);
  }
}

TEST(ScanGuard, RefusesScansThatSayNothingAboutNow) {
  GuardWorld world;
  const RangeScan scan = world.sweep();
  ScanGuard& guard = world.guard;
  EXPECT_TRUE(std::isinf(guard.scan_age(10.0)));
  EXPECT_FALSE(guard.add_scan(NAN, scan, Pose2{}, 10.0));
  EXPECT_FALSE(guard.add_scan(10.2, scan, Pose2{}, 10.0));
  EXPECT_FALSE(guard.add_scan(9.6, scan, Pose2{}, 10.0));
  EXPECT_FALSE(guard.add_scan(10.0, RangeScan{}, Pose2{}, 10.0));
  EXPECT_FALSE(guard.add_scan(10.0, scan, {{1e6, 0.0}, 0.0}, 10.0));
  EXPECT_TRUE(guard.add_scan(10.05, scan, Pose2{}, 10.0));
  EXPECT_FALSE(guard.add_scan(10.05, scan, Pose2{}, 10.1));
  EXPECT_EQ(guard.counts().scans_refused, 6u);
  EXPECT_TRUE(guard.sees(10.3));
  EXPECT_FALSE(guard.sees(10.4));
  guard.forget();
  EXPECT_FALSE(guard.sees(10.3));
  EXPECT_TRUE(guard.add_scan(3.0, scan, Pose2{}, 3.0));
}

TEST(ScanGuard, AllocatesNothingOnceItsMemoryHasGrown) {
  GuardWorld world;
  world.walls = {{{1.5, -3.0}, {1.5, 3.0}}, {{-1.0, -3.0}, {-1.0, 3.0}}};
  world.range_sigma = 0.05;
  const RangeScan scan = world.sweep();
  const auto use = [&](double from) {
    for (int i = 0; i < 20; ++i) {
      const double now = from + 0.1 * i;
      world.guard.add_scan(now, scan, Pose2{}, now);
      world.guard.moves(now, {0.0, 0.0, 0.0});
      world.guard.judge(now, {1.0, 0.2, 0.5});
    }
  };
  use(10.0);
  const AllocationGuard allocations;
  use(12.0);
  EXPECT_EQ(allocations.allocations(), 0);
}

}  // namespace
}  // namespace spf::host
