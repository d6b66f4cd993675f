// The control half of a robot: the planner's trajectory in, wheel speeds out, at the control rate and
// whatever the planner does. When what it relies on is missing, it brakes at the largest planned acceleration
// along a braking trajectory of its own, and stands until all is well again. Whatever it does, its commands
// keep the robot's limits; but the ScanGuard has the last word, and may stop it harder. Where the robot is it
// is told by a Localiser, to which it tells what it commands. One thread. Frame: world (the fleet's); times
// are the host's [s] and have passed a StepClock.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "host/health.hpp"
#include "host/localiser.hpp"
#include "host/scan_guard.hpp"
#include "host/watchdog.hpp"
#include "spf/team/agent_parameters.hpp"
#include "spf/tracking/command_limiter.hpp"
#include "spf/tracking/trajectory_controller.hpp"
#include "spf/world/trajectory_message.hpp"

namespace spf::host {

enum class PlanVerdict {
  accepted,
  foreign,    ///< of another robot
  malformed,  ///< not one that this robot could drive
  future,     ///< sent, or starting, ahead of the clock
  late,       ///< not newer than the one that is known
};
[[nodiscard]] const char* to_string(PlanVerdict verdict);

struct TrackerCommand {
  StopCause stop = StopCause::no_pose;  ///< why it brakes or stands; none: it follows its plan
  bool braking = false;                 ///< still moving, on the way to standstill
  DriveInput wheel_speeds;              ///< within the limits
  Eigen::Vector3d twist_body = Eigen::Vector3d::Zero();  ///< [m/s, m/s, rad/s] that they mean
  GuardVerdict guard;                                    ///< on what was to be commanded
  StateEstimate estimate;
  Eigen::Vector3d reference_pose = Eigen::Vector3d::Zero();  ///< [m, m, rad]
};

class TrackerHost {
 public:
  /// As PlannerHost.
  TrackerHost(int robot_id, const AgentParameters& agent, const HostParameters& host);

  PlanVerdict add_plan(const TrajectoryMessage& message, double now);
  void set_switches(const Switches& switches) { switches_ = switches; }
  /// [m/s] that the planner keeps to from now on (CommandLimiter::set_max_speed).
  void set_speed_limit(double max_speed) { limiter_.set_max_speed(max_speed); }
  /// A scan, for the guard alone. False when it is refused (ScanGuard::add_scan), or there is no guard.
  bool add_scan(double time, const RangeScan& scan, const Pose2& sensor_in_body, double now);
  /// The host could not even read a plan.
  void count_refused_plan() { ++plans_refused_; }
  /// What the Localiser said of a pose.
  void note_pose(PoseVerdict verdict, double now);
  /// Nothing known can be dated any more, but the robot still moves as it was told.
  void meet_clock_jump();

  /// One control tick; the localiser learns of the command. Never blocks, throws or allocates.
  const TrackerCommand& step(double now, Localiser& localiser);

  [[nodiscard]] const TrackerCommand& command() const { return command_; }
  /// Well while it follows its plan.
  [[nodiscard]] Health health() const;
  [[nodiscard]] const TrajectoryMessage& plan() const { return plan_; }
  [[nodiscard]] double plan_age(double now) const;  ///< [s] infinite without one
  [[nodiscard]] std::uint32_t plans_refused() const { return plans_refused_; }
  [[nodiscard]] double max_wheel_speed() const { return drive_.max_wheel_speed(); }  ///< [m/s]
  /// Null when it is switched off.
  [[nodiscard]] const ScanGuard* guard() const { return guard_.get(); }

 private:
  [[nodiscard]] StopCause stop_cause(double now, const Localiser& localiser) const;
  [[nodiscard]] PlanVerdict judge(const TrajectoryMessage& message, double now) const;
  void follow(double now, const MotionState& state);
  void brake(double now, const MotionState& state);
  void stop_pushing(double now, const MotionState& state);
  void send(double now, const DriveInput& wanted, const MotionState& state);
  void heed_guard(double now, const MotionState& state);

  int robot_id_;
  RobotParameters robot_;
  double clock_error_;  // [s]
  Drive drive_;
  TrajectoryController controller_;
  CommandLimiter limiter_;
  Watchdog watchdog_;
  bool relies_on_scan_;
  std::unique_ptr<ScanGuard> guard_;  // null: it is off
  TrajectoryMessage plan_;
  bool has_plan_ = false;
  double relocalised_ = kNever;          // [s] plans from before lead on from where it was thought to be
  bool after_jump_ = false;              // of the clock, and nothing new since
  std::unique_ptr<Trajectory> braking_;  // rarely there, and large
  double last_step_time_ = kNever;       // [s]
  Switches switches_;
  TrackerCommand command_;
  std::uint32_t plans_refused_ = 0;
};

}  // namespace spf::host
