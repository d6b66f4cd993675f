// spf report: merges the results of campaigns and runs into a page.
#include <algorithm>
#include <iostream>
#include <limits>
#include <memory>
#include <optional>
#include <set>

#include "apps/campaign_summary.hpp"
#include "apps/command.hpp"
#include "apps/interrupt.hpp"
#include "apps/progress_line.hpp"
#include "apps/run_summary.hpp"
#include "apps/version.hpp"
#include "config/input_problem.hpp"
#include "experiments/campaign_report.hpp"
#include "experiments/replay_export.hpp"
#include "experiments/results_folder.hpp"
#include "report/html_text.hpp"

namespace spf {
namespace {

namespace fs = std::filesystem;

struct ReportOptions {
  std::vector<std::string> folders;
  std::string out;
  std::string json;
  bool csv = false;
  bool markdown = false;
  std::string replays = "20";  ///< a number, or all
  std::string charts;
  bool quiet = false;
  MethodTable methods;
};

/// The deepest folder that contains all of them.
fs::path common_folder(const std::vector<fs::path>& folders) {
  fs::path common = folders.front();
  for (const fs::path& folder : folders) {
    fs::path shared;
    auto a = common.begin();
    auto b = folder.begin();
    for (; a != common.end() && b != folder.end() && *a == *b; ++a, ++b) shared /= *a;
    common = shared;
  }
  return common.empty() ? fs::path{"."} : common;
}

std::string in_other_file_type(const fs::path& page, const char* extension) {
  fs::path other = page;
  return other.replace_extension(extension).string();
}

class Report {
 public:
  Report(const ReportOptions& options, std::vector<CampaignParts> campaigns, fs::path page)
      : options_{options},
        campaigns_{std::move(campaigns)},
        page_{std::move(page)},
        progress_{options.quiet} {
    require_writable(page_);
    catch_interrupts();
  }

  int run() {
    std::vector<PageSection> sections;
    std::string markdown, csv, lines;
    for (const CampaignParts& parts : campaigns_) {
      const ReplayLinks replays = write_replays(parts);
      const std::vector<PageSection> of_campaign = report_sections(parts, replays);
      write_charts(parts);
      sections.insert(sections.end(), of_campaign.begin(), of_campaign.end());
      if (options_.markdown) markdown += report_markdown(parts);
      const std::vector<ResultRow> rows = rows_of(parts.cells);
      std::string table = csv_text(rows);
      csv += csv.empty() ? table : table.substr(table.find('\n') + 1);
      lines += json_lines(rows, pairs_of(parts.cells));
    }
    progress_.end();
    if (interrupted()) return kInterruptedStatus;
    write_file_atomically(page_, html_page(title(), lead(), sections));
    if (options_.csv) write_file_atomically(in_other_file_type(page_, ".csv"), csv);
    if (options_.markdown) write_file_atomically(in_other_file_type(page_, ".md"), markdown);
    if (options_.json == "-") {
      std::cout << lines;  // and nothing else, for pipes
      return kDone;
    }
    if (!options_.json.empty()) write_file_atomically(options_.json, lines);
    for (const CampaignParts& parts : campaigns_)
      std::cout << parts.campaign.name << ": " << parts.campaign.title << "\n\n"
                << campaign_table(rows_of(parts.cells)) << "\n";
    std::cout << "report: " << page_.string() << "\n";
    return kDone;
  }

 private:
  [[nodiscard]] std::string title() const {
    std::string names;
    for (const CampaignParts& parts : campaigns_) names += (names.empty() ? "" : ", ") + parts.campaign.name;
    return "Results: " + names;
  }
  [[nodiscard]] std::string lead() const {
    std::size_t trials = 0;
    std::set<std::string> commits;
    for (const CampaignParts& parts : campaigns_) {
      for (const CellTrials& cell : parts.cells) trials += cell.size();
      for (const std::string& run : parts.run_files)
        for (const std::string& commit : commits_of(run)) commits.insert(commit);
    }
    std::string text = std::to_string(trials) + " trials; page made " + today() + " by spf " + version();
    for (const std::string& commit : commits)
      text += (commit == *commits.begin() ? "; simulated by commit " : ", ") + commit;
    if (commits.size() > 1) text += " (more than one version: the trials may not belong together)";
    return "<p class=\"muted\">" + escape_html(text) + "</p>";
  }

  /// Every chart as a separate file.
  void write_charts(const CampaignParts& parts) const {
    if (options_.charts.empty()) return;
    const fs::path folder = options_.charts;
    std::error_code error;
    fs::create_directories(folder, error);
    if (error) throw OutputError{folder.string() + ": cannot be made: " + error.message()};
    for (const StoredPicture& chart : report_pictures(parts))
      write_file_atomically(folder / (parts.campaign.name + "_" + chart.name), chart.svg);
  }

  [[nodiscard]] int most_replays() const {
    return options_.replays == "all" ? std::numeric_limits<int>::max() : std::stoi(options_.replays);
  }

