// Trajectories and drives.
#include <memory>
#include <optional>

#include "python/bind.hpp"
#include "spf/robot/drive.hpp"
#include "spf/trajectory/constant_acceleration.hpp"
#include "spf/trajectory/minco.hpp"
#include "spf/trajectory/trajectory.hpp"

namespace spf::python {
namespace {

using Coefficients = Eigen::Matrix<double, 6, 2, Eigen::RowMajor>;

const Trajectory& moving(const Trajectory& trajectory) {
  if (trajectory.empty()) throw std::invalid_argument("the trajectory has no pieces");
  return trajectory;
}

Eigen::Matrix<double, 6, 2> coefficients_from(const py::object& value) {
  const char* const rule = "must be numbers in [-1e9, 1e9] of shape (6, 2)";
  const Numbers numbers = Numbers::ensure(value);
  if (!numbers) PyErr_Clear();
  if (!numbers || numbers.ndim() != 2 || numbers.shape(0) != 6 || numbers.shape(1) != 2)
    refuse("coefficients", value, rule);
  const Coefficients coefficients = Eigen::Map<const Coefficients>{numbers.data()};
  if (!(coefficients.cwiseAbs().maxCoeff() <= 1e9)) refuse("coefficients", value, rule);
  return coefficients;
}

HeadingState heading_from(const py::object& value, const char* key) {
  const std::vector<double> numbers = finite_numbers(value, key, 2);
  return {numbers[0], numbers[1]};
}

void append(Trajectory& self, const py::object& coefficients, const py::object& duration,
            const py::object& heading_from_state, const py::object& heading_to_state) {
  QuinticPiece piece;
  piece.coefficients = coefficients_from(coefficients);
  piece.duration = positive_number(duration, "duration");
  if (self.piece_count() == Trajectory::kMaxPieces)
    throw std::invalid_argument("a trajectory has at most " + std::to_string(Trajectory::kMaxPieces) +
                                " pieces");
  const bool steered = !heading_from_state.is_none();
  if (steered == heading_to_state.is_none())
    throw std::invalid_argument("heading_from and heading_to must both be given, or neither");
  if (!self.empty() && self.steered() != steered)
    throw std::invalid_argument("all pieces or none have a heading of their own");
  if (steered)
    self.append(piece, heading_from(heading_from_state, "heading_from"),
                heading_from(heading_to_state, "heading_to"));
  else
    self.append(piece);
}

Trajectory minimum_jerk(const py::object& points, const py::object& durations, const py::object& start_time,
                        const py::object& velocity, const py::object& end_velocity) {
  const Numbers through = points_from(points, "points");
  const py::ssize_t pieces = through.ndim() == 2 ? through.shape(0) - 1 : 0;
  if (pieces < 1 || pieces > Trajectory::kMaxPieces)
    refuse("points", points, "must be 2 to " + std::to_string(Trajectory::kMaxPieces + 1) + " points (n, 2)");
  const std::vector<double> seconds = finite_numbers(durations, "durations", pieces);
  for (const double duration : seconds)
    if (duration <= 0.0) refuse("durations", durations, "must be greater than 0");
  const Eigen::Map<const Eigen::Matrix2Xd> columns{through.data(), 2, pieces + 1};
  MincoEnds ends;
  ends.head.position_world = columns.col(0);
  ends.head.velocity_world = point_from(velocity, "velocity");
  ends.tail.position_world = columns.col(pieces);
  ends.tail.velocity_world = point_from(end_velocity, "end_velocity");
  Minco minco;
  minco.solve(ends, columns.middleCols(1, pieces - 1),
              Eigen::Map<const Eigen::VectorXd>{seconds.data(), pieces});
  if (!minco.coefficients().allFinite()) refuse("durations", durations, "must not be so extreme");
  return minco.trajectory(finite_number(start_time, "start_time"));
}

py::array_t<double> all_coefficients(const Trajectory& self) {
  py::array_t<double> array({py::ssize_t{self.piece_count()}, py::ssize_t{6}, py::ssize_t{2}});
  for (int i = 0; i < self.piece_count(); ++i)
    Eigen::Map<Coefficients>{array.mutable_data(i, 0, 0)} = self.piece(i).coefficients;
  return array;
}

py::array_t<double> all_durations(const Trajectory& self) {
  py::array_t<double> array(self.piece_count());
  for (int i = 0; i < self.piece_count(); ++i) array.mutable_at(i) = self.piece(i).duration;
  return array;
}

void bind_drive(py::module_& module) {
  py::class_<Drive>(module, "Drive", "What the wheels of a robot can do. Immutable.")
      .def(py::init<const RobotParameters&>(), py::arg("robot") = RobotParameters{})
      .def_property_readonly("inputs", &Drive::inputs, "How many numbers command it.")
      .def_property_readonly("holonomic", &Drive::holonomic, "It may move along and turn at once, every way.")
      .def_property_readonly(
          "lower", [](const Drive& self) { return to_array(self.lower()); }, "Least inputs.")
      .def_property_readonly(
          "upper", [](const Drive& self) { return to_array(self.upper()); }, "Largest inputs.")
      .def(
          "twist_body",
          [](const Drive& self, const py::object& input) {
            const std::vector<double> numbers = finite_numbers(input, "input", self.inputs());
            return to_array(
                self.twist_body(Eigen::Map<const Eigen::VectorXd>(numbers.data(), self.inputs())));
          },
          py::arg("input"),
          "The motion of the body (3,) [m/s, m/s, rad/s] that inputs cause: rim speeds [m/s] of the wheels, "
          "of\n"
          "a car the rim speed and the steering angle [rad].")
      .def(
          "input_for",
          [](const Drive& self, const py::object& twist, const py::object& steering_angle) {
            const std::vector<double> numbers = finite_numbers(twist, "twist_body", 3);
            return to_array(self.input_for(Eigen::Vector3d{numbers[0], numbers[1], numbers[2]},
                                           finite_number(steering_angle, "steering_angle")));
          },
          py::arg("twist_body"), py::arg("steering_angle") = 0.0,
          "Inputs for a motion of the body, perhaps beyond the limits; what it cannot do is left out.")
      .def(
          "saturated",
          [](const Drive& self, const py::object& input) {
            const std::vector<double> numbers = finite_numbers(input, "input", self.inputs());
            return to_array(self.saturated(Eigen::Map<const Eigen::VectorXd>(numbers.data(), self.inputs())));
          },
          py::arg("input"), "Inputs within the limits, scaled so that the path is kept.");
}

/// A motion at times of any shape.
void bind_motion(py::class_<Trajectory>& type) {
  type.def(
          "position",
          [](const Trajectory& self, const Numbers& time) {
            return vector_of_numbers<2>(time, [&self = moving(self)](double t) { return self.position(t); });
          },
          py::arg("time"), "(..., 2) [m] at absolute times [s].")
      .def(
          "velocity",
          [](const Trajectory& self, const Numbers& time) {
            return vector_of_numbers<2>(
                time, [&self = moving(self)](double t) { return self.state(t).velocity_world; });
          },
          py::arg("time"), "(..., 2) [m/s]")
      .def(
          "acceleration",
          [](const Trajectory& self, const Numbers& time) {
            return vector_of_numbers<2>(
                time, [&self = moving(self)](double t) { return self.state(t).acceleration_world; });
          },
          py::arg("time"), "(..., 2) [m/s^2]")
      .def(
          "heading",
          [](const Trajectory& self, const Numbers& time) {
            return vector_of_numbers<2>(time, [&self](double t) {
              const HeadingState state = self.heading_state(t);
              return Eigen::Vector2d{state.heading, state.yaw_rate};
            });
          },
          py::arg("time"), "(..., 2): heading [rad] and yaw rate [rad/s].");
}

void bind_pieces(py::class_<Trajectory>& type) {
  type.def_property_readonly("coefficients", &all_coefficients, "(pieces, 6, 2)")
      .def_property_readonly("durations", &all_durations, "(pieces,) [s]")
      .def_property_readonly("start_time", &Trajectory::start_time, "[s]")
      .def_property_readonly("duration", &Trajectory::duration, "[s]")
      .def_property_readonly("end_time", &Trajectory::end_time, "[s]")
      .def_property_readonly("steered", &Trajectory::steered, "Its pieces have a heading of their own.")
      .def(
          "max_speed", [](const Trajectory& self) { return moving(self).max_speed(); },
          "Largest speed [m/s], by the roots of polynomials.")
      .def(
          "max_acceleration", [](const Trajectory& self) { return moving(self).max_acceleration(); },
          "Largest acceleration [m/s^2], likewise.")
      .def(
          "length", [](const Trajectory& self) { return moving(self).length(); }, "Length of the path [m].")
      .def("__len__", &Trajectory::piece_count)
      .def("__repr__", [](const Trajectory& self) {
        return "<spf.Trajectory from " + std::to_string(self.start_time()) + " to " +
               std::to_string(self.end_time()) + " s, " + std::to_string(self.piece_count()) + " pieces>";
      });
}

}  // namespace

void bind_trajectory(py::module_& module) {
  bind_drive(module);
  py::class_<Trajectory> type(
      module, "Trajectory", "A planned motion: quintic pieces over absolute time, at rest before and after.");
  type.def(py::init([](const py::object& start_time) {
             return Trajectory{finite_number(start_time, "start_time")};
           }),
           py::arg("start_time") = 0.0, "One without pieces, which begins at a time [s].")
      .def_static(
          "standing",
          [](const py::object& position, const py::object& start_time, const py::object& duration) {
            return Trajectory::standing(point_from(position, "position"),
                                        finite_number(start_time, "start_time"),
                                        positive_number(duration, "duration"));
          },
          py::arg("position"), py::arg("start_time") = 0.0, py::arg("duration") = 1.0, "Rests at a position.")
      .def_static(
          "minimum_jerk", &minimum_jerk, py::arg("points"), py::arg("durations"), py::arg("start_time") = 0.0,
          py::arg("velocity") = py::make_tuple(0.0, 0.0), py::arg("end_velocity") = py::make_tuple(0.0, 0.0),
          "Of all curves through points (n + 1, 2) [m] with these durations (n,) [s] between them the one\n"
          "with the least integral of the squared jerk (eq. 5-6).")
      .def(
          "append", &append, py::arg("coefficients"), py::arg("duration"), py::kw_only(),
          py::arg("heading_from") = py::none(), py::arg("heading_to") = py::none(),
          "Adds a piece: coefficients (6, 2) of p(t) = sum_k c_k t^k [m] in its own time, duration [s] > 0.\n"
          "Of a robot that cannot move sideways with (heading [rad], yaw rate [rad/s]) at either end.");
  bind_motion(type);
  bind_pieces(type);
  module.def(
      "constant_acceleration",
      [](const py::object& position, const py::object& velocity, const py::object& end_velocity,
         const py::object& duration) {
        const QuinticPiece piece = constant_acceleration(
            point_from(position, "position"), point_from(velocity, "velocity"),
            point_from(end_velocity, "end_velocity"), positive_number(duration, "duration"));
        py::array_t<double> array({py::ssize_t{6}, py::ssize_t{2}});
        Eigen::Map<Coefficients>{array.mutable_data()} = piece.coefficients;
        return array;
      },
      py::arg("position"), py::arg("velocity"), py::arg("end_velocity"), py::arg("duration"),
      "Coefficients (6, 2) of a piece that goes from one velocity [m/s] to another in a duration [s].");
}

}  // namespace spf::python
