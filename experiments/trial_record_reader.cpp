// Reads a line of trials.jsonl back. Such a file may come from anywhere, so every value is checked.
#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "config/input_problem.hpp"
#include "config/parameter_text.hpp"
#include "experiments/trial_record.hpp"
#include "sim/trial_result.hpp"
#include "study/scenario_file.hpp"

namespace spf {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kDeepest = 6;        // levels of brackets
constexpr int kLastBucket = 3000;  // of a histogram: 10^17 s

/// A problem with a value, by its key.
struct FieldRefused {
  std::string sentence;
};

std::string shown(const Json& value) {
  constexpr std::size_t kLongest = 60;
  if (value.is_structured()) return value.is_array() ? "[...]" : "{...}";
  const std::string text = value.dump(-1, ' ', true, Json::error_handler_t::replace);
  return text.size() <= kLongest ? text : text.substr(0, kLongest) + "...";
}

/// One value of a record, under its key.
class Field {
 public:
  Field(const Json& json, std::string key) : json_{json}, key_{std::move(key)} {}

  [[nodiscard]] bool has(const char* name) const { return json_.is_object() && json_.contains(name); }
  [[nodiscard]] Field at(const char* name) const {
    if (!json_.is_object()) refuse("must be an object");
    const auto found = json_.find(name);
    if (found == json_.end()) throw FieldRefused{key_of(name) + " is missing"};
    return {*found, key_of(name)};
  }
  [[nodiscard]] std::vector<Field> items(std::size_t least, std::size_t most) const {
    if (!json_.is_array() || json_.size() < least || json_.size() > most)
      refuse("must be a list of " + std::to_string(least) + " to " + std::to_string(most) + " values");
    std::vector<Field> all;
    for (std::size_t i = 0; i < json_.size(); ++i)
      all.emplace_back(json_[i], key_ + "[" + std::to_string(i) + "]");
    return all;
  }
  [[nodiscard]] bool unknown() const { return json_.is_null(); }

  [[nodiscard]] double number(Range range) const {
    const double value = json_.is_number() ? json_.get<double>() : kNotKnown;
    if (!range.contains(value)) refuse("must be a number in " + to_text(range));
    return value;
  }
  [[nodiscard]] std::int64_t whole(std::int64_t low, std::int64_t high) const {
    const bool fits = json_.is_number_unsigned()
                          ? json_.get<std::uint64_t>() <= static_cast<std::uint64_t>(high)
                          : json_.is_number_integer();
    const std::int64_t value = fits ? json_.get<std::int64_t>() : low - 1;
    if (value < low || value > high)
      refuse("must be a whole number in [" + std::to_string(low) + ", " + std::to_string(high) + "]");
    return value;
  }
  [[nodiscard]] std::uint64_t seed() const {
    if (!json_.is_number_unsigned()) refuse("must be a whole number of at least 0");
    return json_.get<std::uint64_t>();
  }
  [[nodiscard]] bool flag() const {
    if (!json_.is_boolean()) refuse("must be true or false");
    return json_.get<bool>();
  }
  [[nodiscard]] std::string text(std::size_t least, std::size_t most) const {
    if (!json_.is_string() || json_.get_ref<const std::string&>().size() < least ||
        json_.get_ref<const std::string&>().size() > most)
      refuse("must be text of " + std::to_string(least) + " to " + std::to_string(most) + " bytes");
    return json_.get<std::string>();
  }
  template <class E>
  [[nodiscard]] E choice() const {
    std::string listed;
    for (const auto& [value, name] : EnumNames<E>::values) {
      if (json_.is_string() && json_.get_ref<const std::string&>() == name) return value;
      listed += (listed.empty() ? "" : ", ") + std::string{name};
    }
    refuse("must be one of " + listed);
  }
  /// Up to 16 digits of a hash.
  [[nodiscard]] std::string hexadecimal(std::size_t least) const {
    const std::string digits = text(least, 16);
    if (digits.find_first_not_of("0123456789abcdef") != std::string::npos)
      refuse("must be hexadecimal digits");
    return digits;
  }

 private:
  [[nodiscard]] std::string key_of(const char* name) const { return key_.empty() ? name : key_ + "." + name; }
  [[noreturn]] void refuse(const std::string& sentence) const {
    throw FieldRefused{(key_.empty() ? "the line" : key_ + " = " + shown(json_)) + " " + sentence};
  }

