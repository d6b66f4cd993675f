// The simulated world in the manner of Gymnasium: reset(), step().
#include "python/world.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "python/robot.hpp"
#include "python/run.hpp"

namespace spf::python {
namespace {

/// Inputs of the drive that has the most: rows of an action are that long.
Eigen::Index widest(const std::vector<DriveInput>& inputs) {
  Eigen::Index most = 0;
  for (const DriveInput& input : inputs) most = std::max(most, input.size());
  return most;
}

constexpr double kAbsent = std::numeric_limits<double>::quiet_NaN();

class GymWorld {
 public:
  GymWorld(const ScenarioFile& scenario, const py::object& trial)
      : first_{whole_number(trial, "trial", 0, kLastTrial)}, next_{first_}, stepper_{scenario, first_} {
    inputs_ = stepper_.world().commands();
  }

  py::tuple reset(const py::object& seed, const std::optional<py::dict>& options) {
    if (!seed.is_none())
      stepper_ = WorldStepper{stepper_.scenario().changed({{"seed=" + value_text(seed), "seed"}}), first_};
    int trial = next_;
    for (const auto& [key, value] : options.value_or(py::dict())) {
      if (std::string{py::str(key)} != "trial") refuse("options", *options, "may hold trial alone");
      trial = whole_number(py::reinterpret_borrow<py::object>(value), "options[\"trial\"]", 0, kLastTrial);
    }
    stepper_.reset(trial);
    next_ = trial + 1;
    left_ = distances();
    return py::make_tuple(observation(), info());
  }

  py::tuple step(const py::object& action) {
    if (stepper_.finished())
      throw std::invalid_argument("step(): the trial has ended; reset() begins another");
    read_inputs(action);
    stepper_.step(inputs_);
    const std::vector<double> left = distances();
    py::array_t<double> reward(static_cast<py::ssize_t>(left.size()));
    for (std::size_t i = 0; i < left.size(); ++i) reward.mutable_data()[i] = left_[i] - left[i];
    for (const sim::FleetOrder& order : stepper_.orders()) reward.mutable_data()[order.robot] = 0.0;
    left_ = left;
    const bool finished = stepper_.finished();
    const bool truncated = finished && stepper_.world().time() >= time_limit_of(stepper_.world().scenario());
    return py::make_tuple(observation(), reward, finished && !truncated, truncated, info());
  }

  void broadcast(int robot, const HeardMessage& message) {
    check_robot(robot);
    stepper_.broadcast(robot, message);
  }

  [[nodiscard]] std::unique_ptr<Robot> robot(int number) const {
    check_robot(number);
    const sim::Scenario& scene = stepper_.world().scenario();
    const std::vector<AgentParameters> agents = agents_of(stepper_.scenario().config());
    return std::make_unique<Robot>(
        scene, agents[scene.fleet.empty() ? 0 : scene.robots[static_cast<std::size_t>(number)].kind], number);
  }

  [[nodiscard]] Observation observation_of(int robot) const {
    check_robot(robot);
    return stepper_.observations()[static_cast<std::size_t>(robot)];
  }

  [[nodiscard]] py::list messages(int robot) const {
    check_robot(robot);
    py::list messages;
    for (const HeardMessage& message : stepper_.messages()[static_cast<std::size_t>(robot)])
      messages.append(message);
    return messages;
  }

  [[nodiscard]] py::dict result() const {
    const sim::TrialResult result = stepper_.world().result();
    py::dict found;
    found["outcome"] = enum_name(result.outcome);
    found["sim_time"] = result.sim_seconds;
    found["digest"] = result.digest;
    found["dynamic_distance"] = result.dynamic_distance;
    found["dynamic_clearance"] = result.dynamic_clearance;
    found["static_clearance"] = result.static_clearance;
    found["peer_clearance"] = result.peer_clearance;
    return found;
  }

  [[nodiscard]] std::size_t robots() const { return stepper_.world().robots().size(); }
  [[nodiscard]] const WorldStepper& stepper() const { return stepper_; }
  [[nodiscard]] WorldStepper& stepper() { return stepper_; }

