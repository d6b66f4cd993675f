// A robot whose scanner is all it has: nobody reports obstacles to it. For its nodes on ROS 1 and on ROS 2
// alike, as in robot_faults_test.hpp.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <vector>

#include "wire/robot_under_way_test.hpp"

namespace spf::wire {

/// A file with a text, as long as this lives.
class WrittenFile {
 public:
  explicit WrittenFile(const std::string& text)
      : path_{std::filesystem::temp_directory_path() / ("spf_robot_" + std::to_string(getpid()) + ".yaml")} {
    std::ofstream{path_} << text;
  }
  ~WrittenFile() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  WrittenFile(const WrittenFile&) = delete;
  WrittenFile& operator=(const WrittenFile&) = delete;
  [[nodiscard]] std::string path() const { return path_.string(); }

 private:
  std::filesystem::path path_;
};

template <class Ros>
class RobotScanner : private WrittenFile, public RobotUnderWay<Ros> {
 protected:
  explicit RobotScanner(const std::string& text = "host: {relies_on_obstacles: false}\n")
      : WrittenFile{text}, RobotUnderWay<Ros>{{{}, path()}, 20.0} {}

  void set_out() {
    ASSERT_NO_FATAL_FAILURE(this->start());
    this->base().set_obstacles(false);
  }
  /// +1 or -1: where it goes, at full speed, with nobody in sight.
  double under_way() {
    this->base().set_walkers({});
    this->drive_steadily();
    return std::copysign(1.0, this->base().velocity_world().x());
  }
  void go_on(double seconds) {
    for (int i = 0; i < static_cast<int>(10.0 * seconds); ++i)
      if (!this->world().go_on()) FAIL() << "it has not kept up: " << this->base().status().reason;
  }
};

TYPED_TEST_SUITE_P(RobotScanner);

/// How often each scene is tried; SPF_CROSSINGS=3 makes 24 crossings and 12 stops.
inline int scanner_repeats() {
  const char* repeats = std::getenv("SPF_CROSSINGS");
  return repeats != nullptr ? std::max(1, std::atoi(repeats)) : 1;
}

TYPED_TEST_P(RobotScanner, TouchesNobodyWhoCrossesItsWayAndNeverYields) {
  constexpr double kUntil = 4.0;  // [s] before they would meet
  ASSERT_NO_FATAL_FAILURE(this->set_out());
  std::mt19937 random{7};
  std::uniform_real_distribution<double> along{-0.3, 0.3}, across{-0.1, 0.1};
  for (int repeat = 0; repeat < scanner_repeats(); ++repeat)
    for (const double speed : {0.5, 1.0})
      for (const double direction : {-90.0, 90.0, 180.0, 45.0}) {  // [deg] to the robot's
        SCOPED_TRACE(testing::Message() << direction << " deg at " << speed << " m/s");
        const double ahead = this->under_way();
        const double turn = direction * M_PI / 180.0 + (ahead > 0.0 ? 0.0 : M_PI);
        const Eigen::Vector2d meeting = this->base().pose().position_world +
                                        Eigen::Vector2d{ahead * (kUntil + along(random)), across(random)};
        const double meets = this->world().seconds() + kUntil;
        const Eigen::Vector2d velocity = speed * Eigen::Vector2d{std::cos(turn), std::sin(turn)};
        this->base().set_walkers(
            {{0.3, [=](double time) -> Eigen::Vector2d { return meeting + (time - meets) * velocity; }}});
        ASSERT_NO_FATAL_FAILURE(this->go_on(kUntil + 4.0));
        EXPECT_GT(this->base().least_gap(), 0.0);
      }
}

TYPED_TEST_P(RobotScanner, TouchesNobodyWhoStopsBeforeItAndPasses) {
  constexpr double kComes = 2.5;  // [s]
  ASSERT_NO_FATAL_FAILURE(this->set_out());
  std::mt19937 random{9};
  std::uniform_real_distribution<double> speeds{0.8, 1.4}, across{-0.2, 0.2};
  for (int number = 0; number < 2 + 4 * (scanner_repeats() - 1); ++number) {
    SCOPED_TRACE(number);
    const double ahead = this->under_way();
    const double side = number % 2 == 0 ? 1.0 : -1.0, speed = speeds(random);
    const Eigen::Vector2d stop =
        this->base().pose().position_world + Eigen::Vector2d{ahead * (kComes + 0.3 + 1.0), across(random)};
    const double stops = this->world().seconds() + kComes;
    this->base().set_walkers({{0.25, [=](double time) -> Eigen::Vector2d {
                                 return {stop.x(), stop.y() + side * speed * std::max(0.0, stops - time)};
                               }}});
    const auto passed = [&] { return (this->base().pose().position_world.x() - stop.x()) * ahead > 0.5; };
    EXPECT_LT(this->world().tenths_until(250, passed), 250) << this->base().status().reason;
    EXPECT_GT(this->base().least_gap(), 0.0);
  }
}

TYPED_TEST_P(RobotScanner, FindsAndEvadesSomebodyWhoComesTowardsIt) {
  using Tracks = typename TypeParam::ObstacleTracks;
  constexpr double kSpeed = 0.6;  // [m/s]
  ASSERT_NO_FATAL_FAILURE(this->set_out());
  const double ahead = this->under_way();
  const Eigen::Vector2d from = this->base().pose().position_world + Eigen::Vector2d{7.0 * ahead, 0.1};
  const double begun = this->world().seconds();
  const auto path = [=](double time) -> Eigen::Vector2d {
    return {from.x() - ahead * kSpeed * (time - begun), from.y()};
  };
  std::vector<double> off, slip;  // errors of the position [m] and the velocity [m/s]
  const auto heard =
      this->world().ros().template subscribe<Tracks>("/robot3/tracks", 50, [&](const Tracks& message) {
        const Eigen::Vector2d is =
            path(1e-9 * static_cast<double>(TypeParam::nanoseconds_of(message.header.stamp)));
        for (const auto& track : message.tracks) {
          const double error = std::hypot(track.position.x - is.x(), track.position.y - is.y());
          if (error > 0.5 || (is - this->base().pose().position_world).norm() > 4.0) continue;
          off.push_back(error);
          slip.push_back(std::hypot(track.velocity.x + ahead * kSpeed, track.velocity.y));
        }
      });
  this->base().set_walkers({{0.25, path}});
  const auto behind = [&] {
    return (path(this->world().seconds()).x() - this->base().pose().position_world.x()) * ahead < -1.0;
  };
  EXPECT_LT(this->world().tenths_until(200, behind), 200) << this->base().status().reason;
  EXPECT_GT(this->base().least_gap(), 0.02);
  ASSERT_GT(off.size(), 10U);
  const auto median = [](std::vector<double>& values) {
    std::nth_element(values.begin(), values.begin() + static_cast<long>(values.size() / 2), values.end());
    return values[values.size() / 2];
  };
  EXPECT_LT(median(off), 0.15);
  EXPECT_LT(median(slip), 0.3);
  EXPECT_GE(heard.matched(), 1);
  this->base().set_walkers({});
  this->goes_on();
}

/// One whose own period is long.
template <class Ros>
class RobotArrivals : public RobotScanner<Ros> {
 protected:
  RobotArrivals()
      : RobotScanner<Ros>{
            "agent: {team: {plan_period: 0.5}}\n"
            "host: {plan_silence: 1.5, relies_on_obstacles: false}\n"} {}

