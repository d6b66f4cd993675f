#include "experiments/campaign.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <set>
#include <tuple>

#include "config/closest_name.hpp"
#include "config/parameter_text.hpp"
#include "config/yaml_reader.hpp"
#include "config/yaml_writer.hpp"
#include "experiments/hexadecimal.hpp"
#include "report/table.hpp"

namespace spf {
namespace {

bool is_plain(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '.' ||
         c == '-';
}

/// FNV-1a, as hexadecimal digits.
std::string hash_text(const std::string& text) {
  std::uint64_t hash = 0xcbf29ce484222325ULL;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3ULL;
  return hexadecimal(hash);
}

// Limits of what one file may ask for: far beyond any sensible campaign.
constexpr std::size_t kMostCombinations = 100'000;  // of the lists, before conditions select their methods
constexpr std::size_t kMostFailed = 100;            // cells that cannot run

/// Source and name of the scenes of a cell.
struct SceneSource {
  std::string name;
  std::string file;  ///< empty: a family, given by its name
};

/// A method or variant that runs.
struct MethodEntry {
  std::string name;
  std::optional<std::string> method;  ///< none: the scenario's own
  const MethodVariant* variant = nullptr;
  std::size_t index = 0;  ///< in its list
};

/// Makes the cells of a campaign; reports problems by their location in its file.
class CellMaker {
 public:
  CellMaker(const YamlNode& root, const Campaign& campaign, const std::filesystem::path& folder,
            const std::vector<Setting>& scene_settings, const MethodTable& known, InputProblems& problems)
      : root_{root},
        campaign_{campaign},
        folder_{folder},
        scene_settings_{scene_settings},
        known_{known},
        problems_{problems} {}

  std::vector<Cell> make() {
    check_sizes();
    if (!problems_.empty()) return {};
    const std::vector<SceneSource> scenes = scene_sources();
    const std::vector<MethodEntry> entries = all_entries();
    check_names(entries);
    if (!problems_.empty()) return {};
    const std::size_t count = size_of(campaign_.conditions) * scenes.size() * size_of(campaign_.noise) *
                              size_of(campaign_.levels) * kTracking.size() * entries.size();
    for (std::size_t i = 0; i < count; ++i) {
      const Choice choice = choice_at(i, scenes, entries);
      if (runs(choice)) add(choice);
    }
    if (cells_.empty() && problems_.empty()) problems_.add(root_.location, "leaves no cell to run");
    if (asked_ > kMostCells)
      problems_.add(root_.location, "asks for " + std::to_string(asked_) + " cells: must be at most " +
                                        std::to_string(kMostCells) + " (" + kAxes + ")");
    refuse_duplicates();
    check_trials();
    return std::move(cells_);
  }

 private:
  struct Choice {
    const Condition* condition;  ///< null: none
    std::size_t condition_index;
    const SceneSource* scene;
    std::optional<sim::NoiseModel> noise;
    std::optional<double> level;
    sim::TrackingMode tracking;
    const MethodEntry* entry;
  };

  static constexpr std::array kTracking{sim::TrackingMode::full, sim::TrackingMode::ideal};

  /// Number of values of an axis; an axis without values counts as one.
  template <class Axis>
  static std::size_t size_of(const Axis& axis) {
    return std::max<std::size_t>(axis.size(), 1);
  }

  static constexpr const char* kAxes = "conditions x scenes x noise x levels x tracking x methods";

  /// Limits the work that the lists ask for, before any of it is done.
  void check_sizes() {
    constexpr std::size_t kMostSettings = 100;  // of one list
    double combinations = 2.0;
    for (const std::size_t size :
         {campaign_.conditions.size(), campaign_.families.size() + campaign_.scenarios.size(),
          campaign_.noise.size(), campaign_.levels.size(),
          campaign_.methods.size() + campaign_.variants.size()})
      combinations *= static_cast<double>(std::max<std::size_t>(size, 1));
    if (combinations > static_cast<double>(kMostCombinations))
      problems_.add(root_.location, "has " + fixed(combinations, 0) + " combinations: must be at most " +
                                        std::to_string(kMostCombinations) + " (" + kAxes + ")");
    const auto check_set = [&](const std::string& path, const std::vector<std::string>& list) {
      if (list.size() > kMostSettings)
        refuse(path, "has " + std::to_string(list.size()) + " settings: must be at most " +
                         std::to_string(kMostSettings));
    };
    check_set("set", campaign_.set);
    for (std::size_t i = 0; i < campaign_.variants.size(); ++i)
      check_set("variants[" + std::to_string(i) + "].set", campaign_.variants[i].set);
    for (std::size_t i = 0; i < campaign_.conditions.size(); ++i)
      check_set("conditions[" + std::to_string(i) + "].set", campaign_.conditions[i].set);
  }

