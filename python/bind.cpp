#include "python/bind.hpp"

#include <algorithm>
#include <stdexcept>

#include "spf/math/believable.hpp"

namespace spf::python {
namespace {

template <class Vector>
py::array_t<double> copy_of(const Vector& values) {
  py::array_t<double> array(static_cast<py::ssize_t>(values.size()));
  std::copy(values.data(), values.data() + values.size(), array.mutable_data());
  return array;
}

/// As much of a value as a sentence bears.
std::string short_text(py::handle value) {
  constexpr std::size_t kLongest = 80;
  const std::string text = py::repr(value);
  return text.size() <= kLongest ? text : text.substr(0, kLongest) + "...";
}

Numbers numbers_from(py::handle value, const char* key, const std::string& rule) {
  Numbers numbers = Numbers::ensure(value);
  if (numbers) return numbers;
  PyErr_Clear();
  refuse(key, value, rule);
}

}  // namespace

void refuse(const std::string& key, py::handle value, const std::string& rule) {
  throw std::invalid_argument(key + " = " + short_text(value) + " " + rule);
}

std::vector<double> finite_numbers(py::handle value, const char* key, py::ssize_t count) {
  const std::string rule = "must be " + std::to_string(count) + " numbers in [-1e9, 1e9]";
  const Numbers numbers = numbers_from(value, key, rule);
  std::vector<double> found(numbers.data(), numbers.data() + numbers.size());
  const bool good = std::all_of(found.begin(), found.end(), [](double number) { return believable(number); });
  if (numbers.ndim() != 1 || numbers.size() != count || !good) refuse(key, value, rule);
  return found;
}

double finite_number(py::handle value, const char* key) {
  const std::string rule = "must be a number in [-1e9, 1e9]";
  const Numbers numbers = numbers_from(value, key, rule);
  if (numbers.ndim() != 0 || !believable(*numbers.data())) refuse(key, value, rule);
  return *numbers.data();
}

Eigen::Vector2d point_from(py::handle value, const char* key) {
  const std::vector<double> numbers = finite_numbers(value, key, 2);
  return {numbers[0], numbers[1]};
}

Pose2 pose_from(py::handle value, const char* key) {
  const std::vector<double> numbers = finite_numbers(value, key, 3);
  return {{numbers[0], numbers[1]}, numbers[2]};
}

Numbers points_from(py::handle value, const char* key) {
  const std::string rule = "must hold numbers in [-1e9, 1e9], of shape (..., 2)";
  Numbers points = numbers_from(value, key, rule);
  const bool good = std::all_of(points.data(), points.data() + points.size(),
                                [](double number) { return believable(number); });
  if (points.ndim() < 1 || points.shape(points.ndim() - 1) != 2 || !good) refuse(key, value, rule);
  return points;
}

double positive_number(py::handle value, const char* key) {
  const double number = finite_number(value, key);
  if (number <= 0.0) refuse(key, value, "must be greater than 0");
  return number;
}

py::array_t<double> to_array(const Eigen::Vector2d& point) {
  return copy_of(point);
}
py::array_t<double> to_array(const Eigen::Vector3d& vector) {
  return copy_of(vector);
}
py::array_t<double> to_array(const Pose2& pose) {
  return copy_of(Eigen::Vector3d{pose.position_world.x(), pose.position_world.y(), pose.heading});
}
py::array_t<double> to_array(const DriveInput& input) {
  return copy_of(input);
}

py::array_t<double> to_array(const std::vector<Eigen::Vector2d>& points) {
  py::array_t<double> array({static_cast<py::ssize_t>(points.size()), py::ssize_t{2}});
  double* to = array.mutable_data();
  for (const Eigen::Vector2d& point : points) {
    *to++ = point.x();
    *to++ = point.y();
  }
  return array;
}

std::vector<py::ssize_t> shape_of(const py::array& array, py::ssize_t dropped,
                                  const std::vector<py::ssize_t>& added) {
  std::vector<py::ssize_t> shape(array.shape(), array.shape() + array.ndim() - dropped);
  shape.insert(shape.end(), added.begin(), added.end());
  return shape;
}

}  // namespace spf::python
