// spf experiment: runs a campaign or a part of it, and continues an interrupted one.
#include <algorithm>
#include <charconv>
#include <iostream>
#include <memory>
#include <optional>

#include "apps/campaign_summary.hpp"
#include "apps/command.hpp"
#include "apps/interrupt.hpp"
#include "apps/progress_line.hpp"
#include "apps/run_summary.hpp"
#include "apps/version.hpp"
#include "config/closest_name.hpp"
#include "config/input_problem.hpp"
#include "config/parameter_text.hpp"
#include "experiments/campaign.hpp"
#include "experiments/campaign_pictures.hpp"
#include "experiments/campaign_run.hpp"
#include "experiments/trial_store.hpp"
#include "parallel/worker_pool.hpp"
#include "report/table.hpp"

namespace spf {
namespace {

namespace fs = std::filesystem;

struct ExperimentOptions {
  std::string campaign;
  std::optional<std::string> trials, first, seed;
  std::vector<std::string> methods, noise, levels, tracking;  ///< instead of the campaign's
  std::vector<std::string> settings;
  std::optional<int> jobs;
  std::string shard = "1/1";
  bool resume = false;
  std::string out;
  std::string json;
  bool quiet = false;
  std::vector<std::string> command;
  MethodTable known_methods;
};

/// "[a, b]"
std::string in_brackets(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return "[" + text + "]";
}

std::vector<Setting> campaign_settings(const ExperimentOptions& options) {
  std::vector<Setting> all;
  const auto add = [&all](const std::optional<std::string>& value, const char* key) {
    if (value) all.push_back({std::string{key} + "=" + *value, std::string{"--"} + key});
  };
  const auto add_list = [&all](const std::vector<std::string>& values, const char* key, const char* option) {
    if (!values.empty()) all.push_back({std::string{key} + "=" + in_brackets(values), option});
  };
  add(options.trials, "trials");
  add(options.first, "first");
  add(options.seed, "seed");
  add_list(options.noise, "noise", "--noise");
  add_list(options.levels, "levels", "--level");
  add_list(options.tracking, "tracking", "--tracking");
  return all;
}

CampaignPlan read_plan(const ExperimentOptions& options, const std::vector<Setting>& settings) {
  std::vector<Setting> scene;
  for (const std::string& setting : options.settings) scene.push_back({setting});
  std::vector<std::string> names;
  for (const CampaignPreset& preset : campaign_presets()) {
    names.emplace_back(preset.name);
    if (preset.name == options.campaign)
      return campaign_from_text(std::string{preset.text}, options.campaign, ".", settings, scene,
                                options.known_methods);
  }
  std::error_code error;
  if (options.campaign.find_first_of("/.") == std::string::npos && !fs::exists(options.campaign, error)) {
    const std::optional<std::string> meant = closest_name(options.campaign, names);
    throw InputError{{options.campaign, 0, 0},
                     "is no campaign: " + in_brackets(names) + ", or a file" +
                         (meant ? "; did you mean " + *meant + "?" : "")};
  }
  return read_campaign(options.campaign, settings, scene, options.known_methods);
}

/// Whether a campaign has rows of this name.
bool has_rows_of(const CampaignPlan& plan, const std::string& name) {
  return std::any_of(plan.cells.begin(), plan.cells.end(),
                     [&name](const Cell& cell) { return cell.key.method == name; });
}

/// The campaign; methods that were asked for and that it does not have join it.
CampaignPlan plan_with_methods(const ExperimentOptions& options) {
  std::vector<Setting> settings = campaign_settings(options);
  CampaignPlan plan = read_plan(options, settings);
  std::vector<std::string> joined = plan.campaign.methods;
  for (const std::string& wanted : options.methods)
    if (!has_rows_of(plan, wanted) && options.known_methods.find(wanted) != nullptr) joined.push_back(wanted);
  if (joined.size() == plan.campaign.methods.size()) return plan;
  settings.push_back({"methods=" + in_brackets(joined), "--method"});
  return read_plan(options, settings);
}

/// Keeps the methods and trackings that were asked for, by the names of the rows.
void narrow(CampaignPlan& plan, const ExperimentOptions& options) {
  const auto keep = [](const std::vector<std::string>& wanted, const std::string& name) {
    return wanted.empty() || std::find(wanted.begin(), wanted.end(), name) != wanted.end();
  };
  std::vector<std::string> names = method_names(options.known_methods);
  for (const Cell& cell : plan.cells) names.push_back(cell.key.method);
  for (const std::string& wanted : options.methods)
    if (!has_rows_of(plan, wanted)) {
      const std::optional<std::string> meant = closest_name(wanted, names);
      throw InputError{
          {"--method", 0, 0},
          wanted + " is no method of this campaign" + (meant ? "; did you mean " + *meant + "?" : "")};
    }
  std::erase_if(plan.cells, [&](const Cell& cell) {
    return !keep(options.methods, cell.key.method) || !keep(options.tracking, cell.key.tracking);
  });
  if (plan.cells.empty()) throw InputError{{"--method, --tracking", 0, 0}, "leave no cell to run"};
}

Shard read_shard(const std::string& text) {
  Shard shard;
  const std::size_t slash = text.find('/');
  const auto number = [](const std::string& digits, int& value) {
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    return error == std::errc{} && end == digits.data() + digits.size();
  };
  if (slash == std::string::npos || !number(text.substr(0, slash), shard.index) ||
      !number(text.substr(slash + 1), shard.count) || shard.count < 1 || shard.index < 1 ||
      shard.index > shard.count || shard.count > 1'000'000)
    throw InputError{{"--shard", 0, 0}, "'" + text + "' must read i/n with 1 <= i <= n, as in 3/8"};
  return shard;
}

/// One call of `spf experiment`.
class Experiment {
 public:
  Experiment(const ExperimentOptions& options, CampaignPlan plan)
      : options_{options},
        plan_{std::move(plan)},
        shard_{read_shard(options.shard)},
        progress_{options.quiet} {
    const std::vector<CampaignFigure>& figures = plan_.campaign.figures;
    const bool times = std::find(figures.begin(), figures.end(), CampaignFigure::runtime) != figures.end();
    jobs_ = thread_count(options.jobs.value_or(times ? 1 : 0));
    if (!options_.json.empty() && options_.json != "-") require_writable(options_.json);
    if (options_.out.empty())
      store_.emplace(plan_);
    else
      open_folder();
    catch_interrupts();
  }