  void check_trials() {
    const std::int64_t all =
        static_cast<std::int64_t>(cells_.size()) * static_cast<std::int64_t>(campaign_.trials);
    if (all > kMostTrials)
      refuse("trials", "makes " + std::to_string(all) + " trials of " + std::to_string(cells_.size()) +
                           " cells: must be at most " + std::to_string(kMostTrials) + " in all");
  }

  /// Entry `index` of the product of all axes, of which the last varies fastest.
  [[nodiscard]] Choice choice_at(std::size_t index, const std::vector<SceneSource>& scenes,
                                 const std::vector<MethodEntry>& entries) const {
    const auto digit = [&index](std::size_t size) { return std::exchange(index, index / size) % size; };
    Choice choice{};
    choice.entry = &entries[digit(entries.size())];
    choice.tracking = kTracking[digit(kTracking.size())];
    if (!campaign_.levels.empty()) choice.level = campaign_.levels[digit(campaign_.levels.size())];
    if (!campaign_.noise.empty()) choice.noise = campaign_.noise[digit(campaign_.noise.size())];
    choice.scene = &scenes[digit(scenes.size())];
    choice.condition_index = digit(size_of(campaign_.conditions));
    if (!campaign_.conditions.empty()) choice.condition = &campaign_.conditions[choice.condition_index];
    return choice;
  }

  [[nodiscard]] std::string location_of(const std::string& path) const {
    return to_string(nearest_node(root_, path).location);
  }
  void refuse(const std::string& path, const std::string& sentence) {
    const YamlNode& node = nearest_node(root_, path);
    problems_.add(node.location,
                  path + (node.kind == YamlKind::scalar ? " = " + shown(node) : "") + " " + sentence);
  }

  std::vector<SceneSource> scene_sources() {
    std::vector<SceneSource> scenes;
    for (const sim::Family family : campaign_.families) scenes.push_back({enum_name(family), ""});
    for (const std::string& file : campaign_.scenarios)
      scenes.push_back({std::filesystem::path{file}.stem().string(), (folder_ / file).string()});
    if (scenes.empty()) problems_.add(root_.location, "names no scene: give families or scenarios");
    return scenes;
  }

  std::vector<MethodEntry> all_entries() const {
    std::vector<MethodEntry> all;
    for (std::size_t i = 0; i < campaign_.methods.size(); ++i)
      all.push_back({campaign_.methods[i], campaign_.methods[i], nullptr, i});
    for (std::size_t i = 0; i < campaign_.variants.size(); ++i)
      all.push_back({campaign_.variants[i].name, campaign_.variants[i].method, &campaign_.variants[i], i});
    if (all.empty()) all.push_back({"", std::nullopt, nullptr, 0});
    return all;
  }

  void check_names(const std::vector<MethodEntry>& entries) {
    std::vector<std::string> names;
    for (const MethodEntry& entry : entries) {
      const std::string path = entry.variant == nullptr
                                   ? "methods[" + std::to_string(entry.index) + "]"
                                   : "variants[" + std::to_string(entry.index) + "].name";
      if (std::find(names.begin(), names.end(), entry.name) != names.end())
        refuse(path, "is the name of another method of this campaign");
      if (entry.variant != nullptr &&
          (entry.name.empty() || !std::all_of(entry.name.begin(), entry.name.end(), is_plain)))
        refuse(path, "must be letters, digits, dots, dashes and underscores");
      if (entry.method) check_method(entry);
      names.push_back(entry.name);
    }
    if (campaign_.name.empty() || !std::all_of(campaign_.name.begin(), campaign_.name.end(), is_plain))
      refuse("name", "must be letters, digits, dots, dashes and underscores");
    for (std::size_t i = 0; i < campaign_.conditions.size(); ++i) check_condition(i, names);
  }

  void check_method(const MethodEntry& entry) {
    if (known_.find(*entry.method) != nullptr) return;
    const bool is_variant = entry.variant != nullptr;
    const std::string index = "[" + std::to_string(entry.index) + "]";
    const std::string path = is_variant ? "variants" + index + ".method" : "methods" + index;
    const std::vector<std::string> names = method_names(known_);
    const std::optional<std::string> meant = closest_name(*entry.method, names);
    refuse(path, "must be one of " + choices_of(MethodChoice{kDefaultMethod, known_}) +
                     (meant ? "; did you mean " + *meant + "?" : ""));
  }