  static constexpr std::size_t kScans = 50;

  /// How many of so many scans an event is of.
  std::size_t known(const std::vector<Nanoseconds>& events) const {
    const std::vector<Nanoseconds>& scans = scans_;
    return static_cast<std::size_t>(std::count_if(scans.begin(), scans.end(), [&](Nanoseconds stamp) {
      return std::any_of(events.begin(), events.end(),
                         [&](Nanoseconds event) { return std::abs(event - stamp) < 100'000; });
    }));
  }
  /// How many plans were made meanwhile.
  std::size_t scan() {
    const std::size_t scans = this->base().scans().size(), plans = this->base().planned_with().size();
    this->go_on(0.1 * static_cast<double>(kScans));
    scans_.assign(this->base().scans().begin() + static_cast<long>(scans), this->base().scans().end());
    const std::size_t made = this->base().planned_with().size() - plans;
    this->go_on(0.3);
    return made;
  }

 private:
  std::vector<Nanoseconds> scans_;
};

TYPED_TEST_SUITE_P(RobotArrivals);

TYPED_TEST_P(RobotArrivals, EveryScanIsPlannedWithAndFollowed) {
  ASSERT_NO_FATAL_FAILURE(this->set_out());
  this->drive_steadily();
  const std::size_t plans = this->scan();
  // A machine that is busy elsewhere may let two scans come before a plan.
  EXPECT_GT(this->known(this->base().planned_with()), 7 * this->kScans / 10);
  EXPECT_GT(this->known(this->base().commanded_with()), 7 * this->kScans / 10);
  EXPECT_LT(plans, 12 * this->kScans / 10);
}

TYPED_TEST_P(RobotArrivals, WhatPeersTellBringsNoPlanForward) {
  using Trajectory = typename TypeParam::Trajectory;
  ASSERT_NO_FATAL_FAILURE(this->set_out());
  this->drive_steadily();
  const auto air = this->world().ros().template advertise<Trajectory>("/swarm/trajectories", 100);
  const std::uint32_t heard = this->base().status().messages_accepted;
  std::uint32_t sequence = 0;
  const auto tell = [&] {  // 100 messages a second
    ++sequence;
    Trajectory message;
    message.header.stamp = TypeParam::time_of(this->world().time());
    message.header.frame_id = "map";
    message.sequence = sequence;
    message.expiry = TypeParam::time_of(this->world().time() + 1'500'000'000);
    message.start = message.heading_start = message.header.stamp;
    message.radius = 0.3;
    message.state = Trajectory::STOPPED;
    message.durations = {1.0};
    for (std::uint32_t number = 0; number < 10; ++number) {
      message.robot_id = number == 3 ? 10 : number;
      message.coefficients = {40.0, 0, 0, 0, 0, 0, 6.0 + 0.7 * number, 0, 0, 0, 0, 0};
      air.publish(message);
    }
    return false;
  };
  (void)this->world().tenths_until(20, tell);
  const std::size_t before = this->base().planned_with().size();
  (void)this->world().tenths_until(static_cast<int>(this->kScans), tell);
  EXPECT_GT(this->base().status().messages_accepted, heard + 100);
  EXPECT_LT(this->base().planned_with().size() - before, 12 * this->kScans / 10);
}

REGISTER_TYPED_TEST_SUITE_P(RobotScanner, TouchesNobodyWhoCrossesItsWayAndNeverYields,
                            TouchesNobodyWhoStopsBeforeItAndPasses, FindsAndEvadesSomebodyWhoComesTowardsIt);
REGISTER_TYPED_TEST_SUITE_P(RobotArrivals, EveryScanIsPlannedWithAndFollowed,
                            WhatPeersTellBringsNoPlanForward);

}  // namespace spf::wire
