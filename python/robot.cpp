#include "python/robot.hpp"

#include <cmath>
#include <utility>

#include "sim/fleet_order.hpp"
#include "spf/math/index.hpp"

namespace spf::python {
namespace {

Detection detection_from(const py::handle item, int id) {
  const std::vector<double> numbers = finite_numbers(item, "detections", 5);
  Detection detection;
  detection.id = id;
  detection.position_world = {numbers[0], numbers[1]};
  detection.velocity_world = Eigen::Vector2d{numbers[2], numbers[3]};
  if (numbers[4] <= 0.0) refuse("detections", item, "must end with a radius greater than 0 m");
  detection.radius = numbers[4];
  return detection;
}

Observation make_observation(const py::object& time, const py::list& detections) {
  Observation observation;
  observation.time = finite_number(time, "time");
  for (const py::handle item : detections)
    observation.detections.push_back(detection_from(item, static_cast<int>(observation.detections.size())));
  return observation;
}

py::array_t<double> detections_of(const Observation& self) {
  py::array_t<double> array({static_cast<py::ssize_t>(self.detections.size()), py::ssize_t{5}});
  double* to = array.mutable_data();
  for (const Detection& detection : self.detections) {
    const Eigen::Vector2d velocity =
        detection.velocity_world.value_or(Eigen::Vector2d::Constant(std::nan("")));
    for (const double number : {detection.position_world.x(), detection.position_world.y(), velocity.x(),
                                velocity.y(), detection.radius})
      *to++ = number;
  }
  return array;
}

py::object ranges_of(const Observation& self) {
  if (!self.scan) return py::none();
  return py::array_t<double>(static_cast<py::ssize_t>(self.scan->ranges.size()), self.scan->ranges.data());
}

py::dict status_of(const Robot& self) {
  const host::PlannerStatus status = self.host().planner().status();
  py::dict found;
  found["reason"] = status.reason;
  found["blocking_id"] = status.blocking_id;
  return found;
}

py::dict output_of(const Robot& self, const host::RobotOutput& output) {
  py::dict found;
  found["planned"] = output.planned;
  found["wheel_speeds"] = to_array(self.wheel_speeds());
  if (output.broadcast)
    found["broadcast"] = *output.broadcast;
  else
    found["broadcast"] = py::none();
  return found;
}

}  // namespace

Robot::Robot(const sim::Scenario& scene, const AgentParameters& fleet, int number)
    : host_{number, sim::agent_parameters_for(scene, fleet),
            sim::host_parameters_for(scene, sim::agent_parameters_for(scene, fleet))},
      wheel_speeds_{Drive{scene.robot_of(static_cast<std::size_t>(number))}.standstill()} {
  const sim::RobotTask& task = scene.robots[static_cast<std::size_t>(number)];
  host_.planner().set_goal({task.goal_world, task.goal_heading});
  host_.start(sim::robot_map(scene), task.start, 0.0);
}

void Robot::add_pose(const py::object& time, const py::object& pose, const py::object& now) {
  host_.add_pose({finite_number(time, "time"), pose_from(pose, "pose")}, finite_number(now, "now"));
}

void Robot::add_observation(const Observation& observation, const py::object& now) {
  host_.add_observation({observation, true}, finite_number(now, "now"));
}

void Robot::add_message(const HeardMessage& message, const py::object& now) {
  host_.add_message(message, finite_number(now, "now"));
}

void Robot::obey(const sim::FleetOrder& order, const sim::World& world) {
  if (order.act != sim::FleetAct::join && order.act != sim::FleetAct::repair)
    return sim::obey(order, world, *host_.planner().given_map(), host_);
  wheel_speeds_ = Drive{world.scenario().robot_of(as_index(order.robot))}.standstill();
  sim::obey(order, world, sim::robot_map(world.scenario()), host_);
}

void Robot::set_goal(const py::object& goal, const std::optional<double>& heading) {
  if (heading && !std::isfinite(*heading)) refuse("heading", py::float_(*heading), "must be finite, or None");
  if (!host_.planner().set_goal({point_from(goal, "goal"), heading}))
    refuse("goal", goal, "lies beyond all robots");
}

host::RobotOutput Robot::live(const PoseMeasurement& pose, const std::vector<HeardMessage>& messages,
                              const Observation* observation, double now) {
  host_.add_pose(pose, now);
  for (const HeardMessage& message : messages) host_.add_message(message, now);
  if (observation != nullptr) host_.add_observation({*observation, true}, now);
  return step(now);
}

host::RobotOutput Robot::step(double now) {
  host::RobotOutput output = host_.step(now);
  if (output.controlled) wheel_speeds_ = output.wheel_speeds;
  return output;
}

void bind_robot(py::module_& module) {
  py::class_<Observation>(module, "Observation", "What a robot has seen around it at one instant.")
      .def(py::init(&make_observation), py::arg("time"), py::arg("detections"),
           "Rows x, y [m], velocity x, y [m/s], radius [m] of what moves, at a time [s].")
      .def_readonly("time", &Observation::time, "[s]")
      .def_property_readonly("detections", &detections_of,
                             "(n, 5): x, y [m], velocity x, y [m/s] (NaN: unknown), radius [m].")
      .def_property_readonly(
          "ranges", &ranges_of,
          "(beams,) [m] of a sweep of the range sensor, infinite without a return; or None.");
  py::class_<HeardMessage>(module, "Message", "A robot's broadcast to its peers.")
      .def_property_readonly(
          "robot_id", [](const HeardMessage& self) { return self->robot_id; }, "Whose it is.")
      .def_property_readonly(
          "sent_time", [](const HeardMessage& self) { return self->sent_time; }, "[s]")
      .def_property_readonly(
          "trajectory", [](const HeardMessage& self) { return Trajectory{self->trajectory}; },
          "What it is going to do.");
  py::class_<Robot>(
      module, "Robot",
      "One robot as a whole: localiser, planner and controller with their guards; see World.robot().")
      .def("add_pose", &Robot::add_pose, py::arg("time"), py::arg("pose"), py::arg("now"),
           "A pose (3,) measured at a time [s], taken in `now` [s].")
      .def("add_observation", &Robot::add_observation, py::arg("observation"), py::arg("now"),
           "What it sees, taken in `now` [s].")
      .def("add_message", &Robot::add_message, py::arg("message"), py::arg("now"),
           "What it hears, taken in `now` [s].")
      .def(
          "step",
          [](Robot& self, const py::object& now) {
            const double time = finite_number(now, "now");
            return output_of(self, self.step(time));
          },
          py::arg("now"),
          "Plans and controls where due, as a dict: wheel_speeds (inputs,) to hold until the next, planned,\n"
          "broadcast (a Message for the peers, or None).")
      .def("set_goal", &Robot::set_goal, py::arg("goal"), py::arg("heading") = py::none(),
           "Another goal (2,) [m] from now on, with a heading [rad] or any.")
      .def("cancel", &Robot::cancel, "No goal any more: it brakes and stands.")
      .def("set_switches", &Robot::set_switches, py::arg("paused"), py::arg("emergency_stop") = false,
           "What makes it stand until it is taken back.")
      .def_property_readonly("status", &status_of,
                             "How it stands, as a dict: reason, blocking_id (-1: none).")
      .def_property_readonly(
          "trajectory",
          [](const Robot& self) {
            const RobotAgent* agent = self.host().planner().agent();
            return agent == nullptr ? std::nullopt : std::optional<Trajectory>{agent->committed()};
          },
          "The plan that it follows; None while it starts afresh, as after a jump of its clock.");
}

}  // namespace spf::python
