// A parameter struct as a Python class: its visit_fields list gives the properties, their documentation and
// their checks, so that names, units and limits stand in one place.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "config/closest_name.hpp"
#include "config/parameter_table.hpp"
#include "config/yaml_reader.hpp"
#include "python/bind.hpp"
#include "python/values.hpp"

namespace spf::python {

/// The value of a field, if it may be one. Throws by refuse(), naming key, value and limit.
void assign_number(py::handle from, const std::string& key, const char* unit, Range range, double& value);
void assign_number(py::handle from, const std::string& key, const char* unit, Range range, int& value);
void assign_points(py::handle from, const std::string& key, const char* unit, Range range,
                   std::vector<Eigen::Vector2d>& points);
/// As a list, which compares, and prints, as the other values do.
[[nodiscard]] std::vector<std::array<double, 2>> pairs_of(const std::vector<Eigen::Vector2d>& points);
void assign_choice(py::handle from, const std::string& key, bool& value);
/// Index of a name.
[[nodiscard]] std::size_t name_index(py::handle from, const std::string& key,
                                     const std::vector<std::string>& names);
template <class E, class = decltype(EnumNames<E>::values)>
void assign_choice(py::handle from, const std::string& key, E& value) {
  std::vector<std::string> names;
  for (const auto& entry : EnumNames<E>::values) names.emplace_back(entry.second);
  value = EnumNames<E>::values[name_index(from, key, names)].first;
}

/// Throws std::invalid_argument: "FieldParameters has no field 'atention'; did you mean attention?"
[[noreturn]] void refuse_name(const std::string& type, const std::string& name,
                              const std::vector<std::string>& known);

/// Sets attributes by name.
void set_attributes(py::handle object, const py::dict& values);

/// {name: value}, groups as dicts in it.
[[nodiscard]] py::dict attributes_of(py::handle object, const std::vector<std::string>& names);

/// Defines a property for every field of T that its visit_fields names.
template <class T>
class PropertyMaker {
 public:
  PropertyMaker(py::class_<T>& type, const T& sample)
      : type_{type}, sample_{sample}, type_name_{py::str(type.attr("__name__"))} {}

  template <class Number>
  void operator()(const char* name, const Number& value, const char* unit, Range range, const char* what) {
    const std::ptrdiff_t offset = offset_of(value);
    const std::string key = type_name_ + "." + name;
    const std::string text = std::string{what} + " [" + unit + "], " + to_text(range);
    type_.def_property(
        name, [offset](const T& self) { return to_python(member<Number>(self, offset)); },
        [offset, key, unit = std::string{unit}, range](T& self, const py::object& from) {
          assign_number(from, key, unit.c_str(), range, member<Number>(self, offset));
        },
        text.c_str());
    names_.emplace_back(name);
  }
  template <class Choice>
  void operator()(const char* name, const Choice& value, const char* what) {
    const std::ptrdiff_t offset = offset_of(value);
    const std::string key = type_name_ + "." + name;
    const std::string text = std::string{what} + "; " + choices_of(value);
    type_.def_property(
        name, [offset](const T& self) { return to_python(member<Choice>(self, offset)); },
        [offset, key](T& self, const py::object& from) {
          assign_choice(from, key, member<Choice>(self, offset));
        },
        text.c_str());
    names_.emplace_back(name);
  }
  void values(const char* name, const std::vector<Eigen::Vector2d>& points, const char* unit, Range range,
              const char* what) {
    const std::ptrdiff_t offset = offset_of(points);
    const std::string key = type_name_ + "." + name;
    const std::string text = std::string{what} + "; points [" + unit + "], list of " + to_text(range);
    type_.def_property(
        name,
        [offset](const T& self) { return pairs_of(member<std::vector<Eigen::Vector2d>>(self, offset)); },
        [offset, key, unit = std::string{unit}, range](T& self, const py::object& from) {
          assign_points(from, key, unit.c_str(), range, member<std::vector<Eigen::Vector2d>>(self, offset));
        },
        text.c_str());
    names_.emplace_back(name);
  }
  template <class Nested>
  void group(const char* name, const Nested& nested) {
    const std::ptrdiff_t offset = offset_of(nested);
    const std::string text = "a group: " + std::string{py::str(py::type::of<Nested>().attr("__name__"))} +
                             "; of a dict it takes the fields that it names";
    const std::string key = type_name_ + "." + name;
    type_.def_property(
        name,
        py::cpp_function([offset](T& self) -> Nested& { return member<Nested>(self, offset); },
                         py::return_value_policy::reference_internal),
        [offset, key](T& self, const py::object& from) {
          Nested& own = member<Nested>(self, offset);
          if (py::isinstance<py::dict>(from))
            set_attributes(py::cast(&own, py::return_value_policy::reference),
                           py::reinterpret_borrow<py::dict>(from));
          else if (py::isinstance<Nested>(from))
            own = from.cast<const Nested&>();
          else
            refuse(
                key, from,
                "must be a " + std::string{py::str(py::type::of<Nested>().attr("__name__"))} + " or a dict");
        },
        text.c_str());
    names_.emplace_back(name);
  }
  [[nodiscard]] std::vector<std::string> names() const { return names_; }

