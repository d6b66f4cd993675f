// One robot as a whole, host::RobotHost, started at its place in a scene.
#pragma once

#include <optional>
#include <vector>

#include "host/robot_host.hpp"
#include "python/bind.hpp"
#include "sim/simulation.hpp"
#include "sim/world.hpp"

namespace spf::python {

class Robot {
 public:
  Robot(const sim::Scenario& scene, const AgentParameters& agent, int number);

  /// Takes in what a stepped world has for it, and steps, without Python.
  host::RobotOutput live(const PoseMeasurement& pose, const std::vector<HeardMessage>& messages,
                         const Observation* observation, double now);

  void add_pose(const py::object& time, const py::object& pose, const py::object& now);
  void add_observation(const Observation& observation, const py::object& now);
  void add_message(const HeardMessage& message, const py::object& now);
  void obey(const sim::FleetOrder& order, const sim::World& world);
  void set_goal(const py::object& goal, const std::optional<double>& heading);
  void cancel() { host_.planner().cancel(); }
  void set_switches(bool paused, bool emergency_stop) { host_.set_switches({emergency_stop, paused}); }
  /// The last command is in wheel_speeds().
  host::RobotOutput step(double now);
  [[nodiscard]] const DriveInput& wheel_speeds() const { return wheel_speeds_; }
  [[nodiscard]] const host::RobotHost& host() const { return host_; }

 private:
  host::RobotHost host_;
  DriveInput wheel_speeds_;
};

}  // namespace spf::python
