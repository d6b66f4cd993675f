#include <algorithm>

#include "experiments/parameter_page.hpp"
#include "python/parameter_class.hpp"
#include "spf/robot/footprint.hpp"
#include "spf/team/agent_parameters.hpp"

namespace spf::python {
namespace {

template <class T>
void bind_defaults(py::module_& module, const char* name, const char* doc) {
  bind_parameter_class<T>(module, name, doc, [] { return T{}; });
}

void bind_rows(py::module_& module) {
  py::class_<ParameterRow>(module, "ParameterRow", "What there is to know of one key of a scenario file.")
      .def_readonly("key", &ParameterRow::key, "Path of the key, as \"sensing.range\".")
      .def_readonly("value", &ParameterRow::value, "Its value, as files write it.")
      .def_readonly("unit", &ParameterRow::unit, "\"m\"; \"1\" of pure numbers, empty of choices and text.")
      .def_readonly("range", &ParameterRow::range, "Its limits, or the names to choose from.")
      .def_readonly("what", &ParameterRow::what, "What it means.")
      .def_readonly("follows", &ParameterRow::follows,
                    "The property of the robot that the default follows, or empty.")
      .def("__repr__", [](const ParameterRow& row) {
        return "<" + row.key + " = " + row.value + (row.unit.empty() ? "" : " [" + row.unit + "]") + ", " +
               row.range + ": " + row.what + ">";
      });
  module.def(
      "all_parameters", &all_parameters,
      "Every key that a scenario file may have, with the defaults of family t2 and the default method.");
}

}  // namespace

void assign_number(py::handle from, const std::string& key, const char* unit, Range range, double& value) {
  const double number = py::isinstance<py::str>(from) ? -1.0 : PyFloat_AsDouble(from.ptr());
  const bool none = PyErr_Occurred() != nullptr || py::isinstance<py::str>(from);
  PyErr_Clear();
  if (none) refuse(key, from, "must be a number");
  if (!range.contains(number)) refuse(key, from, limit_sentence(range, unit));
  value = number;
}

void assign_number(py::handle from, const std::string& key, const char* unit, Range range, int& value) {
  const py::object index = py::reinterpret_steal<py::object>(PyNumber_Index(from.ptr()));
  PyErr_Clear();
  if (!index) refuse(key, from, "must be a whole number");
  const double number = PyFloat_AsDouble(index.ptr());  // infinite sizes fail
  PyErr_Clear();
  if (!range.contains(number)) refuse(key, from, limit_sentence(range, unit));
  value = static_cast<int>(number);
}

void assign_points(py::handle from, const std::string& key, const char* unit, Range range,
                   std::vector<Eigen::Vector2d>& points) {
  if (py::isinstance<py::sequence>(from) && py::len(from) == 0) {
    points.clear();
    return;
  }
  const Numbers numbers = points_from(from, key.c_str());
  if (numbers.ndim() > 2 || numbers.size() > 2 * static_cast<py::ssize_t>(Footprint::kMostCorners))
    refuse(key, from, "must be at most " + std::to_string(Footprint::kMostCorners) + " points");
  std::vector<Eigen::Vector2d> found;
  for (py::ssize_t i = 0; i + 1 < numbers.size(); i += 2) {
    found.emplace_back(numbers.data()[i], numbers.data()[i + 1]);
    for (const double coordinate : {found.back().x(), found.back().y()})
      if (!range.contains(coordinate)) refuse(key, from, limit_sentence(range, unit));
  }
  points = std::move(found);
}

std::vector<std::array<double, 2>> pairs_of(const std::vector<Eigen::Vector2d>& points) {
  std::vector<std::array<double, 2>> pairs;
  for (const Eigen::Vector2d& point : points) pairs.push_back({point.x(), point.y()});
  return pairs;
}

void assign_choice(py::handle from, const std::string& key, bool& value) {
  const bool numpy = py::hasattr(from, "dtype") && py::str(from.attr("dtype")).cast<std::string>() == "bool";
  if (!py::isinstance<py::bool_>(from) && !numpy) refuse(key, from, "must be True or False");
  value = py::bool_(py::reinterpret_borrow<py::object>(from));
}

std::size_t name_index(py::handle from, const std::string& key, const std::vector<std::string>& names) {
  const std::string name = py::isinstance<py::str>(from) ? from.cast<std::string>() : "";
  const auto found = std::find(names.begin(), names.end(), name);
  if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
  std::string all;
  for (const std::string& known : names) all += (all.empty() ? "" : ", ") + known;
  const std::optional<std::string> meant = closest_name(name, names);
  refuse(key, from, "must be one of " + all + (meant ? "; did you mean " + *meant + "?" : ""));
}

void refuse_name(const std::string& type, const std::string& name, const std::vector<std::string>& known) {
  const std::optional<std::string> meant = closest_name(name, known);
  throw std::invalid_argument(type + " has no field '" + name + "'" +
                              (meant ? "; did you mean " + *meant + "?" : ""));
}

void set_attributes(py::handle object, const py::dict& values) {
  for (const auto& [key, value] : values) py::setattr(object, key, value);
}

py::dict attributes_of(py::handle object, const std::vector<std::string>& names) {
  py::dict values;
  for (const std::string& name : names) {
    const py::object value = object.attr(name.c_str());
    values[name.c_str()] = py::hasattr(value, "to_dict") ? py::object{value.attr("to_dict")()} : value;
  }
  return values;
}

void bind_parameters(py::module_& module) {
  bind_rows(module);
  bind_defaults<RobotParameters>(module, "RobotParameters", "Size, limits and drive of a robot.");
  bind_defaults<FieldParameters>(module, "FieldParameters",
                                 "How a moving obstacle is spread into a field (eq. 1-4).");
  bind_defaults<CostWeights>(module, "CostWeights", "Weights of the paper's cost (eq. 9).");
  bind_defaults<PlannerParameters>(module, "PlannerParameters", "The paper's planner, and margins of all.");
  bind_defaults<CostToGoParameters>(module, "CostToGoParameters", "The cost-to-go around static shapes.");
  bind_defaults<SpaceTimeParameters>(module, "SpaceTimeParameters", "The space-time planner.");
  bind_defaults<OrcaParameters>(module, "OrcaParameters", "Optimal reciprocal collision avoidance.");
  bind_defaults<ObserverParameters>(module, "ObserverParameters", "The pose observer (eq. 17).");
  bind_defaults<ReferenceParameters>(module, "ReferenceParameters", "The MPC's reference (eq. 18).");
  bind_defaults<MpcParameters>(module, "MpcParameters", "The model predictive controller (eq. 19).");
  bind_defaults<TrackerParameters>(module, "TrackerParameters", "Observer, reference and MPC.");
  bind_defaults<TeamParameters>(module, "TeamParameters", "When a robot plans, and what it tells its peers.");
  bind_defaults<SightParameters>(module, "SightParameters", "What a robot cannot see.");
  bind_defaults<PerceptionParameters>(module, "PerceptionParameters", "Moving obstacles in range scans.");
  bind_defaults<DiffusionParameters>(module, "DiffusionParameters", "How fast tracks become uncertain.");
  bind_defaults<ObstacleTrackerParameters>(module, "ObstacleTrackerParameters",
                                           "Tracks of moving obstacles.");
  bind_defaults<PeerTableParameters>(module, "PeerTableParameters", "Belief about teammates.");
  bind_parameter_class<AgentParameters>(module, "AgentParameters",
                                        "Everything that can be set about one robot.",
                                        [] { return defaults_for(RobotParameters{}); });
  module.def("defaults_for", &defaults_for, py::arg("robot"),
             "The defaults for a robot: what follows its size, speed or acceleration is scaled.");
}

}  // namespace spf::python
