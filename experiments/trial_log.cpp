#include "experiments/trial_log.hpp"

#include <fstream>
#include <string>
#include <system_error>
#include <utility>

#include "config/input_problem.hpp"

namespace spf {

TrialLog read_trial_log(const std::filesystem::path& path) {
  TrialLog log;
  std::error_code error;
  if (!std::filesystem::exists(path, error)) return log;
  std::ifstream file{path, std::ios::binary};
  if (!file || std::filesystem::is_directory(path, error))
    throw InputError{{path.string(), 0, 0}, "cannot be read"};
  int number = 0;
  for (std::string line; std::getline(file, line);) {
    ++number;
    if (file.eof()) {  // no line feed behind it
      log.torn = !line.empty();
      break;
    }
    try {
      log.records.push_back(trial_record_from_json(line, path.string(), number));
      log.starts.push_back(std::exchange(log.good_bytes, log.good_bytes + line.size() + 1));
    } catch (const InputError&) {
      if (file.peek() != std::ifstream::traits_type::eof()) throw;
      log.torn = true;
    }
  }
  if (file.bad()) throw InputError{{path.string(), number, 0}, "cannot be read further"};
  return log;
}

}  // namespace spf