 private:
  void check_robot(int robot) const {
    if (robot < 0 || static_cast<std::size_t>(robot) >= robots())
      throw std::invalid_argument("robot = " + std::to_string(robot) + " must lie in [0, " +
                                  std::to_string(robots() - 1) + "]");
  }

  void read_inputs(const py::object& action) {
    const Numbers numbers = Numbers::ensure(action);
    if (!numbers) PyErr_Clear();
    const py::ssize_t rows = static_cast<py::ssize_t>(robots());
    const py::ssize_t width = static_cast<py::ssize_t>(widest(inputs_));
    const bool fits = numbers && numbers.ndim() == 2 && numbers.shape(0) == rows && numbers.shape(1) == width;
    const auto good = [](double number) { return std::abs(number) <= kLargestInput; };
    if (!fits || !std::all_of(numbers.data(), numbers.data() + numbers.size(), good))
      refuse("action", action,
             "must be numbers in [-1000, 1000] of shape (" + std::to_string(rows) + ", " +
                 std::to_string(width) + ")");
    for (std::size_t i = 0; i < inputs_.size(); ++i)
      inputs_[i] =
          Eigen::Map<const Eigen::VectorXd>(numbers.data(static_cast<py::ssize_t>(i), 0), inputs_[i].size());
  }

  [[nodiscard]] std::vector<double> distances() const {
    std::vector<double> left;
    for (std::size_t i = 0; i < robots(); ++i) {
      const std::optional<host::Goal>& goal = stepper_.world().goal(static_cast<int>(i));
      left.push_back(goal ? (goal->position_world - stepper_.world().robots()[i].pose.position_world).norm()
                          : 0.0);
    }
    return left;
  }

  [[nodiscard]] py::dict observation() const {
    const py::ssize_t count = static_cast<py::ssize_t>(robots());
    py::array_t<double> pose({count, py::ssize_t{3}});
    py::array_t<double> goal({count, py::ssize_t{2}});
    py::array_t<bool> observed(count);
    for (py::ssize_t i = 0; i < count; ++i) {
      const Pose2& measured = stepper_.poses()[static_cast<std::size_t>(i)].pose_world;
      const std::optional<host::Goal>& told = stepper_.world().goal(static_cast<int>(i));
      const Eigen::Vector2d to = told ? told->position_world : Eigen::Vector2d{kAbsent, kAbsent};
      Eigen::Map<Eigen::Vector3d>{pose.mutable_data(i, 0)} << measured.position_world, measured.heading;
      Eigen::Map<Eigen::Vector2d>{goal.mutable_data(i, 0)} = to;
      observed.mutable_at(i) = stepper_.observed(static_cast<std::size_t>(i));
    }
    py::dict found;
    found["time"] = stepper_.world().time();
    found["pose"] = pose;
    found["goal"] = goal;
    found["obstacles"] = obstacles();
    found["observed"] = observed;
    return found;
  }

  /// What the robots have seen, padded with NaN to the most that one has.
  [[nodiscard]] py::array_t<double> obstacles() const {
    constexpr py::ssize_t kWidth = 5;
    std::size_t most = 0;
    for (const Observation& observation : stepper_.observations())
      most = std::max(most, observation.detections.size());
    py::array_t<double> array({static_cast<py::ssize_t>(robots()), static_cast<py::ssize_t>(most), kWidth});
    double* to = array.mutable_data();
    std::fill(to, to + array.size(), kAbsent);
    for (const Observation& observation : stepper_.observations()) {
      double* row = to;
      for (const Detection& detection : observation.detections) {
        const Eigen::Vector2d velocity = detection.velocity_world.value_or(Eigen::Vector2d{kAbsent, kAbsent});
        for (const double number : {detection.position_world.x(), detection.position_world.y(), velocity.x(),
                                    velocity.y(), detection.radius})
          *row++ = number;
      }
      to += static_cast<py::ssize_t>(most) * kWidth;
    }
    return array;
  }

