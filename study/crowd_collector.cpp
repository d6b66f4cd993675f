#include "study/crowd_collector.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <system_error>
#include <unordered_map>

#include "config/number_text.hpp"
#include "config/parameter_text.hpp"

namespace spf {
namespace {

constexpr double kFastest = 15.0;                // [m/s] faster than any person runs
constexpr double kLongestRecording = 1e7;        // [s]; times that begin later are counted from the first one
constexpr std::int64_t kSimulatedIds = 1000000;  // ids from here on are the simulator's own
constexpr double kLongestFrame = 1000.0;         // [s]
constexpr std::size_t kLongestShown = 60;        // bytes of a value in a message

std::string shown(std::string_view text) {
  return std::string{text.substr(0, kLongestShown)} + (text.size() > kLongestShown ? "..." : "");
}

bool parsed(std::string_view text, double& value, std::errc& error) {
  const NumberRead read = read_number(text);
  value = read.value;
  error = read.error;
  return !text.empty() && read.used == text.size() && error != std::errc::invalid_argument;
}

bool parsed(std::string_view text, std::int64_t& value, std::errc& error) {
  const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
  error = result.ec;
  return !text.empty() && result.ptr == text.data() + text.size() && result.ec != std::errc::invalid_argument;
}

}  // namespace

void CrowdCollector::refuse(const std::string& sentence) {
  problems_.add({name_, line_, 0}, sentence);
}

bool CrowdCollector::read(std::string_view column, std::string_view text, const char* unit, double limit,
                          double& value) {
  std::errc error{};
  const bool is_number = parsed(text, value, error);
  const std::string key = std::string{column} + " = " + shown(text);
  if (!is_number)
    refuse(key + " must be a number" + (*unit == '\0' ? "" : std::string{" in "} + unit));
  else if (!(std::abs(value) <= limit) || error != std::errc{})
    refuse(key + " " + limit_sentence({-limit, limit}, *unit == '\0' ? "1" : unit));
  else
    return true;
  return false;
}

bool CrowdCollector::read(std::string_view column, std::string_view text, std::int64_t& value) {
  std::errc error{};
  bool whole = parsed(text, value, error) && error == std::errc{};
  if (!whole) {  // a whole number may be written with a point or an exponent
    double number = 0.0;
    whole = parsed(text, number, error) && error == std::errc{} &&
            std::abs(number) <= static_cast<double>(kLargestId) && number == std::floor(number);
    if (whole) value = static_cast<std::int64_t>(number);
  }
  if (whole && value >= 0 && value <= kLargestId) return true;
  refuse(std::string{column} + " = " + shown(text) + " must be a whole number in [0, " +
         std::to_string(kLargestId) + "]");
  return false;
}

void CrowdCollector::add(double when, std::int64_t id, const Eigen::Vector2d& position_world) {
  if (lines_.size() == kMostSamples) {
    if (!too_many_) refuse("is one more than the " + std::to_string(kMostSamples) + " samples that are read");
    too_many_ = true;
    return;
  }
  lines_.push_back({when, when, id, position_world, line_});
}

/// Frames between two samples of a person. The lines must be sorted.
double CrowdCollector::median_step() const {
  std::unordered_map<std::int64_t, double> last_seen;
  std::vector<double> steps;
  for (const Line& line : lines_) {
    const auto [last, is_new] = last_seen.try_emplace(line.id, line.time);
    if (!is_new && line.time > last->second) steps.push_back(line.time - last->second);
    last->second = line.time;
  }
  if (steps.empty()) return 1.0;
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return *middle;
}

void CrowdCollector::convert_frames(double frame_rate) {
  const double interval = sample_rate_ > 0.0 ? 1.0 / sample_rate_ : kUsualInterval;
  const double seconds_per_frame = frame_rate > 0.0 ? 1.0 / frame_rate : interval / median_step();
  if (!(std::isfinite(seconds_per_frame) && seconds_per_frame > 0.0 && seconds_per_frame <= kLongestFrame))
    return refuse("frame_rate gives " + to_text(seconds_per_frame) +
                  " s a frame: must be above 0 and at most " + to_text(kLongestFrame));
  for (Line& line : lines_) line.time *= seconds_per_frame;
}

/// Nobody stands in two places at once, or moves faster than people do.
void CrowdCollector::check_persons() {
  std::unordered_map<std::int64_t, const Line*> last;
  for (const Line& here : lines_) {
    line_ = here.line;
    const auto [known, is_new] = last.try_emplace(here.id, &here);
    if (is_new) continue;
    const Line& before = *known->second;
    const double duration = here.time - before.time;
    const double moved = (here.position_world - before.position_world).norm();
    const std::string person = id_name_ + " = " + std::to_string(here.id);
    if (duration <= 0.0)
      refuse(person + " stands twice at " + time_name_ + " = " + to_text(here.when) + " (first in line " +
             std::to_string(before.line) + ")");
    else if (moved > kFastest * duration)
      refuse(person + " moves " + to_text(moved) + " m in " + to_text(duration) + " s: must be at most " +
             to_text(kFastest) + " m/s");
    else
      known->second = &here;
  }
}

/// Ids as they are when all are small, else 1, 2, ... in the order in which people appear.
std::vector<sim::CrowdSample> CrowdCollector::numbered() const {
  const bool small =
      std::all_of(lines_.begin(), lines_.end(), [](const Line& line) { return line.id < kSimulatedIds; });
  std::unordered_map<std::int64_t, int> numbers;
  std::vector<sim::CrowdSample> samples;
  samples.reserve(lines_.size());
  for (const Line& line : lines_) {
    int id = 0;
    if (small)
      id = static_cast<int>(line.id);
    else
      id = numbers.try_emplace(line.id, static_cast<int>(numbers.size()) + 1).first->second;
    if (id >= kSimulatedIds) return {};
    samples.push_back({line.time, id, line.position_world});
  }
  return samples;
}

std::vector<sim::CrowdSample> CrowdCollector::finish(double frame_rate) {
  if (!problems_.empty() || lines_.empty()) return {};
  const auto earlier = [](const Line& a, const Line& b) { return a.time < b.time; };
  std::stable_sort(lines_.begin(), lines_.end(), earlier);
  if (clock_ == CrowdClock::frames) convert_frames(frame_rate);
  if (!problems_.empty()) return {};
  const double first = lines_.front().time;
  const double duration = lines_.back().time - first;
  if (duration > kLongestRecording) {
    line_ = lines_.back().line;
    refuse(time_name_ + " is " + to_text(duration) + " s after the first one, of line " +
           std::to_string(lines_.front().line) + ": a recording must last at most " +
           to_text(kLongestRecording) + " s");
    return {};
  }
  if (std::abs(first) > kLongestRecording)
    for (Line& line : lines_) line.time -= first;
  check_persons();
  if (!problems_.empty()) return {};
  std::vector<sim::CrowdSample> samples = numbered();
  if (samples.empty()) {
    line_ = 0;
    refuse("holds more than " + std::to_string(kSimulatedIds - 1) + " people");
  }
  return samples;
}

}  // namespace spf
