// spf run: simulates a scenario once, or over many trials.
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>

#include "apps/command.hpp"
#include "apps/interrupt.hpp"
#include "apps/progress_line.hpp"
#include "apps/run_summary.hpp"
#include "experiments/campaign_run.hpp"
#include "experiments/replay_export.hpp"
#include "experiments/trial_store.hpp"
#include "mcap/trial_recorder.hpp"
#include "parallel/worker_pool.hpp"
#include "report/replay_page.hpp"
#include "report/table.hpp"

namespace spf {
namespace {

struct RunOptions {
  std::string file;
  ScenarioOptions scenario;
  std::optional<int> trials;
  int first = 0;
  int jobs = 1;
  int replays = 10;
  std::string out;
  std::string json;
  std::string mcap;
  bool quiet = false;
  std::vector<std::string> command;
  MethodTable methods;
};

std::string time_left(double elapsed, std::size_t done, int all) {
  if (done == 0) return "";
  return ", " + clock_text(elapsed / static_cast<double>(done) * (all - static_cast<int>(done))) + " left";
}

/// A run replaces the run before it in its folder, but never a campaign.
const std::string& own_folder(const std::string& out) {
  if (std::filesystem::exists(std::filesystem::path{out} / "campaign.yaml"))
    throw InputError{{"--out", 0, 0}, out + " holds the results of a campaign, which a run would remove"};
  return out;
}

/// One call of `spf run`: a campaign of one cell.
class Run {
 public:
  Run(const RunOptions& options, RunConfiguration config)
      : options_{options},
        plan_{single_cell(std::move(config), options.first, options.trials.value_or(1))},
        progress_{options.quiet} {
    if (!options_.json.empty() && options_.json != "-") require_writable(options_.json);
    if (options_.out.empty())
      store_.emplace(plan_);
    else
      store_.emplace(plan_, own_folder(options_.out), EarlierResults::remove);
    catch_interrupts();
  }

  int once() {
    TrialOptions trial;
    trial.record = store_->folder() != nullptr;
    trial.threads = thread_count(options_.jobs);
    trial.clock = steady_seconds;
    trial.progress = [this](double time) {
      const double elapsed = steady_seconds() - began_;
      progress_.show(fixed(time, 1) + " s simulated, " + fixed(time / std::max(elapsed, 1e-3), 1) +
                     " times real time");
      return !interrupted();
    };
    std::optional<mcap::TrialRecorder> recorder;
    if (!options_.mcap.empty())
      trial.listener = &recorder.emplace(options_.mcap, make_trial(cell().config, options_.first));
    const FinishedTrial finished = run_trial(cell(), options_.first, trial);
    if (recorder) recorder->close();
    if (finished.stopped) {
      progress_.end();
      std::cerr << "interrupted after " << fixed(finished.record.sim_time, 1)
                << " s of simulated time; nothing is kept\n";
      return kInterruptedStatus;
    }
    store_->add(finished.record);
    if (finished.recording) write_page("replay.html", render_replay(replay_data(cell().config, finished)));
    finish(store_->finish());
    return finished.record.succeeded() ? kDone : kFailedCheck;
  }

  int many() {
    int good = 0;
    CampaignRequest request;
    request.trials = trials_of(plan_);
    request.jobs = thread_count(options_.jobs);
    request.clock = steady_seconds;
    request.stop = interrupted;
    request.finished = [&](TrialRecord record) {
      good += record.succeeded() ? 1 : 0;
      store_->add(std::move(record));
      progress_.show("trial " + std::to_string(store_->size()) + " of " + std::to_string(*options_.trials) +
                     ", " + std::to_string(good) + " succeeded" +
                     time_left(steady_seconds() - began_, store_->size(), *options_.trials));
    };
    run_campaign(plan_, request);
    progress_.end();
    const std::vector<TrialRecord> records = store_->finish();
    if (records.empty()) {
      std::cerr << "interrupted before the first trial ended; nothing is kept\n";
      return kInterruptedStatus;
    }
    if (store_->folder() != nullptr) write_replays(records);
    finish(records);
    if (!interrupted()) return kDone;
    std::cerr << "interrupted: " << records.size() << " of " << *options_.trials << " trials are kept\n";
    return kInterruptedStatus;
  }

 private:
  [[nodiscard]] const Cell& cell() const { return plan_.cells.front(); }

  void write_page(const std::string& name, const std::string& html) {
    store_->folder()->write(name, html);
    pages_.push_back(store_->folder()->file(name).string());
  }

  /// Failed trials are run again, recorded.
  void write_replays(const std::vector<TrialRecord>& records) {
    int written = 0;
    for (const TrialRecord& record : records) {
      if (record.succeeded() || written == options_.replays || interrupted()) continue;
      progress_.show("replay of trial " + std::to_string(record.key.trial));
      const std::optional<ReplayPage> page = replay_page(cell(), record, steady_seconds, interrupted);
      if (!page) return;
      if (page->went_another_way)
        std::cerr << "warning: trial " << record.key.trial << " gave another result when it was run again\n";
      write_page(replay_name(record.key.trial), page->html);
      ++written;
    }
  }