  /// Failed trials, taken from all cells in turn, run again and recorded.
  ReplayLinks write_replays(const CampaignParts& parts) {
    ReplayLinks links;
    std::vector<std::vector<const TrialRecord*>> failed(parts.cells.size());
    std::size_t longest = 0;
    for (std::size_t i = 0; i < parts.cells.size(); ++i) {
      for (const TrialRecord& record : parts.cells[i])
        if (!record.succeeded() && !parts.scenarios[i].empty()) failed[i].push_back(&record);
      longest = std::max(longest, failed[i].size());
    }
    int written = 0;
    for (std::size_t turn = 0; turn < longest; ++turn)
      for (std::size_t i = 0; i < failed.size(); ++i) {
        if (turn >= failed[i].size() || written >= most_replays() || interrupted()) continue;
        const std::string address = write_replay(parts, i, *failed[i][turn]);
        if (address.empty()) continue;
        links[{i, failed[i][turn]->key.trial}] = address;
        ++written;
      }
    return links;
  }

  /// Results outlive the version that made them, and the files that their scenarios name: what cannot be read
  /// again has no replay, which is told once.
  std::optional<Cell> cell_again(const fs::path& scenario, const TrialKey& key) {
    if (unreadable_.count(scenario) > 0) return std::nullopt;
    try {
      return cell_of(read_run_configuration(scenario.string(), {}, options_.methods));
    } catch (const InputError& error) {
      progress_.end();
      const InputProblems& problems = error.problems();
      const std::size_t others = problems.kept().size() + problems.left_out() - 1;
      std::cerr << "warning: no replays of " << cell_text(key)
                << ", whose scenario cannot be read: " << to_string(problems.kept().front().location) << ": "
                << problems.kept().front().sentence
                << (others == 0 ? "" : " (and " + std::to_string(others) + " more)") << "\n";
      unreadable_.insert(scenario);
      return std::nullopt;
    }
  }

  /// The file's name contains the trial's digest, so a page of an earlier report is that of the same trial.
  std::string write_replay(const CampaignParts& parts, std::size_t cell, const TrialRecord& record) {
    const fs::path folder = page_.parent_path() / (page_.stem().string() + "_replays");
    const std::string cell_name = cell_file_name(record.key);
    const std::string name = parts.campaign.name + "_" + cell_name.substr(0, cell_name.rfind('.')) + "_" +
                             std::to_string(record.key.trial) + "_" + record.digest.substr(0, 8) + ".html";
    const std::string address = folder.filename().string() + "/" + name;
    std::error_code error;
    if (fs::exists(folder / name, error)) return address;
    progress_.show("replay of trial " + std::to_string(record.key.trial) + " of " + cell_text(record.key));
    std::optional<Cell> again = cell_again(parts.scenarios[cell], record.key);
    if (!again) return "";
    again->key = record.key;
    const std::optional<ReplayPage> page = replay_page(*again, record, steady_seconds, interrupted);
    if (!page) return "";
    if (page->went_another_way)
      std::cerr << "warning: trial " << record.key.trial << " of " << cell_text(record.key)
                << " differs from the results, which come from another version\n";
    fs::create_directories(folder, error);
    if (error) throw OutputError{folder.string() + ": cannot be made: " + error.message()};
    write_file_atomically(folder / name, page->html);
    return address;
  }

  const ReportOptions& options_;
  std::vector<CampaignParts> campaigns_;
  fs::path page_;
  ProgressLine progress_;
  std::set<fs::path> unreadable_;  // scenarios
};

int report(const ReportOptions& options) {
  std::vector<fs::path> folders;
  for (const std::string& folder : options.folders) {
    fs::path path = fs::path{folder}.lexically_normal();
    if (!path.has_filename() && path.has_parent_path()) path = path.parent_path();
    if (std::find(folders.begin(), folders.end(), path) == folders.end()) folders.push_back(path);
  }
  const fs::path page = options.out.empty() ? common_folder(folders) / "report.html" : fs::path{options.out};
  return Report{options, read_parts(folders), page}.run();
}

}  // namespace

Verb add_report(CLI::App& program, const MethodTable& methods) {
  CLI::App* app =
      program.add_subcommand("report", "Merge results and make a page of tables, charts and failures");
  const auto options = std::make_shared<ReportOptions>();
  options->methods = methods;
  app->add_option("folders", options->folders,
                  "folders of spf experiment or spf run; parts of one campaign are merged")
      ->type_name("DIR")
      ->required();
  app->add_option("--out", options->out,
                  "the page (default: report.html in the folder, or in what holds them all)")
      ->type_name("FILE.html");
  app->add_flag("--csv", options->csv, "the rows as CSV too, beside the page");
  app->add_flag("--markdown", options->markdown, "the tables as Markdown too, beside the page");
  app->add_option(
         "--json", options->json,
         "file for rows and paired comparisons, one JSON object a line; - prints them, and nothing else")
      ->type_name("FILE");
  app->add_option(
         "--replays", options->replays,
         "run up to this many failed trials of each campaign again, in turn from its rows, and link their "
         "replays; 0 = none (default 20)")
      ->type_name("N|all")
      ->check(CLI::Range(0, 1'000'000) | CLI::IsMember({"all"}));
  app->add_option("--charts", options->charts, "folder for the charts as SVG files, one each")
      ->type_name("DIR");
  app->add_flag("--quiet", options->quiet, "no progress on stderr");
  app->footer(
      "Examples:\n"
      "  spf report results/table2                            # then open results/table2/report.html\n"
      "  spf report results/table3/part* --out results/table3.html --csv --markdown\n"
      "  spf report results/table2 --replays all              # half a megabyte for every failed trial\n"
      "Exit status: 0 done, 2 bad usage or input, or a path that cannot be written, 130 interrupted.");
  return {app, [options](const std::vector<std::string>&) { return report(*options); }};
}

}  // namespace spf
