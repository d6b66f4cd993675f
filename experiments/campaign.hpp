// Campaign files: which methods run on which scenes, with which noise and tracking, and how often. Reading
// one gives the cells of its table, each with its own configuration; every cell runs the same trials.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "experiments/trial_record.hpp"
#include "study/scenario_file.hpp"

namespace spf {

/// What a report shows of a campaign besides its rows.
enum class CampaignFigure {
  table2,   ///< as the paper's Table 2, with its figures beside
  table3,   ///< likewise Table 3
  runtime,  ///< computing time of each part (Fig. 6)
  scenes,   ///< still frames of the first trial at chosen times (Fig. 7, 8)
  wheels,   ///< wheel speeds of the first trial and their limit (Fig. 9)
};
template <>
struct EnumNames<CampaignFigure> {
  static constexpr std::array<std::pair<CampaignFigure, const char*>, 5> values{
      {{CampaignFigure::table2, "table2"},
       {CampaignFigure::table3, "table3"},
       {CampaignFigure::runtime, "runtime"},
       {CampaignFigure::scenes, "scenes"},
       {CampaignFigure::wheels, "wheels"}}};
};

/// A method with additional settings, under its own name.
struct MethodVariant {
  std::string name;
  std::string method;
  std::vector<std::string> set;             ///< key=value
  std::vector<sim::TrackingMode> tracking;  ///< instead of the campaign's; empty: the campaign's

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit.required("name");
    visit.required("method");
    visit("name", self.name, "what its rows are called");
    visit("method", self.method, "the method that it varies");
    visit.values("set", self.set, "keys of the scenario file, as in agent.orca.margin=0.2");
    visit.values("tracking", self.tracking, "runs with these alone, instead of the campaign's");
  }
};

/// Further settings of the scene; every condition gives a part of the table.
struct Condition {
  std::string name;
  std::vector<std::string> set;      ///< key=value
  std::vector<std::string> methods;  ///< names of methods and variants; empty: all

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit.required("name");
    visit("name", self.name, "what its rows are called");
    visit.values("set", self.set, "keys of the scenario file, as in pose_noise.position_sigma=1");
    visit.values("methods", self.methods, "methods and variants that run under it; none: all");
  }
};

struct Campaign {
  std::string name;   ///< reports merge parts of the same name
  std::string title;  ///< one line
  std::vector<sim::Family> families;
  std::vector<std::string> scenarios;  ///< files, relative to the campaign's
  std::vector<std::string> methods;
  std::vector<MethodVariant> variants;
  std::vector<Condition> conditions;
  std::vector<sim::NoiseModel> noise;
  std::vector<double> levels;  ///< [1] multiples of Sigma
  std::vector<sim::TrackingMode> tracking;
  std::vector<std::string> set;  ///< key=value for all
  std::uint64_t seed = sim::kDefaultSeed;
  int first = 0;
  int trials = 50;
  std::vector<CampaignFigure> figures;
  std::vector<double> times;  ///< [s] of the still frames

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit.required("name");
    visit("name", self.name, "short name; results of the same name are merged by spf report");
    visit("title", self.title, "one line about it");
    visit.values("families", self.families, "families of scenes");
    visit.values("scenarios", self.scenarios, "scenario files, relative to this file");
    visit.values("methods", self.methods, "methods; none: the scenario's own");
    visit.list("variants", self.variants, "methods with settings of their own");
    visit.list("conditions", self.conditions, "further settings of the scene, each a part of the table");
    visit.values("noise", self.noise, "noise models of the moving obstacles; none: the scenario's own");
    visit.values("levels", self.levels, "1", Range{0.0, 100.0},
                 "multiples of Sigma; none: the scenario's own");
    visit.values("tracking", self.tracking, "how robots follow their plans; none: the scenario's own");
    visit.values("set", self.set, "keys of the scenario file for all, as in sensing.range=5");
    visit("seed", self.seed, "1", Range{0.0, 18446744073709551615.0}, "seed of everything random");
    visit("first", self.first, "1", Range{0, 1'000'000'000}, "number of the first trial");
    visit("trials", self.trials, "1", Range{1, 10'000'000}, "trials of every cell");
    visit.values("figures", self.figures, "what its report shows beside the rows");
    visit.values("times", self.times, "s", Range{0.0, 1e5}, "times of still frames");
  }
};

/// One row of the resulting table: a configuration under the name of its row.
struct Cell {
  TrialKey key;  ///< of its trials; `method` is the variant's name for a variant
  RunConfiguration config;
  std::string setup;  ///< hash of the configuration: equal for equal trials
};

/// Largest number of cells of a campaign, and of trials in all of them.
inline constexpr std::size_t kMostCells = 2'000;
inline constexpr int kMostTrials = 1'000'000;

struct CampaignPlan {
  Campaign campaign;
  std::vector<Cell> cells;  ///< at least one
};

/// The cell of a configuration, under the names of its own family and method.
[[nodiscard]] Cell cell_of(RunConfiguration config);
/// The campaign of a single configuration: trials `first` to `first + trials - 1` of one cell.
[[nodiscard]] CampaignPlan single_cell(RunConfiguration config, int first, int trials);

/// Reads a campaign file of at most kMostCells and kMostTrials. `settings` are written over its own keys,
/// `scene_settings` over every scenario's; `known` are the methods that it may name. Throws InputError with
/// every problem.
[[nodiscard]] CampaignPlan read_campaign(const std::string& path, const std::vector<Setting>& settings = {},
                                         const std::vector<Setting>& scene_settings = {},
                                         const MethodTable& known = {});
/// The same from text; `name` stands for the file in messages, `folder` contains its scenarios.
[[nodiscard]] CampaignPlan campaign_from_text(const std::string& text, const std::string& name,
                                              const std::filesystem::path& folder,
                                              const std::vector<Setting>& settings = {},
                                              const std::vector<Setting>& scene_settings = {},
                                              const MethodTable& known = {});

/// The campaign alone, without reading the scenarios of the file. Throws InputError.
[[nodiscard]] Campaign read_campaign_header(const std::string& path);
/// The file that gives this campaign.
[[nodiscard]] std::string to_yaml_text(const Campaign& campaign);

/// Campaigns that are built into the program: name and text.
struct CampaignPreset {
  std::string_view name, text;
};
[[nodiscard]] const std::vector<CampaignPreset>& campaign_presets();

/// Name of the file of a cell's scenario: letters, digits, dots, dashes and underscores; unique among the
/// cells of a campaign.
[[nodiscard]] std::string cell_file_name(const TrialKey& key);

/// Names of one cell of a table, without seed and trial.
[[nodiscard]] bool same_cell(const TrialKey& a, const TrialKey& b);
/// "t2, orca, walk noise at 1 Sigma, full tracking, pose 1 m"
[[nodiscard]] std::string cell_text(const TrialKey& key);

}  // namespace spf
