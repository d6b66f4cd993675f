#include "study/crowd_formats.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "config/number_text.hpp"

namespace spf {
namespace {

constexpr double kFarthestPerson = 1e5;  // [m]
constexpr double kLatest = 1e11;         // [s] since any epoch
constexpr double kLatestFrame = 1e12;    // [1]
constexpr std::size_t kMostColumns = 100;
constexpr std::size_t kLongestJson = 1000;  // bytes of a line, which bounds its depth too
constexpr std::string_view kBlanks = " \t\r";

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

/// At most `most` fields, and one more when there are more.
std::vector<std::string_view> fields_of(std::string_view line, char separator, std::size_t most) {
  std::vector<std::string_view> fields;
  while (true) {
    const std::size_t end = line.find(separator);
    fields.push_back(trimmed(line.substr(0, end)));
    if (end == std::string_view::npos || fields.size() > most) return fields;
    line.remove_prefix(end + 1);
  }
}

/// Likewise of what stands between blanks.
std::vector<std::string_view> words_of(std::string_view line, std::size_t most) {
  std::vector<std::string_view> words;
  for (line = trimmed(line); !line.empty() && words.size() <= most; line = trimmed(line)) {
    const std::size_t end = std::min(line.find_first_of(kBlanks), line.size());
    words.push_back(line.substr(0, end));
    line.remove_prefix(end);
  }
  return words;
}

/// What a column may be called, our own name first.
struct Column {
  std::array<std::string_view, 10> names;
};
constexpr Column kSeconds{{"t_s", "time_s", "timestamp_s", "time", "t", "timestamp"}};
constexpr Column kMilliseconds{{"t_ms", "time_ms", "timestamp_ms"}};
constexpr Column kFrame{{"frame", "frame_id", "frame_number"}};
constexpr Column kPerson{
    {"agent_id", "person_id", "pedestrian_id", "ped_id", "track_id", "person", "pedestrian", "id"}};
constexpr Column kX{{"x_m", "x", "pos_x", "position_x"}};
constexpr Column kY{{"y_m", "y", "pos_y", "position_y"}};

/// Columns with names in the first line, in any order; others are ignored.
class NamedColumns : public CrowdFormat {
 public:
  bool read(std::string_view line, CrowdCollector& collector) override {
    if (names_.empty()) return read_names(line, collector);
    if (trimmed(line).empty()) return true;
    const std::vector<std::string_view> fields = fields_of(line, separator_, names_.size());
    if (fields.size() != names_.size()) {
      collector.refuse("has " +
                       (fields.size() > names_.size() ? std::string{"more"} : std::to_string(fields.size())) +
                       " values, but the first line names " + std::to_string(names_.size()) + " columns");
      return true;
    }
    double when = 0.0;
    double x = 0.0;
    double y = 0.0;
    std::int64_t id = 0;
    bool good = collector.read(names_[time_], fields[time_], unit_, limit_, when);
    good = collector.read(names_[x_], fields[x_], "m", kFarthestPerson, x) && good;
    good = collector.read(names_[y_], fields[y_], "m", kFarthestPerson, y) && good;
    good = collector.read(names_[id_], fields[id_], id) && good;
    if (good) collector.add(when * factor_, id, {x, y});
    return true;
  }

 private:
  /// The index of a column, by the first of its names that there is.
  [[nodiscard]] std::optional<std::size_t> find(const Column& column) const {
    for (const std::string_view name : column.names) {
      const auto found = name.empty() ? names_.end() : std::find(names_.begin(), names_.end(), name);
      if (found != names_.end()) return static_cast<std::size_t>(found - names_.begin());
    }
    return std::nullopt;
  }