  void check_condition(std::size_t index, const std::vector<std::string>& names) {
    const Condition& condition = campaign_.conditions[index];
    const std::string path = "conditions[" + std::to_string(index) + "]";
    if (condition.name.empty()) refuse(path + ".name", "must not be empty");
    for (std::size_t other = 0; other < index; ++other)
      if (campaign_.conditions[other].name == condition.name)
        refuse(path + ".name", "is the name of another condition");
    for (std::size_t i = 0; i < condition.methods.size(); ++i) {
      if (std::find(names.begin(), names.end(), condition.methods[i]) != names.end()) continue;
      const std::optional<std::string> meant =
          problems_.full() ? std::nullopt : closest_name(condition.methods[i], names);
      refuse(path + ".methods[" + std::to_string(i) + "]",
             "is no method or variant of this campaign" + (meant ? "; did you mean " + *meant + "?" : ""));
    }
  }

  [[nodiscard]] bool runs(const Choice& choice) const {
    if (choice.condition != nullptr && !choice.condition->methods.empty()) {
      const std::vector<std::string>& methods = choice.condition->methods;
      if (std::find(methods.begin(), methods.end(), choice.entry->name) == methods.end()) return false;
    }
    const std::vector<sim::TrackingMode>* modes = &campaign_.tracking;
    if (choice.entry->variant != nullptr && !choice.entry->variant->tracking.empty())
      modes = &choice.entry->variant->tracking;
    // None named: the scenario's own, which `add` takes once, under the first of the two.
    if (modes->empty()) return choice.tracking == sim::TrackingMode::full;
    return std::find(modes->begin(), modes->end(), choice.tracking) != modes->end();
  }

  /// In ascending precedence: the axes, the campaign's own, variant, condition, command line.
  [[nodiscard]] std::vector<Setting> settings_of(const Choice& choice) const {
    std::vector<Setting> all;
    if (root_.find("seed") != nullptr)
      all.push_back({"seed=" + to_text(campaign_.seed), location_of("seed")});
    if (choice.entry->method) all.push_back({"method=" + *choice.entry->method, location_of("methods")});
    if (choice.noise)
      all.push_back({std::string{"noise.model="} + enum_name(*choice.noise), location_of("noise")});
    if (choice.level) all.push_back({"noise.level=" + to_text(*choice.level), location_of("levels")});
    const bool named = !campaign_.tracking.empty() ||
                       (choice.entry->variant != nullptr && !choice.entry->variant->tracking.empty());
    if (named)
      all.push_back({std::string{"trial.tracking="} + enum_name(choice.tracking), location_of("tracking")});
    const auto add_list = [&](const std::vector<std::string>& list, const std::string& path) {
      for (std::size_t i = 0; i < list.size(); ++i)
        all.push_back({list[i], location_of(path + "[" + std::to_string(i) + "]")});
    };
    add_list(campaign_.set, "set");
    if (choice.entry->variant != nullptr)
      add_list(choice.entry->variant->set, "variants[" + std::to_string(choice.entry->index) + "].set");
    if (choice.condition != nullptr)
      add_list(choice.condition->set, "conditions[" + std::to_string(choice.condition_index) + "].set");
    all.insert(all.end(), scene_settings_.begin(), scene_settings_.end());
    return all;
  }

  void add(const Choice& choice) {
    if (++asked_ > kMostCells || failed_ == kMostFailed) return;
    try {
      const std::vector<Setting> settings = settings_of(choice);
      Cell cell = cell_of(choice.scene->file.empty()
                              ? run_configuration_from_text("family: " + choice.scene->name + "\n",
                                                            choice.scene->name, settings, known_)
                              : read_run_configuration(choice.scene->file, settings, known_));
      cell.key.family = choice.scene->name;
      if (!choice.entry->name.empty()) cell.key.method = choice.entry->name;
      if (choice.condition != nullptr) cell.key.condition = choice.condition->name;
      const std::string problem = trials_problem(cell.config, campaign_.first, campaign_.trials);
      if (!problem.empty() && reported_.insert(problem).second) refuse("trials", problem);
      cells_.push_back(std::move(cell));
    } catch (const InputError& error) {
      if (++failed_ == kMostFailed)
        problems_.add(root_.location,
                      std::to_string(failed_) + " cells cannot run; further ones were not looked at");
      for (const InputProblem& problem : error.problems().kept())
        if (reported_.insert(to_string(problem.location) + problem.sentence).second)
          problems_.add(problem.location, problem.sentence);
    }
  }

