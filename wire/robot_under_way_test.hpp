// A robot of processes of their own, under way on a straight stretch, and what is said about it: for tests
// that run on ROS 1 and on ROS 2 alike.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "wire/robot_world_test.hpp"

namespace spf::wire {

inline constexpr double kMaxSpeed = 1.0;         // [m/s] of a robot without a file of its own
inline constexpr double kMaxAcceleration = 1.0;  // [m/s^2]
// Tenths of a second until it stands: 1 m/s at 1 m/s^2, and back to where its plan ends, which the clock lets
// come some 0.2 s late.
inline constexpr int kStanding = 40;

/// A robot under way, and what is said about it.
template <class Ros>
class RobotUnderWay : public testing::Test {
 protected:
  using Base = RobotBase<Ros>;
  using World = RobotWorld<Ros>;

  RobotUnderWay() = default;
  /// With a file of its own, on a stretch from -half_length to half_length [m].
  RobotUnderWay(PartOptions options, double half_length)
      : options_{std::move(options)}, half_length_{half_length} {}

  void start(const std::vector<std::string>& roles = {"robot"}) {
    for (const std::string& role : roles) start_part(role);
    world_.emplace();
    diagnostics_ = world_->ros().template subscribe<typename Ros::Diagnostics>(
        "/diagnostics", 50, [this](const typename Ros::Diagnostics& array) {
          for (const auto& status : array.status) said_[status.name] = status.message;
        });
    ASSERT_TRUE(world_->wait_for_robots(static_cast<int>(roles.size())));
    for (int i = 0; i < 20; ++i) ASSERT_TRUE(world_->go_on()) << i;
    drive();
  }
  void start_part(const std::string& role) {
    parts_[role] = std::make_unique<typename Ros::Part>(3, role, options_);
  }
  /// From now on the clock does not wait for the robot.
  void kill_part(const std::string& role) {
    base().set_awaited(false);
    parts_.at(role)->kill();
  }
  /// And waits until it says how it is: how long that takes is the machine's affair.
  void restart_part(const std::string& role) {
    said_.clear();
    start_part(role);
    const std::string name = "robot3: " + (role == "robot" ? "planner" : role);
    const Nanoseconds since = world().time();
    const auto is_back = [&] { return said_.count(name) > 0 && base().heard_since(since); };
    EXPECT_LT(world_->tenths_until(1000, is_back), 1000) << name;
    base().set_awaited(true);
  }
  /// Whatever the test was about, commands have kept the limits.
  void TearDown() override {
    if (!world_) return;
    EXPECT_GT(base().commands(), 20U);
    base().check_limits(kMaxSpeed, kMaxAcceleration);
  }

  /// To the other end of the stretch, until it goes there fast. Told again, since who has just been
  /// started may not listen yet.
  void drive() {
    const double end = base().pose().position_world.x() > 0.0 ? -half_length_ : half_length_;
    for (int i = 0; i < 10; ++i) {
      base().send_goal(end, 0.0, 0.0);
      const auto fast = [&] { return base().velocity_world().x() * end > 0.8 * std::abs(end); };
      if (world_->tenths_until(30, fast) < 30) return;
    }
    ADD_FAILURE() << "it does not set out: " << base().status().reason;
  }
  /// And until it has been as fast for a while.
  void drive_steadily() {
    drive();
    for (int i = 0; i < 10; ++i) EXPECT_TRUE(world_->go_on()) << i;
  }
  void goes_on() {
    EXPECT_LT(world_->tenths_until(150, [&] { return base().speed() > 0.8; }), 150) << base().status().reason;
  }
  void stands(int tenths = kStanding) {
    EXPECT_LT(world_->tenths_until(tenths, [&] { return base().speed() < 0.01; }), tenths)
        << base().status().reason;
  }
  /// Begins within so many seconds from now, and does not end before it stands.
  void brakes_and_stands(double soonest, double latest) {
    const Nanoseconds since = world().time();
    stands(static_cast<int>(std::ceil(10.0 * latest)) + kStanding);
    const double after = 1e-9 * static_cast<double>(base().last_fast(since) - since);
    EXPECT_GT(after, soonest) << base().status().reason;
    EXPECT_LT(after, latest) << base().status().reason;
  }
  /// Within 2 s.
  void is_said(const std::string& part, const std::string& words) {
    const auto said = [&] { return said_[part].find(words) != std::string::npos; };
    EXPECT_LT(world_->tenths_until(20, said), 20) << part << ": " << said_[part];
  }

  Base& base() { return world_->base(); }
  World& world() { return *world_; }

 private:
  PartOptions options_;
  double half_length_ = 10.0;                // [m]
  std::map<std::string, std::string> said_;  // last message of each part
  std::optional<World> world_;
  typename Ros::Heard diagnostics_;  // of world_'s node
  std::map<std::string, std::unique_ptr<typename Ros::Part>> parts_;
};

}  // namespace spf::wire
