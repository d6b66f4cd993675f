// Robot files: refused by InputError, or read to one that writes itself.
#include "config/robot_file.hpp"
#include "fuzz/fuzz_input.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace spf;
  try {
    const RobotFile file = robot_file_from_text(fuzz::text_of(data, size), "fuzz.yaml");
    const RobotFile again = robot_file_from_text(to_yaml_text(file), "again.yaml");
    fuzz::require(to_yaml_text(again) == to_yaml_text(file), "a robot file reads back as it was written");
  } catch (const InputError& error) {
    fuzz::require(error.problems().kept().size() <= InputProblems::kMostProblems,
                  "few problems are reported");
  }
  return 0;
}