  void refuse_duplicates() {
    std::set<std::string> names;
    for (const Cell& cell : cells_)
      if (!names.insert(cell_file_name(cell.key)).second)
        return problems_.add(root_.location, "lists this cell twice: " + cell_text(cell.key));
  }

  const YamlNode& root_;
  const Campaign& campaign_;
  std::filesystem::path folder_;
  const std::vector<Setting>& scene_settings_;
  const MethodTable& known_;
  InputProblems& problems_;
  std::vector<Cell> cells_;
  std::size_t asked_ = 0;   // cells that the file asks for
  std::size_t failed_ = 0;  // of them
  std::set<std::string> reported_;
};

CampaignPlan read_document(YamlNode root, const std::filesystem::path& folder,
                           const std::vector<Setting>& settings, const std::vector<Setting>& scene_settings,
                           const MethodTable& known, InputProblems problems) {
  if (root.kind == YamlKind::nothing) problems.throw_if_any();
  for (const Setting& setting : settings) apply_setting(root, setting.assignment, setting.source, problems);
  CampaignPlan plan;
  read_parameters(root, plan.campaign, problems);
  if (problems.empty())
    plan.cells = CellMaker{root, plan.campaign, folder, scene_settings, known, problems}.make();
  problems.throw_if_any();
  return plan;
}

}  // namespace

Cell cell_of(RunConfiguration config) {
  Cell cell;
  cell.setup = hash_text(identity_text(config));
  cell.key.family = enum_name(config.family);
  cell.key.method = config.method.name();
  cell.key.noise = enum_name(config.simulation.noise.model);
  cell.key.level = config.simulation.noise.level;
  cell.key.tracking = enum_name(config.simulation.trial.tracking);
  cell.key.seed = config.seed;
  cell.config = std::move(config);
  return cell;
}

CampaignPlan single_cell(RunConfiguration config, int first, int trials) {
  CampaignPlan plan;
  plan.cells.push_back(cell_of(std::move(config)));
  plan.campaign.name = plan.cells.front().key.family;
  plan.campaign.seed = plan.cells.front().key.seed;
  plan.campaign.first = first;
  plan.campaign.trials = trials;
  return plan;
}

CampaignPlan read_campaign(const std::string& path, const std::vector<Setting>& settings,
                           const std::vector<Setting>& scene_settings, const MethodTable& known) {
  InputProblems problems;
  YamlNode root = read_yaml_file(path, problems);
  return read_document(std::move(root), std::filesystem::path{path}.parent_path(), settings, scene_settings,
                       known, std::move(problems));
}

CampaignPlan campaign_from_text(const std::string& text, const std::string& name,
                                const std::filesystem::path& folder, const std::vector<Setting>& settings,
                                const std::vector<Setting>& scene_settings, const MethodTable& known) {
  InputProblems problems;
  YamlNode root = parse_yaml(text, name, problems);
  return read_document(std::move(root), folder, settings, scene_settings, known, std::move(problems));
}

Campaign read_campaign_header(const std::string& path) {
  InputProblems problems;
  const YamlNode root = read_yaml_file(path, problems);
  Campaign campaign;
  read_parameters(root, campaign, problems);
  problems.throw_if_any();
  return campaign;
}

std::string to_yaml_text(const Campaign& campaign) {
  return to_yaml(campaign);
}

std::string cell_file_name(const TrialKey& key) {
  std::string name = key.family + "_" + key.method + "_" + key.noise + "_" + to_text(key.level) + "_" +
                     key.tracking + (key.condition.empty() ? "" : "_" + key.condition);
  std::string safe;
  for (const char c : name) safe += is_plain(c) ? c : '-';
  // Two names may differ in characters that a file name cannot contain.
  if (safe != name) safe += "_" + hash_text(name).substr(0, 4);
  return safe + ".yaml";
}

bool same_cell(const TrialKey& a, const TrialKey& b) {
  return std::tie(a.family, a.method, a.noise, a.level, a.tracking, a.condition) ==
         std::tie(b.family, b.method, b.noise, b.level, b.tracking, b.condition);
}

std::string cell_text(const TrialKey& key) {
  return key.family + ", " + key.method + ", " + key.noise + " noise at " + to_text(key.level) + " Sigma, " +
         key.tracking + " tracking" + (key.condition.empty() ? "" : ", " + key.condition);
}

}  // namespace spf