  bool read_names(std::string_view line, CrowdCollector& collector) {
    for (const char separator : {'\t', ';', ','})
      if (line.find(separator) != std::string_view::npos) separator_ = separator;
    const std::vector<std::string_view> names = fields_of(line, separator_, kMostColumns);
    for (const std::string_view name : names) {
      std::string& lower = names_.emplace_back(name);
      std::transform(lower.begin(), lower.end(), lower.begin(),
                     [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    }
    bool complete = names.size() <= kMostColumns;
    if (!complete) collector.refuse("names more than " + std::to_string(kMostColumns) + " columns");
    const auto require = [&](const std::optional<std::size_t>& column, std::string_view name,
                             std::size_t& kept) {
      if (column) {
        kept = *column;
        return;
      }
      collector.refuse("the column " + std::string{name} +
                       " is missing: the first line must name t_s, agent_id, x_m and y_m");
      complete = false;
    };
    require(find_time(collector), kSeconds.names[0], time_);
    require(find(kPerson), kPerson.names[0], id_);
    require(find(kX), kX.names[0], x_);
    require(find(kY), kY.names[0], y_);
    if (complete) collector.name_columns(names_[time_], names_[id_]);
    return complete;
  }

  std::optional<std::size_t> find_time(CrowdCollector& collector) {
    if (const auto seconds = find(kSeconds)) return seconds;
    if (const auto milliseconds = find(kMilliseconds)) {
      unit_ = "ms";
      factor_ = 1e-3;
      limit_ = kLatest / factor_;
      return milliseconds;
    }
    const auto frame = find(kFrame);
    if (!frame) return std::nullopt;
    collector.set_clock(CrowdClock::frames);
    unit_ = "";
    limit_ = kLatestFrame;
    return frame;
  }

  std::vector<std::string> names_;  // in lower case
  char separator_ = ',';
  std::size_t time_ = 0, id_ = 0, x_ = 0, y_ = 0;  // their columns
  const char* unit_ = "s";
  double factor_ = 1.0;  // of times, to seconds
  double limit_ = kLatest;
};

/// Numbers between blanks: frame, person, x, height, y and three of the velocity (obsmat), or frame, person,
/// x, y.
class NumberColumns : public CrowdFormat {
 public:
  bool read(std::string_view line, CrowdCollector& collector) override {
    const std::vector<std::string_view> words = words_of(line, kObsmat);
    if (words.empty()) return true;
    if (columns_ == 0) begin(words.size(), collector);
    if (words.size() != columns_ || (columns_ != kObsmat && columns_ != kPlain)) {
      collector.refuse("has " +
                       (words.size() > kObsmat ? std::string{"more"} : std::to_string(words.size())) +
                       " numbers: must have 8 (frame, id, x, z, y, vx, vz, vy) or 4 (frame, id, x, y), the "
                       "same in all lines");
      return true;
    }
    double frame = 0.0;
    double x = 0.0;
    double y = 0.0;
    std::int64_t id = 0;
    bool good = collector.read("frame", words[0], "", kLatestFrame, frame);
    good = collector.read("id", words[1], id) && good;
    good = collector.read("x", words[2], "m", kFarthestPerson, x) && good;
    good = collector.read("y", words[columns_ == kObsmat ? 4 : 3], "m", kFarthestPerson, y) && good;
    if (good) collector.add(frame, id, {x, y});
    return true;
  }

 private:
  static constexpr std::size_t kObsmat = 8;
  static constexpr std::size_t kPlain = 4;

  void begin(std::size_t columns, CrowdCollector& collector) {
    columns_ = columns;
    collector.set_clock(CrowdClock::frames);
    collector.name_columns("frame", "id");
  }

  std::size_t columns_ = 0;  // of the first line
};

/// TrajNet++: a JSON object a line, a scene or a sample of a track. Samples that are predictions are left
/// out.
class TrajnetLines : public CrowdFormat {
 public:
  TrajnetLines() = default;

  bool read(std::string_view line, CrowdCollector& collector) override {
    if (trimmed(line).empty()) return true;
    collector.set_clock(CrowdClock::frames);
    collector.name_columns("f", "p");
    if (line.size() > kLongestJson) {
      collector.refuse("is longer than " + std::to_string(kLongestJson) + " bytes");
      return true;
    }
    const Json json = Json::parse(line, nullptr, false);
    if (!json.is_object())
      collector.refuse("is no JSON object");
    else if (const auto track = json.find("track"); track != json.end() && track->is_object())
      read_track(*track, collector);
    else if (const auto scene = json.find("scene"); scene != json.end() && scene->is_object())
      read_scene(*scene, collector);
    else
      collector.refuse("must hold a scene or a track");
    return true;
  }

 private:
  using Json = nlohmann::json;

  static bool number(const Json& object, const char* key, double limit, CrowdCollector& collector,
                     double& value) {
    const auto found = object.find(key);
    if (found == object.end()) {
      collector.refuse(std::string{key} + " is missing");
      return false;
    }
    value = found->is_number() ? found->get<double>() : NAN;
    if (std::abs(value) <= limit) return true;
    collector.refuse(std::string{key} + " = " + found->dump().substr(0, 60) + " must be a number in [" +
                     Json(-limit).dump() + ", " + Json(limit).dump() + "]");
    return false;
  }

  static void read_track(const Json& track, CrowdCollector& collector) {
    for (const char* key : {"pred_number", "prediction_number"})
      if (const auto found = track.find(key); found != track.end() && !found->is_null()) return;
    double frame = 0.0;
    double person = 0.0;
    double x = 0.0;
    double y = 0.0;
    bool good = number(track, "f", kLatestFrame, collector, frame);
    good = number(track, "p", static_cast<double>(CrowdCollector::kLargestId), collector, person) && good;
    good = number(track, "x", kFarthestPerson, collector, x) && good;
    good = number(track, "y", kFarthestPerson, collector, y) && good;
    if (!good) return;
    if (person < 0.0 || person != std::floor(person))
      return collector.refuse("p = " + Json(person).dump() + " must be a whole number of at least 0");
    collector.add(frame, static_cast<std::int64_t>(person), {x, y});
  }

  static void read_scene(const Json& scene, CrowdCollector& collector) {
    constexpr double kFastestRate = 1000.0;  // [1/s]
    double rate = 0.0;
    if (scene.find("fps") == scene.end() || !number(scene, "fps", kFastestRate, collector, rate)) return;
    if (rate > 0.0)
      collector.set_sample_rate(rate);
    else
      collector.refuse("fps = " + Json(rate).dump() + " must be above 0");
  }
};

}  // namespace

std::unique_ptr<CrowdFormat> crowd_format_of(std::string_view first_line) {
  if (trimmed(first_line).starts_with('{')) return std::make_unique<TrajnetLines>();
  const std::vector<std::string_view> words = words_of(first_line, 1);
  const bool begins_with_number = !words.empty() && read_number(words[0]).used == words[0].size();
  if (begins_with_number && words.size() > 1 && first_line.find_first_of(",;") == std::string_view::npos)
    return std::make_unique<NumberColumns>();
  return std::make_unique<NamedColumns>();
}

}  // namespace spf
