// The table of methods, and methods written in Python.
#include <cmath>
#include <exception>
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>

#include "python/planner.hpp"
#include "spf/planning/plan_judge.hpp"
#include "spf/robot/drive.hpp"
#include "spf/team/method_table.hpp"

namespace spf::python {
namespace {

constexpr double kLookAhead = 0.5;  // [s] beyond a plan's end, where its clearance is checked

constexpr double kSameTime = 1e-6;      // [s] between a request and the plan that answers it
constexpr double kSamePosition = 1e-3;  // [m] likewise

/// A Python object that may be copied and dropped on any thread, with or without the lock.
class Held {
 public:
  explicit Held(py::object object)
      : object_{new py::object{std::move(object)}, [](py::object* held) {
                  if (Py_IsInitialized() == 0) return;  // too late: the interpreter has gone
                  const py::gil_scoped_acquire lock;
                  delete held;
                }} {}
  [[nodiscard]] const py::object& get() const { return *object_; }

 private:
  std::shared_ptr<py::object> object_;
};

/// Calls Python from any thread; what it raises is told in words, with the place.
template <class Call>
auto with_lock(const std::string& method, const Call& call) {
  const py::gil_scoped_acquire lock;
  try {
    return call();
  } catch (const py::error_already_set& error) {
    const std::string reason = error.what();
    if (error.matches(PyExc_KeyboardInterrupt)) PyErr_SetInterrupt();  // seen again when the run has ended
    throw std::runtime_error("method " + method + ": " + reason);
  }
}

bool flag_of(const py::object& object, const char* name, bool otherwise) {
  return py::cast<bool>(py::getattr(object, name, py::bool_(otherwise)));
}

/// A planner whose plan() is Python's. The clearance check judges what it returns, as it does other methods'.
class PythonPlanner final : public Planner {
 public:
  PythonPlanner(std::string name, Held planner, const AgentParameters& agent)
      : name_{std::move(name)},
        planner_{std::move(planner)},
        robot_{agent.robot},
        judge_{agent.planner, agent.robot},
        needs_heading_{!Drive{agent.robot}.holonomic()},
        approaches_{flag_of(planner_.get(), "approaches_cut_off_goal", true)},
        passes_{flag_of(planner_.get(), "passes_narrow_gaps", false)} {}

  void plan(const PlanRequest& request, PlanResult& result) override {
    result.clear();
    if (const std::optional<PlanOutcome> refused = refusal(request))
      return stand_instead(request, robot_, *refused, result);
    std::optional<Trajectory> trajectory = with_lock(name_, [&] { return ask(request); });
    if (!trajectory) return stand_instead(request, robot_, PlanOutcome::unsafe, result);
    result.trajectory = std::move(*trajectory);
    result.action = PlanAction::follow;
    judge_.judge(request, result.trajectory.end_time() + kLookAhead, result);
    if (result.outcome == PlanOutcome::unsafe) stand_instead(request, robot_, PlanOutcome::unsafe, result);
  }
  [[nodiscard]] bool approaches_cut_off_goal() const override { return approaches_; }
  [[nodiscard]] bool passes_narrow_gaps() const override { return passes_; }

 private:
  [[nodiscard]] std::optional<Trajectory> ask(const PlanRequest& request) const {
    const py::object view = py::cast(RequestView{request});
    struct Expire {
      RequestView& view;
      ~Expire() { view.expire(); }
    } const expire{view.cast<RequestView&>()};
    const py::object answer = planner_.get().attr("plan")(view);
    if (answer.is_none()) return std::nullopt;
    if (!py::isinstance<Trajectory>(answer))
      refuse("plan()", answer, "must be a Trajectory, or None to stop");
    auto trajectory = answer.cast<Trajectory>();
    if (trajectory.empty()) refuse("plan()", answer, "must have pieces");
    if (!(std::abs(trajectory.start_time() - request.time) <= kSameTime))
      refuse("plan()", answer, "must start at request.time = " + std::to_string(request.time) + " s");
    if (!((trajectory.position(request.time) - request.head.position_world).norm() <= kSamePosition))
      refuse("plan()", answer, "must start at request.position");
    if (needs_heading_ && !trajectory.steered())
      refuse("plan()", answer, "must give the heading of each piece: this robot cannot move sideways");
    return trajectory;
  }

  std::string name_;
  Held planner_;
  RobotParameters robot_;
  PlanJudge judge_;
  bool needs_heading_;
  bool approaches_, passes_;
};

PlannerFactory factory_of(const std::string& name, const py::function& make) {
  return [name, make = Held{make}](const AgentParameters& agent) -> std::unique_ptr<Planner> {
    return with_lock(name, [&]() -> std::unique_ptr<Planner> {
      py::object planner = make.get()(agent);
      if (!py::hasattr(planner, "plan")) refuse("method " + name, planner, "must have a plan(request)");
      return std::make_unique<PythonPlanner>(name, Held{std::move(planner)}, agent);
    });
  };
}

void add(MethodTable& self, const std::string& name, const std::string& what, const py::function& make,
         const std::optional<py::function>& change) {
  Method method{name, what, factory_of(name, make)};
  if (change)
    method.change = [name, change = Held{*change}](AgentParameters& agent) {
      with_lock(name, [&] { change.get()(py::cast(&agent, py::return_value_policy::reference)); });
    };
  self.add(std::move(method));
}

py::dict all(const MethodTable& self) {
  py::dict methods;
  for (const Method& method : self.all()) methods[method.name.c_str()] = method.what;
  return methods;
}

}  // namespace

void bind_methods(py::module_& module) {
  py::class_<MethodTable>(module, "MethodTable", "The built-in methods, and those that you add.")
      .def(py::init<>())
      .def(
          "add", &add, py::arg("name"), py::arg("what"), py::arg("make"), py::arg("change") = py::none(),
          "Adds a method: make(parameters) gives an object for each robot, whose plan(request) returns a\n"
          "Trajectory that starts at request.time, position and velocity and ends at rest, or None to stop.\n"
          "A plan that fails the clearance check is not driven. The object may say passes_narrow_gaps and\n"
          "approaches_cut_off_goal (docs/add_a_method.md). change(parameters) may set some of them.")
      .def_property_readonly("all", &all, "Name and meaning of each, as a dict.")
      .def("__contains__",
           [](const MethodTable& self, const std::string& name) { return self.find(name) != nullptr; });
}

}  // namespace spf::python
