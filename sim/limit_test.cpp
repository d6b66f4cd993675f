// In ordinary trials nobody is taken for stuck, and no command is beyond the robot's limits.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "sim/families.hpp"
#include "sim/input_log.hpp"
#include "sim/simulation.hpp"
#include "spf/robot/drive.hpp"

namespace spf::sim {
namespace {

constexpr double kControlPeriod = TrackerParameters{}.control_period;  // [s]

struct OrdinaryTrial {
  const char* name;
  Family family;
  double pose_sigma;   // [m] of which the observer is told nothing
  double motor_lag;    // [s] of the plant and the model
  double noise_level;  // [1] of the moving obstacles
};

void PrintTo(const OrdinaryTrial& trial, std::ostream* out) {
  *out << trial.name;
}

class OrdinaryTrials : public testing::TestWithParam<OrdinaryTrial> {};

INSTANTIATE_TEST_SUITE_P(Scenes, OrdinaryTrials,
                         testing::Values(OrdinaryTrial{"noisy_poses", Family::t2, 0.02, 0.05, 1.0},
                                         OrdinaryTrial{"slow_motors", Family::t2_hard, 0.0, 0.2, 2.0},
                                         OrdinaryTrial{"waiting", Family::swap, 0.0, 0.05, 0.0},
                                         OrdinaryTrial{"small_robots", Family::p8, 0.0, 0.05, 1.0}),
                         [](const auto& scene) { return std::string{scene.param.name}; });

TEST_P(OrdinaryTrials, NobodyIsTakenForStuckAndCommandsKeepTheLimits) {
  const OrdinaryTrial& trial = GetParam();
  FamilySetup setup = family_setup(trial.family);
  setup.robot.motor_lag = trial.motor_lag;
  setup.simulation.pose_noise.position_sigma = trial.pose_sigma;
  setup.simulation.noise.level = trial.noise_level;
  setup.simulation.trial.after_contact = AfterContact::go_on;
  setup.simulation.trial.time_limit = 25.0;
  const Scenario scenario = make_scenario(setup, kDefaultSeed, 10000);
  InputLog log{0};
  SimulationOptions options;
  options.listener = &log;
  const TrialResult result = Simulation{scenario, defaults_for(scenario.robot), options}.run();
  for (const RobotResult& robot : result.robots)
    EXPECT_EQ(robot.stood[static_cast<std::size_t>(StopCause::stuck)], 0.0);

  const RobotParameters& robot = scenario.robot;
  const Drive drive{robot};
  Eigen::Vector3d before = Eigen::Vector3d::Zero();  // in body
  int commands = 0;
  for (const LoggedTick& tick : log.ticks()) {
    if (!tick.action.controlled) continue;
    ++commands;
    const Eigen::Vector3d twist = drive.twist_body(tick.action.wheel_speeds);
    const Eigen::Vector3d change = twist - twist_in_body(before, kControlPeriod * before.z());
    ASSERT_LE(twist.head<2>().norm(), 1.01 * robot.max_speed) << tick.time;
    ASSERT_LE(std::abs(twist.z()), 1.01 * robot.max_yaw_rate) << tick.time;
    ASSERT_LE(change.head<2>().norm(), 1.1 * robot.max_acceleration * kControlPeriod) << tick.time;
    ASSERT_LE(std::abs(change.z()), 1.1 * robot.max_yaw_acceleration * kControlPeriod) << tick.time;
    ASSERT_LE(tick.action.wheel_speeds.lpNorm<Eigen::Infinity>(), (1.0 + 1e-9) * robot.max_wheel_speed);
    before = twist;
  }
  EXPECT_GT(commands, 100);
}

}  // namespace
}  // namespace spf::sim
