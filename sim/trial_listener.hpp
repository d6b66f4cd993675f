// Observers of a running trial: the recorder of replays, and meters of the caller. Listeners do not change
// the result of a trial. Frame: world, SI.
#pragma once

#include <vector>

#include "host/robot_host.hpp"
#include "sim/contact.hpp"
#include "sim/dynamic_obstacles.hpp"
#include "sim/fleet_event.hpp"
#include "sim/robot_truth.hpp"

namespace spf::sim {

/// State of a trial after the robots have planned and before they move; by robot unless said otherwise.
struct TrialFrame {
  double time = 0.0;   ///< [s]
  double share = 0.0;  ///< of the obstacles' step
  const std::vector<RobotTruth>* robots = nullptr;
  const std::vector<DynamicObstacle>* dynamic_obstacles = nullptr;
  const std::vector<host::RobotHost>* hosts = nullptr;
  const std::vector<DriveInput>* wheel_speeds = nullptr;    ///< [m/s] true
  const std::vector<DriveInput>* wheel_commands = nullptr;  ///< [m/s]
  const std::vector<double>* control_us = nullptr;  ///< [us] of the last control tick, 0 without a clock
  const StaticShapes* shapes = nullptr;
};

/// What a robot was given in one tick before it planned and controlled, in this order.
struct RobotInput {
  PoseMeasurement pose;
  std::vector<HeardMessage> messages;
  std::vector<host::SensedWorld> seen;
};

/// What it did in that tick.
struct RobotAction {
  bool planned = false;        ///< it was decided what to do
  bool asked_planner = false;  ///< for that: not when there was a cause to stop
  bool controlled = false;
  DriveInput wheel_speeds;  ///< commanded, when controlled
};

/// All calls come from the thread that runs the trial, in the order of time.
class TrialListener {
 public:
  virtual ~TrialListener() = default;

  /// Every 0.1 s.
  virtual void frame(const TrialFrame&) {}
  /// At every pose: what a robot was given, and what it did.
  virtual void thought(double /*time*/, int /*robot*/, const RobotInput&, const RobotAction&) {}
  /// A robot has asked its planner, which took `plan_ms` [ms] (0 without a clock); the result is the agent's
  /// last_plan().
  virtual void planned(double /*time*/, const RobotAgent&, double /*plan_ms*/) {}
  /// A robot has controlled, which took `control_us` [us] with the poses since the last time (0 without a
  /// clock).
  virtual void controlled(double /*time*/, int /*robot*/, double /*control_us*/) {}
  /// A robot was to plan but has to stop, for the agent's stop_cause(): its planner was not asked.
  virtual void stopped(double /*time*/, const RobotAgent&) {}
  /// Robots touched something, by time.
  virtual void contact(const Contact&) {}
  /// A recorded person, who does not react, walked into a robot that stood still.
  virtual void hit_while_standing(const Contact&) {}
  /// A robot is told something, or something befalls it.
  virtual void ordered(double /*time*/, const FleetOrder&, const Eigen::Vector2d& /*position_world*/) {}
  virtual void arrived(double /*time*/, int /*robot*/, const Eigen::Vector2d& /*position_world*/) {}
};

}  // namespace spf::sim
