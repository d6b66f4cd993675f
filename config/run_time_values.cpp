#include "config/run_time_values.hpp"

#include <algorithm>
#include <optional>
#include <stdexcept>

#include "config/parameter_text.hpp"

namespace spf {
namespace {

std::optional<std::string> run_time_name_of(const std::string& key) {
  for (const auto& [name, of_file] : run_time_keys())
    if (of_file == key) return name;
  return std::nullopt;
}

/// Visits the fields of a file that may change at run time, as `field(name, key, ...)`, and no others.
template <class Field>
class RunTimeVisitor {
 public:
  explicit RunTimeVisitor(Field& field) : field_{field} {}

  template <class Number>
  void operator()(const char* name, Number& value, const char* unit, Range range, const char* what) {
    const std::string key = prefix_ + name;
    if constexpr (std::is_same_v<std::remove_const_t<Number>, double>)
      if (const auto own_name = run_time_name_of(key))
        field_.number(*own_name, key, value, unit, range, what);
  }
  template <class Choice>
  void operator()(const char* name, Choice& value, const char* what) {
    const std::string key = prefix_ + name;
    if constexpr (std::is_enum_v<Choice>)
      if (const auto own_name = run_time_name_of(key)) field_.choice(*own_name, key, value, what);
  }
  template <class... Rest>
  void values(const char* /*name*/, Rest&&... /*rest*/) {}
  template <class Nested>
  void group(const char* name, Nested& nested) {
    const std::string outer = std::exchange(prefix_, prefix_ + name + ".");
    std::remove_const_t<Nested>::visit_fields(nested, *this);
    prefix_ = outer;
  }

 private:
  Field& field_;
  std::string prefix_;
};

struct FieldCollector {
  std::vector<RunTimeField> found;

  void number(const std::string& name, const std::string& key, double value, const char* unit, Range range,
              const char* what) {
    if (key == "robot.max_speed") range.high = std::min(range.high, value);
    found.push_back({name, key, value, range, unit, {}, what});
  }
  template <class Choice>
  void choice(const std::string& name, const std::string& key, Choice value, const char* what) {
    RunTimeField field{name, key, std::string{enum_name(value)}, {0.0, 0.0}, "", {}, what};
    for (const auto& entry : EnumNames<std::remove_const_t<Choice>>::values)
      field.choices.emplace_back(entry.second);
    found.push_back(std::move(field));
  }
};

/// Sets what is asked for; what cannot be is named.
struct FieldSetter {
  const std::map<std::string, RunTimeValue>& values;
  std::string problems;

  void number(const std::string& name, const std::string& key, double& value, const char* unit, Range range,
              const char* /*what*/) {
    const auto asked = values.find(name);
    if (asked == values.end()) return;
    if (key == "robot.max_speed") range.high = std::min(range.high, value);
    const double* wanted = std::get_if<double>(&asked->second);
    if (wanted == nullptr)
      complain(name + " = " + std::get<std::string>(asked->second) + " is no number");
    else if (!range.contains(*wanted))
      complain(name + " = " + to_text(*wanted) + " " + limit_sentence(range, unit));
    else
      value = *wanted;
  }
  template <class Choice>
  void choice(const std::string& name, const std::string& /*key*/, Choice& value, const char* /*what*/) {
    const auto asked = values.find(name);
    if (asked == values.end()) return;
    const std::string* wanted = std::get_if<std::string>(&asked->second);
    for (const auto& [candidate, its_name] : EnumNames<Choice>::values) {
      if (wanted == nullptr || *wanted != its_name) continue;
      value = candidate;
      return;
    }
    complain(name + " = " + (wanted != nullptr ? *wanted : to_text(std::get<double>(asked->second))) +
             " must be one of " + choices_of(value));
  }
  void complain(const std::string& problem) { problems += (problems.empty() ? "" : "; ") + problem; }
};

}  // namespace

const std::vector<std::pair<std::string, std::string>>& run_time_keys() {
  static const std::vector<std::pair<std::string, std::string>> kKeys{
      {"speed_limit", "robot.max_speed"},
      {"heading_mode", "agent.heading_mode"},
      {"goal_tolerance", "agent.team.goal_tolerance"},
      {"goal_heading_tolerance", "host.goal_heading_tolerance"},
      {"goal_patience", "host.goal_patience"},
      {"path_clearance", "agent.guide.clearance"}};
  return kKeys;
}

std::vector<RunTimeField> run_time_fields(const RobotFile& file) {
  FieldCollector collector;
  RobotFile::visit_fields(file, RunTimeVisitor<FieldCollector>{collector});
  return std::move(collector.found);
}

RobotFile with_run_time_values(const RobotFile& file, const std::map<std::string, RunTimeValue>& values) {
  RobotFile changed = file;
  FieldSetter setter{values, ""};
  const auto& keys = run_time_keys();
  for (const auto& [name, value] : values) {
    const bool known = std::any_of(keys.begin(), keys.end(),
                                   [&wanted = name](const auto& entry) { return entry.first == wanted; });
    if (!known) setter.complain(name + " cannot be changed at run time");
  }
  RobotFile::visit_fields(changed, RunTimeVisitor<FieldSetter>{setter});
  if (!setter.problems.empty()) throw std::invalid_argument{setter.problems};
  const double limit = std::exchange(changed.robot.max_speed, file.robot.max_speed);
  const AgentParameters slowed = slowed_to(agent_parameters(changed), limit);
  changed.robot = slowed.robot;
  changed.agent.planner = slowed.planner;
  return changed;
}

}  // namespace spf
