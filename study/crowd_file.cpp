#include "study/crowd_file.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <optional>
#include <system_error>
#include <unordered_map>
#include <vector>

#include "config/parameter_text.hpp"

namespace spf {
namespace {

constexpr double kFastest = 15.0;  // [m/s] faster than any person runs
constexpr double kFarthest = 1e5;  // [m]
constexpr double kLatest = 1e7;    // [s]
constexpr std::size_t kMostColumns = 100;
constexpr std::size_t kLongestShown = 60;  // bytes of a value in a message
constexpr int kLargestId = 999'999;        // ids above are the simulator's own
constexpr std::array<const char*, 4> kColumns{"t_s", "agent_id", "x_m", "y_m"};
enum Column : std::size_t { kTime, kId, kX, kY };

std::string_view trimmed(std::string_view text) {
  constexpr const char* kBlank = " \t\r";
  const std::size_t first = text.find_first_not_of(kBlank);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

std::string shown(std::string_view text) {
  return std::string{text.substr(0, kLongestShown)} + (text.size() > kLongestShown ? "..." : "");
}

/// At most `most` fields, and one more when there are more.
std::vector<std::string_view> fields_of(std::string_view line, std::size_t most) {
  std::vector<std::string_view> fields;
  while (true) {
    const std::size_t comma = line.find(',');
    fields.push_back(trimmed(line.substr(0, comma)));
    if (comma == std::string_view::npos || fields.size() > most) return fields;
    line.remove_prefix(comma + 1);
  }
}

/// Reads line by line; a problem in one does not hide those of the next.
class CrowdReader {
 public:
  CrowdReader(const std::string& name, InputProblems& problems) : name_{name}, problems_{problems} {}

  /// False when a column is missing.
  bool header(std::string_view line) {
    ++line_;
    if (line.starts_with("\xEF\xBB\xBF")) line.remove_prefix(3);
    const std::vector<std::string_view> names = fields_of(line, kMostColumns);
    bool complete = names.size() <= kMostColumns;
    if (!complete) refuse("names more than " + std::to_string(kMostColumns) + " columns");
    for (std::size_t column = 0; column < kColumns.size(); ++column) {
      const auto found = std::find(names.begin(), names.end(), kColumns[column]);
      place_[column] = static_cast<std::size_t>(found - names.begin());
      if (found != names.end()) continue;
      refuse(std::string{"the column "} + kColumns[column] +
             " is missing: the first line must name t_s, agent_id, x_m and y_m");
      complete = false;
    }
    columns_ = names.size();
    return complete;
  }

  void sample(std::string_view line) {
    ++line_;
    if (trimmed(line).empty()) return;
    const std::vector<std::string_view> fields = fields_of(line, columns_);
    if (fields.size() != columns_)
      return refuse("has " +
                    (fields.size() > columns_ ? std::string{"more"} : std::to_string(fields.size())) +
                    " values, but the first line names " + std::to_string(columns_) + " columns");
    const auto field = [&](Column column) { return fields[place_[column]]; };
    const std::optional<double> time = number(kTime, field(kTime), "s", kLatest);
    const std::optional<double> x = number(kX, field(kX), "m", kFarthest);
    const std::optional<double> y = number(kY, field(kY), "m", kFarthest);
    const std::optional<int> id = whole(field(kId));
    if (!time || !x || !y || !id) return;
    enter({*time, *id, {*x, *y}});
  }

  [[nodiscard]] std::vector<sim::CrowdSample> take() { return std::move(samples_); }

 private:
  struct Seen {
    int line;
    sim::CrowdSample sample;
  };

  void refuse(const std::string& sentence) { problems_.add({name_, line_, 0}, sentence); }

  std::optional<double> number(Column column, std::string_view text, const char* unit, double limit) {
    double value = 0.0;
    const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const std::string key = std::string{kColumns[column]} + " = " + shown(text);
    if (text.empty() || rest != text.data() + text.size() || error == std::errc::invalid_argument)
      refuse(key + " must be a number in " + unit);
    else if (!(std::abs(value) <= limit) || error != std::errc{})
      refuse(key + " " + limit_sentence({-limit, limit}, unit));
    else
      return value;
    return std::nullopt;
  }

  std::optional<int> whole(std::string_view text) {
    int value = 0;
    const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (!text.empty() && error == std::errc{} && rest == text.data() + text.size() && value >= 0 &&
        value <= kLargestId)
      return value;
    refuse("agent_id = " + shown(text) + " must be a whole number in [0, " + std::to_string(kLargestId) +
           "]");
    return std::nullopt;
  }

  void enter(const sim::CrowdSample& sample) {
    const std::string person = "agent_id = " + std::to_string(sample.id);
    if (!samples_.empty() && sample.time < samples_.back().time)
      return refuse("t_s = " + to_text(sample.time) + " must not be less than " +
                    to_text(samples_.back().time) + ", the time before: samples are sorted by time");
    const auto [known, is_new] = last_.try_emplace(sample.id, Seen{line_, sample});
    if (!is_new) {
      const sim::CrowdSample& before = known->second.sample;
      const double duration = sample.time - before.time;
      const double moved = (sample.position_world - before.position_world).norm();
      if (duration <= 0.0)
        return refuse(person + " stands twice at t_s = " + to_text(sample.time) + " (first in line " +
                      std::to_string(known->second.line) + ")");
      if (moved > kFastest * duration)
        return refuse(person + " moves " + to_text(moved) + " m in " + to_text(duration) +
                      " s: must be at most " + to_text(kFastest) + " m/s");
      known->second = {line_, sample};
    }
    samples_.push_back(sample);
  }

  const std::string& name_;
  InputProblems& problems_;
  int line_ = 0;
  std::size_t columns_ = 0;
  std::array<std::size_t, kColumns.size()> place_{};
  std::vector<sim::CrowdSample> samples_;
  std::unordered_map<int, Seen> last_;
};

}  // namespace

std::shared_ptr<const sim::CrowdRecording> crowd_from_text(std::string_view text, const std::string& name,
                                                           InputProblems& problems) {
  InputProblems found;
  CrowdReader reader{name, found};
  bool first = true;
  while (!text.empty() && !found.full()) {  // further problems are not shown
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    if (!first)
      reader.sample(line);
    else if (!reader.header(line))
      break;
    first = false;
  }
  std::vector<sim::CrowdSample> samples = reader.take();
  if (first) found.add({name, 0, 0}, "is empty: a recording has the columns t_s, agent_id, x_m and y_m");
  if (!first && samples.empty() && found.empty())
    found.add({name, 0, 0}, "holds nobody: no line but the first");
  for (const InputProblem& problem : found.kept()) problems.add(problem.location, problem.sentence);
  if (!found.empty()) return nullptr;
  return std::make_shared<const sim::CrowdRecording>(std::move(samples));
}

std::shared_ptr<const sim::CrowdRecording> read_crowd_file(const std::string& path,
                                                           const SourceLocation& asked_at,
                                                           InputProblems& problems) {
  constexpr std::uintmax_t kMostBytes = 128u << 20;
  const auto refuse = [&](const std::string& why) {
    problems.add(asked_at, "crowd = " + path + " " + why);
    return nullptr;
  };
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (status.type() == std::filesystem::file_type::not_found)
    return refuse("is no file: there is none of that name");
  if (error) return refuse("cannot be read: " + error.message());
  if (!std::filesystem::is_regular_file(status)) return refuse("is not a regular file");
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (!error && size > kMostBytes)
    return refuse("is larger than " + std::to_string(kMostBytes >> 20) + " MiB");
  std::ifstream file{path, std::ios::binary};
  std::string text(error ? 0 : static_cast<std::size_t>(size), '\0');
  if (file) file.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (error || !file) return refuse("cannot be opened for reading");
  return crowd_from_text(text, path, problems);
}

std::string crowd_text(const std::vector<sim::CrowdSample>& samples) {
  std::string text = "t_s,agent_id,x_m,y_m\n";
  const auto add = [&text](double value, int decimals, char end) {
    std::array<char, 64> digits;
    const std::to_chars_result done = std::to_chars(digits.data(), digits.data() + digits.size(), value,
                                                    std::chars_format::fixed, decimals);
    text.append(digits.data(), done.ptr).push_back(end);
  };
  for (const sim::CrowdSample& sample : samples) {
    add(sample.time, 2, ',');
    text += std::to_string(sample.id) + ",";
    add(sample.position_world.x(), 4, ',');
    add(sample.position_world.y(), 4, '\n');
  }
  return text;
}

}  // namespace spf
