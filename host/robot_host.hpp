// One robot as a whole, in one process: what it measures, senses and hears goes in, wheel speeds and its
// broadcast come out. A Localiser says where it is, PlannerHost plans, TrackerHost drives; one gate judges
// the poses, one clock the time. A robot whose planner and controller are processes of their own is the same
// parts, split (split_host.hpp). One thread at a time. Frame: world (the fleet's); times are the host's [s].
#pragma once

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <optional>

#include "host/planner_host.hpp"
#include "host/step_clock.hpp"
#include "host/tracker_host.hpp"

namespace spf::host {

/// How the robot is moved.
enum class Motion {
  by_wheels,   ///< by the wheel speeds that it commands; poses are measured
  as_planned,  ///< exactly as it plans, by somebody else: it needs no poses, and its wheels are never asked.
};

/// After a step.
struct RobotOutput {
  bool planned = false;                   ///< a plan was made in this step
  bool controlled = false;                ///< `wheel_speeds` was renewed in this step
  DriveInput wheel_speeds;                ///< held until the next
  std::optional<HeardMessage> broadcast;  ///< for the peers, when there is something to tell
};

class RobotHost {
 public:
  /// As PlannerHost, whose map and goal are to be set too.
  RobotHost(int robot_id, const AgentParameters& agent, const HostParameters& host,
            Motion motion = Motion::by_wheels, std::uint32_t first_sequence = 0);

  /// Starts at once (PlannerHost::start).
  void start(const OccupancyMap& map, const Pose2& pose_world, double now);

  PoseVerdict add_pose(const PoseMeasurement& pose, double now);
  ObservationVerdict add_observation(const SensedWorld& sensed, double now);
  MessageVerdict add_message(const HeardMessage& message, double now);
  void set_switches(const Switches& switches);
  /// Told when the base did not do what the last control tick commanded: a limit on the way to its motors, or
  /// a switch of its own. Rim speeds [m/s] from a time on.
  void applied(double time, const DriveInput& wheel_speeds) {
    localiser_.applied(std::min(time, clock_.now()), wheel_speeds);
  }

  /// Plans and controls where due. Call it at the rate of the poses or faster; a call right after an
  /// observation plans with it sooner.
  RobotOutput step(double now);

  // Its halves, for hosts that time them: first plan(), then control() where it is due.
  const PlannerOutput& plan(double now);
  [[nodiscard]] bool control_due(double now) const;
  const TrackerCommand& control(double now);

  [[nodiscard]] PlannerHost& planner() { return planner_; }
  [[nodiscard]] const PlannerHost& planner() const { return planner_; }
  [[nodiscard]] const TrackerHost& tracker() const { return tracker_; }
  [[nodiscard]] Localiser& localiser() { return localiser_; }
  [[nodiscard]] const Localiser& localiser() const { return localiser_; }
  [[nodiscard]] std::uint32_t clock_jumps() const { return clock_.count(); }
  /// Requires that it has started (planner().agent() is null before, and while it starts afresh).
  [[nodiscard]] const RobotAgent& agent() const {
    assert(planner_.agent() != nullptr);
    return *planner_.agent();
  }

 private:
  double tell_time(double now);
  [[nodiscard]] const Localiser* localiser_of_plan() const {
    return motion_ == Motion::by_wheels ? &localiser_ : nullptr;
  }

  Motion motion_;
  double control_period_;  // [s]
  StepClock clock_;
  Localiser localiser_;
  PlannerHost planner_;
  TrackerHost tracker_;
  double next_control_time_ = kNever;  // [s]
  double last_time_ = kNever;          // [s] of the last call
};

}  // namespace spf::host
