#include "experiments/parameter_page.hpp"

#include <map>

#include "report/table.hpp"

namespace spf {
namespace {

constexpr SceneFamily kShownFamily{sim::Family::t2};

/// "agent.tracker" of "agent.tracker.observer.kind": the heading of a key's section.
std::string section_of(const std::string& key) {
  const std::size_t first = key.find('.');
  if (first == std::string::npos || key.find("[]") != std::string::npos) return "";
  if (!key.starts_with("agent.")) return key.substr(0, first);
  const std::size_t second = key.find('.', first + 1);
  return second == std::string::npos ? "agent" : key.substr(0, second);
}

Table table_of(const std::vector<ParameterRow>& rows) {
  Table table{{{"key", Alignment::left},
               {"default", Alignment::left},
               {"unit", Alignment::left},
               {"follows", Alignment::left},
               {"range", Alignment::left},
               {"what", Alignment::left}}};
  for (const ParameterRow& row : rows)
    table.add_row({"`" + row.key + "`", row.value, row.unit, row.follows, row.range, row.what});
  return table;
}

/// The differences. With the same method, agents differ only in defaults that follow their robot; these are
/// left out.
std::string changes_text(const RunConfiguration& base, const RunConfiguration& changed) {
  const bool same_method = base.method == changed.method;
  std::string text;
  for (const ParameterRow& row : differences(base, changed)) {
    if (row.key == "family" || row.key == "method" || row.key.starts_with("crowd") ||
        (same_method && row.key.starts_with("agent.")))
      continue;
    text += (text.empty() ? "" : ", ") + std::string{"`"} + row.key + ": " + row.value + "`";
  }
  return text.empty() ? "nothing" : text;
}

std::string presets() {
  const MethodChoice standard;
  const RunConfiguration base = default_run_configuration(kShownFamily, standard);
  Table methods{{{"method", Alignment::left}, {"what", Alignment::left}, {"sets", Alignment::left}}};
  for (const Method& method : standard.table().all())
    if (method.name != standard.name())
      methods.add_row(
          {"`" + method.name + "`", method.what,
           changes_text(base, default_run_configuration(kShownFamily, MethodChoice{method.name}))});
  Table families{{{"family", Alignment::left}, {"sets", Alignment::left}}};
  for (const auto& [family, name] : EnumNames<SceneFamily>::values)
    if (family != kShownFamily && family != kExplicitScene)
      families.add_row(
          {"`" + std::string{name} + "`", changes_text(base, default_run_configuration(family, standard))});
  return "## What a method sets\n\nA method is a planner and a set of parameters. Besides its planner it "
         "sets, compared with `" +
         standard.name() + "`:\n\n" + methods.to_markdown() +
         "\n## What a family sets\n\nCompared with `t2`:\n\n" + families.to_markdown();
}

}  // namespace

std::vector<ParameterRow> all_parameters() {
  const MethodChoice standard;
  std::vector<ParameterRow> rows = parameter_rows(default_run_configuration(kShownFamily, standard));
  // Keys of explicit scenes follow those that come before any group.
  std::vector<ParameterRow> of_scene;
  std::map<std::string, bool> known;
  for (const ParameterRow& row : rows) known[row.key] = true;
  for (ParameterRow& row : parameter_rows(default_run_configuration(kExplicitScene, standard))) {
    if (row.key == "robots") row.what += " (family: explicit)";
    if (row.key == "robots" || !known.contains(row.key)) of_scene.push_back(std::move(row));
  }
  for (ParameterRow& row : of_scene)
    if (row.value == to_text(kUnsetPoint)) row.value = "required";
  std::size_t at = 0;
  while (at < rows.size() && section_of(rows[at].key).empty()) ++at;
  rows.insert(rows.begin() + static_cast<std::ptrdiff_t>(at), of_scene.begin(), of_scene.end());
  // What a kind of robots may set has the keys of the file itself.
  std::erase_if(rows, [](const ParameterRow& row) { return row.key.starts_with("fleet[]."); });
  return rows;
}

std::vector<ParameterRow> differences(const RunConfiguration& base, const RunConfiguration& changed) {
  std::map<std::string, std::string> values;
  for (const ParameterRow& row : parameter_rows(base)) values[row.key] = row.value;
  std::vector<ParameterRow> found;
  for (const ParameterRow& row : parameter_rows(changed)) {
    const auto known = values.find(row.key);
    if (known == values.end() || known->second != row.value) found.push_back(row);
  }
  return found;
}

std::string parameter_page() {
  std::string page =
      "# Parameters\n\nEvery key of a scenario file. Made by `spf parameters --markdown`; do not edit.\n\nA "
      "key that is absent has its default. `--set key=value` sets any of them from the command line. Units "
      "are SI, angles in radians. `what` names the source where there is one: an equation or section of the "
      "paper, the experiment protocol (docs/protocol.md), or our choice.\n\nDefaults are written down for "
      "the standard robot (radius r = 0.3 m, speed v = 1 m/s, acceleration a = 1 m/s^2). Where the column "
      "`follows` names something, another robot's default is this one times: `size` r / 0.3 m, of a robot "
      "with corners half its width / 0.3 m; `distance` max(r, 0.3 v^2 / a) / 0.3 m; `speed` v / (1 m/s); "
      "`time` (v / a + r / v) / 1.3 s, the time to stop and to clear the robot's own footprint. `spf run` "
      "with `--out` writes the values used into `scenario.yaml`. "
      "A value that is set counts as it is written, whatever the robot.\n";
  std::string section = "none yet";
  std::vector<ParameterRow> rows;
  const auto flush = [&] {
    if (rows.empty()) return;
    page +=
        "\n## " + (section.empty() ? std::string{"Scene"} : section) + "\n\n" + table_of(rows).to_markdown();
    rows.clear();
  };
  for (const ParameterRow& row : all_parameters()) {
    const bool of_scene = section_of(row.key).empty() || row.key.starts_with("border.") ||
                          row.key.starts_with("map_settings.") || row.key.starts_with("crowd_");
    const std::string next = of_scene ? "" : section_of(row.key);
    if (next != section) flush();
    section = next;
    rows.push_back(row);
  }
  flush();
  return page + "\n" + presets();
}

}  // namespace spf
