// What a robot on ROS 2 does when its sensors, its processes, its peers or the network fail: the rows of
// docs/faults.md that the nodes on ROS 1 are tested for (ros/spf_empc_ros/test).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <deque>
#include <limits>
#include <map>
#include <optional>
#include <random>
#include <ros2_messages/diagnostic_msgs/DiagnosticArray.hpp>

#include "ros2/robot/robot_world_test.hpp"

namespace spf_ros2 {
namespace {

using ros2::Qos;
using ros2::spf_empc_msgs::Trajectory;
using testing::HasSubstr;

constexpr int kStale =
    6;  // tenths of a second until braking begins: at most 0.5 s of silence, and a scan's tick
// And until it stands: 1 m/s at 1 m/s^2, and back to where its plan ends, which the clock lets come some 0.2
// s late.
constexpr int kStanding = 40;

/// A robot under way, and what is said about it.
class RobotFaults : public testing::Test {
 protected:
  void start(const std::vector<std::string>& roles = {"robot"}) {
    for (const std::string& role : roles) start_part(role);
    world_.emplace();
    world_->node().subscribe<ros2::diagnostic_msgs::DiagnosticArray>("/diagnostics", {},
                                                                     [this](const auto& array) {
                                                                       for (const auto& status : array.status)
                                                                         said_[status.name] = status.message;
                                                                     });
    ASSERT_TRUE(world_->wait_for_robots());
    for (int i = 0; i < 20; ++i) ASSERT_TRUE(world_->go_on()) << i;
    drive();
  }
  void start_part(const std::string& role) {
    parts_[role] = std::make_unique<Program>(robot_arguments(3, role));
  }
  void kill_part(const std::string& role) { EXPECT_EQ(parts_.at(role)->end(SIGKILL), -1); }

  /// To the other end of a stretch of 20 m, until it is fast. Told again, since who has just been started may
  /// not listen yet.
  void drive() {
    const double end = base().pose().position_world.x() > 0.0 ? -10.0 : 10.0;
    for (int i = 0; i < 10; ++i) {
      base().send_goal(end, 0.0, 0.0);
      if (world_->tenths_until(15, [&] { return base().speed() > 0.8; }) < 15) return;
    }
    ADD_FAILURE() << "it does not set out: " << base().status().reason;
  }
  void goes_on() {
    EXPECT_LT(world_->tenths_until(150, [&] { return base().speed() > 0.8; }), 150) << base().status().reason;
  }
  void brakes_and_stands() {
    double fastest = 0.0;
    const auto brakes = [&] {
      fastest = std::max(fastest, base().speed());
      return base().speed() < fastest - 0.05;
    };
    EXPECT_LT(world_->tenths_until(kStale, brakes), kStale)
        << "it goes on at " << base().speed() << " m/s: " << base().status().reason;
    EXPECT_LT(world_->tenths_until(kStanding, [&] { return base().speed() < 0.01; }), kStanding)
        << base().status().reason;
  }
  /// Within 2 s.
  void is_said(const std::string& part, const std::string& words) {
    const auto said = [&] { return said_[part].find(words) != std::string::npos; };
    EXPECT_LT(world_->tenths_until(20, said), 20) << part << ": " << said_[part];
  }

  Base& base() { return world_->base(); }
  World& world() { return *world_; }

