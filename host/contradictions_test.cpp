#include "host/contradictions.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <ostream>
#include <stdexcept>
#include <string>

#include "host/robot_host.hpp"
#include "host/split_host.hpp"
#include "spf/robot/robot_scale.hpp"

namespace spf::host {
namespace {

using testing::HasSubstr;

/// All that the rules look at. Peers that are honest but not trusted, as on a real fleet.
struct TestedRobot {
  AgentParameters agent = defaults_for(RobotParameters{});
  HostParameters host;
  OperatingConditions conditions;

  TestedRobot() {
    conditions.sensing_range = 8.0;
    conditions.sensing_rate = 10.0;
    conditions.pose_rate = 100.0;
    conditions.has_peers = true;
    conditions.message_delay = 0.05;
  }
  [[nodiscard]] std::vector<Contradiction> found() const { return contradictions(agent, host, conditions); }
};

/// A change that contradicts something, and one that just does not.
struct Conflict {
  const char* key;
  Severity severity;
  std::string text;
  std::function<void(TestedRobot&)> bad;
  std::function<void(TestedRobot&)> good;
};

void PrintTo(const Conflict& one, std::ostream* stream) {
  *stream << one.key;
}

const std::vector<Conflict> kConflicts{
    {"robot.max_speed", Severity::warning,
     "robot.max_speed = 1.6 m/s is more than the wheels reach in every direction: 1.5 m/s "
     "(robot.max_wheel_speed = 1.5 m/s)",
     [](TestedRobot& all) { all.agent.robot.max_speed = 1.6; },
     [](TestedRobot& all) { all.agent.robot.max_speed = 1.5; }},
    // Three wheels of 0.4 N m / 0.05 m push 10 kg with 1.5 * 8 N where they push least.
    {"robot.max_acceleration", Severity::warning,
     "than it plans: 1.2 m/s^2 (robot.max_wheel_torque = 0.4 N m)",
     [](TestedRobot& all) { all.agent.robot.max_acceleration = 1.21; },
     [](TestedRobot& all) { all.agent.robot.max_acceleration = 1.2; }},
    // 1.5 m/s on an arm of 0.2 m.
    {"robot.max_yaw_rate", Severity::warning, "the wheels reach: 7.5 rad/s (robot.max_wheel_speed",
     [](TestedRobot& all) { all.agent.robot.max_yaw_rate = 7.6; },
     [](TestedRobot& all) { all.agent.robot.max_yaw_rate = 7.5; }},
    // Three times 8 N on 0.2 m turn 0.45 kg m^2.
    {"robot.max_yaw_acceleration", Severity::warning, "the wheels give: 10.67 rad/s^2",
     [](TestedRobot& all) { all.agent.robot.max_yaw_acceleration = 10.7; },
     [](TestedRobot& all) { all.agent.robot.max_yaw_acceleration = 10.6; }},
    {"robot.wheel_arm", Severity::warning, "is longer than robot.radius = 0.3 m",
     [](TestedRobot& all) { all.agent.robot.wheel_arm = 0.31; },
     [](TestedRobot& all) { all.agent.robot.wheel_arm = 0.3; }},
    {"agent.team.plan_period", Severity::error, "= 0.6 s is longer than host.plan_silence = 0.5 s",
     [](TestedRobot& all) { all.agent.team.plan_period = 0.6; },
     [](TestedRobot& all) { all.agent.team.plan_period = 0.5; }},
    {"agent.tracker.control_period", Severity::error, "is longer than host.command_silence = 0.04 s",
     [](TestedRobot& all) { all.host.command_silence = 0.04; },
     [](TestedRobot& all) { all.host.command_silence = 0.05; }},
    {"agent.tracker.control_period", Severity::error, "is longer than host.clock_jump = 0.1 s",
     [](TestedRobot& all) {
       all.host.clock_jump = 0.1;
       all.agent.tracker.control_period = 0.11;
     },
     [](TestedRobot& all) { all.host.clock_jump = all.agent.tracker.control_period = 0.1; }},
    {"agent.team.reanchor_distance", Severity::warning, "is longer than host.largest_plan_error = 0.6 m",
     [](TestedRobot& all) { all.agent.team.reanchor_distance = 0.7; },
     [](TestedRobot& all) { all.agent.team.reanchor_distance = 0.6; }},
    {"pose_noise.rate", Severity::warning, "= 3 Hz leaves 0.3333 s between two poses",
     [](TestedRobot& all) { all.conditions.pose_rate = 3.0; },
     [](TestedRobot& all) { all.conditions.pose_rate = 4.0; }},
    {"host.clock_error", Severity::warning, "is longer than agent.team.stale_time = 0.3 s",
     [](TestedRobot& all) { all.host.clock_error = 0.4; },
     [](TestedRobot& all) { all.host.clock_error = 0.3; }},
    {"host.jump_distance", Severity::warning,
     "is less than 6 times agent.tracker.observer.pose_sigma = 0.1 m",
     [](TestedRobot& all) { all.agent.tracker.observer.pose_sigma = 0.1; },
     [](TestedRobot& all) { all.agent.tracker.observer.pose_sigma = 0.08; }},
    {"host.jump_heading", Severity::warning, "is less than 6 times agent.tracker.observer.heading_sigma",
     [](TestedRobot& all) { all.agent.tracker.observer.heading_sigma = 0.1; },
     [](TestedRobot& all) { all.agent.tracker.observer.heading_sigma = 0.08; }},
    {"trial.computing_delay", Severity::error,
     "= 0.31 s is longer than agent.team.stale_time = 0.3 s: whatever the robot senses would be too old",
     [](TestedRobot& all) { all.conditions.computing_delay = 0.31; },
     [](TestedRobot& all) { all.conditions.computing_delay = 0.2; }},
    {"agent.perception.enabled", Severity::warning,
     "= false together with host.relies_on_obstacles = false leaves nobody to tell of what moves",
     [](TestedRobot& all) { all.host.relies_on_obstacles = false; },
     [](TestedRobot& all) {
       all.host.relies_on_obstacles = false;
       all.agent.perception.enabled = true;
     }},
    {"sensing.rate", Severity::warning, "= 10 Hz lets observations grow 0.35 s old",
     [](TestedRobot& all) { all.conditions.computing_delay = 0.25; },
     [](TestedRobot& all) {
       all.conditions.computing_delay = 0.25;
       all.host.relies_on_scan = all.host.relies_on_obstacles = false;
       all.agent.perception.enabled = true;
     }},
    // 0.3 m + 1 m/s * (0.1 + 0.1 + 0.05 + 0.05) s + 0.5 m.
    {"sensing.range", Severity::warning, "= 1.05 m is shorter than the 1.1 m that the robot needs to stop",
     [](TestedRobot& all) { all.conditions.sensing_range = 1.05; },
     [](TestedRobot& all) { all.conditions.sensing_range = 1.11; }},
    {"host.map_reach", Severity::error, "does not reach beyond the robot and its margin, 0.32 m",
     [](TestedRobot& all) {
       all.host.map_grain.reach = 0.3;
       all.host.map_grain.resolution = 0.05;
     },
     [](TestedRobot& all) { all.host.map_grain.reach = 0.3; }},  // four cells of 0.1 m are farther
    {"host.map_resolution", Severity::warning, "is longer than robot.radius = 0.3 m",
     [](TestedRobot& all) { all.host.map_grain.resolution = 0.31; },
     [](TestedRobot& all) { all.host.map_grain.resolution = 0.3; }},
    {"agent.team.message_lifetime", Severity::warning, "is shorter than the 0.25 s until the next broadcast",
     [](TestedRobot& all) { all.agent.team.message_lifetime = 0.2; },
     [](TestedRobot& all) { all.agent.team.message_lifetime = 0.25; }},
    {"agent.team.message_lifetime", Severity::warning, "is shorter than the 1.6 s until the next broadcast",
     [](TestedRobot& all) { all.conditions.message_delay = 1.4; },
     [](TestedRobot& all) { all.conditions.message_delay = 1.3; }},
    {"robot.radius", Severity::warning, "goes beyond host.largest_peer_radius = 0.25 m",
     [](TestedRobot& all) { all.host.largest_peer_radius = 0.25; },
     [](TestedRobot& all) {
       all.host.largest_peer_radius = 0.25;
       all.host.trusts_peers = true;
     }},
    {"agent.tracker.observer.pose_sigma", Severity::warning, "goes beyond host.largest_peer_sigma = 0.01 m",
     [](TestedRobot& all) {
       all.agent.tracker.observer.pose_sigma = 0.02;
       all.host.largest_peer_sigma = 0.01;
     },
     [](TestedRobot& all) {
       all.agent.tracker.observer.pose_sigma = 0.01;
       all.host.largest_peer_sigma = 0.01;
     }},
    {"robot.max_speed", Severity::warning, "= 1 m/s goes beyond host.largest_peer_speed = 1.004 m/s",
     [](TestedRobot& all) { all.host.largest_peer_speed = 1.004; },
     [](TestedRobot& all) { all.host.largest_peer_speed = 1.006; }},
    // Twice the 1.1 m of one robot.
    {"radio.range", Severity::warning, "within the 2.2 m that two of them need to stop",
     [](TestedRobot& all) {
       all.conditions.message_range = 2.1;
       all.conditions.peer_sight = 0.0;
     },
     [](TestedRobot& all) {
       all.conditions.message_range = 2.3;
       all.conditions.peer_sight = 0.0;
     }},
    {"radio.loss", Severity::warning, "they sense each other within 2 m (sensing.peer_detection_range)",
     [](TestedRobot& all) {
       all.conditions.message_loss = 1.0;
       all.conditions.peer_sight = 2.0;
     },
     [](TestedRobot& all) {
       all.conditions.message_loss = 1.0;
       all.conditions.peer_sight = 3.0;
     }},
};

class Contradictions : public testing::TestWithParam<Conflict> {};

TEST_P(Contradictions, AreFoundAndNothingElseIs) {
  TestedRobot settings;
  GetParam().bad(settings);
  const std::vector<Contradiction> found = settings.found();
  ASSERT_EQ(found.size(), 1u) << (found.empty() ? "" : to_text(found.front()));
  EXPECT_EQ(found.front().key, GetParam().key);
  EXPECT_EQ(found.front().severity, GetParam().severity);
  EXPECT_THAT(to_text(found.front()), HasSubstr(GetParam().text));
}

TEST_P(Contradictions, AreNotFoundAtTheLimit) {
  TestedRobot settings;
  GetParam().good(settings);
  for (const Contradiction& found : settings.found()) ADD_FAILURE() << to_text(found);
}

INSTANTIATE_TEST_SUITE_P(All, Contradictions, testing::ValuesIn(kConflicts));

TEST(ContradictionsOfDefaults, AreNone) {
  for (const double size : {0.05, 0.3, 1.0}) {
    TestedRobot settings;
    RobotParameters& robot = settings.agent.robot;
    robot.radius = size;
    robot.wheel_arm = 0.6 * size;
    robot.inertia = 1.5 * size;  // as the arm on which the wheels turn it
    settings.agent = defaults_for(robot);
    settings.host = scaled(HostParameters{}, RobotScale{robot});
    for (const Contradiction& found : settings.found()) ADD_FAILURE() << size << " m: " << to_text(found);
    for (const Contradiction& found : contradictions(settings.agent, settings.host))
      ADD_FAILURE() << size << " m: " << to_text(found);
  }
}

TEST(ContradictionsOfAHost, WithoutWheelsAreNotOfWheels) {
  TestedRobot settings;
  settings.agent.robot.max_speed = 1.6;
  settings.agent.team.plan_period = 0.6;
  settings.conditions.pose_rate = 1.0;
  settings.conditions.by_wheels = false;
  EXPECT_TRUE(settings.found().empty());
}

TEST(ContradictionsOfAHost, AreRefusedWhenItIsMade) {
  AgentParameters agent;
  agent.team.plan_period = 0.6;
  const auto refusal = [](const std::function<void()>& make) -> std::string {
    try {
      make();
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "was made";
  };
  const std::string expected =
      "agent.team.plan_period = 0.6 s is longer than host.plan_silence = 0.5 s: the controller would brake "
      "between any two plans";
  EXPECT_EQ(refusal([&] { const RobotHost robot(1, agent, HostParameters{}); }), expected);
  EXPECT_EQ(refusal([&] { const PlannerProcess planner(1, agent, HostParameters{}); }), expected);
  EXPECT_EQ(refusal([&] { const TrackerProcess tracker(1, agent, HostParameters{}); }), expected);
  agent = {};
  agent.robot.max_speed = 1.6;  // a warning
  EXPECT_EQ(refusal([&] { const RobotHost robot(1, agent, HostParameters{}); }), "was made");
}

}  // namespace
}  // namespace spf::host
