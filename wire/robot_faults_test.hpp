// What a robot does when its sensors, its processes, its peers or what carries their messages fail: rows of
// docs/faults.md, for its nodes on ROS 1 and on ROS 2 alike. A test program that includes this says what they
// run on by INSTANTIATE_TYPED_TEST_SUITE_P.
#pragma once

#include <gtest/gtest.h>

#include <deque>
#include <limits>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "wire/robot_under_way_test.hpp"

namespace spf::wire {

template <class Ros>
class RobotFaults : public RobotUnderWay<Ros> {};

TYPED_TEST_SUITE_P(RobotFaults);

// Silence counts from 0.3 s on (team.stale_time), by a sensor's last stamp. That it brakes is seen after a
// report's period, a plan's and two commands, and messages take some of the time of a clock that is fast.
inline constexpr double kStale = 0.25, kStaleAndSeen = 0.75;  // [s]

TYPED_TEST_P(RobotFaults, WithoutOneOfItsSensorsItBrakesSaysSoAndGoesOnWithIt) {
  using Robot = RobotBase<TypeParam>;
  ASSERT_NO_FATAL_FAILURE(this->start());
  struct Sensor {
    void (Robot::*set)(bool told);
    const char* reason;
  };
  for (const Sensor& sensor :
       {Sensor{&Robot::set_odometry, "stale pose"}, Sensor{&Robot::set_scans, "no scan"},
        Sensor{&Robot::set_obstacles, "no report of obstacles"}}) {
    SCOPED_TRACE(sensor.reason);
    this->drive_steadily();
    (this->base().*sensor.set)(false);
    this->brakes_and_stands(kStale - 0.1, kStaleAndSeen);  // scans come every 0.1 s
    EXPECT_EQ(this->base().status().reason, sensor.reason);
    this->is_said("robot3: planner", sensor.reason);
    if (sensor.set == &Robot::set_odometry) this->is_said("robot3: tracker", sensor.reason);
    (this->base().*sensor.set)(true);
    this->goes_on();
  }
}

TYPED_TEST_P(RobotFaults, PosesThatAreNotNumbersAreNone) {
  ASSERT_NO_FATAL_FAILURE(this->start());
  this->drive_steadily();
  this->base().set_error({std::numeric_limits<double>::quiet_NaN(), 0.0});
  this->brakes_and_stands(kStale, kStaleAndSeen);
  this->base().set_error({0.0, 0.0});
  this->goes_on();
}

TYPED_TEST_P(RobotFaults, AJumpOfThePoseIsAFaultUntilItPersists) {
  ASSERT_NO_FATAL_FAILURE(this->start());
  this->drive_steadily();
  // Believed, it plans from there: it goes on as soon as it stands, or nearly.
  for (const double error : {2.0, 0.0}) {
    const Nanoseconds since = this->world().time();
    this->base().set_error({0.0, error});
    const auto slow = [&] { return this->base().slowest_since(since) < 0.3; };
    EXPECT_LT(this->world().tenths_until(15, slow), 15) << this->base().status().reason;
    const auto stands = [&] { return this->base().slowest_since(since) < 0.05; };
    EXPECT_LT(this->world().tenths_until(20, stands), 20) << this->base().status().reason;
    this->drive_steadily();
  }
}

TYPED_TEST_P(RobotFaults, NoiseOfItsPosesDoesNotSlowIt) {
  ASSERT_NO_FATAL_FAILURE(this->start());
  std::mt19937 random{1};
  std::normal_distribution<double> error{0.0, 0.02};
  for (int i = 0; i < 40; ++i) {
    this->base().set_error({error(random), error(random)});
    ASSERT_TRUE(this->world().go_on()) << i;
    EXPECT_GT(this->base().speed(), 0.7) << this->base().status().reason;
  }
  this->base().set_error({-1.0, 1.0});
  for (int i = 0; i < 30; ++i) ASSERT_TRUE(this->world().go_on()) << i;
  this->base().set_error({0.0, 0.0});
  this->drive();
}

TYPED_TEST_P(RobotFaults, HeldItStopsPushingAndTriesAgain) {
  ASSERT_NO_FATAL_FAILURE(this->start());
  this->base().set_held(true);
  const auto stuck = [&] { return this->base().status().reason == "stuck"; };
  EXPECT_LT(this->world().tenths_until(20, stuck), 20) << this->base().status().reason;
  this->is_said("robot3: tracker", "stuck");
  this->is_said("robot3: planner", "stuck");
  EXPECT_LT(this->world().tenths_until(20, [&] { return this->base().speed() == 0.0; }), 20)
      << this->base().speed();
  this->base().set_held(false);
  this->goes_on();
}

TYPED_TEST_P(RobotFaults, AProcessThatIsKilledIsNamedAndTheRobotGoesOnWithTheNext) {
  ASSERT_NO_FATAL_FAILURE(this->start({"planner", "tracker", "perception"}));
  // Without a plan for half a second (host.plan_silence) the tracker brakes, as a base does without commands.
  for (const char* role : {"tracker", "perception", "planner"}) {
    SCOPED_TRACE(role);
    this->drive_steadily();
    this->kill_part(role);
    if (std::string{role} == "tracker")
      this->stands(6 + kStanding);
    else
      this->brakes_and_stands(0.0, kStaleAndSeen + 0.2);
    if (std::string{role} == "planner") this->is_said("robot3: tracker", "stale plan");
    this->is_said("robot3", std::string{role} + ": silent");
    this->restart_part(role);
    this->drive();
  }
}

TYPED_TEST_P(RobotFaults, APlannerThatIsBackBeforeTheRobotStandsBeginsAtItsSpeed) {
  ASSERT_NO_FATAL_FAILURE(this->start({"planner", "tracker", "perception"}));
  this->kill_part("planner");
  this->restart_part("planner");
  this->drive();
}

TYPED_TEST_P(RobotFaults, ARobotThatIsKilledStandsAndGoesOn) {
  ASSERT_NO_FATAL_FAILURE(this->start());
  this->kill_part("robot");
  EXPECT_LT(this->world().tenths_until(kStanding, [&] { return this->base().speed() == 0.0; }), kStanding);
  this->restart_part("robot");
  this->drive();
}

TYPED_TEST_P(RobotFaults, AnotherRobotOfItsNumberIsNamedAndPeersOfOtherClocksAndFramesToo) {
  using Trajectory = typename TypeParam::Trajectory;
  ASSERT_NO_FATAL_FAILURE(this->start());
  std::optional<Trajectory> told;
  [[maybe_unused]] const auto heard = this->world().ros().template subscribe<Trajectory>(
      "/swarm/trajectories", 50, [&](const Trajectory& plan) {
        if (plan.robot_id == 3 && !told) told = plan;
      });
  const auto swarm = this->world().ros().template advertise<Trajectory>("/swarm/trajectories", 50);
  ASSERT_LT(this->world().tenths_until(50, [&] { return told.has_value(); }), 50) << "nothing was told";
  for (std::uint32_t number = 1; number < 20; ++number) {
    Trajectory peer = *told;
    const auto publish = [&](std::uint32_t robot_id, Nanoseconds ahead, const char* frame) {
      peer.robot_id = robot_id;
      peer.sequence = number;
      peer.header.stamp = TypeParam::time_of(this->world().time() + ahead);
      peer.header.frame_id = frame;
      swarm.publish(peer);
    };
    for (std::size_t i = 0; i < peer.coefficients.size(); i += 12) peer.coefficients[i + 6] += 30.0;
    publish(3, 0, "map");
    publish(5, 400'000'000, "map");
    publish(6, 0, "another_map");
    ASSERT_TRUE(this->world().go_on()) << number;
  }
  this->is_said("robot3", "robot 3: another robot has this number");
  this->is_said("robot3", "robot 5: its clock is 0.4 s ahead");
  this->is_said("robot3", "robot 6: its frame is 'another_map'");
}

TYPED_TEST_P(RobotFaults, WhenTheClockJumpsItStopsAndGoesOnInTheNewTime) {
  ASSERT_NO_FATAL_FAILURE(this->start());
  std::uint32_t jumps = 0;
  for (const double jump : {30.0, -25.0, -500.0}) {
    SCOPED_TRACE(jump);
    this->drive_steadily();
    this->world().jump(jump);
    const auto slow = [&] {
      return this->base().speed() < 0.1;
    };  // it goes on as soon as it stands, or nearly
    EXPECT_LT(this->world().tenths_until(40, slow), 40) << this->base().status().reason;
    this->drive_steadily();
    EXPECT_EQ(this->base().status().clock_jumps, ++jumps);
  }
}

/// Carries what each robot tells its peers to the other's topic, with loss and delay.
template <class Ros>
class Air {
 public:
  using Trajectory = typename Ros::Trajectory;

