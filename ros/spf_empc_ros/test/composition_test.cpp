// What a robot of a simulated trial was given, played through ROS messages: a planner and a tracker that
// exchange nothing else command the same, bit for bit, as one robot in one process without ROS. Nothing is
// lost on the wire but what it cannot hold: times are to the nanosecond, ranges are single precision, and
// headings are quaternions, so the input is of that kind from the start.
#include <gtest/gtest.h>

#include <algorithm>

#include "host/split_host.hpp"
#include "sim/families.hpp"
#include "sim/input_log.hpp"
#include "sim/simulation.hpp"
#include "spf_empc_ros/conversions.hpp"

namespace spf_empc_ros {
namespace {

using spf::sim::LoggedTick;
using Commands = std::vector<Eigen::Vector3d>;

constexpr int kRobot = 3;
const ClockEdge kSimulatorClock{ros::Time{1700000000, 0}};
const std::string kFrame = "map";

spf::sim::Scenario sensed_swap() {
  using namespace spf::sim;
  Scenario scenario = make_scenario(family_setup(Family::f7), kDefaultSeed, 10000);
  scenario.simulation.pose_noise.position_sigma = 0.02;
  scenario.simulation.pose_noise.heading_sigma = 0.01;
  scenario.simulation.trial.after_contact = AfterContact::go_on;
  scenario.simulation.trial.time_limit = 16.0;
  return scenario;
}

// ---- what the wire can hold

double held(double time) {
  return kSimulatorClock.seconds(kSimulatorClock.time(time));
}

spf::Pose2 held(spf::Pose2 pose) {
  for (int i = 0; i < 20; ++i) {
    const spf::Pose2 next = *from_message(to_message(pose));
    if (next.heading == pose.heading) break;
    pose = next;
  }
  return pose;
}

void hold(double& value) {
  value = static_cast<double>(static_cast<float>(value));
}

/// As a driver and a localisation on ROS would give it from the start.
std::vector<LoggedTick> of_ros(std::vector<LoggedTick> ticks) {
  for (LoggedTick& tick : ticks) {
    tick.time = held(tick.time);
    tick.input.pose = {held(tick.input.pose.time), held(tick.input.pose.pose_world)};
    for (spf::HeardMessage& message : tick.input.messages)
      message = from_message(to_message(StampedTrajectory{message, {}}, kSimulatorClock, kFrame),
                             kSimulatorClock, kFrame)
                    ->message;
    for (spf::host::SensedWorld& seen : tick.input.seen) {
      seen.observation.time = held(seen.observation.time);
      if (!seen.observation.scan) continue;
      spf::RangeScan& scan = *seen.observation.scan;
      for (double* value : {&scan.angle_min, &scan.angle_increment, &scan.max_range}) hold(*value);
      for (double& range : scan.ranges) hold(range);
    }
  }
  return ticks;
}

class CompositionTest : public ::testing::Test {
 protected:
  CompositionTest() {
    spf::sim::InputLog log{kRobot};
    spf::sim::SimulationOptions options;
    options.listener = &log;
    (void)spf::sim::Simulation{scenario, spf::AgentParameters{}, options}.run();
    ticks = of_ros(log.ticks());
  }

  [[nodiscard]] Commands without_ros() const {
    spf::host::RobotHost robot{kRobot, agent, host};
    robot.planner().set_goal({task.goal_world, task.goal_heading});
    robot.start(map, task.start, 0.0);
    Commands commands;
    for (const LoggedTick& tick : ticks) {
      robot.add_pose(tick.input.pose, tick.time);
      for (const spf::HeardMessage& message : tick.input.messages) robot.add_message(message, tick.time);
      for (const spf::host::SensedWorld& seen : tick.input.seen) robot.add_observation(seen, tick.time);
      robot.plan(tick.time);
      if (tick.action.controlled) commands.push_back(robot.control(tick.time).wheel_speeds);
    }
    return commands;
  }

  /// Everything between the two crosses as a message, and so does everything that comes in.
  [[nodiscard]] Commands through_ros(double share_that_is_told) const {
    spf::host::PlannerProcess planner{kRobot, agent, host};
    spf::host::TrackerProcess tracker{kRobot, agent, host};
    planner.planner().set_goal({task.goal_world, task.goal_heading});
    planner.planner().start(map, task.start, 0.0);
    Commands commands;
    for (const LoggedTick& tick : ticks) {
      const double now = kSimulatorClock.seconds(kSimulatorClock.time(tick.time));
      const spf::PoseMeasurement pose{kSimulatorClock.seconds(kSimulatorClock.time(tick.input.pose.time)),
                                      *from_message(to_message(tick.input.pose.pose_world))};
      planner.add_pose(pose, now);
      tracker.add_pose(pose, now);
      for (const spf::HeardMessage& message : tick.input.messages)
        planner.add_message(over_wire(message, std::nullopt), now);
      for (const spf::host::SensedWorld& seen : tick.input.seen) {
        const spf::host::SensedWorld told =
            *from_message(to_message(seen, kSimulatorClock, kFrame), kSimulatorClock, kFrame);
        if (told.observation.scan)
          tracker.add_scan(told.observation.time, *told.observation.scan, spf::Pose2{}, now);
        planner.add_observation(told, now);
      }
      const spf::host::PlannerOutput& output = planner.step(now);
      if (output.planned) tracker.add_plan(over_wire(output.plan, output.observed), now);
      if (!tick.action.controlled) continue;  // its timer
      commands.push_back(tracker.step(now).wheel_speeds);
      spf_empc_msgs::WheelSpeeds wheels =
          to_message(share_that_is_told * commands.back(), tracker.tracker().max_wheel_speed());
      wheels.header.stamp = kSimulatorClock.time(now);
      planner.add_command(kSimulatorClock.seconds(wheels.header.stamp), *from_message(wheels, 3), now,
                          tracker.tracker().command().guard.action);
    }
    return commands;
  }

  const spf::sim::Scenario scenario = sensed_swap();
  const spf::AgentParameters agent = spf::sim::agent_parameters_for(scenario, spf::AgentParameters{});
  spf::host::HostParameters host = spf::sim::host_parameters_for(scenario, agent);
  const spf::OccupancyMap map = spf::sim::robot_map(scenario);
  const spf::sim::RobotTask task = scenario.robots[kRobot];
  std::vector<LoggedTick> ticks;

 private:
  [[nodiscard]] static spf::TrajectoryMessage over_wire(const spf::TrajectoryMessage& message,
                                                        std::optional<double> observed) {
    const StampedTrajectory stamped{message, observed};
    return from_message(to_message(stamped, kSimulatorClock, kFrame), kSimulatorClock, kFrame)->message;
  }
};

TEST_F(CompositionTest, ThroughMessagesARobotCommandsTheSame) {
  const Commands commands = without_ros();
  ASSERT_EQ(commands.size(), 320U);  // 16 s at 20 Hz
  double fastest = 0.0;
  for (const Eigen::Vector3d& command : commands) fastest = std::max(fastest, command.norm());
  EXPECT_GT(fastest, 0.5);
  EXPECT_EQ(through_ros(1.0), commands);
  EXPECT_NE(through_ros(0.7), commands);  // a planner that is told something else plans something else
}

TEST_F(CompositionTest, UnderItsGuardToo) {
  host.guard.enabled = true;
  host.guard.margin = 0.5;  // so that it has something to do
  EXPECT_EQ(through_ros(1.0), without_ros());
}

}  // namespace
}  // namespace spf_empc_ros