  int run() {
    const std::vector<CampaignTrial> wanted = trials_of(plan_, shard_);
    CampaignRequest request;
    request.trials = missing(wanted);
    request.jobs = jobs_;
    request.clock = steady_seconds;
    request.stop = interrupted;
    const std::size_t all = request.trials.size();
    std::size_t done = 0;
    request.finished = [&](TrialRecord record) {
      store_->add(std::move(record));
      show_progress(++done, all);
    };
    try {
      run_campaign(plan_, request);
    } catch (const OutputError& error) {
      progress_.end();
      throw OutputError{std::string{error.what()} + "\n" + std::to_string(store_->size()) +
                        " trials are kept; make room, then go on with --resume"};
    }
    if (store_->folder() != nullptr) draw_pictures();
    progress_.end();
    finish(wanted.size());
    if (!interrupted()) return kDone;
    std::cerr << "interrupted after " << done << " of " << all << " trials"
              << (store_->folder() != nullptr ? "; go on with --resume" : "; nothing is kept without --out")
              << "\n";
    return kInterruptedStatus;
  }

 private:
  void open_folder() {
    const fs::path log = fs::path{options_.out} / "trials.jsonl";
    std::error_code error;
    if (!options_.resume && fs::exists(log, error))
      throw OutputError{
          log.string() +
          ": holds the trials of an earlier run; go on with it by --resume, or choose another --out"};
    store_.emplace(plan_, options_.out, EarlierResults::keep);
    if (store_->torn())
      std::cerr << log.string() << ": the last line was cut off in writing; that trial runs again\n";
    earlier_run_ = text_of_file(store_->folder()->file("run.json"));
    const std::vector<std::string> commits = commits_of(earlier_run_);
    if (!commits.empty() && commits.back() != kCommit)
      std::cerr << "warning: " << log.string() << " was begun by commit " << commits.back()
                << "; its trials are kept\n";
    write_inputs();
  }

