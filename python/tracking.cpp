// From a plan to wheel speeds: reference (eq. 18), model predictive controller (eq. 19), and both with the
// observer as one tracker.
#include <memory>
#include <utility>

#include "python/bind.hpp"
#include "spf/localisation/motion_estimator.hpp"
#include "spf/tracking/trajectory_controller.hpp"

namespace spf::python {
namespace {

Eigen::Vector3d vector3_from(const py::object& value, const char* key) {
  const std::vector<double> numbers = finite_numbers(value, key, 3);
  return {numbers[0], numbers[1], numbers[2]};
}

DriveInput input_from(const py::object& value, const char* key, const Drive& drive) {
  if (value.is_none()) return drive.standstill();
  const std::vector<double> numbers = finite_numbers(value, key, drive.inputs());
  return Eigen::Map<const Eigen::VectorXd>(numbers.data(), drive.inputs());
}

const Trajectory& moving(const Trajectory& trajectory) {
  if (trajectory.empty()) throw std::invalid_argument("trajectory: it has no pieces");
  return trajectory;
}

/// The first `count` vectors of an array, a row for each.
template <class Vectors>
py::array_t<double> rows_of(const Vectors& vectors, int count) {
  const py::ssize_t width = count > 0 ? static_cast<py::ssize_t>(vectors[0].size()) : 0;
  py::array_t<double> array({py::ssize_t{count}, width});
  for (int i = 0; i < count; ++i)
    for (py::ssize_t k = 0; k < width; ++k)
      array.mutable_at(i, k) = vectors[static_cast<std::size_t>(i)][static_cast<Eigen::Index>(k)];
  return array;
}

const char* name_of(MpcStatus status) {
  switch (status) {
    case MpcStatus::converged:
      return "converged";
    case MpcStatus::iteration_limit:
      return "iteration limit";
    case MpcStatus::step_limit:
      return "step limit";
    case MpcStatus::invalid_problem:
      return "invalid problem";
  }
  return "?";
}

const char* name_of(TrackerStatus status) {
  switch (status) {
    case TrackerStatus::tracking:
      return "tracking";
    case TrackerStatus::no_estimate:
      return "no estimate";
    case TrackerStatus::no_reference:
      return "no reference";
    case TrackerStatus::failed:
      return "failed";
  }
  return "?";
}

/// The controller with its drive.
class Controller {
 public:
  Controller(const MpcParameters& parameters, const RobotParameters& robot)
      : parameters_{parameters}, drive_{robot}, mpc_{parameters, drive_} {}

  py::dict solve(const Trajectory& trajectory, const py::object& time, const py::object& pose,
                 const py::object& disturbance, const py::object& previous) {
    ReferenceRequest request;
    request.time = finite_number(time, "time");
    request.dt = parameters_.dt;
    request.steps = parameters_.horizon;
    request.robot_world = pose_from(pose, "pose");
    MpcProblem problem;
    problem.initial_pose << request.robot_world.position_world, request.robot_world.heading;
    problem.disturbance = vector3_from(disturbance, "disturbance");
    problem.previous_wheel_speeds = input_from(previous, "previous", drive_);
    problem.reference = sample_reference(moving(trajectory), request, drive_, ReferenceParameters{});
    const MpcResult& result = mpc_.solve(problem);
    py::dict found;
    found["status"] = name_of(result.status);
    found["wheel_speeds"] = rows_of(result.wheel_speeds, parameters_.horizon);
    found["pose"] = rows_of(result.pose, parameters_.horizon + 1);
    found["reference_pose"] = rows_of(problem.reference.pose, parameters_.horizon + 1);
    found["reference_twist"] = rows_of(problem.reference.twist, parameters_.horizon + 1);
    found["cost"] = result.cost;
    found["optimality_residual"] = result.optimality_residual;
    found["iterations"] = result.iterations;
    return found;
  }
  void forget() { mpc_.forget(); }
  [[nodiscard]] const MpcParameters& parameters() const { return parameters_; }