  [[nodiscard]] py::dict info() const {
    const sim::World& world = stepper_.world();
    const py::ssize_t count = static_cast<py::ssize_t>(robots());
    py::array_t<double> pose({count, py::ssize_t{3}});
    py::array_t<double> velocity({count, py::ssize_t{2}});
    py::array_t<bool> arrived(count);
    for (py::ssize_t i = 0; i < count; ++i) {
      const sim::RobotTruth& truth = world.robots()[static_cast<std::size_t>(i)];
      Eigen::Map<Eigen::Vector3d>{pose.mutable_data(i, 0)} << truth.pose.position_world, truth.pose.heading;
      Eigen::Map<Eigen::Vector2d>{velocity.mutable_data(i, 0)} = truth.velocity_world;
      arrived.mutable_data()[i] = truth.arrived;
    }
    py::dict found;
    found["trial"] = stepper_.trial();
    found["pose"] = pose;
    found["velocity"] = velocity;
    found["arrived"] = arrived;
    found["contacts"] = static_cast<int>(world.contacts().size());
    return found;
  }

  static constexpr double kLargestInput = 1000.0;  // [m/s], beyond all wheels

  int first_, next_;
  WorldStepper stepper_;
  std::vector<DriveInput> inputs_;
  std::vector<double> left_;  // [m] straight to the goals
};

/// All robots of a world, as the program drives them.
class Fleet {
 public:
  explicit Fleet(GymWorld& world) : world_{world} { begin(); }

  py::array_t<double> act() {
    think();
    const py::ssize_t width = static_cast<py::ssize_t>(widest(world_.stepper().world().commands()));
    py::array_t<double> action({static_cast<py::ssize_t>(robots_.size()), width});
    for (std::size_t i = 0; i < robots_.size(); ++i) {
      const DriveInput& speeds = robots_[i].wheel_speeds();
      Eigen::Map<Eigen::VectorXd> row{action.mutable_data(static_cast<py::ssize_t>(i), 0), width};
      row.setZero();
      row.head(speeds.size()) = speeds;
    }
    return action;
  }

 private:
  void begin() {
    const WorldStepper& stepper = world_.stepper();
    const sim::Scenario& scene = stepper.world().scenario();
    const std::vector<AgentParameters> agents = agents_of(stepper.scenario().config());
    robots_.clear();
    robots_.reserve(world_.robots());
    for (std::size_t i = 0; i < world_.robots(); ++i)
      robots_.emplace_back(scene, agents[scene.fleet.empty() ? 0 : scene.robots[i].kind],
                           static_cast<int>(i));
    begun_ = stepper.beginnings();
  }

  void think() {
    WorldStepper& stepper = world_.stepper();
    if (begun_ != stepper.beginnings()) begin();
    for (const sim::FleetOrder& order : stepper.orders())
      robots_[static_cast<std::size_t>(order.robot)].obey(order, stepper.world());
    std::vector<std::pair<int, HeardMessage>> said;
    for (std::size_t i = 0; i < robots_.size(); ++i) {
      if (!stepper.world().robots()[i].active()) continue;
      const Observation* seen = stepper.observed(i) ? &stepper.observations()[i] : nullptr;
      const host::RobotOutput output =
          robots_[i].live(stepper.poses()[i], stepper.messages()[i], seen, stepper.world().time());
      if (output.broadcast) said.emplace_back(static_cast<int>(i), *output.broadcast);
    }
    for (const auto& [robot, message] : said) stepper.broadcast(robot, message);
  }

