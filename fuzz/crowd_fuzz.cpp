// Recordings of people: problems are reported, or there is a recording that can be cut into windows.
#include "fuzz/fuzz_input.hpp"
#include "study/crowd_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace spf;
  InputProblems problems;
  const auto recording = crowd_from_text(fuzz::text_of(data, size), "fuzz.csv", problems);
  fuzz::require((recording == nullptr) != problems.empty(), "there is a recording, or a reason");
  if (!recording) return 0;
  const int windows = recording->window_count(60.0, 5.0);
  fuzz::require(windows >= 1, "a recording has a window");
  const auto part = recording->window(recording->begin() + 5.0 * (windows - 1), 60.0);
  fuzz::require(part.size() <= recording->samples().size(), "a window is a part");
  // Rounded to the digits of a file it may break a rule, but it can still be read.
  InputProblems of_copy;
  static_cast<void>(crowd_from_text(crowd_text(recording->samples()), "again.csv", of_copy));
  return 0;
}