  void write_inputs() const {
    store_->folder()->write(
        "campaign.yaml", "# The campaign as it was run, by spf; cells/ holds the scenario of every row.\n" +
                             to_yaml_text(plan_.campaign));
    std::error_code error;
    fs::create_directories(store_->folder()->file("cells"), error);
    if (error)
      throw OutputError{store_->folder()->file("cells").string() + ": cannot be made: " + error.message()};
    for (const Cell& cell : plan_.cells)
      write_file_atomically(store_->folder()->file("cells") / cell_file_name(cell.key),
                            resolved_scenario(cell.config));
  }

  [[nodiscard]] std::vector<CampaignTrial> missing(std::vector<CampaignTrial> wanted) const {
    std::erase_if(wanted,
                  [this](const CampaignTrial& trial) { return store_->has(trial.cell, trial.trial); });
    return wanted;
  }

  void show_progress(std::size_t done, std::size_t all) {
    const double elapsed = steady_seconds() - began_;
    const double left = elapsed / static_cast<double>(done) * static_cast<double>(all - done);
    progress_.show(plan_.campaign.name + ": trial " + std::to_string(done) + " of " + std::to_string(all) +
                   " (" + fixed(100.0 * static_cast<double>(done) / static_cast<double>(all), 0) + " %), " +
                   clock_text(left) + " left");
  }

  /// Pictures of the first trial of every cell, if the campaign asks for them and this part contains that
  /// trial.
  void draw_pictures() {
    if (!has_pictures(plan_.campaign)) return;
    std::error_code error;
    fs::create_directories(store_->folder()->file("pictures"), error);
    if (error)
      throw OutputError{store_->folder()->file("pictures").string() + ": cannot be made: " + error.message()};
    for (std::size_t i = 0; i < plan_.cells.size(); ++i) {
      const Cell& cell = plan_.cells[i];
      if (!store_->has(static_cast<int>(i), plan_.campaign.first) || interrupted()) continue;
      progress_.show("pictures of " + cell_text(cell.key));
      for (const StoredPicture& picture : pictures_of(plan_.campaign, cell, plan_.campaign.first))
        write_file_atomically(store_->folder()->file("pictures") / picture.name, picture.svg);
    }
  }

  void finish(std::size_t asked) {
    const std::size_t finished = store_->size();
    const std::vector<CellTrials> cells = by_cell(store_->finish());
    const std::vector<ResultRow> rows = rows_of(cells);
    const std::string lines = json_lines(rows, pairs_of(cells));
    if (const ResultsFolder* folder = store_->folder()) {
      CampaignFacts facts;
      facts.command = options_.command;
      facts.shard = shard_;
      facts.jobs = jobs_;
      facts.asked = asked;
      facts.finished = finished;
      facts.wall_time = steady_seconds() - began_;
      folder->write("summary.csv", csv_text(rows));
      folder->write("summary.jsonl", lines);
      folder->write("run.json", campaign_json(plan_.campaign, facts, earlier_run_));
    }
    if (options_.json == "-") {
      std::cout << lines;  // and nothing else, for pipes
      return;
    }
    if (!options_.json.empty()) write_file_atomically(options_.json, lines);
    std::cout << plan_.campaign.name << ": " << plan_.campaign.title << "\n\n" << campaign_table(rows);
    if (store_->folder() != nullptr)
      std::cout << "\nresults: " << options_.out << "\nreport:  spf report " << options_.out << "\n";
  }

