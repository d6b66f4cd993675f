// What the parts of the Python module share: their order, and how arrays and errors cross the border.
// Arrays that come in are copied; what goes out is an array of its own. Frame: world, SI. Python's lock is
// released where a trial or a campaign runs, on values that nothing can change; objects that change keep it.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <Eigen/Core>

#include <string>
#include <vector>

#include "spf/math/pose2.hpp"
#include "spf/robot/drive.hpp"

namespace spf::python {

namespace py = pybind11;

/// What numpy makes an array of doubles of.
using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;

// One function a subject, called in this order: a signature names only what was bound before.
void bind_parameters(py::module_& module);
void bind_trajectory(py::module_& module);
void bind_field(py::module_& module);
void bind_map(py::module_& module);
void bind_tracking(py::module_& module);
void bind_planner(py::module_& module);
void bind_methods(py::module_& module);
void bind_standalone_planner(py::module_& module);
void bind_scenario(py::module_& module);
void bind_trial(py::module_& module);
void bind_campaign(py::module_& module);
void bind_robot(py::module_& module);
void bind_world(py::module_& module);

/// std::invalid_argument, a ValueError in Python: "goal = [1] must be 2 numbers".
[[noreturn]] void refuse(const std::string& key, py::handle value, const std::string& rule);

// Numbers from Python are finite and of a size to compute with (spf/math/believable.hpp), or refused.
/// `count` numbers. Throws by refuse().
[[nodiscard]] std::vector<double> finite_numbers(py::handle value, const char* key, py::ssize_t count);
/// A number. Throws by refuse().
[[nodiscard]] double finite_number(py::handle value, const char* key);
/// A number > 0. Throws by refuse().
[[nodiscard]] double positive_number(py::handle value, const char* key);
/// Two numbers [m].
[[nodiscard]] Eigen::Vector2d point_from(py::handle value, const char* key);
/// Three numbers: x, y [m], heading [rad].
[[nodiscard]] Pose2 pose_from(py::handle value, const char* key);
/// Points of shape (..., 2). Throws by refuse().
[[nodiscard]] Numbers points_from(py::handle value, const char* key);

[[nodiscard]] py::array_t<double> to_array(const Eigen::Vector2d& point);
[[nodiscard]] py::array_t<double> to_array(const Eigen::Vector3d& vector);
[[nodiscard]] py::array_t<double> to_array(const Pose2& pose);
[[nodiscard]] py::array_t<double> to_array(const DriveInput& input);
/// (n, 2)
[[nodiscard]] py::array_t<double> to_array(const std::vector<Eigen::Vector2d>& points);

/// The shape of `array` without its last `dropped` axes, and with `added` ones.
[[nodiscard]] std::vector<py::ssize_t> shape_of(const py::array& array, py::ssize_t dropped,
                                                const std::vector<py::ssize_t>& added);

/// f(point) for points of shape (..., 2): an array of shape (...).
template <class Function>
[[nodiscard]] py::object number_of_points(py::handle value, const char* key, const Function& function) {
  const Numbers points = points_from(value, key);
  py::array_t<double> result(shape_of(points, 1, {}));
  const double* from = points.data();
  double* to = result.mutable_data();
  for (py::ssize_t i = 0; i < result.size(); ++i)
    to[i] = function(Eigen::Vector2d{from[2 * i], from[2 * i + 1]});
  return result.ndim() == 0 ? py::object{py::float_(to[0])} : py::object{result};
}

/// Likewise a vector of `Rows` numbers for each point.
template <int Rows, class Function>
[[nodiscard]] py::array_t<double> vector_of_points(py::handle value, const char* key,
                                                   const Function& function) {
  const Numbers points = points_from(value, key);
  py::array_t<double> result(shape_of(points, 1, {Rows}));
  const double* from = points.data();
  double* to = result.mutable_data();
  for (py::ssize_t i = 0; 2 * i < points.size(); ++i)
    Eigen::Map<Eigen::Matrix<double, Rows, 1>>{to + Rows* i} =
        function(Eigen::Vector2d{from[2 * i], from[2 * i + 1]});
  return result;
}

/// f(number) for an array of any shape (...): an array of shape (..., Rows).
template <int Rows, class Function>
[[nodiscard]] py::array_t<double> vector_of_numbers(const Numbers& numbers, const Function& function) {
  py::array_t<double> result(shape_of(numbers, 0, {Rows}));
  const double* from = numbers.data();
  double* to = result.mutable_data();
  for (py::ssize_t i = 0; i < numbers.size(); ++i)
    Eigen::Map<Eigen::Matrix<double, Rows, 1>>{to + Rows* i} = function(from[i]);
  return result;
}

}  // namespace spf::python
