// Where the robot is: the only place where measured poses are judged, and the only estimate of the robot's
// motion. It knows no controller; whoever drives the wheels tells it what was applied to them, so that
// braking, a limit on the way to the motors, or a base that has stopped by itself does not mislead it. Frame:
// world; times are the host's [s].
#pragma once

#include <cstdint>
#include <optional>

#include "host/motion_monitor.hpp"
#include "host/pose_gate.hpp"
#include "host/pose_history.hpp"
#include "host/scan_guard.hpp"
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
  /// Of the last pose that was believed: the transform that placed it in the world was last known at this
  /// time [s]. Its robot is localised no later, however fresh its odometry. Not called where poses are
  /// measured in the world itself.
  void placed_by_transform_of(double time) { placed_time_ = time; }
  /// What the last relocalisation did: a position that was taken for p is turned by this and then shifted by
  /// it.
  [[nodiscard]] const Pose2& correction() const { return correction_; }
  /// Rim speeds [m/s] that the motors are told from a time on, held until the next: those that were really
  /// applied. Those that are not finite count as none. What is older than the last is ignored; the caller
  /// sees to it that nothing lies ahead of the present, where it would carry the estimate.
  void applied(double time, const DriveInput& wheel_speeds);
  /// What the guard made of the last command.
  void note_guard(GuardAction action) { guard_ = action; }
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
  /// Carried to a time [s] ahead, without changing anything; for one that has passed the present.
  [[nodiscard]] StateEstimate estimate(double time) const { return estimator_.estimate(time); }
  /// Where it is at a time [s], or was: what is sensed is some moments old. Nothing where that is not known.
  [[nodiscard]] std::optional<Pose2> pose(double time) const;
  /// state(), for displays.
  [[nodiscard]] AgentEstimate belief() const;
  /// That of the last note_guard(), while commands come.
  [[nodiscard]] GuardAction guard() const { return guard_; }
  /// Whether the poses show what was applied.
  [[nodiscard]] const MotionMonitor& motion() const { return monitor_; }
  [[nodiscard]] bool has_pose() const { return gate_.last().has_value(); }
  [[nodiscard]] double pose_age(double now) const { return gate_.age(now); }  ///< [s] infinite without one
  /// [s] since the robot was last localised; zero where no transform has placed its poses.
  [[nodiscard]] double localisation_age(double now) const { return placed_time_ ? now - *placed_time_ : 0.0; }
  [[nodiscard]] double command_age(double now) const { return now - command_time_; }  ///< [s] likewise
  [[nodiscard]] std::uint32_t poses_refused() const { return poses_refused_; }

 private:
  PoseGate gate_;
  Drive drive_;
  MotionEstimator estimator_;
  PoseHistory history_;
  MotionMonitor monitor_;
  Pose2 correction_;
  double command_silence_;             // [s]
  double command_time_ = kNever;       // [s] when the last command was applied
  std::optional<double> placed_time_;  // [s]
  bool standing_ = true;               // no command is in force
  GuardAction guard_ = GuardAction::none;
  std::uint32_t poses_refused_ = 0;
};

}  // namespace spf::host
