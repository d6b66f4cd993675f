#include "experiments/trial_log.hpp"

#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "config/input_problem.hpp"

namespace spf {
namespace {

constexpr std::size_t kLongestLine = 16u << 20;  // [bytes] ten times a trial of ten thousand robots

enum class LineEnd { line_feed, file, too_long };

/// As std::getline, but no line takes more memory than kLongestLine.
LineEnd read_line(std::istream& file, std::string& line) {
  line.clear();
  std::streambuf& buffer = *file.rdbuf();
  for (int c = buffer.sbumpc(); c != std::streambuf::traits_type::eof(); c = buffer.sbumpc()) {
    if (c == '\n') return LineEnd::line_feed;
    if (line.size() == kLongestLine) return LineEnd::too_long;
    line.push_back(static_cast<char>(c));
  }
  return LineEnd::file;
}

/// Detects whether a text that is not valid JSON is truncated rather than malformed.
struct EndSeeker : nlohmann::json_sax<nlohmann::ordered_json> {
  bool null() override { return true; }
  bool boolean(bool) override { return true; }
  bool number_integer(number_integer_t) override { return true; }
  bool number_unsigned(number_unsigned_t) override { return true; }
  bool number_float(number_float_t, const string_t&) override { return true; }
  bool string(string_t&) override { return true; }
  bool binary(binary_t&) override { return true; }
  bool start_object(std::size_t) override { return true; }
  bool key(string_t&) override { return true; }
  bool end_object() override { return true; }
  bool start_array(std::size_t) override { return true; }
  bool end_array() override { return true; }
  bool parse_error(std::size_t position, const std::string&, const nlohmann::json::exception&) override {
    stopped_at = position;
    return false;
  }
  std::size_t stopped_at = 0;  // [bytes] read by then
};

/// Whether this is a line of ours that was cut off in writing: it begins as ours do, is valid JSON as far as
/// it goes, and ends too early; after a power failure zeros may follow instead of the rest.
bool cut_off(std::string_view line) {
  constexpr std::string_view kBegin = "{\"family\":\"";
  const std::size_t with_zeros = line.size();
  line = line.substr(0, line.find_last_not_of('\0') + 1);
  if (line.size() <= kBegin.size()) return kBegin.substr(0, line.size()) == line;
  if (line.substr(0, kBegin.size()) != kBegin) return false;
  EndSeeker seeker;
  const bool whole = nlohmann::ordered_json::sax_parse(line.begin(), line.end(), &seeker);
  return whole ? line.size() < with_zeros : seeker.stopped_at > line.size();
}

}  // namespace

TrialLog read_trial_log(const std::filesystem::path& path) {
  TrialLog log;
  std::error_code error;
  if (!std::filesystem::exists(path, error)) return log;
  std::ifstream file{path, std::ios::binary};
  if (!file || std::filesystem::is_directory(path, error))
    throw InputError{{path.string(), 0, 0}, "cannot be read"};
  log = read_trial_log(file, path.string());
  if (file.bad()) throw InputError{{path.string(), 0, 0}, "cannot be read further"};
  return log;
}

TrialLog read_trial_log(std::istream& file, const std::string& name) {
  TrialLog log;
  InputProblems problems;
  int number = 0;
  std::string line;
  while (true) {
    const LineEnd end = read_line(file, line);
    if (end == LineEnd::file && line.empty()) break;
    ++number;
    if (end == LineEnd::too_long)
      throw InputError{
          {name, number, 0},
          "is no line of trial results: is longer than " + std::to_string(kLongestLine >> 20) + " MiB"};
    const bool last = end == LineEnd::file || file.peek() == std::istream::traits_type::eof();
    const bool zeros = !line.empty() && line.back() == '\0';
    if (last && (end == LineEnd::file || zeros) && cut_off(line)) {
      log.torn = true;
      break;
    }
    try {
      TrialRecord record = trial_record_from_json(line, name, number);
      if (end == LineEnd::file) {  // cut off before its line feed
        log.torn = true;
        break;
      }
      log.records.push_back(std::move(record));
      log.starts.push_back(std::exchange(log.good_bytes, log.good_bytes + line.size() + 1));
    } catch (const InputError& refused) {
      for (const InputProblem& problem : refused.problems().kept())
        problems.add(problem.location, problem.sentence);
    }
  }
  problems.throw_if_any();
  return log;
}

}  // namespace spf