 private:
  std::map<std::string, std::unique_ptr<Program>> parts_;
  std::optional<World> world_;
  std::map<std::string, std::string> said_;  // last message of each part
};

TEST_F(RobotFaults, WithoutOneOfItsSensorsItBrakesSaysSoAndGoesOnWithIt) {
  start();
  struct Sensor {
    void (Base::*set)(bool told);
    const char* reason;
  };
  for (const Sensor& sensor : {Sensor{&Base::set_odometry, "stale pose"}, Sensor{&Base::set_scans, "no scan"},
                               Sensor{&Base::set_obstacles, "no report of obstacles"}}) {
    SCOPED_TRACE(sensor.reason);
    drive();
    (base().*sensor.set)(false);
    brakes_and_stands();
    EXPECT_EQ(base().status().reason, sensor.reason);
    is_said("robot3: planner", sensor.reason);
    (base().*sensor.set)(true);
    goes_on();
  }
}

TEST_F(RobotFaults, PosesThatAreNotNumbersAreNone) {
  start();
  base().set_error({std::numeric_limits<double>::quiet_NaN(), 0.0});
  brakes_and_stands();
  base().set_error({0.0, 0.0});
  goes_on();
}

TEST_F(RobotFaults, AJumpOfThePoseIsAFaultUntilItPersists) {
  start();
  base().set_error({0.0, 2.0});
  brakes_and_stands();
  drive();  // it is believed now
  base().set_error({0.0, 0.0});
  EXPECT_LT(world().tenths_until(30, [&] { return base().speed() < 0.05; }), 30) << base().status().reason;
  drive();
}

TEST_F(RobotFaults, HeldItStopsPushingAndTriesAgain) {
  start();
  base().set_held(true);
  EXPECT_LT(world().tenths_until(30, [&] { return base().status().reason == "stuck"; }), 30)
      << base().status().reason;
  is_said("robot3: tracker", "stuck");
  EXPECT_LT(world().tenths_until(20, [&] { return base().speed() == 0.0; }), 20) << base().speed();
  base().set_held(false);
  goes_on();
}

TEST_F(RobotFaults, AProcessThatIsKilledIsNamedAndTheRobotGoesOnWithTheNext) {
  start({"planner", "tracker", "perception"});
  for (const std::string role : {"tracker", "perception", "planner"}) {
    SCOPED_TRACE(role);
    drive();
    kill_part(role);
    base().set_awaited(false);
    EXPECT_LT(world().tenths_until(kStale + kStanding, [&] { return base().speed() < 0.01; }),
              kStale + kStanding)
        << base().status().reason;
    is_said("robot3", role + ": silent");
    start_part(role);
    base().set_awaited(true);
    drive();  // nothing keeps a goal for a planner that begins anew
  }
}

TEST_F(RobotFaults, ARobotThatIsKilledStandsAndGoesOn) {
  start();
  kill_part("robot");
  base().set_awaited(false);
  EXPECT_LT(world().tenths_until(kStanding, [&] { return base().speed() == 0.0; }), kStanding);
  start_part("robot");
  base().set_awaited(true);
  drive();
}

TEST_F(RobotFaults, AnotherRobotOfItsNumberIsNamedAndPeersOfOtherClocksAndFramesToo) {
  start();
  std::optional<Trajectory> told;
  world().node().subscribe<Trajectory>("/swarm/trajectories", Qos::keep_last(50),
                                       [&](const Trajectory& plan) {
                                         if (plan.robot_id == 3 && !told) told = plan;
                                       });
  const auto swarm = world().node().advertise<Trajectory>("/swarm/trajectories", Qos::keep_last(50));
  ASSERT_LT(world().tenths_until(50, [&] { return told.has_value(); }), 50) << "nothing was told";
  for (std::uint32_t number = 1; number < 20; ++number) {
    Trajectory peer = *told;
    const auto publish = [&](std::uint32_t robot_id, ros2::Nanoseconds ahead, const char* frame) {
      peer.robot_id = robot_id;
      peer.sequence = number;
      peer.header.stamp = ros2::time_of(world().time() + ahead);
      peer.header.frame_id = frame;
      swarm.publish(peer);
    };
    for (std::size_t i = 0; i < peer.coefficients.size(); i += 12) peer.coefficients[i + 6] += 30.0;
    publish(3, 0, "map");
    publish(5, 400'000'000, "map");
    publish(6, 0, "another_map");
    ASSERT_TRUE(world().go_on()) << number;
  }
  is_said("robot3", "robot 3: another robot has this number");
  is_said("robot3", "robot 5: its clock is 0.4 s ahead");
  is_said("robot3", "robot 6: its frame is 'another_map'");
}

TEST(LossyNetworkSlow, WithThreeOfTenPacketsLostARobotArrives) {
  const ros2::MoreSettings lossy{
      "<CycloneDDS><Domain><Internal><Test><XmitLossiness>300</XmitLossiness></Test></Internal></Domain></"
      "CycloneDDS>"};
  Program robot{robot_arguments(3)};
  World world;
  ASSERT_TRUE(world.wait_for_robots());
  for (int i = 0; i < 20; ++i) ASSERT_TRUE(world.go_on()) << i;
  for (int i = 0; i < 10 && world.base().status().goal_outcome != "reached"; ++i) {
    if (i == 0) world.base().send_goal(1.5, 0.0, 0.0);
    (void)world.tenths_until(30, [&] { return world.base().status().goal_outcome == "reached"; });
  }
  EXPECT_EQ(world.base().status().goal_outcome, "reached") << world.base().status().reason;
  EXPECT_LT((world.base().pose().position_world - Eigen::Vector2d{1.5, 0.0}).norm(), 0.15);
}

/// Carries what each robot tells its peers to the other's topic, with loss and delay.
class Air {
 public:
  Air(World& world, std::vector<std::string> topics, double loss, double longest_delay)
      : world_{world}, loss_{loss}, delay_{0.0, longest_delay} {
    for (const std::string& topic : topics)
      publishers_.push_back(world.node().advertise<Trajectory>(topic, Qos::keep_last(200)));
    for (std::size_t i = 0; i < topics.size(); ++i)
      world.node().subscribe<Trajectory>(topics[i], Qos::keep_last(200), [this, i](const Trajectory& plan) {
        if (plan.robot_id == i) take(plan);  // else it was carried here
      });
  }

