#include "python/trial.hpp"

#include <utility>

#include "experiments/replay_export.hpp"
#include "experiments/trial_run.hpp"
#include "parallel/worker_pool.hpp"
#include "python/run.hpp"
#include "python/scenario.hpp"
#include "report/frame_svg.hpp"
#include "report/replay_page.hpp"

namespace spf::python {
namespace {

constexpr const char* kRobots =
    "Structured array, a row for each robot: arrived, path_length [m], travel_time [s], their ratios to the\n"
    "obstacle-free optimum, plans, failed_plans, optimiser_calls, inner_iterations, guard_stops,\n"
    "guard_held [s].";

Trial run_one(const ScenarioFile& scenario, const py::object& number, bool record, const py::object& jobs,
              bool timed) {
  const int trial = whole_number(number, "trial", 0, kLastTrial);
  TrialOptions options;
  options.record = record;
  options.threads = thread_count(whole_number(jobs, "jobs", 0, kMostJobs));
  if (timed) options.clock = steady_seconds;
  if (const std::string problem = trials_problem(scenario.config(), trial, 1); !problem.empty())
    throw std::invalid_argument("trial = " + std::to_string(trial) + ": " + problem);
  Interruption interruption;
  options.progress = [&interruption](double) { return !interruption.wanted(); };
  FinishedTrial finished;
  run_unlocked(interruption, [&] { finished = run_trial(cell_of(scenario.config()), trial, options); });
  Trial done{std::move(finished.record), std::move(finished.recording), nullptr};
  if (record) done.config = std::make_shared<const RunConfiguration>(scenario.config());
  return done;
}

py::array_t<RobotRecord> robots_of(const Trial& trial) {
  return py::array_t<RobotRecord>(static_cast<py::ssize_t>(trial.record.robots.size()),
                                  trial.record.robots.data());
}

py::object contact_of(const Trial& trial) {
  if (!trial.record.contact) return py::none();
  const ContactRecord& contact = *trial.record.contact;
  py::dict found;
  found["time"] = contact.time;
  found["robot"] = contact.robot;
  found["with"] = contact.with;
  found["other"] = contact.other;
  found["position"] = to_array(contact.position);
  found["robot_speed"] = contact.robot_speed;
  found["other_speed"] = contact.other_speed;
  return found;
}

ReplayData replay_of(const Trial& trial) {
  if (!trial.recording) throw std::invalid_argument("the trial was not recorded: run it with record=True");
  return replay_data(*trial.config, {trial.record, trial.recording, false});
}

std::string picture_of(const Trial& trial, const py::object& time, bool plans, bool trails, bool dark) {
  FrameSvgOptions options;
  options.plans = plans;
  options.trails = trails;
  options.dark = dark;
  const double at = time.is_none() ? trial.record.sim_time : finite_number(time, "time");
  return render_frame_svg(replay_of(trial), at, options);
}

/// What a trial came to.
void bind_figures(py::class_<Trial>& type) {
  type.def_property_readonly(
          "number", [](const Trial& self) { return self.record.key.trial; }, "Number of the trial.")
      .def_property_readonly(
          "method", [](const Trial& self) { return self.record.key.method; },
          "Method, or its variant's name.")
      .def_property_readonly(
          "outcome", [](const Trial& self) { return enum_name(self.record.outcome); },
          "success, collision or overtime.")
      .def_property_readonly(
          "succeeded", [](const Trial& self) { return self.record.succeeded(); },
          "Every robot is at its goal, and touched nothing.")
      .def_property_readonly(
          "failure", [](const Trial& self) { return self.record.failure; },
          "Why it failed, in words; empty after a success.")
      .def_property_readonly(
          "sim_time", [](const Trial& self) { return self.record.sim_time; }, "Simulated time [s].")
      .def_property_readonly(
          "dynamic_distance", [](const Trial& self) { return self.record.dynamic_distance; },
          "Least distance of a centre to that of a moving obstacle [m]; NaN without any.")
      .def_property_readonly(
          "dynamic_clearance", [](const Trial& self) { return self.record.dynamic_clearance; },
          "The same minus radii [m].")
      .def_property_readonly(
          "digest", [](const Trial& self) { return self.record.digest; },
          "Hash over the bits of all positions: equal for equal motion.")
      .def_property_readonly("contact", &contact_of, "The first contact as a dict, or None.")
      .def_property_readonly("robots", &robots_of, kRobots)
      .def("picture", &picture_of, py::arg("time") = py::none(), py::kw_only(), py::arg("plans") = true,
           py::arg("trails") = true, py::arg("dark") = false,
           "The recorded scene at a time [s] (None: the end) as the text of an SVG file.")
      .def(
          "replay", [](const Trial& self) { return render_replay(replay_of(self)); },
          "The page that replays the recorded trial in a browser, as the text of an HTML file.")
      .def_property_readonly(
          "recording", [](const Trial& self) { return self.recording; },
          "What a replay shows; None unless it was run with record=True.")
      .def("__repr__", [](const Trial& self) {
        return "<spf.Trial " + std::to_string(self.record.key.trial) + ": " + enum_name(self.record.outcome) +
               (self.record.failure.empty() ? "" : ", " + self.record.failure) + ">";
      });
}

}  // namespace

py::object from_json(const std::string& line) {
  return py::module_::import("json").attr("loads")(line);
}

void bind_trial(py::module_& module) {
  bind_recording(module);
  PYBIND11_NUMPY_DTYPE(RobotRecord, arrived, path_length, travel_time, path_length_ratio, travel_time_ratio,
                       plans, failed_plans, optimiser_calls, inner_iterations, guard_stops, guard_held);
  py::class_<Trial> type(module, "Trial", "A finished trial.");
  type.def_static(
          "from_json",
          [](const std::string& line) {
            return Trial{trial_record_from_json(line, "line", 1), nullptr, nullptr};
          },
          py::arg("line"),
          "The trial of a line of trials.jsonl. Raises InputError with key, value and limit.")
      .def(
          "to_json", [](const Trial& self) { return to_json_line(self.record); }, "Its line of trials.jsonl.")
      .def(
          "to_dict", [](const Trial& self) { return from_json(to_json_line(self.record)); },
          "The same as a dict.")
      .def(
          "same_result",
          [](const Trial& self, const Trial& other) { return same_result(self.record, other.record); },
          py::arg("other"), "Whether both tell the same of a trial, timings apart.");
  bind_figures(type);
  module.attr("Scenario").attr("run") = py::cpp_function(
      &run_one, py::name("run"), py::is_method(module.attr("Scenario")), py::arg("trial") = 0, py::kw_only(),
      py::arg("record") = false, py::arg("jobs") = 1, py::arg("timed") = false,
      "Runs a trial to its end, without Python's lock. The result depends on scenario and number alone, to\n"
      "the bit, and not on `jobs`: threads for its robots, 0 for one a processor. With `record` it keeps a\n"
      "recording; with `timed` it measures computing times.");
}

}  // namespace spf::python