 private:
  template <class Value>
  [[nodiscard]] std::ptrdiff_t offset_of(const Value& value) const {
    return reinterpret_cast<const char*>(&value) - reinterpret_cast<const char*>(&sample_);
  }
  template <class Value>
  [[nodiscard]] static const Value& member(const T& self, std::ptrdiff_t offset) {
    return *reinterpret_cast<const Value*>(reinterpret_cast<const char*>(&self) + offset);
  }
  template <class Value>
  [[nodiscard]] static Value& member(T& self, std::ptrdiff_t offset) {
    return *reinterpret_cast<Value*>(reinterpret_cast<char*>(&self) + offset);
  }

  py::class_<T>& type_;
  const T& sample_;
  std::string type_name_;
  std::vector<std::string> names_;
};

/// The class of a struct; its groups' classes come first. `make` gives the defaults.
template <class T, class Make>
void bind_parameter_class(py::module_& module, const char* name, const char* doc, const Make& make) {
  py::class_<T> type(module, name, doc);
  const T sample = make();
  PropertyMaker<T> maker{type, sample};
  T::visit_fields(sample, maker);
  const std::vector<std::string> names = maker.names();
  type.def(py::init([make, names](const py::kwargs& values) {
             auto made = std::make_unique<T>(make());
             set_attributes(py::cast(made.get(), py::return_value_policy::reference), values);
             return made;
           }),
           "The defaults, but for the fields that are named.");
  type.def("__setattr__", [names](const py::object& self, const std::string& field, const py::object& value) {
    if (std::find(names.begin(), names.end(), field) == names.end())
      refuse_name(py::str(py::type::of(self).attr("__name__")), field, names);
    const py::str key{field};
    if (PyObject_GenericSetAttr(self.ptr(), key.ptr(), value.ptr()) != 0) throw py::error_already_set{};
  });
  type.def(
      "to_dict", [names](const py::object& self) { return attributes_of(self, names); },
      "Every field with its value, groups as dicts.");
  type.def(
      "rows", [](const T& self) { return parameter_rows(self); },
      "Every field with value, unit, limits and meaning.");
  type.def("__eq__", [names](const py::object& self, const py::object& other) {
    return py::isinstance<T>(other) && attributes_of(self, names).equal(attributes_of(other, names));
  });
  type.attr("__hash__") = py::none();
  type.def("__copy__", [](const T& self) { return T{self}; });
  type.def("__deepcopy__", [](const T& self, const py::dict&) { return T{self}; });
  type.def("__repr__", [names](const py::object& self) {
    return std::string{py::str(py::type::of(self).attr("__name__"))} + "(**" +
           std::string{py::repr(attributes_of(self, names))} + ")";
  });
  type.def(py::pickle([names](const py::object& self) { return attributes_of(self, names); },
                      [make, names](const py::dict& values) {
                        T made = make();
                        set_attributes(py::cast(&made, py::return_value_policy::reference), values);
                        return made;
                      }));
}

}  // namespace spf::python