  /// What has arrived by now.
  void carry() {
    for (auto message = under_way_.begin(); message != under_way_.end();) {
      if (message->arrival > world_.time()) {
        ++message;
        continue;
      }
      publishers_[1 - message->plan.robot_id].publish(message->plan);
      message = under_way_.erase(message);
    }
  }
  [[nodiscard]] int sent() const { return sent_; }
  [[nodiscard]] int lost() const { return lost_; }

 private:
  struct Message {
    ros2::Nanoseconds arrival;
    Trajectory plan;
  };
  void take(const Trajectory& plan) {
    ++sent_;
    if (std::uniform_real_distribution<double>{}(random_) < loss_)
      ++lost_;
    else
      under_way_.push_back({world_.time() + static_cast<ros2::Nanoseconds>(1e9 * delay_(random_)), plan});
  }

  World& world_;
  double loss_;
  std::uniform_real_distribution<double> delay_;
  std::mt19937 random_{1};
  std::vector<ros2::Publisher<Trajectory>> publishers_;
  std::deque<Message> under_way_;
  int sent_ = 0, lost_ = 0;
};

/// Two robots face to face, each on a topic of its own for what it tells its peers; their least distance [m].
double pass(double loss, double longest_delay) {
  const auto arguments = [](int robot_id) {
    std::vector<std::string> words = robot_arguments(robot_id);
    words.insert(words.end(), {"-r", "/swarm/trajectories:=/air" + std::to_string(robot_id)});
    return words;
  };
  Program first{arguments(0)}, second{arguments(1)};
  World world{{{0, {{-5.0, 0.0}, 0.0}}, {1, {{5.0, 0.1}, 0.0}}}};
  Air air{world, {"/air0", "/air1"}, loss, longest_delay};
  if (!world.wait_for_robots()) return -1.0;
  for (int i = 0; i < 20; ++i) EXPECT_TRUE(world.go_on()) << i;
  world.base(0).send_goal(5.0, 0.0, 0.0);
  world.base(1).send_goal(-5.0, 0.0, 0.0);
  double least = 10.0;
  const int tenths = world.tenths_until(450, [&] {
    air.carry();
    least =
        std::min(least, (world.base(0).pose().position_world - world.base(1).pose().position_world).norm());
    return world.base(0).status().goal_outcome == "reached" &&
           world.base(1).status().goal_outcome == "reached";
  });
  EXPECT_LT(tenths, 450) << world.base(0).status().reason << ", " << world.base(1).status().reason;
  EXPECT_GT(air.sent(), 50);
  EXPECT_NEAR(air.lost(), loss * air.sent(), 0.2 * air.sent());
  for (std::size_t robot = 0; robot < 2; ++robot) EXPECT_GT(world.base(robot).status().messages_accepted, 5U);
  return least;
}

TEST(LossyAir, PeersPassWithThreeOfTenMessagesLostAndTheRestUpTo200MillisecondsLate) {
  EXPECT_GT(pass(0.3, 0.2), 0.6);
}

TEST(LossyAir, PeersPassWithHalfOfTheirMessagesLostAndTheRestUpTo300MillisecondsLate) {
  EXPECT_GT(pass(0.5, 0.3), 0.6);
}

}  // namespace
}  // namespace spf_ros2
