// spf crowd: makes a synthetic crowd in the file format of recorded ones.
#include <algorithm>
#include <charconv>
#include <iostream>
#include <memory>
#include <set>
#include <system_error>

#include "apps/command.hpp"
#include "config/input_problem.hpp"
#include "config/parameter_text.hpp"
#include "experiments/results_folder.hpp"
#include "report/table.hpp"
#include "sim/crowd_generator.hpp"
#include "sim/families.hpp"
#include "study/crowd_file.hpp"

namespace spf {
namespace {

struct CrowdOptions {
  std::string out;
  std::uint64_t seed = sim::kDefaultSeed;
  sim::CrowdGeneratorParameters parameters;
};

/// One option for each parameter of the generator.
class OptionMaker {
 public:
  explicit OptionMaker(CLI::App& app) : app_{app} {}
  void operator()(const std::string& name, double& value, const std::string& unit, Range range,
                  const std::string& what) {
    std::string option = "--" + name;
    std::replace(option.begin(), option.end(), '_', '-');
    app_.add_option(option, value, what + " (default " + to_text(value) + ")")
        ->type_name(unit == "1" ? "NUMBER" : unit)
        ->check([range, unit](const std::string& text) {
          const char* const end = text.data() + text.size();
          double number = 0.0;
          const auto [rest, error] = std::from_chars(text.data(), end, number);
          const bool good = error == std::errc{} && rest == end && range.contains(number);
          return good ? std::string{} : text + " " + limit_sentence(range, unit.c_str());
        });
  }

 private:
  CLI::App& app_;
};

int make(const CrowdOptions& options) {
  const std::vector<sim::CrowdSample> samples = sim::generate_crowd(options.parameters, options.seed);
  if (samples.empty())
    throw InputError{{"--people", 0, 0}, "the crowd is empty: ask for more people or a longer duration"};
  write_file_atomically(options.out, crowd_text(samples));
  std::set<int> people;
  for (const sim::CrowdSample& sample : samples) people.insert(sample.id);
  const double instants = options.parameters.duration / options.parameters.sample_interval + 1.0;
  std::cout << options.out << ": " << people.size() << " people in " << fixed(samples.back().time, 1)
            << " s, " << fixed(static_cast<double>(samples.size()) / instants, 1) << " at once\n";
  return kDone;
}

}  // namespace

Verb add_crowd(CLI::App& program) {
  CLI::App* app =
      program.add_subcommand("crowd", "Make a synthetic crowd, as a recording for the family ped");
  const auto options = std::make_shared<CrowdOptions>();
  app->add_option("--out", options->out, "CSV file to write: t_s, agent_id, x_m, y_m")
      ->type_name("FILE")
      ->required();
  app->add_option("--seed", options->seed,
                  "seed of the crowd (default " + std::to_string(sim::kDefaultSeed) + ")")
      ->type_name("N");
  sim::CrowdGeneratorParameters::visit_fields(options->parameters, OptionMaker{*app});
  app->footer(
      "Examples:\n"
      "  spf crowd --out crowd.csv --seed 7 --people 20\n"
      "  spf run scenarios/ped.yaml --set crowd=crowd.csv --trials 10\n"
      "Exit status: 0 done, 2 bad usage, or a file that cannot be written.");
  return {app, [options](const std::vector<std::string>&) { return make(*options); }};
}

}  // namespace spf
