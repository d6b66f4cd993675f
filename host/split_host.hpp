// A robot whose planner and controller are processes of their own: each judges the poses and keeps the time
// for itself. What passes between them is the planner's trajectory one way, and what was applied to the
// wheels the other way, and whether the guard held them back. Each serves one thread. Frame: world (the
// fleet's); times are the host's [s].
#pragma once

#include <algorithm>
#include <cstdint>

#include "host/planner_host.hpp"
#include "host/step_clock.hpp"
#include "host/tracker_host.hpp"

namespace spf::host {

class PlannerProcess {
 public:
  PlannerProcess(int robot_id, const AgentParameters& agent, const HostParameters& host,
                 std::uint32_t first_sequence = 0);

  PoseVerdict add_pose(const PoseMeasurement& pose, double now) {
    const PoseVerdict verdict = localiser_.add_pose(pose, tell_time(now));
    planner_.note_pose(pose, verdict, localiser_);
    return verdict;
  }
  ObservationVerdict add_observation(const SensedWorld& sensed, double now) {
    return planner_.add_observation(sensed, tell_time(now), &localiser_);
  }
  MessageVerdict add_message(const HeardMessage& message, double now) {
    return planner_.add_message(message, tell_time(now));
  }
  [[nodiscard]] int drive_inputs() const { return drive_.inputs(); }
  /// What the motors were told by the controller's process, at a time. False when they are
  /// refused: not of the present, or none that these motors could run at.
  bool add_command(double time, const DriveInput& wheel_speeds, double now,
                   GuardAction guard = GuardAction::none);
  [[nodiscard]] bool plan_due(double now) { return planner_.plan_due(tell_time(now)); }
  const PlannerOutput& step(double now) { return planner_.step(tell_time(now), &localiser_); }

  [[nodiscard]] PlannerHost& planner() { return planner_; }
  [[nodiscard]] const PlannerHost& planner() const { return planner_; }
  [[nodiscard]] Localiser& localiser() { return localiser_; }
  [[nodiscard]] const Localiser& localiser() const { return localiser_; }
  [[nodiscard]] std::uint32_t clock_jumps() const { return clock_.count(); }

 private:
  double tell_time(double now);

  Drive drive_;
  StepClock clock_;
  Localiser localiser_;
  PlannerHost planner_;
};

class TrackerProcess {
 public:
  TrackerProcess(int robot_id, const AgentParameters& agent, const HostParameters& host)
      : clock_{validated(host).clock_jump}, localiser_{agent, host}, tracker_{robot_id, agent, host} {}

  PoseVerdict add_pose(const PoseMeasurement& pose, double now) {
    const PoseVerdict verdict = localiser_.add_pose(pose, tell_time(now));
    tracker_.note_pose(verdict, now);
    return verdict;
  }
  PlanVerdict add_plan(const TrajectoryMessage& message, double now) {
    return tracker_.add_plan(message, tell_time(now));
  }
  /// For the guard: a scan from its sensor's position in the body. False when it is refused: not of the
  /// present, malformed, or half blind.
  bool add_scan(double time, const RangeScan& scan, const Pose2& sensor_in_body, double now);
  /// As RobotHost::applied.
  void applied(double time, const DriveInput& wheel_speeds) {
    localiser_.applied(std::min(time, clock_.now()), wheel_speeds);
  }
  const TrackerCommand& step(double now) { return tracker_.step(tell_time(now), localiser_); }

  [[nodiscard]] TrackerHost& tracker() { return tracker_; }
  [[nodiscard]] const TrackerHost& tracker() const { return tracker_; }
  [[nodiscard]] Localiser& localiser() { return localiser_; }
  [[nodiscard]] const Localiser& localiser() const { return localiser_; }
  [[nodiscard]] std::uint32_t clock_jumps() const { return clock_.count(); }

 private:
  double tell_time(double now);

  StepClock clock_;
  Localiser localiser_;
  TrackerHost tracker_;
};

}  // namespace spf::host
