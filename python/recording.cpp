// A recorded trial as arrays over its frames.
#include <algorithm>
#include <limits>
#include <map>

#include "python/trial.hpp"

namespace spf::python {
namespace {

using Recorded = std::shared_ptr<const sim::Recording>;
constexpr double kAbsent = std::numeric_limits<double>::quiet_NaN();

py::ssize_t size(std::size_t count) {
  return static_cast<py::ssize_t>(count);
}

/// (frames, robots, width); get(robot) gives a range of numbers. What a robot has fewer of is NaN.
template <class Get>
py::array_t<double> robots_over_frames(const sim::Recording& recording, py::ssize_t width, const Get& get) {
  const py::ssize_t robots = size(recording.scenario.robots.size());
  py::array_t<double> array({size(recording.frames.size()), robots, width});
  double* to = array.mutable_data();
  std::fill(to, to + array.size(), kAbsent);
  for (const sim::RecordedFrame& frame : recording.frames)
    for (const sim::RecordedRobot& robot : frame.robots) {
      const auto values = get(robot);
      std::copy(values.data(), values.data() + std::min<py::ssize_t>(width, values.size()), to);
      to += width;
    }
  return array;
}

Eigen::Vector3d vector_of(const Pose2& pose) {
  return {pose.position_world.x(), pose.position_world.y(), pose.heading};
}

py::ssize_t input_count(const sim::Recording& recording) {
  py::ssize_t most = 0;
  for (const sim::RecordedFrame& frame : recording.frames)
    for (const sim::RecordedRobot& robot : frame.robots)
      most = std::max<py::ssize_t>(most, robot.wheel_speeds.size());
  return most;
}

py::array_t<double> times(const sim::Recording& recording) {
  py::array_t<double> array(size(recording.frames.size()));
  std::transform(recording.frames.begin(), recording.frames.end(), array.mutable_data(),
                 [](const sim::RecordedFrame& frame) { return frame.time; });
  return array;
}

/// What moves, by id, in the order of their ids: the column of each.
std::map<int, std::size_t> obstacle_columns(const sim::Recording& recording) {
  std::map<int, std::size_t> columns;
  for (const sim::RecordedFrame& frame : recording.frames)
    for (const sim::RecordedDynamicObstacle& obstacle : frame.dynamic_obstacles) columns[obstacle.id] = 0;
  std::size_t next = 0;
  for (auto& [id, column] : columns) column = next++;
  return columns;
}

py::dict obstacles(const sim::Recording& recording) {
  const std::map<int, std::size_t> columns = obstacle_columns(recording);
  const py::ssize_t frames = size(recording.frames.size());
  const py::ssize_t count = size(columns.size());
  py::array_t<int> ids(count);
  py::array_t<bool> person(count);
  py::array_t<double> radius(count);
  py::array_t<double> position({frames, count, py::ssize_t{2}});
  py::array_t<double> velocity({frames, count, py::ssize_t{2}});
  std::fill(position.mutable_data(), position.mutable_data() + position.size(), kAbsent);
  std::fill(velocity.mutable_data(), velocity.mutable_data() + velocity.size(), kAbsent);
  py::ssize_t row = 0;
  for (const sim::RecordedFrame& frame : recording.frames) {
    for (const sim::RecordedDynamicObstacle& obstacle : frame.dynamic_obstacles) {
      const py::ssize_t column = size(columns.at(obstacle.id));
      ids.mutable_at(column) = obstacle.id;
      person.mutable_at(column) = obstacle.person;
      radius.mutable_at(column) = obstacle.state.radius;
      for (int axis = 0; axis < 2; ++axis) {
        position.mutable_at(row, column, axis) = obstacle.state.position_world[axis];
        velocity.mutable_at(row, column, axis) = obstacle.state.velocity_world[axis];
      }
    }
    ++row;
  }
  py::dict all;
  all["id"] = ids;
  all["person"] = person;
  all["radius"] = radius;
  all["position"] = position;
  all["velocity"] = velocity;
  return all;
}

py::array_t<double> points_of(const std::vector<sim::RecordedPoint>& points) {
  py::array_t<double> array({size(points.size()), py::ssize_t{3}});
  double* to = array.mutable_data();
  for (const sim::RecordedPoint& point : points) {
    *to++ = point.time;
    *to++ = point.position_world.x();
    *to++ = point.position_world.y();
  }
  return array;
}

py::list plans(const sim::Recording& recording) {
  py::list all;
  for (const sim::RecordedPlan& plan : recording.plans) {
    py::dict entry;
    entry["time"] = plan.time;
    entry["robot"] = plan.robot;
    const bool asked = plan.stop == StopCause::none;
    entry["stop"] = asked ? py::object{py::none()} : py::object{py::str(to_string(plan.stop))};
    entry["outcome"] = asked ? py::object{py::str(to_string(plan.outcome))} : py::object{py::none()};
    entry["risk"] = plan.risk;
    entry["points"] = points_of(plan.points);
    all.append(entry);
  }
  return all;
}

const char* name_of(sim::RecordedEvent::Kind kind) {
  switch (kind) {
    case sim::RecordedEvent::Kind::contact:
      return "contact";
    case sim::RecordedEvent::Kind::hit_while_standing:
      return "hit while standing";
    case sim::RecordedEvent::Kind::stop:
      return "stop";
    case sim::RecordedEvent::Kind::go:
      return "go";
    case sim::RecordedEvent::Kind::arrival:
      return "arrival";
    case sim::RecordedEvent::Kind::order:
      return "order";
  }
  return "?";
}

py::list events(const sim::Recording& recording) {
  py::list all;
  for (const sim::RecordedEvent& event : recording.events) {
    py::dict entry;
    entry["time"] = event.time;
    entry["robot"] = event.robot;
    entry["kind"] = name_of(event.kind);
    entry["text"] = event.text;
    entry["other"] = event.other;
    entry["position"] = to_array(event.position_world);
    all.append(entry);
  }
  return all;
}

}  // namespace

void bind_recording(py::module_& module) {
  py::class_<sim::Recording, std::shared_ptr<sim::Recording>>(
      module, "Recording", "A trial in F frames of 0.1 s, with N robots. Frame: world, SI.")
      .def_property_readonly("time", &times, "(F,) [s]")
      .def_property_readonly(
          "pose",
          [](const sim::Recording& self) {
            return robots_over_frames(self, 3, [](const auto& robot) { return vector_of(robot.pose); });
          },
          "(F, N, 3) true x, y [m], heading [rad]")
      .def_property_readonly(
          "velocity",
          [](const sim::Recording& self) {
            return robots_over_frames(self, 2, [](const auto& robot) { return robot.velocity_world; });
          },
          "(F, N, 2) true [m/s]")
      .def_property_readonly(
          "estimate",
          [](const sim::Recording& self) {
            return robots_over_frames(self, 3,
                                      [](const auto& robot) { return vector_of(robot.estimate.pose_world); });
          },
          "(F, N, 3) where the robots believe to be")
      .def_property_readonly(
          "wheel_speeds",
          [](const sim::Recording& self) {
            return robots_over_frames(self, input_count(self),
                                      [](const auto& robot) { return robot.wheel_speeds; });
          },
          "(F, N, W) true rim speeds [m/s]; of a car rim speed and steering angle [rad]")
      .def_property_readonly(
          "wheel_commands",
          [](const sim::Recording& self) {
            return robots_over_frames(self, input_count(self),
                                      [](const auto& robot) { return robot.wheel_commands; });
          },
          "(F, N, W) the same, as commanded")
      .def_property_readonly(
          "obstacles", &obstacles,
          "What moves, M in all, as a dict: id (M,), person (M,), radius (M,) [m], position\n"
          "(F, M, 2) [m] and velocity (F, M, 2) [m/s], NaN where it is absent.")
      .def_property_readonly("plans", &plans,
                             "Every planning call as a dict: time [s], robot, stop (why the planner was not "
                             "asked, or None),\noutcome, risk, points (k, 3) of time [s], x, y [m].")
      .def_property_readonly("events", &events,
                             "What happened, as dicts: time [s], robot, kind, text, other, position [m].");
}

}  // namespace spf::python
