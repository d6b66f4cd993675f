#include "study/scenario_file.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "config/contradiction_report.hpp"
#include "config/footprint_reader.hpp"
#include "config/parameter_text.hpp"
#include "config/removed_keys.hpp"
#include "config/renamed_keys.hpp"
#include "config/yaml_reader.hpp"
#include "config/yaml_writer.hpp"
#include "sim/pedestrian_scene.hpp"
#include "sim/simulation.hpp"
#include "spf/robot/robot_scale.hpp"
#include "study/explicit_scene.hpp"

namespace spf {
namespace {

/// The family of a document that names none, by the form of its robots.
SceneFamily likely_family(const YamlNode& root) {
  const YamlNode* robots = root.find("robots");
  return robots != nullptr && robots->kind == YamlKind::list ? kExplicitScene : SceneFamily{sim::Family::t2};
}

/// Kinds of robots as they are before their own entries are read: what the file says of all robots, with
/// defaults for the robot and the method of the entry. Nothing is reported: all is read again. The file
/// without its fleet has been found good, so that what is read for every kind is short.
void prepare_fleet(const YamlNode& root, RunConfiguration& config) {
  const YamlNode* fleet = root.find("fleet");
  if (fleet == nullptr || fleet->kind != YamlKind::list || fleet->items.size() > kMostEntries) return;
  InputProblems reported_later;
  const std::vector<std::string> no_hints;
  for (const YamlNode& entry : fleet->items) {
    RobotKind kind;
    kind.method = config.method;
    kind.robot = config.robot;
    FieldReader own{entry, "", no_hints, reported_later};
    RobotKind::visit_robot(kind, own);
    settle_footprint(entry.find("robot"), "robot", kind.robot, reported_later);
    kind.agent = with_method(defaults_for(kind.robot), kind.method.method());
    FieldReader common{root, "", no_hints, reported_later};
    PartlyHidden<AgentParameters> agent{kind.agent, {"robot"}};
    common.group("agent", agent);
    config.fleet.push_back(std::move(kind));
  }
}

/// Reads every key once, those on which defaults depend first.
RunConfiguration read_keys(const YamlNode& root, const MethodTable& methods, InputProblems& problems) {
  std::vector<std::string> keys;  // known once the family is
  FieldReader reader{root, "", keys, problems};
  RunConfiguration head;
  head.family = likely_family(root);
  head.method = MethodChoice{kDefaultMethod, methods};
  RunConfiguration::visit_head(head, reader);
  head.robot = default_run_configuration(head.family, head.method).robot;
  keys = keys_of(head);
  std::erase_if(keys, [](const std::string& key) {
    return key.rfind("fleet[].", 0) == 0 || key.rfind("events[].", 0) == 0;
  });
  reader.group("robot", head.robot);
  settle_footprint(root.find("robot"), "robot", head.robot, problems);
  RunConfiguration config = default_run_configuration(head.family, head.method, head.robot);
  config.seed = head.seed;
  RunConfiguration::visit_scene(config, reader);
  RunConfiguration::visit_parameters(config, reader);
  if (problems.empty()) prepare_fleet(root, config);
  RunConfiguration::visit_fleet(config, reader);
  if (const YamlNode* fleet = root.find("fleet"))
    for (std::size_t i = 0; i < std::min(config.fleet.size(), fleet->items.size()); ++i)
      settle_footprint(fleet->items[i].find("robot"), "fleet[" + std::to_string(i) + "].robot",
                       config.fleet[i].robot, problems);
  reader.finish();
  return config;
}

/// The key that sizes a family: what of the layout did not fit, where that is known and was set, or else the
/// number of robots or the family itself.
std::pair<std::string, const YamlNode*> sizing_key(const YamlNode& root, const std::string& of_layout) {
  const YamlNode* layout = root.find("layout");
  if (const YamlNode* node = layout == nullptr ? nullptr : layout->find(of_layout))
    return {"layout." + of_layout, node};
  const std::string key = root.find("robots") != nullptr ? "robots" : "family";
  return {key, root.find(key)};
}

/// Checks that a family draws a first trial that can run. Reported as one problem, at the key that sizes it.
void check_drawn(const YamlNode& root, const RunConfiguration& config, InputProblems& problems) {
  const auto refuse = [&](const std::string& why, const std::string& of_layout = "") {
    const auto [key, node] = sizing_key(root, of_layout);
    problems.add(node == nullptr ? root.location : node->location,
                 key + (node == nullptr ? "" : " = " + shown(*node)) + " cannot be drawn: " + why);
  };
  try {
    const std::vector<sim::ScenarioProblem> found = sim::problems_of(make_trial(config, 0));
    if (found.empty()) return;
    const bool of_events = found.front().where.rfind("events", 0) == 0;
    if (of_events) {
      for (const sim::ScenarioProblem& problem : found) report(problem, root, problems);
      return;
    }
    const std::string others =
        found.size() == 1 ? "" : " (and " + std::to_string(found.size() - 1) + " more)";
    refuse(to_text(found.front()) + others);
  } catch (const sim::NoRoom& error) {
    refuse(error.what(), error.entry);
  } catch (const std::exception& error) {
    refuse(error.what());
  }
}

bool needs_recording(const RunConfiguration& config) {
  return config.family.drawn == sim::Family::ped;
}

/// The recorded people of an explicit scene's trial, from the beginning of the recording on when it has
/// ended.
void place_recorded(const RunConfiguration& config, sim::Scenario& scenario) {
  const sim::CrowdRecording& recording = *config.recording;
  const CrowdPlacement& placement = config.scene.crowd_placement;
  const double duration = recording.end() - recording.begin();
  double begin = placement.begin + placement.spacing * scenario.trial;
  if (duration > 0.0) begin = std::fmod(begin, duration);
  scenario.crowd = recording.window(recording.begin() + begin, sim::time_limit_of(scenario));
  scenario.crowd_gap = recording.longest_gap();
  const Eigen::Rotation2Dd turn{placement.heading};
  for (sim::CrowdSample& sample : scenario.crowd)
    sample.position_world = placement.origin + turn * sample.position_world;
}

/// A path in the scenario file is relative to that file, any other (from --set or a campaign) to the working
/// directory.
std::filesystem::path path_of(const YamlNode& root, const YamlNode& node, const std::string& named) {
  const std::string& file = root.location.source;
  std::filesystem::path path{named};
  if (path.is_relative() && node.location.source == file)
    path = std::filesystem::path{file}.parent_path() / path;
  return path.lexically_normal();
}

/// So that the configuration can be written elsewhere.
void make_absolute(const std::filesystem::path& path, std::string& named) {
  std::error_code error;
  const std::filesystem::path absolute = std::filesystem::absolute(path, error);
  if (!error) named = absolute.lexically_normal().string();
}

/// Reads the map that an explicit scene names, if any.
void read_map(const YamlNode& root, RunConfiguration& config, InputProblems& problems) {
  const YamlNode* node = root.find("map");
  if (node == nullptr || config.scene.map.empty()) return;
  const std::filesystem::path path = path_of(root, *node, config.scene.map);
  config.map = read_map_file(path.string(), config.scene.map_settings, node->location, problems);
  make_absolute(path, config.scene.map);
}

/// Reads the recording that the configuration names.
void read_recording(const YamlNode& root, RunConfiguration& config, InputProblems& problems) {
  const YamlNode* node = root.find("crowd");
  if (node == nullptr || config.crowd.empty()) {
    if (!needs_recording(config)) return;
    if (node == nullptr || node->kind == YamlKind::scalar)
      problems.add(node == nullptr ? root.location : node->location,
                   "crowd is missing: the family ped needs a recording, as in --set crowd=FILE.csv");
    return;
  }
  const std::filesystem::path path = path_of(root, *node, config.crowd);
  config.recording = read_crowd_file(path.string(), node->location, problems, config.crowd_settings);
  make_absolute(path, config.crowd);
}

/// Whether the settings go together. What a family draws does not matter to that.
void check_settings(const YamlNode& root, RunConfiguration& config, InputProblems& problems) {
  sim::Scenario scenario;
  scenario.robot = config.robot;
  scenario.fleet = robots_of(config.fleet);
  scenario.simulation = config.simulation;
  scenario.robots.resize(config.family.drawn ? static_cast<std::size_t>(config.layout.robots)
                                             : config.scene.robots.size());
  const std::vector<AgentParameters> agents = agents_of(config);
  std::vector<host::Contradiction> found;
  for (std::size_t kind = 0; kind < agents.size(); ++kind)
    for (host::Contradiction& one : sim::contradictions(scenario, agents[kind])) {
      const bool of_robot = one.key.rfind("robot.", 0) == 0 || one.key.rfind("agent.", 0) == 0;
      if (!config.fleet.empty() && of_robot) one.key = entry_name("fleet", kind, ".") + one.key;
      const bool told = std::any_of(found.begin(), found.end(), [&](const host::Contradiction& other) {
        return other.key == one.key && other.sentence == one.sentence;
      });
      if (!told) found.push_back(std::move(one));
    }
  report_contradictions(root, found, problems, config.warnings);
}

RunConfiguration read_document(YamlNode root, const std::vector<Setting>& settings,
                               const MethodTable& methods, InputProblems problems) {
  if (root.kind == YamlKind::nothing) problems.throw_if_any();  // there is no document to check further
  rename_old_keys(root, OldKey::conflicts, problems);
  for (const Setting& setting : settings) {
    apply_setting(root, setting.assignment, setting.source, problems);
    rename_old_keys(root, OldKey::replaces, problems);
  }
  refuse_removed_keys(root, problems);
  if (!require_map(root, problems)) problems.throw_if_any();
  RunConfiguration config = read_keys(root, methods, problems);
  if (needs_recording(config) || !config.family.drawn) read_recording(root, config, problems);
  if (!config.family.drawn) read_map(root, config, problems);
  if (!config.family.drawn)
    check_explicit(root, config, problems);
  else if (problems.empty())
    check_drawn(root, config, problems);
  // A refused value has been replaced by a default, which contradicts nothing that was meant.
  if (problems.empty()) check_settings(root, config, problems);
  problems.throw_if_any();
  return config;
}

}  // namespace

RunConfiguration default_run_configuration(SceneFamily family, const MethodChoice& method) {
  RobotParameters robot;
  if (family.drawn) robot = sim::family_setup(*family.drawn).robot;
  return default_run_configuration(family, method, robot);
}

RunConfiguration default_run_configuration(SceneFamily family, const MethodChoice& method,
                                           const RobotParameters& robot) {
  RunConfiguration config;
  config.family = family;
  config.method = method;
  config.agent = with_method(defaults_for(robot), method.method());
  RobotParameters sized_for;  // the robot that the family's numbers are for
  if (family.drawn) {
    const sim::FamilySetup setup = sim::family_setup(*family.drawn);
    config.layout = setup.layout;
    config.simulation = setup.simulation;
    sized_for = setup.robot;
  }
  config.simulation = scaled(config.simulation, RobotScale{robot, sized_for});
  config.robot = robot;
  return config;
}

RunConfiguration read_run_configuration(const std::string& path, const std::vector<Setting>& settings,
                                        const MethodTable& methods) {
  InputProblems problems;
  YamlNode root = read_yaml_file(path, problems);
  return read_document(std::move(root), settings, methods, std::move(problems));
}

RunConfiguration run_configuration_from_text(const std::string& text, const std::string& name,
                                             const std::vector<Setting>& settings,
                                             const MethodTable& methods) {
  InputProblems problems;
  YamlNode root = parse_yaml(text, name, problems);
  return read_document(std::move(root), settings, methods, std::move(problems));
}

std::string to_yaml_text(const RunConfiguration& config, bool explains) {
  return to_yaml(config, explains);
}

sim::Scenario make_trial(const RunConfiguration& config, int trial) {
  if (config.family.drawn) {
    sim::Scenario scenario =
        sim::make_scenario({*config.family.drawn, config.layout, config.robot, config.simulation,
                            config.recording, robots_of(config.fleet)},
                           config.seed, trial);
    for (const EventEntry& event : config.events) scenario.events.push_back(event_of(event));
    return scenario;
  }
  sim::Scenario scenario = explicit_scenario(config);
  scenario.trial = trial;
  if (config.recording) place_recorded(config, scenario);
  return scenario;
}

std::optional<int> trial_count(const RunConfiguration& config) {
  if (!needs_recording(config) || !config.recording) return std::nullopt;
  return sim::pedestrian_trials(*config.recording, config.layout);
}

std::string trials_problem(const RunConfiguration& config, int first, int trials) {
  const std::optional<int> count = trial_count(config);
  if (!count || first + trials <= *count) return "";
  return "trial " + std::to_string(first + trials - 1) + " is beyond the recording " + config.crowd +
         ", which has " + std::to_string(*count) + (*count == 1 ? " window of " : " windows of ") +
         to_text(config.layout.window) + " s: trials 0 to " + std::to_string(*count - 1);
}

std::vector<AgentParameters> agents_of(const RunConfiguration& config) {
  std::vector<AgentParameters> agents;
  const auto add = [&](const AgentParameters& agent, const RobotParameters& robot) {
    AgentParameters& parameters = agents.emplace_back(agent);
    parameters.robot = robot;
    const sim::PoseNoiseParameters& noise = config.simulation.pose_noise;
    ObserverParameters& observer = parameters.tracker.observer;
    if (observer.pose_sigma == 0.0) observer.pose_sigma = noise.position_sigma;
    if (observer.heading_sigma == 0.0) observer.heading_sigma = std::min(noise.heading_sigma, 3.0);
  };
  for (const RobotKind& kind : config.fleet) add(kind.agent, kind.robot);
  if (agents.empty()) add(config.agent, config.robot);
  return agents;
}

AgentParameters agent_parameters(const RunConfiguration& config) {
  return agents_of(config).front();
}

}  // namespace spf