 private:
  MpcParameters parameters_;
  Drive drive_;
  ModelPredictiveController mpc_;
};

/// Observer and controller, as a robot has them.
class Tracker {
 public:
  Tracker(const TrackerParameters& parameters, const RobotParameters& robot)
      : drive_{robot},
        estimator_{parameters.observer, drive_, reckoned_lag(parameters, robot)},
        controller_{parameters, drive_, reckoned_lag(parameters, robot)} {}

  void add_pose(const py::object& time, const py::object& pose) {
    estimator_.observe(finite_number(time, "time"), pose_from(pose, "pose"));
  }

  py::dict step(const py::object& time, const Trajectory& trajectory) {
    const double now = finite_number(time, "time");
    estimator_.advance_to(now);
    const TrackerOutput& output = controller_.step(now, estimator_.state(), trajectory);
    estimator_.apply(now, output.wheel_speeds);
    py::dict found;
    found["status"] = name_of(output.status);
    found["wheel_speeds"] = to_array(output.wheel_speeds);
    found["twist"] = to_array(output.twist_world);
    found["reference_pose"] = to_array(output.reference_pose);
    found["reference_twist"] = to_array(output.reference_twist);
    return found;
  }

  [[nodiscard]] py::object estimate() const {
    const StateEstimate estimate = estimator_.state().estimate;
    if (!estimate.valid) return py::none();
    py::dict found;
    found["pose"] = to_array(estimate.pose_world);
    found["disturbance"] = to_array(estimate.disturbance_world);
    found["position_variance"] = estimate.position_variance;
    found["heading_variance"] = estimate.heading_variance;
    return found;
  }

  void reset() {
    estimator_.reset();
    controller_.reset();
  }

 private:
  Drive drive_;
  MotionEstimator estimator_;
  TrajectoryController controller_;
};

}  // namespace

void bind_tracking(py::module_& module) {
  py::class_<Controller>(module, "ModelPredictiveController",
                         "The extended-state model predictive controller (eq. 18, 19) of a robot.")
      .def(py::init<const MpcParameters&, const RobotParameters&>(), py::arg("parameters") = MpcParameters{},
           py::arg("robot") = RobotParameters{})
      .def("solve", &Controller::solve, py::arg("trajectory"), py::arg("time"), py::arg("pose"),
           py::arg("disturbance") = py::make_tuple(0.0, 0.0, 0.0), py::arg("previous") = py::none(),
           "Inputs that lead from a pose (3,) along a trajectory from a time [s] on, as a dict: status,\n"
           "wheel_speeds (H, inputs), pose (H + 1, 3) as predicted, reference_pose and reference_twist\n"
           "(H + 1, 3), cost, optimality_residual, iterations. `disturbance` (3,) [m/s, m/s, rad/s] in "
           "world,\n"
           "`previous` the inputs before (None: standstill).")
      .def("forget", &Controller::forget, "Drops what makes the next solution quicker, not other.")
      .def_property_readonly("parameters", &Controller::parameters, "A copy of its parameters.",
                             py::return_value_policy::copy);
  py::class_<Tracker>(module, "Tracker", "Observer (eq. 17) and controller (eq. 18, 19) of a robot.")
      .def(py::init<const TrackerParameters&, const RobotParameters&>(),
           py::arg("parameters") = TrackerParameters{}, py::arg("robot") = RobotParameters{})
      .def("add_pose", &Tracker::add_pose, py::arg("time"), py::arg("pose"),
           "Takes in a measured pose (3,): x, y [m], heading [rad].")
      .def("step", &Tracker::step, py::arg("time"), py::arg("trajectory"),
           "One control tick, as a dict: status, wheel_speeds (inputs,), twist (3,) that they command,\n"
           "reference_pose and reference_twist (3,). They count as applied until the next.")
      .def_property_readonly("estimate", &Tracker::estimate,
                             "Where the robot is, as a dict: pose, disturbance, position_variance,\n"
                             "heading_variance; None before the first pose.")
      .def("reset", &Tracker::reset, "Forgets the estimate and the last command.");
}

}  // namespace spf::python