  const ExperimentOptions& options_;
  CampaignPlan plan_;
  Shard shard_;
  ProgressLine progress_;
  int jobs_ = 1;
  std::optional<TrialStore> store_;
  std::string earlier_run_;
  double began_ = steady_seconds();
};

int experiment(const ExperimentOptions& options) {
  if (options.resume && options.out.empty())
    throw InputError{{"--resume", 0, 0}, "needs --out, the folder to go on with"};
  CampaignPlan plan = plan_with_methods(options);
  narrow(plan, options);
  std::vector<InputProblem> warnings;
  for (const Cell& cell : plan.cells)
    warnings.insert(warnings.end(), cell.config.warnings.begin(), cell.config.warnings.end());
  print_warnings(warnings);
  return Experiment{options, std::move(plan)}.run();
}

CLI::Option* add_words(CLI::App& app, const char* name, std::vector<std::string>& words, const char* what) {
  return app.add_option(name, words, what)->delimiter(',')->allow_extra_args(false)->take_all();
}

}  // namespace

Verb add_experiment(CLI::App& program, const MethodTable& methods) {
  CLI::App* app = program.add_subcommand("experiment", "Run a campaign: methods x scenes x noise x trials");
  const auto options = std::make_shared<ExperimentOptions>();
  options->known_methods = methods;
  app->add_option("campaign", options->campaign,
                  "table2, table3, runtime, wheels, scenes, or a campaign file (docs/campaigns.md)")
      ->type_name("NAME|FILE")
      ->required();
  app->add_option("--trials", options->trials, "trials of every cell (key trials)")->type_name("N");
  app->add_option("--first", options->first, "number of the first trial (key first)")->type_name("K");
  app->add_option("--seed", options->seed, "seed of everything random (key seed)")->type_name("N");
  add_words(*app, "--method", options->methods,
            "only these rows, by method or variant; a method that the campaign does not name joins it")
      ->type_name("NAME,...");
  add_words(*app, "--noise", options->noise, "white, walk, or both (key noise)")->type_name("MODEL,...");
  add_words(*app, "--level", options->levels, "multiples of Sigma (key levels)")->type_name("S,...");
  add_words(*app, "--tracking", options->tracking, "full, ideal, or both (key tracking)")
      ->type_name("MODE,...");
  app->add_option("--set", options->settings,
                  "any key of every scenario, as in sensing.range=5; may be repeated")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false)
      ->take_all();
  app->add_option("--jobs", options->jobs,
                  "trials at the same time (default 0 = one per processor; 1 where run times are the figure)")
      ->type_name("J")
      ->check(CLI::Range(0, 1024));
  app->add_option("--shard", options->shard, "run part i of n equal parts (default 1/1)")->type_name("I/N");
  app->add_flag("--resume", options->resume, "go on with the trials of an interrupted run in --out");
  app->add_option("--out", options->out, "folder for trials, tables, and the scenario of every row")
      ->type_name("DIR");
  app->add_option(
         "--json", options->json,
         "file for rows and paired comparisons, one JSON object a line; - prints them, and nothing else")
      ->type_name("FILE");
  app->add_flag("--quiet", options->quiet, "no progress on stderr");
  app->footer(
      "Examples:\n"
      "  spf experiment table2 --trials 50 --out results/table2   # then: spf report results/table2\n"
      "  spf experiment table2 --trials 500 --out results/table2 --resume\n"
      "  spf experiment table3 --shard 3/8 --out results/table3/part3\n"
      "  spf experiment table2 --method orca,space_time --noise walk --level 1 --tracking ideal --json -\n"
      "Every trial is on the disk as soon as it ends. Exit status: 0 done, 2 bad usage or input, or a path\n"
      "that cannot be written, 130 interrupted (go on with --resume).");
  return {app, [options](const std::vector<std::string>& command) {
            options->command = command;
            return experiment(*options);
          }};
}

}  // namespace spf
