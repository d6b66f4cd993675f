// Reads a line of trials.jsonl back. Such a file may come from anywhere, so nothing in it is taken on trust.
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

// Limits far above any trial; sums over a million trials stay whole numbers.
constexpr std::size_t kMostRobots = 10'000;
constexpr std::size_t kLongestName = 200;      // bytes
constexpr std::size_t kLongestText = 1 << 20;  // bytes
constexpr int kDeepest = 6;                    // levels of brackets
constexpr double kLongestTime = 1e6;           // [s]
constexpr double kLongestWay = 1e9;            // [m]
constexpr std::int64_t kMostCalls = 1'000'000'000'000;
constexpr std::int64_t kMostContacts = 100'000;
constexpr int kLastBucket = 3000;  // of a histogram: 10^17 s

/// What is wrong with a value, by its key.
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

  [[nodiscard]] double number(double low, double high) const {
    const double value = json_.is_number() ? json_.get<double>() : kNotKnown;
    if (!(value >= low && value <= high)) refuse("must be a number in " + to_text(Range{low, high}));
    return value;
  }
  [[nodiscard]] double number_or_unknown(double low, double high) const {
    return unknown() ? kNotKnown : number(low, high);
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
  [[nodiscard]] int small(std::int64_t low, std::int64_t high) const {
    return static_cast<int>(whole(low, high));
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
  [[nodiscard]] std::string one_of(const std::vector<std::string>& names) const {
    std::string listed;
    for (const std::string& name : names) {
      if (json_.is_string() && json_.get_ref<const std::string&>() == name) return name;
      listed += (listed.empty() ? "" : ", ") + name;
    }
    refuse("must be one of " + listed);
  }
  template <class E>
  [[nodiscard]] E choice() const {
    std::vector<std::string> names;
    for (const auto& entry : EnumNames<E>::values) names.emplace_back(entry.second);
    const std::string name = one_of(names);
    return std::find_if(EnumNames<E>::values.begin(), EnumNames<E>::values.end(),
                        [&name](const auto& entry) { return entry.second == name; })
        ->first;
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
  std::map<int, std::int64_t> buckets;
  std::int64_t left = kMostCalls;
  for (const Field& bucket : field.at("buckets").items(0, kLastBucket + 1)) {
    const std::vector<Field> pair = bucket.items(2, 2);
    const std::int64_t count = pair[1].whole(1, left);
    left -= count;
    buckets[pair[0].small(0, kLastBucket)] += count;
  }
  if (buckets.empty()) return {};
  const double least = field.at("min").number(0.0, 1e9);
  return DurationHistogram::from_buckets(std::move(buckets), least, field.at("max").number(least, 1e9));
}

RobotRecord robot_of(const Field& field) {
  RobotRecord robot;
  robot.arrived = field.at("arrived").flag();
  robot.path_length = field.at("path_length").number(0.0, kLongestWay);
  robot.travel_time = field.at("travel_time").number(0.0, kLongestTime);
  robot.path_length_ratio = field.at("path_length_ratio").number_or_unknown(0.0, kLongestWay);
  robot.travel_time_ratio = field.at("travel_time_ratio").number_or_unknown(0.0, kLongestWay);
  robot.plans = field.at("plans").whole(0, kMostCalls);
  robot.failed_plans = field.at("failed_plans").whole(0, kMostCalls);
  robot.optimiser_calls = field.at("optimiser_calls").whole(0, kMostCalls);
  robot.inner_iterations = field.at("inner_iterations").whole(0, kMostCalls);
  return robot;
}

ContactRecord contact_of(const Field& field, std::int64_t robots) {
  ContactRecord contact;
  contact.time = field.at("time").number(0.0, kLongestTime);
  contact.robot = field.at("robot").small(0, robots - 1);
  contact.with = enum_name(field.at("with").choice<sim::ContactWith>());
  contact.other = field.at("other").small(-1, 1'000'000'000);
  contact.position = {field.at("x").number(-kLongestWay, kLongestWay),
                      field.at("y").number(-kLongestWay, kLongestWay)};
  contact.robot_speed = field.at("robot_speed").number(0.0, kLongestWay);
  contact.other_speed = field.at("other_speed").number(0.0, kLongestWay);
  return contact;
}

CauseRecord cause_of(const Field& field, std::int64_t robots) {
  CauseRecord cause;
  cause.robot = field.at("robot").small(-1, robots - 1);
  cause.last_plan = field.at("last_plan").text(0, kLongestName);
  cause.plan_age = field.at("plan_age").number_or_unknown(0.0, kLongestTime);
  cause.stand_reason = field.at("stand_reason").text(0, kLongestName);
  cause.culprit = field.at("culprit").small(-1, 1'000'000'000);
  return cause;
}

CrossingRecord crossing_of(const Field& record, std::int64_t robots) {
  CrossingRecord crossing;
  crossing.crossings = record.at("crossings").small(0, robots);
  crossing.crossings_ok = record.at("crossings_ok").small(0, crossing.crossings);
  crossing.contacts_moving = record.at("contacts_moving").small(0, kMostContacts);
  crossing.robot_minutes = record.at("robot_minutes").number(0.0, kLongestTime * kMostRobots);
  return crossing;
}

TrialKey key_of(const Field& record) {
  TrialKey key;
  key.family = record.at("family").text(1, kLongestName);
  key.method = record.at("method").text(1, kLongestName);
  key.noise = enum_name(record.at("noise").choice<sim::NoiseModel>());
  key.level = record.at("level").number(0.0, 100.0);
  key.tracking = enum_name(record.at("tracking").choice<sim::TrackingMode>());
  key.seed = record.at("seed").seed();
  key.trial = record.at("trial").small(0, 2'000'000'000);
  if (record.has("condition")) key.condition = record.at("condition").text(0, kLongestName);
  return key;
}

TrialRecord record_of(const Field& field) {
  TrialRecord record;
  record.key = key_of(field);
  for (const Field& robot : field.at("robots").items(1, kMostRobots))
    record.robots.push_back(robot_of(robot));
  const auto robots = static_cast<std::int64_t>(record.robots.size());
  record.outcome = field.at("outcome").choice<sim::TrialOutcome>();
  record.failure = field.at("failure").text(0, kLongestText);
  if (!field.at("contact").unknown()) record.contact = contact_of(field.at("contact"), robots);
  record.contacts = field.at("contacts").small(0, kMostContacts);
  record.hits_while_standing = field.at("hits_while_standing").small(0, kMostContacts);
  record.sim_time = field.at("sim_time").number(0.0, kLongestTime);
  record.dynamic_distance = field.at("dynamic_distance").number_or_unknown(0.0, kLongestWay);
  record.dynamic_clearance = field.at("dynamic_clearance").number_or_unknown(-kLongestWay, kLongestWay);
  record.digest = field.at("digest").hexadecimal(1);
  record.plan_time = histogram_of(field.at("plan_time"));
  record.control_time = histogram_of(field.at("control_time"));
  record.wall_time = field.at("wall_time").number(0.0, 1e9);
  if (field.has("setup")) record.setup = field.at("setup").hexadecimal(0);
  if (field.has("new_plan_time")) record.new_plan_time = histogram_of(field.at("new_plan_time"));
  if (field.has("optimiser_time")) record.optimiser_time = histogram_of(field.at("optimiser_time"));
  if (field.has("wheel_share")) record.wheel_share = field.at("wheel_share").number(0.0, kLongestWay);
  if (field.has("crossings")) record.crossing = crossing_of(field, robots);
  if (field.has("cause")) record.cause = cause_of(field.at("cause"), robots);
  return record;
}

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
    return record_of(Field{json, ""});
  } catch (const FieldRefused& refused) {
    throw refuse(refused.sentence);
  } catch (const nlohmann::json::exception& error) {
    throw refuse(error.what());
  }
}

}  // namespace spf
