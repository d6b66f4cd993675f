// Campaigns, their trials and the rows of their tables.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <optional>
#include <utility>

#include "experiments/campaign_results.hpp"
#include "experiments/campaign_run.hpp"
#include "experiments/trial_store.hpp"
#include "parallel/worker_pool.hpp"
#include "python/run.hpp"
#include "python/scenario.hpp"
#include "python/trial.hpp"

namespace spf::python {
namespace {

/// The trials of a campaign, sorted by cell and number.
struct Results {
  std::vector<TrialRecord> trials;
};

std::vector<ResultRow> rows_of(const Results& results) {
  return spf::rows_of(by_cell(results.trials));
}

std::string json_lines(const Results& results) {
  const std::vector<CellTrials> cells = by_cell(results.trials);
  std::string lines;
  for (const ResultRow& row : spf::rows_of(cells)) lines += to_json_line(row) + "\n";
  for (const PairedRow& pair : pairs_of(cells)) lines += to_json_line(pair) + "\n";
  return lines;
}

template <class Rows>
py::list dicts_of(const Rows& rows) {
  py::list dicts;
  for (const auto& row : rows) dicts.append(from_json(to_json_line(row)));
  return dicts;
}

py::list trials_of_results(const Results& results) {
  py::list trials;
  for (const TrialRecord& record : results.trials) trials.append(Trial{record, nullptr, nullptr});
  return trials;
}

Results from_trials(const std::vector<Trial>& trials) {
  Results results;
  for (const Trial& trial : trials) results.trials.push_back(trial.record);
  return results;
}

Shard shard_from(const std::pair<int, int>& shard) {
  const auto [index, count] = shard;
  if (count < 1 || count > 1'000'000 || index < 1 || index > count)
    refuse("shard", py::cast(shard), "must be (i, n) with 1 <= i <= n <= 1000000");
  return {index, count};
}

Results run(const CampaignPlan& plan, const py::object& jobs, const std::pair<int, int>& shard, bool timed,
            const std::optional<py::function>& progress) {
  Interruption interruption;
  TrialStore store{plan};
  CampaignRequest request;
  request.trials = trials_of(plan, shard_from(shard));
  request.jobs = thread_count(whole_number(jobs, "jobs", 0, kMostJobs));
  if (timed) request.clock = steady_seconds;
  request.stop = [&interruption] { return interruption.wanted(); };
  const std::size_t count = request.trials.size();
  request.finished = [&](TrialRecord record) {
    store.add(record);
    if (!progress) return;
    const py::gil_scoped_acquire lock;
    try {
      (*progress)(store.size(), count, Trial{std::move(record), nullptr, nullptr});
    } catch (py::error_already_set& error) {
      error.restore();
      interruption.keep_error();
    }
  };
  run_unlocked(interruption, [&] { run_campaign(plan, request); });
  return {store.finish()};
}

/// As the program writes them into trials.jsonl.
Results read_trials(const py::object& path) {
  const std::string name = py::str(path);
  std::ifstream file{name};
  if (!file) throw InputError{{name, 0, 0}, "cannot be read"};
  Results results;
  std::string line;
  for (int number = 1; std::getline(file, line); ++number)
    results.trials.push_back(trial_record_from_json(line, name, number));
  return results;
}

CampaignPlan preset(const std::string& name, const py::dict& settings, const py::dict& scene_settings,
                    const MethodTable& methods) {
  std::string known;
  for (const CampaignPreset& campaign : campaign_presets()) {
    if (campaign.name == name)
      return campaign_from_text(std::string{campaign.text}, name, ".", settings_from(settings),
                                settings_from(scene_settings), methods);
    known += (known.empty() ? "" : ", ") + std::string{campaign.name};
  }
  refuse("name", py::str(name), "must be one of " + known);
}

CampaignPlan campaign_of(const ScenarioFile& scenario, const py::object& trials, const py::object& first) {
  const int count = whole_number(trials, "trials", 1, kMostTrials);
  const int begin = whole_number(first, "first", 0, kLastTrial);
  if (const std::string problem = trials_problem(scenario.config(), begin, count); !problem.empty())
    throw std::invalid_argument("trials = " + std::to_string(count) + ": " + problem);
  return single_cell(scenario.config(), begin, count);
}

void bind_results(py::module_& module) {
  py::class_<Results>(module, "Results", "Trials of a campaign, by cell and number, and their tables.")
      .def(py::init(&from_trials), py::arg("trials"), "Of trials from anywhere, in that order.")
      .def_static("read", &read_trials, py::arg("path"), "Those of a file trials.jsonl of the program.")
      .def_property_readonly("trials", &trials_of_results, "The trials as a list of Trial.")
      .def_property_readonly(
          "rows", [](const Results& self) { return dicts_of(rows_of(self)); },
          "A dict for each cell: success rate with its interval, means, medians (docs/protocol.md).")
      .def_property_readonly(
          "pairs", [](const Results& self) { return dicts_of(pairs_of(by_cell(self.trials))); },
          "A dict for every two methods on the same trials.")
      .def("to_json_lines", &json_lines, "Rows and pairs as `spf experiment --json -` prints them.")
      .def("__len__", [](const Results& self) { return self.trials.size(); });
}

}  // namespace

void bind_campaign(py::module_& module) {
  bind_results(module);
  py::class_<CampaignPlan>(module, "Campaign", "Methods on scenes, with noise and tracking, and how often.")
      .def_static(
          "load",
          [](const py::object& path, const py::dict& settings, const py::dict& scene_settings,
             const MethodTable& methods) {
            return read_campaign(py::str(path), settings_from(settings), settings_from(scene_settings),
                                 methods);
          },
          py::arg("path"), py::arg("settings") = py::dict(), py::arg("scene_settings") = py::dict(),
          py::arg("methods") = MethodTable{},
          "Reads a campaign file (docs/campaigns.md). `settings` are written over its own keys,\n"
          "`scene_settings` over every scenario's. Raises InputError with every problem.")
      .def_static("preset", &preset, py::arg("name"), py::arg("settings") = py::dict(),
                  py::arg("scene_settings") = py::dict(), py::arg("methods") = MethodTable{},
                  "A campaign that is built in: table2, table3, runtime, scenes, wheels.")
      .def_static("of", &campaign_of, py::arg("scenario"), py::arg("trials"), py::arg("first") = 0,
                  "Trials `first` to `first + trials - 1` of one scenario.")
      .def("run", &run, py::kw_only(), py::arg("jobs") = 0, py::arg("shard") = std::pair<int, int>{1, 1},
           py::arg("timed") = false, py::arg("progress") = py::none(),
           "Runs it without Python's lock on `jobs` threads (0: one a processor), all of it or part `shard`\n"
           "= (i, n). Timings apart, the results do not depend on either. progress(done, all, trial) is\n"
           "called after every trial; what it raises ends the run, and so does Ctrl-C.")
      .def_property_readonly(
          "name", [](const CampaignPlan& self) { return self.campaign.name; }, "Its short name.")
      .def_property_readonly(
          "trials", [](const CampaignPlan& self) { return self.campaign.trials; }, "Trials of each cell.")
      .def_property_readonly(
          "cells",
          [](const CampaignPlan& self) {
            std::vector<std::string> names;
            for (const Cell& cell : self.cells) names.push_back(cell_text(cell.key));
            return names;
          },
          "What the rows of its table are about, one sentence each.")
      .def("__repr__", [](const CampaignPlan& self) {
        return "<spf.Campaign " + self.campaign.name + ": " + std::to_string(self.cells.size()) +
               " cells of " + std::to_string(self.campaign.trials) + " trials>";
      });
}

}  // namespace spf::python
