// The compiled half of the Python package (docs/python.md).
#include "config/input_problem.hpp"
#include "python/bind.hpp"

PYBIND11_MODULE(_core, module) {
  namespace py = pybind11;
  using namespace spf::python;
  module.doc() = "Safety probability field and extended-state MPC planner for robot fleets.";
  module.attr("__version__") = SPF_VERSION;
  py::register_exception<spf::InputError>(module, "InputError", PyExc_ValueError);
  module.attr("InputError").attr("__doc__") =
      "A file that cannot be used: every problem on a line, with file, line, key, value and limit.";
  bind_parameters(module);
  bind_trajectory(module);
  bind_field(module);
  bind_map(module);
  bind_tracking(module);
  bind_planner(module);
  bind_methods(module);
  bind_standalone_planner(module);
  bind_scenario(module);
  bind_trial(module);
  bind_campaign(module);
  bind_robot(module);
  bind_world(module);
}
