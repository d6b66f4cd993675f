// Scans of scanners that are mounted and that read as they do on real robots.
#include "host/driver_scan.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "host/perception_host.hpp"
#include "spf/math/angles.hpp"

namespace spf::host {
namespace {

constexpr double kNoWall = std::numeric_limits<double>::infinity();

/// A room of this body: what a beam from a position in a direction meets [m].
double range_in_room(const Eigen::Vector2d& from, double angle) {
  const Eigen::Vector2d direction{std::cos(angle), std::sin(angle)};
  double range = kNoWall;  // walls at x = 2, y = 3, x = -4, y = -5: no two alike
  if (direction.x() > 1e-9) range = std::min(range, (2.0 - from.x()) / direction.x());
  if (direction.y() > 1e-9) range = std::min(range, (3.0 - from.y()) / direction.y());
  if (direction.x() < -1e-9) range = std::min(range, (-4.0 - from.x()) / direction.x());
  if (direction.y() < -1e-9) range = std::min(range, (-5.0 - from.y()) / direction.y());
  return range;
}

double off_the_walls(const Eigen::Vector2d& point) {
  return std::min({std::abs(point.x() - 2.0), std::abs(point.y() - 3.0), std::abs(point.x() + 4.0),
                   std::abs(point.y() + 5.0)});
}

RangeScan full_turn(int beams) {
  RangeScan scan;
  scan.angle_min = -kPi;
  scan.angle_increment = 2.0 * kPi / beams;
  scan.max_range = 20.0;
  scan.ranges.assign(static_cast<std::size_t>(beams), kNoWall);
  return scan;
}

/// What a scanner at this position sees, whose axes are turned like this in the body.
DriverScan of_mounted(const Eigen::Vector3d& position, const Eigen::Quaterniond& turn) {
  DriverScan driver;
  driver.scan = full_turn(720);
  for (std::size_t i = 0; i < driver.scan.ranges.size(); ++i) {
    const double angle = driver.scan.angle_min + driver.scan.angle_increment * static_cast<double>(i);
    const Eigen::Vector3d direction = turn * Eigen::Vector3d{std::cos(angle), std::sin(angle), 0.0};
    driver.scan.ranges[i] = range_in_room(position.head<2>(), std::atan2(direction.y(), direction.x()));
  }
  driver.mount = planar_mount(position, turn).value();
  return driver;
}

RangeScan made_plain_and_seen(DriverScan driver, const BodyMotion& motion = {}) {
  make_plain(driver, NoReturn::infinite);
  return seen_from_centre(driver, motion);
}

/// Share of the beams that end on the room's walls, to within what half a beam makes of a range.
double share_on_walls(const RangeScan& seen) {
  int on = 0, readings = 0;
  for (std::size_t i = 0; i < seen.ranges.size(); ++i) {
    const double angle = seen.angle_min + seen.angle_increment * static_cast<double>(i);
    if (!std::isfinite(seen.ranges[i])) continue;
    ++readings;
    const Eigen::Vector2d end = seen.ranges[i] * Eigen::Vector2d{std::cos(angle), std::sin(angle)};
    on += off_the_walls(end) < seen.ranges[i] * std::abs(seen.angle_increment) ? 1 : 0;
  }
  return readings > 300 ? static_cast<double>(on) / readings : 0.0;
}

Eigen::Quaterniond turned(double roll, double pitch, double yaw) {
  return Eigen::AngleAxisd{yaw, Eigen::Vector3d::UnitZ()} *
         Eigen::AngleAxisd{pitch, Eigen::Vector3d::UnitY()} *
         Eigen::AngleAxisd{roll, Eigen::Vector3d::UnitX()};
}

TEST(DriverScan, IsSeenRightHoweverItsScannerIsMounted) {
  for (const Eigen::Vector3d& position :
       {Eigen::Vector3d{0.0, 0.0, 0.3}, Eigen::Vector3d{0.25, -0.1, 0.3}, Eigen::Vector3d{-0.4, 0.0, 0.1}})
    for (const double yaw : {0.0, 0.5 * kPi, kPi, -2.0})
      for (const double roll : {0.0, kPi, -kPi})
        for (const double pitch : {0.0, kPi}) {
          const RangeScan seen = made_plain_and_seen(of_mounted(position, turned(roll, pitch, yaw)));
          EXPECT_GT(share_on_walls(seen), 0.98)
              << position.transpose() << ", " << roll << ", " << pitch << ", " << yaw;
        }
}

TEST(DriverScan, KnowsAMirroredScanFromOneThatIsNot) {
  DriverScan driver = of_mounted({0.0, 0.0, 0.0}, turned(kPi, 0.0, 0.3));
  EXPECT_TRUE(driver.mount.upside_down);
  driver.mount.upside_down = false;
  EXPECT_LT(share_on_walls(made_plain_and_seen(driver)), 0.6);
}

TEST(DriverScan, RefusesATiltedScanner) {
  EXPECT_TRUE(planar_mount(Eigen::Vector3d::Zero(), turned(0.1, -0.1, 1.0)));
  EXPECT_FALSE(planar_mount(Eigen::Vector3d::Zero(), turned(0.3, 0.0, 0.0)));
  EXPECT_FALSE(planar_mount(Eigen::Vector3d::Zero(), turned(0.5 * kPi, 0.0, 0.0)));
  EXPECT_FALSE(planar_mount(Eigen::Vector3d::Zero(), turned(kPi - 0.4, 0.0, 0.0)));
  EXPECT_FALSE(planar_mount(Eigen::Vector3d::Zero(), Eigen::Quaterniond{0.0, 0.0, 0.0, 0.0}));
  EXPECT_FALSE(planar_mount({NAN, 0.0, 0.0}, Eigen::Quaterniond::Identity()));
}

TEST(DriverScan, IsSeenAsOfItsFirstBeamWhileTheRobotMoves) {
  const BodyMotion motion{{1.0, 0.3}, 1.2};
  for (const double offset : {0.0, 0.3}) {
    DriverScan driver;
    driver.scan = full_turn(720);
    driver.duration = 0.1;
    driver.mount.in_body.position_world.x() = offset;
    for (std::size_t i = 0; i < driver.scan.ranges.size(); ++i) {
      // The truth in small steps, from the body as it was at the first beam.
      const double time = driver.duration * static_cast<double>(i) / 720.0;
      Pose2 body;
      for (int k = 0; k < 100; ++k) {
        const double dt = time / 100.0;
        body.position_world +=
            dt * (Eigen::Rotation2Dd{body.heading + 0.5 * dt * motion.yaw_rate} * motion.velocity);
        body.heading += dt * motion.yaw_rate;
      }
      const Eigen::Vector2d from =
          body.position_world + Eigen::Rotation2Dd{body.heading} * driver.mount.in_body.position_world;
      const double angle =
          body.heading + driver.scan.angle_min + driver.scan.angle_increment * static_cast<double>(i);
      driver.scan.ranges[i] = range_in_room(from, angle);
    }
    EXPECT_GT(share_on_walls(made_plain_and_seen(driver, motion)), 0.98) << offset;
    EXPECT_LT(share_on_walls(made_plain_and_seen(driver)), 0.8) << offset;
  }
}

TEST(DriverScan, ReadsWhatItsDriverMeansByNothingThere) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto read = [&](double reading, NoReturn no_return) {
    DriverScan driver;
    driver.scan.ranges = {reading};
    driver.min_range = 0.1;
    make_plain(driver, no_return);
    return driver.scan.ranges[0];
  };
  for (const NoReturn any : {NoReturn::infinite, NoReturn::zero, NoReturn::nan, NoReturn::any}) {
    EXPECT_EQ(read(3.0, any), 3.0);
    EXPECT_EQ(read(kNoWall, any), kNoWall);
    EXPECT_EQ(read(65.533, any), kNoWall);
    EXPECT_EQ(read(8.0, any), kNoWall);  // cut off
    EXPECT_TRUE(std::isnan(read(0.05, any)));
    EXPECT_TRUE(std::isnan(read(-1.0, any)));
    EXPECT_TRUE(std::isnan(read(-kNoWall, any)));
    EXPECT_EQ(std::isnan(read(0.0, any)), any != NoReturn::zero && any != NoReturn::any);
    EXPECT_EQ(std::isnan(read(nan, any)), any != NoReturn::nan && any != NoReturn::any);
  }
}

TEST(PerceptionHost, TakesZeroForNothingThereWhereItIsTold) {
  for (const NoReturn no_return : {NoReturn::infinite, NoReturn::zero}) {
    HostParameters parameters;
    parameters.no_return = no_return;
    PerceptionHost host{AgentParameters{}, parameters};
    DriverScan driver;
    driver.scan = full_turn(360);
    for (std::size_t i = 0; i < 300; ++i) driver.scan.ranges[i] = 0.0;
    const std::optional<SensedWorld> sensed = host.add_scan(10.0, driver, 10.0);
    ASSERT_EQ(sensed.has_value(), no_return == NoReturn::zero);
    if (sensed) {
      EXPECT_EQ(sensed->observation.scan->ranges[7], kNoWall);
      continue;
    }
    EXPECT_EQ(host.last_verdict(), ObservationVerdict::blind);
    EXPECT_NE(host.last_refusal().find("half blind: 83 %"), std::string::npos) << host.last_refusal();
    EXPECT_NE(host.last_refusal().find("host.no_return"), std::string::npos);
  }
}

TEST(PerceptionHost, StraightensScansByWhatTheWheelsAreTold) {
  AgentParameters agent;
  PerceptionHost host{agent, HostParameters{}};
  DriverScan driver;
  driver.scan = full_turn(720);
  for (std::size_t i = 0; i < driver.scan.ranges.size(); ++i)
    driver.scan.ranges[i] =
        range_in_room(Eigen::Vector2d::Zero(),
                      driver.scan.angle_min + driver.scan.angle_increment * static_cast<double>(i));
  driver.duration = 0.1;
  host.applied(9.95, Drive{agent.robot}.input_from_world({1.0, 0.0, 0.0}, 0.0));
  const RangeScan moved = *host.add_scan(10.0, driver, 10.0)->observation.scan;
  EXPECT_NEAR(moved.ranges[360], 2.05, 0.01);                                    // ahead, half a scan later
  const RangeScan stood = *host.add_scan(11.0, driver, 11.0)->observation.scan;  // told nothing since
  EXPECT_NEAR(stood.ranges[360], 2.0, 0.01);
}

TEST(PerceptionHost, IsWellWhileAllIsFreshThatItReliesOn) {
  HostParameters parameters;
  PerceptionHost host{AgentParameters{}, parameters};
  EXPECT_EQ(host.health(10.0).level, Level::error);
  EXPECT_EQ(host.health(10.0).text, "no scan; no report of obstacles");
  DriverScan driver;
  driver.scan = full_turn(360);
  ASSERT_TRUE(host.add_scan(10.0, driver, 10.0));
  EXPECT_EQ(host.health(10.0).text, "no report of obstacles");
  ASSERT_TRUE(host.add_detections(10.0, {}, 10.0));
  EXPECT_EQ(host.health(10.0).level, Level::ok);
  EXPECT_EQ(host.health(10.4).text, "no scan; no report of obstacles");
}

// At 5 Hz and 0.12 s late a robot would brake now and then, and nobody would know why.
TEST(PerceptionHost, NamesScansThatComeTooSeldom) {
  for (const double period : {0.1, 0.2}) {
    HostParameters parameters;
    parameters.relies_on_obstacles = false;
    PerceptionHost host{AgentParameters{}, parameters};
    DriverScan driver;
    driver.scan = full_turn(360);
    double now = 10.0;
    for (; now < 20.0; now += period) ASSERT_TRUE(host.add_scan(now - 0.12, driver, now));
    const Health health = host.health(now - period);
    EXPECT_EQ(health.level, period > 0.15 ? Level::warn : Level::ok) << health.text;
    EXPECT_EQ(health.text.find("scans grow 0.32 s old") != std::string::npos, period > 0.15) << health.text;
  }
}

}  // namespace
}  // namespace spf::host
