// spf run: simulates a scenario once, or over many trials.
#include <iostream>
#include <memory>
#include <optional>
#include <thread>

#include "apps/command.hpp"
#include "apps/interrupt.hpp"
#include "apps/progress_line.hpp"
#include "apps/run_summary.hpp"
#include "experiments/replay_export.hpp"
#include "experiments/results_folder.hpp"
#include "experiments/study_run.hpp"
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
  bool quiet = false;
  std::vector<std::string> command;
};

int threads(int jobs) {
  return jobs > 0 ? jobs : static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
}

std::string time_left(double elapsed, int done, int all) {
  return done == 0 ? "" : ", " + clock_text(elapsed / done * (all - done)) + " left";
}

/// One scenario on its way through `spf run`.
class Run {
 public:
  Run(const RunOptions& options, Study study)
      : options_{options}, study_{std::move(study)}, progress_{options.quiet} {
    if (!options_.json.empty() && options_.json != "-") require_writable(options_.json);
    if (!options_.out.empty()) folder_.emplace(options_.out);
    catch_interrupts();
  }

  int once() {
    SingleRequest request;
    request.trial = options_.first;
    request.record = folder_.has_value();
    request.clock = steady_seconds;
    request.progress = [this](double time) {
      const double elapsed = steady_seconds() - began_;
      progress_.show(fixed(time, 1) + " s simulated, " + fixed(time / std::max(elapsed, 1e-3), 1) +
                     " times real time");
      return !interrupted();
    };
    const RecordedTrial trial = run_single(study_, request);
    if (trial.stopped) {
      progress_.end();
      std::cerr << "interrupted after " << fixed(trial.record.sim_time, 1)
                << " s of simulated time; nothing is kept\n";
      return kInterruptedStatus;
    }
    if (folder_) {
      folder_->write("trials.jsonl", to_json_line(trial.record) + "\n");
      folder_->write("replay.html", render_replay(replay_data(study_, trial)));
      pages_.push_back(folder_->file("replay.html").string());
    }
    finish({trial.record});
    return trial.record.outcome == "success" ? kDone : kFailedCheck;
  }

  int many() {
    const std::vector<TrialRecord> records = run_all();
    if (records.empty()) {
      std::cerr << "interrupted before the first trial ended; nothing is kept\n";
      return kInterruptedStatus;
    }
    if (folder_) write_replays(records);
    finish(records);
    if (!interrupted()) return kDone;
    std::cerr << "interrupted: " << records.size() << " of " << *options_.trials << " trials are kept\n";
    return kInterruptedStatus;
  }

 private:
  /// Each trial is on the disk as soon as it ends; at the end the file is put into the order of the trials.
  std::vector<TrialRecord> run_all() {
    std::optional<LineFile> lines;
    if (folder_) lines.emplace(folder_->file("trials.jsonl"));
    int good = 0;
    StudyRequest request;
    request.first = options_.first;
    request.trials = *options_.trials;
    request.jobs = threads(options_.jobs);
    request.clock = steady_seconds;
    request.stop = interrupted;
    request.progress = [&](const TrialRecord& record, int done) {
      good += record.outcome == "success" ? 1 : 0;
      if (lines) lines->append(to_json_line(record));
      progress_.show("trial " + std::to_string(done) + " of " + std::to_string(*options_.trials) + ", " +
                     std::to_string(good) + " succeeded" +
                     time_left(steady_seconds() - began_, done, *options_.trials));
      return !interrupted();
    };
    std::vector<TrialRecord> records = run_study(study_, request);
    progress_.end();
    std::string text;
    for (const TrialRecord& record : records) text += to_json_line(record) + "\n";
    if (folder_) folder_->write("trials.jsonl", text);
    return records;
  }