  void finish(const std::vector<TrialRecord>& records) {
    const ResultRow row = result_row(records);
    if (const ResultsFolder* folder = store_->folder()) {
      RunFacts facts;
      facts.command = options_.command;
      facts.first = options_.first;
      facts.trials = options_.trials.value_or(1);
      facts.finished = static_cast<int>(records.size());
      facts.jobs = thread_count(options_.jobs);
      facts.wall_time = steady_seconds() - began_;
      facts.peak_memory = peak_memory();
      folder->write("scenario.yaml", resolved_scenario(cell().config));
      folder->write("summary.csv", csv_header() + to_csv_line(row));
      folder->write("summary.jsonl", to_json_line(row) + "\n");
      folder->write("run.json", run_json(cell().config, facts));
    }
    progress_.end();
    if (options_.json == "-") {
      std::cout << to_json_line(row) << "\n";  // and nothing else, for pipes
      return;
    }
    if (!options_.json.empty()) write_file_atomically(options_.json, to_json_line(row) + "\n");
    std::cout << summary_text(cell().config, records, peak_memory() - memory_before_);
    for (const std::string& page : pages_) std::cout << "replay: " << page << "\n";
    if (store_->folder() != nullptr) std::cout << "results: " << store_->folder()->path().string() << "\n";
  }

  const RunOptions& options_;
  CampaignPlan plan_;
  ProgressLine progress_;
  std::optional<TrialStore> store_;
  double began_ = steady_seconds();
  double memory_before_ = peak_memory();
  std::vector<std::string> pages_;
};

int run(const RunOptions& options) {
  RunConfiguration config =
      read_run_configuration(options.file, options.scenario.to_settings(), options.methods);
  if (options.trials && !options.mcap.empty())
    throw InputError{{"--mcap", 0, 0}, "records a single run: leave --trials out, --first chooses the trial"};
  const std::string problem = trials_problem(config, options.first, options.trials.value_or(1));
  if (!problem.empty()) throw InputError{{options.trials ? "--trials" : "--first", 0, 0}, problem};
  print_warnings(config.warnings);
  Run work{options, std::move(config)};
  return options.trials ? work.many() : work.once();
}

}  // namespace

Verb add_run(CLI::App& program, const MethodTable& methods) {
  CLI::App* app = program.add_subcommand("run", "Simulate a scenario, once or over many trials");
  const auto options = std::make_shared<RunOptions>();
  options->methods = methods;
  app->add_option("scenario", options->file, "scenario file")->type_name("FILE")->required();
  app->add_option("--trials", options->trials,
                  "repeat over this many trials; a family draws a new scene for each")
      ->type_name("N")
      ->check(CLI::Range(1, kMostTrials));
  app->add_option("--first", options->first, "number of the first trial (default 0)")
      ->type_name("K")
      ->check(CLI::Range(0, 1'000'000'000));
  app->add_option("--jobs", options->jobs,
                  "threads: for the trials, and where there are fewer, for the robots of each (default 1, 0 "
                  "= one per processor)")
      ->type_name("J")
      ->check(CLI::Range(0, 1024));
  options->scenario.add_to(*app);
  app->add_option("--out", options->out, "folder for trials, tables, the scenario as run, and replay pages")
      ->type_name("DIR");
  app->add_option("--json", options->json,
                  "file for the row of results, one JSON object; - prints it, and nothing else")
      ->type_name("FILE");
  app->add_option("--mcap", options->mcap,
                  "without --trials: file for a recording of the trial, for Foxglove and ROS 2's tools")
      ->type_name("FILE");
  app->add_option("--replays", options->replays,
                  "with --trials and --out: replay pages of at most this many failed trials (default 10)")
      ->type_name("N")
      ->check(CLI::Range(0, 10'000));
  app->add_flag("--quiet", options->quiet, "no progress on stderr");
  app->footer(
      "Examples:\n"
      "  spf run scenarios/f7.yaml --out results/f7           # then open results/f7/replay.html\n"
      "  spf run scenarios/t2.yaml --trials 50 --jobs 2 --noise walk --level 1 --json row.jsonl\n"
      "  spf run scenarios/t2.yaml --first 17 --method spf_empc --out results/trial17\n"
      "  spf run scenarios/swap.yaml --mcap swap.mcap\n"
      "  spf run scenarios/field.yaml --set robots=200 --set sensing.range=5\n"
      "Exit status: 0 done (a single run: every robot at its goal without contact), 1 a single run that "
      "failed,\n"
      "2 bad usage or input, 130 interrupted (with --trials, the trials that ended are kept).");
  return {app, [options](const std::vector<std::string>& command) {
            options->command = command;
            return run(*options);
          }};
}

}  // namespace spf
