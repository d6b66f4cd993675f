// The control half of a robot behind one door: poses and the planner's trajectory in, wheel speeds out, at
// the control rate and whatever the planner does. When what it relies on is missing, it brakes at the largest
// planned acceleration along a braking trajectory of its own, and stands until all is well again. One thread.
// Frame: world (the fleet's); times are the host's [s].
#pragma once

#include <cstdint>
#include <optional>

#include "host/pose_gate.hpp"
#include "host/step_clock.hpp"
#include "spf/team/agent_parameters.hpp"
#include "spf/tracking/tracker.hpp"
#include "spf/world/trajectory_message.hpp"

namespace spf::host {

/// Why the tracker brakes or stands, the gravest first; `tracking` while it follows its plan.
enum class TrackerMode {
  tracking,
  emergency_stop,
  paused,
  clock_jump,  ///< until a pose and a plan of the new time are there
  no_pose,     ///< none yet
  stale_pose,
  no_plan,  ///< none yet
  stale_plan,
  far_from_plan,  ///< waits for one that begins here
  failed,         ///< the controller had no answer
};
[[nodiscard]] const char* to_string(TrackerMode mode);

enum class PlanVerdict {
  accepted,
  foreign,    ///< of another robot
  malformed,  ///< not one that this robot could drive
  future,     ///< sent, or starting, ahead of the clock
  late,       ///< not newer than the one that is known
};
[[nodiscard]] const char* to_string(PlanVerdict verdict);

struct TrackerCommand {
  TrackerMode mode = TrackerMode::no_pose;
  bool braking = false;                                    ///< still moving, on the way to standstill
  Eigen::Vector3d wheel_speeds = Eigen::Vector3d::Zero();  ///< [m/s] rims, within the limits
  Eigen::Vector3d twist_body = Eigen::Vector3d::Zero();    ///< [m/s, m/s, rad/s] that they mean
  StateEstimate estimate;
  Eigen::Vector3d reference_pose = Eigen::Vector3d::Zero();  ///< [m, m, rad]
};

class TrackerHost {
 public:
  /// Throws std::invalid_argument on parameters out of range.
  TrackerHost(int robot_id, const AgentParameters& agent, const HostParameters& host);

  PoseVerdict add_pose(const PoseMeasurement& pose, double now);
  PlanVerdict add_plan(const TrajectoryMessage& message, double now);
  void set_emergency_stop(bool stop) { emergency_stop_ = stop; }
  void set_paused(bool paused) { paused_ = paused; }
  /// The host could not even read something.
  void count_refused_plan() { ++plans_refused_; }
  void count_refused_pose() { ++poses_refused_; }

  /// One control tick; never blocks, throws or allocates.
  const TrackerCommand& step(double now);

  [[nodiscard]] const TrackerCommand& command() const { return command_; }
  [[nodiscard]] const TrajectoryMessage& plan() const { return plan_; }
  [[nodiscard]] double pose_age(double now) const { return gate_.age(now); }  ///< [s] infinite without one
  [[nodiscard]] double plan_age(double now) const;                            ///< [s] likewise
  [[nodiscard]] std::uint32_t plans_refused() const { return plans_refused_; }
  [[nodiscard]] std::uint32_t poses_refused() const { return poses_refused_; }
  [[nodiscard]] std::uint32_t clock_jumps() const { return clock_.count(); }
  [[nodiscard]] double max_wheel_speed() const { return kinematics_.max_wheel_speed(); }  ///< [m/s]

 private:
  void meet_clock_jump(double now);
  [[nodiscard]] TrackerMode mode_now(double now) const;
  [[nodiscard]] PlanVerdict judge(const TrajectoryMessage& message, double now) const;
  void follow(double now);
  void brake(double now);

  int robot_id_;
  AgentParameters agent_;
  HostParameters host_;
  OmniKinematics kinematics_;
  Tracker tracker_;
  PoseGate gate_;
  StepClock clock_;
  TrajectoryMessage plan_;
  bool has_plan_ = false;
  bool after_jump_ = false;  // of the clock, and nothing new since
  std::optional<Trajectory> braking_;
  bool emergency_stop_ = false;
  bool paused_ = false;
  TrackerCommand command_;
  std::uint32_t plans_refused_ = 0;
  std::uint32_t poses_refused_ = 0;
};

}  // namespace spf::host
