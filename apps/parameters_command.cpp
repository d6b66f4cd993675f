// spf parameters: every key of a scenario file.
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "apps/command.hpp"
#include "experiments/parameter_page.hpp"
#include "report/table.hpp"

namespace spf {
namespace {

struct ParametersOptions {
  bool markdown = false;
  bool json = false;
  std::string explained;  ///< a scenario file
  MethodTable methods;
};

/// A scenario file with every key written out and explained.
std::string explained(const std::string& file, const MethodTable& methods) {
  return "# Every key that a scenario may have, explained; a file needs only those that differ from the "
         "defaults.\n"
         "# Made by `spf parameters --explain FILE`, which writes any scenario in this form: each key with "
         "its\n"
         "# meaning and range. Units are SI, angles in radians, positions in the world frame.\n" +
         to_yaml_text(read_run_configuration(file, {}, methods), true);
}

std::string as_table(const std::vector<ParameterRow>& rows) {
  Table table{{{"key", Alignment::left},
               {"default", Alignment::left},
               {"unit", Alignment::left},
               {"range", Alignment::left},
               {"what", Alignment::left}}};
  for (const ParameterRow& row : rows) table.add_row({row.key, row.value, row.unit, row.range, row.what});
  return table.to_text();
}

std::string as_json(const std::vector<ParameterRow>& rows) {
  std::string lines;
  for (const ParameterRow& row : rows) {
    const nlohmann::ordered_json json{{"key", row.key},
                                      {"default", row.value},
                                      {"unit", row.unit},
                                      {"range", row.range},
                                      {"what", row.what}};
    lines += json.dump() + "\n";
  }
  return lines;
}

int print_parameters(const ParametersOptions& options) {
  if (!options.explained.empty())
    std::cout << explained(options.explained, options.methods);
  else if (options.markdown)
    std::cout << parameter_page();
  else
    std::cout << (options.json ? as_json(all_parameters()) : as_table(all_parameters()));
  return kDone;
}

}  // namespace

Verb add_parameters(CLI::App& program, const MethodTable& methods) {
  CLI::App* app =
      program.add_subcommand("parameters", "Print every parameter: default, unit, range, meaning");
  const auto options = std::make_shared<ParametersOptions>();
  options->methods = methods;
  CLI::Option* markdown = app->add_flag("--markdown", options->markdown, "as the page docs/parameters.md");
  CLI::Option* json = app->add_flag("--json", options->json, "as JSON lines")->excludes(markdown);
  app->add_option("--explain", options->explained, "this scenario, every key written out with its meaning")
      ->type_name("FILE")
      ->excludes(markdown)
      ->excludes(json);
  app->footer(
      "Examples:\n"
      "  spf parameters | grep agent.tracker\n"
      "  spf parameters --markdown > docs/parameters.md\n"
      "  spf parameters --explain scenarios/t2.yaml");
  return {app, [options](const std::vector<std::string>&) { return print_parameters(*options); }};
}

}  // namespace spf
