#include "study/crowd_file.hpp"

#include <algorithm>
#include <cstdint>
#include <vector>

#include "config/number_text.hpp"
#include "study/crowd_collector.hpp"
#include "study/crowd_formats.hpp"
#include "study/file_bytes.hpp"

namespace spf {
namespace {

constexpr std::string_view kByteOrderMark{"\xEF\xBB\xBF"};

bool is_blank_line(std::string_view line) {
  return line.find_first_not_of(" \t\r") == std::string_view::npos;
}

}  // namespace

std::shared_ptr<const sim::CrowdRecording> crowd_from_text(std::string_view text, const std::string& name,
                                                           InputProblems& problems,
                                                           const CrowdSettings& settings) {
  InputProblems found;
  CrowdCollector collector{name, found};
  std::unique_ptr<CrowdFormat> format;
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  bool more = true;
  while (more && !text.empty() && !collector.full()) {  // further problems are not shown
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    collector.next_line();
    if (!format && is_blank_line(line)) continue;
    if (!format) format = crowd_format_of(line);
    more = format->read(line, collector);
  }
  std::vector<sim::CrowdSample> samples = collector.finish(settings.frame_rate);
  if (!format) found.add({name, 0, 0}, "is empty: a recording has the columns t_s, agent_id, x_m and y_m");
  if (format && samples.empty() && found.empty())
    found.add({name, 0, 0}, "holds nobody: no sample of a person");
  for (const InputProblem& problem : found.kept()) problems.add(problem.location, problem.sentence);
  if (!found.empty()) return nullptr;
  return std::make_shared<const sim::CrowdRecording>(std::move(samples));
}

std::shared_ptr<const sim::CrowdRecording> read_crowd_file(const std::string& path,
                                                           const SourceLocation& asked_at,
                                                           InputProblems& problems,
                                                           const CrowdSettings& settings) {
  constexpr std::uintmax_t kMostBytes = std::uintmax_t{128} << 20;
  const FileBytes file = read_file_bytes(path, kMostBytes);
  if (file.bytes) return crowd_from_text(*file.bytes, path, problems, settings);
  problems.add(asked_at, "crowd = " + path + " " + file.why);
  return nullptr;
}

std::string crowd_text(const std::vector<sim::CrowdSample>& samples) {
  std::string text = "t_s,agent_id,x_m,y_m\n";
  const auto add = [&text](double value, int decimals, char end) {
    text.append(fixed_text(value, decimals)).push_back(end);
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
