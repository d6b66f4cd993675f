// Scenario files: refused by InputError, or read to a configuration that writes itself and can make its
// trials.
#include <stdexcept>

#include "fuzz/fuzz_input.hpp"
#include "study/scenario_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace spf;
  try {
    const RunConfiguration config = run_configuration_from_text(fuzz::text_of(data, size), "fuzz.yaml");
    const RunConfiguration again = run_configuration_from_text(to_yaml_text(config), "again.yaml");
    fuzz::require(to_yaml_text(again) == to_yaml_text(config), "a config reads back as it was written");
    try {
      static_cast<void>(make_trial(config, 1));
    } catch (const std::runtime_error&) {  // no scene for this layout
    }
  } catch (const InputError& error) {
    fuzz::require(error.problems().kept().size() <= InputProblems::kMostProblems,
                  "few problems are reported");
  }
  return 0;
}