  /// Failed trials are run again, recorded.
  void write_replays(const std::vector<TrialRecord>& records) {
    int written = 0;
    for (const TrialRecord& record : records) {
      if (record.outcome == "success" || written == options_.replays || interrupted()) continue;
      progress_.show("replay of trial " + std::to_string(record.key.trial));
      SingleRequest request;
      request.trial = record.key.trial;
      request.record = true;
      request.clock = steady_seconds;
      request.progress = [](double) { return !interrupted(); };
      const RecordedTrial trial = run_single(study_, request);
      if (trial.stopped) return;
      if (trial.record.digest != record.digest)
        std::cerr << "warning: trial " << record.key.trial << " went another way when it was run again\n";
      const std::string name = replay_name(record.key.trial);
      folder_->write(name, render_replay(replay_data(study_, trial)));
      pages_.push_back(folder_->file(name).string());
      ++written;
    }
  }

  void finish(const std::vector<TrialRecord>& records) {
    const ResultRow row = result_row(records);
    if (folder_) {
      RunFacts facts;
      facts.command = options_.command;
      facts.first = options_.first;
      facts.trials = options_.trials.value_or(1);
      facts.finished = static_cast<int>(records.size());
      facts.jobs = threads(options_.jobs);
      facts.wall_time = steady_seconds() - began_;
      folder_->write("scenario.yaml", resolved_scenario(study_));
      folder_->write("summary.csv", csv_header() + to_csv_line(row));
      folder_->write("summary.jsonl", to_json_line(row) + "\n");
      folder_->write("run.json", run_json(study_, facts));
    }
    progress_.end();
    if (options_.json == "-") {
      std::cout << to_json_line(row) << "\n";  // and nothing else, for pipes
      return;
    }
    if (!options_.json.empty()) write_file_atomically(options_.json, to_json_line(row) + "\n");
    std::cout << summary_text(study_, records);
    for (const std::string& page : pages_) std::cout << "replay: " << page << "\n";
    if (folder_) std::cout << "results: " << folder_->path().string() << "\n";
  }

  const RunOptions& options_;
  Study study_;
  ProgressLine progress_;
  std::optional<ResultsFolder> folder_;
  double began_ = steady_seconds();
  std::vector<std::string> pages_;
};

int run(const RunOptions& options) {
  Study study = read_study(options.file, options.scenario.to_settings());
  const std::string problem = trials_problem(study, options.first, options.trials.value_or(1));
  if (!problem.empty()) throw InputError{{options.trials ? "--trials" : "--first", 0, 0}, problem};
  Run work{options, std::move(study)};
  return options.trials ? work.many() : work.once();
}

}  // namespace

Verb add_run(CLI::App& program) {
  CLI::App* app = program.add_subcommand("run", "Simulate a scenario, once or over many trials");
  const auto options = std::make_shared<RunOptions>();
  app->add_option("scenario", options->file, "scenario file")->type_name("FILE")->required();
  app->add_option("--trials", options->trials,
                  "repeat over this many trials; a family draws a new scene for each")
      ->type_name("N")
      ->check(CLI::Range(1, 10'000'000));
  app->add_option("--first", options->first, "number of the first trial (default 0)")
      ->type_name("K")
      ->check(CLI::Range(0, 1'000'000'000));
  app->add_option("--jobs", options->jobs, "trials at the same time (default 1, 0 = one per processor)")
      ->type_name("J")
      ->check(CLI::Range(0, 1024));
  options->scenario.add_to(*app);
  app->add_option("--out", options->out, "folder for trials, tables, the scenario as run, and replay pages")
      ->type_name("DIR");
  app->add_option("--json", options->json,
                  "file for the row of results, one JSON object; - prints it, and nothing else")
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
      "  spf run scenarios/field.yaml --set robots=200 --set sensing.range=5\n"
      "Exit status: 0 done (a single run: every robot home without contact), 1 a single run that failed,\n"
      "2 bad usage or input, 130 interrupted (with --trials, the trials that ended are kept).");
  return {app, [options](const std::vector<std::string>& command) {
            options->command = command;
            return run(*options);
          }};
}

}  // namespace spf