  Air(RobotWorld<Ros>& world, const std::vector<std::string>& topics, double loss, double longest_delay)
      : world_{world}, loss_{loss}, delay_{0.0, longest_delay} {
    for (const std::string& topic : topics)
      publishers_.push_back(world.ros().template advertise<Trajectory>(topic, 200));
    for (std::size_t i = 0; i < topics.size(); ++i)
      heard_.push_back(
          world.ros().template subscribe<Trajectory>(topics[i], 200, [this, i](const Trajectory& plan) {
            if (plan.robot_id == i) take(plan);  // else it was carried here
          }));
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
    Nanoseconds arrival;
    Trajectory plan;
  };
  void take(const Trajectory& plan) {
    ++sent_;
    if (std::uniform_real_distribution<double>{}(random_) < loss_)
      ++lost_;
    else
      under_way_.push_back({world_.time() + static_cast<Nanoseconds>(1e9 * delay_(random_)), plan});
  }

  RobotWorld<Ros>& world_;
  double loss_;
  std::uniform_real_distribution<double> delay_;
  std::mt19937 random_{1};
  std::vector<typename Ros::template Publisher<Trajectory>> publishers_;
  std::vector<typename Ros::Heard> heard_;
  std::deque<Message> under_way_;
  int sent_ = 0, lost_ = 0;
};

/// Two robots face to face, each on a topic of its own for what it tells its peers; their least distance [m].
template <class Ros>
double pass_each_other(double loss, double longest_delay) {
  const auto own_topic = [](int robot_id) {
    return PartOptions{{{"/swarm/trajectories", "/air" + std::to_string(robot_id)}}, {}};
  };
  typename Ros::Part first{0, "robot", own_topic(0)}, second{1, "robot", own_topic(1)};
  RobotWorld<Ros> world{{{0, {{-5.0, 0.0}, 0.0}}, {1, {{5.0, 0.1}, 0.0}}}};
  Air<Ros> air{world, {"/air0", "/air1"}, loss, longest_delay};
  if (!world.wait_for_robots()) return -1.0;
  for (int i = 0; i < 20; ++i) EXPECT_TRUE(world.go_on()) << i;
  world.base(0).send_goal(5.0, 0.0, 0.0);
  world.base(1).send_goal(-5.0, 0.0, 0.0);
  double least = 10.0;
  const auto reached = [&](std::size_t robot) {
    return world.base(robot).status().goal_outcome == "reached";
  };
  const int tenths = world.tenths_until(450, [&] {
    air.carry();
    least =
        std::min(least, (world.base(0).pose().position_world - world.base(1).pose().position_world).norm());
    return reached(0) && reached(1);
  });
  EXPECT_LT(tenths, 450) << world.base(0).status().reason << ", " << world.base(1).status().reason;
  EXPECT_GT(air.sent(), 50);
  EXPECT_NEAR(air.lost(), loss * air.sent(), 0.2 * air.sent());
  for (std::size_t robot = 0; robot < 2; ++robot) {
    EXPECT_GT(world.base(robot).status().messages_accepted, 5U);
    world.base(robot).check_limits(kMaxSpeed, kMaxAcceleration);
  }
  return least;
}

TYPED_TEST_P(RobotFaults, PeersPassWithThreeOfTenMessagesLostAndTheRestUpTo200MillisecondsLate) {
  EXPECT_GT(pass_each_other<TypeParam>(0.3, 0.2), 0.6);
}

TYPED_TEST_P(RobotFaults, PeersPassWithHalfOfTheirMessagesLostAndTheRestUpTo300MillisecondsLate) {
  EXPECT_GT(pass_each_other<TypeParam>(0.5, 0.3), 0.6);
}

REGISTER_TYPED_TEST_SUITE_P(RobotFaults, WithoutOneOfItsSensorsItBrakesSaysSoAndGoesOnWithIt,
                            PosesThatAreNotNumbersAreNone, AJumpOfThePoseIsAFaultUntilItPersists,
                            NoiseOfItsPosesDoesNotSlowIt, HeldItStopsPushingAndTriesAgain,
                            AProcessThatIsKilledIsNamedAndTheRobotGoesOnWithTheNext,
                            APlannerThatIsBackBeforeTheRobotStandsBeginsAtItsSpeed,
                            ARobotThatIsKilledStandsAndGoesOn,
                            AnotherRobotOfItsNumberIsNamedAndPeersOfOtherClocksAndFramesToo,
                            WhenTheClockJumpsItStopsAndGoesOnInTheNewTime,
                            PeersPassWithThreeOfTenMessagesLostAndTheRestUpTo200MillisecondsLate,
                            PeersPassWithHalfOfTheirMessagesLostAndTheRestUpTo300MillisecondsLate);

}  // namespace spf::wire