  const Json& json_;
  std::string key_;
};

DurationHistogram histogram_of(const Field& field) {
  constexpr Range kDuration{0.0, 1e9};
  std::map<int, std::int64_t> buckets;
  std::int64_t left = record_limits::kMostCalls;
  for (const Field& bucket : field.at("buckets").items(0, kLastBucket + 1)) {
    const std::vector<Field> pair = bucket.items(2, 2);
    const std::int64_t count = pair[1].whole(1, left);
    left -= count;
    buckets[static_cast<int>(pair[0].whole(0, kLastBucket))] += count;
  }
  if (buckets.empty()) return {};
  const double least = field.at("min").number(kDuration);
  return DurationHistogram::from_buckets(std::move(buckets), least,
                                         field.at("max").number({least, kDuration.high}));
}

/// Visitor that reads one object.
class RecordReader {
 public:
  /// `line` is the whole record, which knows the number of robots.
  RecordReader(const Field& field, const Field& line) : field_{field}, line_{line} {}

  void number(const char* key, double& value, Range range) const { value = field_.at(key).number(range); }
  void maybe_number(const char* key, double& value, Range range) const {
    const Field field = field_.at(key);
    value = field.unknown() ? kNotKnown : field.number(range);
  }
  template <class Whole>
  void whole(const char* key, Whole& value, std::int64_t low, std::int64_t high) const {
    value = static_cast<Whole>(field_.at(key).whole(low, high));
  }
  void robot(const char* key, int& value, int least) const { whole(key, value, least, robots() - 1); }
  void robot_count(const char* key, int& value) const { whole(key, value, 0, robots()); }
  void seed(const char* key, std::uint64_t& value) const { value = field_.at(key).seed(); }
  void flag(const char* key, bool& value) const { value = field_.at(key).flag(); }
  void text(const char* key, std::string& value, std::size_t least, std::size_t most) const {
    value = field_.at(key).text(least, most);
  }
  void digits(const char* key, std::string& value, std::size_t least) const {
    value = field_.at(key).hexadecimal(least);
  }
  template <class E>
  void choice(const char* key, E& value) const {
    value = field_.at(key).choice<E>();
  }
  template <class E>
  void name(const char* key, std::string& value) const {
    value = enum_name(field_.at(key).choice<E>());
  }
  void histogram(const char* key, DurationHistogram& value) const { value = histogram_of(field_.at(key)); }
  template <class Struct>
  void list(const char* key, std::vector<Struct>& values, std::size_t least, std::size_t most) const {
    for (const Field& item : field_.at(key).items(least, most)) read(item, values.emplace_back());
  }
  template <class Struct>
  void object(const char* key, std::optional<Struct>& value) const {
    read(field_.at(key), value.emplace());
  }
  template <class Struct>
  void object_or_null(const char* key, std::optional<Struct>& value) const {
    if (!field_.at(key).unknown()) object(key, value);
  }
  template <class Struct>
  void part(std::optional<Struct>& value) const {
    Struct::visit_fields(value.emplace(), *this);
  }
  [[nodiscard]] bool present(const char* key, bool /*condition*/) const { return field_.has(key); }

 private:
  [[nodiscard]] std::int64_t robots() const {
    return static_cast<std::int64_t>(line_.at("robots").items(1, record_limits::kMostRobots).size());
  }
  template <class Struct>
  void read(const Field& field, Struct& value) const {
    Struct::visit_fields(value, RecordReader{field, line_});
  }

  const Field& field_;
  const Field& line_;
};

}  // namespace

TrialRecord trial_record_from_json(const std::string& text, const std::string& source, int line) {
  const auto refuse = [&](const std::string& why) {
    return InputError{{source, line, 0}, "is no line of trial results: " + why};
  };
  try {
    const auto shallow = [](int depth, Json::parse_event_t, const Json&) {
      if (depth > kDeepest)
        throw FieldRefused{"is nested deeper than " + std::to_string(kDeepest) + " levels"};
      return true;
    };
    const Json json = Json::parse(text, shallow);
    const Field field{json, ""};
    TrialRecord record;
    TrialRecord::visit_fields(record, RecordReader{field, field});
    return record;
  } catch (const FieldRefused& refused) {
    throw refuse(refused.sentence);
  } catch (const nlohmann::json::exception& error) {
    throw refuse(error.what());
  }
}

}  // namespace spf