  GymWorld& world_;
  std::vector<Robot> robots_;
  int begun_ = 0;
};

py::dict order_dict(const sim::FleetOrder& order) {
  py::dict found;
  found["robot"] = order.robot;
  found["do"] = enum_name(order.act);
  if (order.act == sim::FleetAct::goal) {
    found["goal"] = to_array(order.goal.position_world);
    found["heading"] = order.goal.heading;
  }
  if (order.act == sim::FleetAct::priority) found["priority"] = order.priority;
  return found;
}

void bind_fleet(py::module_& module) {
  py::class_<Fleet>(module, "Fleet", "All robots of a World, as the program drives them.")
      .def(py::init<GymWorld&>(), py::arg("world"), py::keep_alive<1, 2>(),
           "New robots at their starts, and again after each reset().")
      .def("act", &Fleet::act,
           "Once before each step: every robot senses, hears, plans and speaks. Returns the action (N, "
           "inputs)\n"
           "for step(), in which you may replace what some robots do.");
}

}  // namespace

void bind_world(py::module_& module) {
  py::class_<GymWorld>(
      module, "World",
      "The truth of a trial, step by step in the manner of Gymnasium, all robots at once. A step\n"
      "leads from one measured pose to the next. N robots, frame: world, SI.")
      .def(py::init<const ScenarioFile&, const py::object&>(), py::arg("scenario"), py::arg("trial") = 0,
           "Of a scenario with tracking: full; `trial` is the first that reset() begins.")
      .def("reset", &GymWorld::reset, py::kw_only(), py::arg("seed") = py::none(),
           py::arg("options") = py::none(),
           "Begins a trial and returns (observation, info): {\"trial\": k} in `options`, or the one after "
           "the\n"
           "last. `seed` replaces the scenario's. The observation is a dict: time [s]; pose (N, 3) as "
           "measured,\n"
           "x, y [m], heading [rad]; goal (N, 2) [m], NaN: none; obstacles (N, M, 5) as each robot has seen "
           "them last, "
           "x, "
           "y\n[m], their velocity [m/s], radius [m], NaN where there are fewer; observed (N,), whether they "
           "are "
           "new.\nThe info is the truth: trial; pose (N, 3), velocity (N, 2) [m/s], arrived (N,), contacts.")
      .def(
          "step", &GymWorld::step, py::arg("action"),
          "Holds inputs (N, inputs) until the next pose: rim speeds [m/s] of the wheels, of a car rim speed\n"
          "and steering angle [rad]. Returns (observation, reward, terminated, truncated, info): the reward\n"
          "(N,) is by how much [m] each robot came nearer to its goal (0 when it is told another); "
          "terminated by a contact or when all\n"
          "have arrived, truncated when time is up.")
      .def("robot", &GymWorld::robot, py::arg("number"),
           "A new Robot as the scenario has it, at its start: what drives in trials.")
      .def("observation", &GymWorld::observation_of, py::arg("robot"),
           "What a robot has seen last, to be handed to Robot.add_observation().")
      .def("messages", &GymWorld::messages, py::arg("robot"),
           "What it has heard with this step, a list of Message.")
      .def("broadcast", &GymWorld::broadcast, py::arg("robot"), py::arg("message"),
           "Sends a message of a robot, which others hear as the scenario's radio allows.")
      .def("result", &GymWorld::result,
           "The result so far as a dict: outcome, sim_time [s], digest, least clearances [m].")
      .def_property_readonly("robots", &GymWorld::robots, "N, how many there are.")
      .def_property_readonly(
          "time", [](const GymWorld& self) { return self.stepper().world().time(); }, "[s]")
      .def_property_readonly(
          "finished", [](const GymWorld& self) { return self.stepper().finished(); }, "The trial has ended.")
      .def_property_readonly(
          "active",
          [](const GymWorld& self) {
            py::list flags;
            for (const sim::RobotTruth& truth : self.stepper().world().robots()) flags.append(truth.active());
            return flags;
          },
          "By robot: it is neither wrecked, nor broken down, nor gone.")
      .def_property_readonly(
          "orders",
          [](const GymWorld& self) {
            py::list orders;
            for (const sim::FleetOrder& order : self.stepper().orders()) orders.append(order_dict(order));
            return orders;
          },
          "What robots are told with this step, or befalls them, as dicts: robot, do (a word of scenario\n"
          "files), and goal (2,) [m] and heading [rad] (None: any) or priority where it has them.");
  bind_fleet(module);
}

}  // namespace spf::python
