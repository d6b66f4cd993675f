// Where the robot is: the only place where measured poses are judged, and the only estimate of the robot's
// motion. It knows no controller; whoever drives the wheels tells it what was applied to them, so that
// braking, a limit on the way to the motors, or a base that has stopped by itself does not mislead it. Frame:
// world; times are the host's [s].
#pragma once

#include <cstdint>
#include <optional>

#include "host/motion_monitor.hpp"
#include "host/pose_gate.hpp"
#include "host/step_clock.hpp"
#include "spf/localisation/motion_estimator.hpp"
#include "spf/team/agent_parameters.hpp"
#include "spf/team/agent_status.hpp"

namespace spf::host {

/// Never throws or allocates after construction.
class Localiser {
 public:
  /// Throws std::invalid_argument on parameters out of range.
  Localiser(const AgentParameters& agent, const HostParameters& host);

  /// Enters a pose that is believed. After a jump that persisted nothing older counts.
  PoseVerdict add_pose(const PoseMeasurement& pose, double now);
  /// Rim speeds [m/s] that the motors are told from a time on, held until the next: those that were really
  /// applied. Those that are not finite count as none. What is older than the last is ignored; the caller
  /// sees to it that nothing lies ahead of the present, where it would carry the estimate.
  void applied(double time, const Eigen::Vector3d& wheel_speeds);
  /// Without a word of what is applied for HostParameters::command_silence the wheels are taken to stand, as
  /// bases do that are told nothing.
  void advance_to(double now);
  /// Nothing known can be dated any more; but the robot is where it was, and moves as it was told, unless the
  /// clock leapt ahead by more than a base waits for commands.
  void meet_clock_jump(double now);
  /// The host could not even read a pose.
  void count_refused_pose() { ++poses_refused_; }

  /// As of the last call that changed it.
  [[nodiscard]] MotionState state() const { return estimator_.state(); }
  /// Carried to a time not before the last call, without changing anything.
  [[nodiscard]] StateEstimate estimate(double time) const { return estimator_.estimate(time); }
  /// state(), for displays.
  [[nodiscard]] AgentEstimate belief() const;
  /// Whether the poses show what was applied.
  [[nodiscard]] const MotionMonitor& motion() const { return monitor_; }
  [[nodiscard]] bool has_pose() const { return gate_.last().has_value(); }
  [[nodiscard]] double pose_age(double now) const { return gate_.age(now); }  ///< [s] infinite without one
  [[nodiscard]] double command_age(double now) const { return now - command_time_; }  ///< [s] likewise
  [[nodiscard]] std::uint32_t poses_refused() const { return poses_refused_; }

 private:
  PoseGate gate_;
  OmniKinematics kinematics_;
  MotionEstimator estimator_;
  MotionMonitor monitor_;
  double command_silence_;        // [s]
  double command_time_ = kNever;  // [s] when the last command was applied
  bool standing_ = true;          // no command is in force
  std::uint32_t poses_refused_ = 0;
};

}  // namespace spf::host
