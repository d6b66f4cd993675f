// Values of parameters as Python knows them: numbers, texts, None; an enumerator is its name.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "config/method_choice.hpp"
#include "python/bind.hpp"
#include "spf/math/parameters.hpp"

namespace spf::python {

[[nodiscard]] inline py::object to_python(bool value) {
  return py::bool_(value);
}
[[nodiscard]] inline py::object to_python(int value) {
  return py::int_(value);
}
[[nodiscard]] inline py::object to_python(std::uint64_t value) {
  return py::int_(value);
}
[[nodiscard]] inline py::object to_python(double value) {
  return py::float_(value);
}
[[nodiscard]] inline py::object to_python(const std::string& value) {
  return py::str(value);
}
[[nodiscard]] inline py::object to_python(const std::optional<double>& value) {
  return value ? py::object{py::float_(*value)} : py::object{py::none()};
}
[[nodiscard]] inline py::object to_python(const Eigen::Vector2d& value) {
  return to_array(value);
}
[[nodiscard]] inline py::object to_python(const std::optional<Eigen::Vector2d>& value) {
  return value ? py::object{to_array(*value)} : py::object{py::none()};
}
[[nodiscard]] inline py::object to_python(const MethodChoice& value) {
  return py::str(value.name());
}
template <class E, class = decltype(EnumNames<E>::values)>
[[nodiscard]] py::object to_python(E value) {
  return py::str(enum_name(value));
}

}  // namespace spf::python
